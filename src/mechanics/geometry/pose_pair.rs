//! Derivatives of what depends on two poses by their vectors: of joints' conditions and of what springs measure.
//!
//! Nearly all of it is made of scalar products of those vectors, whose second derivatives are scalars times the
//! identity. What is not, angles and lengths, adds products of first derivatives.

use super::pose::VECTORS;
use nalgebra::SMatrix;

/// One vector for each vector of two poses, as columns: side a, then side b.
pub type PairVector = SMatrix<f64, 3, PAIR>;

/// Vectors of two poses.
const PAIR: usize = 2 * VECTORS;

/// Second derivatives by the vectors of two poses: `scalars_ij I + Σ weights_kl vector_k,i vector_l,jᵀ`; both are
/// symmetric.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PairHessian {
    /// Of scalar products.
    pub scalars: SMatrix<f64, PAIR, PAIR>,
    /// First derivatives whose products come in.
    pub vectors: [PairVector; 2],
    /// Of the products of the first one, of both, of the second one.
    pub weights: [f64; 3],
}

impl PairHessian {
    /// Adds `factor` times the second derivative of the scalar product of two different vectors, or half of that of the
    /// square of one.
    pub fn add_product(&mut self, one: usize, other: usize, factor: f64) {
        self.scalars[(one, other)] += factor;
        if one != other {
            self.scalars[(other, one)] += factor;
        }
    }

    /// Sets the products of first derivatives; there are none yet.
    pub fn set_products(&mut self, vectors: [PairVector; 2], weights: [f64; 3]) {
        debug_assert!(!self.has_products(), "one angle or length a joint");
        (self.vectors, self.weights) = (vectors, weights);
    }

    /// Adds to the weights of the products of first derivatives that are set.
    pub fn add_weights(&mut self, weights: [f64; 3]) {
        self.weights.iter_mut().zip(weights).for_each(|(own, weight)| *own += weight);
    }

    /// Whether there are products of first derivatives.
    pub fn has_products(&self) -> bool {
        self.weights != [0.0; 3]
    }

    /// Its product with a change of both poses.
    pub fn times(&self, change: &PairVector) -> PairVector {
        let mut sum = change * self.scalars;
        if self.has_products() {
            let [first, both, second] = self.weights;
            let along = self.vectors.each_ref().map(|vector| vector.dot(change));
            sum += self.vectors[0] * (first * along[0] + both * along[1]);
            sum += self.vectors[1] * (both * along[0] + second * along[1]);
        }
        sum
    }
}
