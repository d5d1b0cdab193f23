//! The softest motions that the constraints allow: block inverse iteration `[A Gᵀ; G 0][y; ·] = [M x; 0]` with
//! Rayleigh-Ritz in the inner product of the mass. `A` is the stiffness, or the stiffness and a share of the mass; only
//! its factorization is asked for.
//!
//! The vectors stay a block, so that motions of one frequency come out together, as many as there are.

use crate::mechanics::system::System;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::{Singular, irregular};
use crate::solve::newton::kkt::Kkt;
use nalgebra::{DMatrix, SymmetricEigen};

/// A vector of which less than this share is left when the others are taken out of it was made of them: only round-off
/// is left.
const DEPENDENT: f64 = 1e-13;

/// One vector of the block after a sweep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ritz {
    /// `xᵀ M A⁻¹ M x`, s²: one over the eigenvalue of `A`.
    pub inverse: f64,
    /// How far `A⁻¹ M x` was from being along `x`, in the norm of the mass, as a share.
    pub error: f64,
}

/// A block of vectors, orthonormal in the mass.
#[derive(Clone, Debug, Default)]
pub struct Subspace {
    vectors: Vec<Vec<f64>>,
    /// `M` times each.
    masses: Vec<Vec<f64>>,
}

impl Subspace {
    /// `count` vectors without pattern; the first sweep makes them motions that the constraints allow, and its numbers
    /// mean nothing.
    pub fn new(system: &System, mass: MassAt, count: usize) -> Self {
        let odd = |vector: usize, index: usize| irregular((2 * vector + 1) * index + vector) - 1.0;
        let vectors = (0..count).map(|vector| (0..system.coordinates()).map(|index| odd(vector, index)).collect());
        let mut block = Self::default();
        vectors.for_each(|vector| block.take(system, mass, vector));
        block
    }

    /// The vectors, those of the largest `|inverse|` first.
    pub fn vectors(&self) -> &[Vec<f64>] {
        &self.vectors
    }

    /// Takes every vector once through the inverse, with the factorization that `kkt` has, and sorts the motions out. A
    /// block of more vectors than there are motions loses those in excess.
    ///
    /// # Errors
    /// The factorization gives no accurate solutions; the block is as it was.
    pub fn sweep(&mut self, system: &System, mass: MassAt, kkt: &mut Kkt) -> Result<Vec<Ritz>, Singular> {
        let (coordinates, count) = (system.coordinates(), self.vectors.len());
        let mut images = Vec::with_capacity(count);
        for momentum in &self.masses {
            let mut image = momentum.clone();
            image.resize(coordinates + system.constraints(), 0.0);
            kkt.solve_again(&mut image)?;
            image.truncate(coordinates);
            images.push(image);
        }
        if count == 0 {
            return Ok(Vec::new());
        }
        let product = DMatrix::from_fn(count, count, |i, j| dot(&self.masses[i], &images[j]));
        if product.iter().any(|value| !value.is_finite()) {
            return Err(Singular);
        }
        let eigen = SymmetricEigen::new((&product + product.transpose()) * 0.5);
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|a, b| eigen.eigenvalues[*b].abs().total_cmp(&eigen.eigenvalues[*a].abs()));
        let before = std::mem::take(self);
        let mut outcome = Vec::with_capacity(count);
        for own in order {
            let weights = eigen.eigenvectors.column(own);
            let inverse = eigen.eigenvalues[own];
            let mixed = |vectors: &[Vec<f64>]| combination(vectors, weights.as_slice());
            let image = mixed(&images);
            let strayed: Vec<f64> =
                image.iter().zip(mixed(&before.vectors)).map(|(image, x)| image - inverse * x).collect();
            let mut momentum = vec![0.0; coordinates];
            system.mass_times(mass, &strayed, &mut momentum);
            let error = dot(&strayed, &momentum).max(0.0).sqrt() / inverse.abs();
            let held = self.vectors.len();
            self.take(system, mass, image);
            if self.vectors.len() > held {
                outcome.push(Ritz { inverse, error });
            }
        }
        Ok(outcome)
    }

    /// Adds `vector`, made orthonormal to the others, unless it is made of them.
    fn take(&mut self, system: &System, at: MassAt, mut vector: Vec<f64>) {
        let mut mass = vec![0.0; vector.len()];
        system.mass_times(at, &vector, &mut mass);
        let whole = dot(&vector, &mass);
        // Twice: what the first time leaves by round-off is gone after the second.
        for _ in 0..2 {
            for (other, other_mass) in self.vectors.iter().zip(&self.masses) {
                let share = dot(&vector, other_mass);
                vector.iter_mut().zip(other).for_each(|(value, other)| *value -= share * other);
            }
        }
        system.mass_times(at, &vector, &mut mass);
        let left = dot(&vector, &mass);
        if left > DEPENDENT * DEPENDENT * whole {
            let scale = 1.0 / left.sqrt();
            vector.iter_mut().chain(&mut mass).for_each(|value| *value *= scale);
            self.vectors.push(vector);
            self.masses.push(mass);
        }
    }
}

/// `Σ_k weight_k vector_k`.
pub fn combination(vectors: &[Vec<f64>], weights: &[f64]) -> Vec<f64> {
    let mut sum = vec![0.0; vectors.first().map_or(0, Vec::len)];
    for (vector, weight) in vectors.iter().zip(weights) {
        sum.iter_mut().zip(vector).for_each(|(sum, value)| *sum += weight * value);
    }
    sum
}

/// `a·b`.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
