//! Quadratic twist: `α += 4 b ξ (1 − ξ)` with one internal coordinate `b` an element, which has no mass and stands
//! where `∂U/∂b = 0` (MECHANICS 5.3). It makes the twist of order 4 where the torque changes along the beam.
//!
//! `b` is found anew from 0 at every evaluation: it is a function of the coordinates, no state. The gradient by the
//! coordinates is the one at `b` held; the Hessian is condensed, `U_qq − U_qb U_qbᵀ / U_bb`. The total twist and the
//! mean torsion of the axial points do not change with `b`.

use crate::mechanics::beam::ancf14::coordinates::{ElementVector, spread};
use crate::mechanics::beam::ancf14::element::Evaluation;
use crate::mechanics::beam::ancf14::kinematics::corotated::{CorotatedMatrix, CorotatedVector};
use crate::mechanics::beam::ancf14::kinematics::points::BendingPoint;
use crate::mechanics::beam::ancf14::kinematics::strain_derivatives::{Couplings, Forces, Gradients, PointCouplings};
use crate::mechanics::beam::ancf14::strain::Rigidities;

/// How the twist runs inside an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Twist {
    /// `theta` and the twist rate of the carried frame alone: the paper's.
    Linear,
    /// With the internal coordinate `b`.
    Quadratic,
}

/// Newton ends at a correction below this, rad: the next one would be its square.
const TOLERANCE: f64 = 1e-8;
/// Largest correction, rad: far from the solution the section must not turn over.
const LARGEST_CORRECTION: f64 = 0.5;
/// More corrections than this mean that there is no solution near 0.
const MOST_ITERATIONS: usize = 50;
/// Smallest stiffness by `b`, relative to that of torsion alone, with which a correction is still Newton's.
const SOFTEST: f64 = 1e-6;

/// `∂α/∂b` at the place `xi`, 1.
pub fn shape(xi: f64) -> f64 {
    4.0 * xi * (1.0 - xi)
}

/// `∂²α/∂b∂ξ` at the place `xi`, 1.
pub fn shape_xi(xi: f64) -> f64 {
    4.0 * (1.0 - 2.0 * xi)
}

/// Brings `evaluation` to the `b` at which `∂U/∂b = 0`, from 0; where there is none nearby, to not-a-number.
pub fn relax(evaluation: &mut Evaluation) {
    let torsion = torsion_stiffness(evaluation);
    for _ in 0..MOST_ITERATIONS {
        let (force, stiffness) = derivatives(evaluation);
        // Towards a minimum, never to a maximum.
        let divisor = if stiffness > SOFTEST * torsion { stiffness } else { torsion };
        let correction = (-force / divisor).clamp(-LARGEST_CORRECTION, LARGEST_CORRECTION);
        if correction.abs() < TOLERANCE {
            evaluation.correct_bubble(correction);
            return;
        }
        evaluation.set_bubble(evaluation.bubble + correction);
    }
    evaluation.set_bubble(f64::NAN);
}

/// `(∂U/∂b, ∂²U/∂b²)`, J and J.
fn derivatives(evaluation: &Evaluation) -> (f64, f64) {
    let (mut force, mut stiffness) = (0.0, 0.0);
    for (g, point) in evaluation.element.bending.iter().enumerate() {
        let ([n1, n2, torque, _], rigidities) = (evaluation.resultants(g).into(), evaluation.rigidities(g));
        let ([gamma1, gamma2], turn) = (evaluation.gammahat[g], shape(point.xi));
        let [g1_b, g2_b, tau_b] = [gamma2 * turn, -gamma1 * turn, shape_xi(point.xi) * point.torsion_by_twist];
        let ([d11, d22], [d1t, d2t]) = (rigidities.bending, rigidities.with_torsion);
        force += n1 * g1_b + n2 * g2_b + torque * tau_b;
        stiffness += d11 * g1_b * g1_b
            + d22 * g2_b * g2_b
            + rigidities.torsion * tau_b * tau_b
            + 2.0 * (rigidities.cross * g1_b * g2_b + (d1t * g1_b + d2t * g2_b) * tau_b)
            - (n1 * gamma1 + n2 * gamma2) * turn * turn;
    }
    (force, stiffness)
}

impl Evaluation<'_> {
    /// `∂b/∂q` of the internal coordinate of the quadratic twist, 14×1; 0 for linear twist.
    pub fn bubble_q(&self) -> ElementVector {
        match self.element.stiffness.twist {
            Twist::Linear => ElementVector::zeros(),
            Twist::Quadratic => {
                let resultants = [self.resultants(0), self.resultants(1), self.resultants(2)];
                let rigidities = [self.rigidities(0), self.rigidities(1), self.rigidities(2)];
                let gradients = Gradients::new(self.element, &self.kinematics);
                // Torques of the axial points do not change with `b`.
                let couplings = Couplings::new(self, &resultants, &rigidities, 0.0);
                Condensation::new(self, &gradients, &couplings, &rigidities).bubble_q(self)
            }
        }
    }
}

/// What Saint-Venant torsion alone gives to `∂²U/∂b²`, J.
fn torsion_stiffness(evaluation: &Evaluation) -> f64 {
    let of_point = |point: &BendingPoint| {
        point.stiffness.torsion * point.weight * (shape_xi(point.xi) * point.torsion_by_twist).powi(2)
    };
    evaluation.element.bending.iter().map(of_point).sum()
}

/// Second derivatives of the energy by `b` and everything else: what is condensed.
#[derive(Clone, Copy, Debug)]
pub struct Condensation {
    /// `∂²U/∂x∂b` by the corotated shape.
    pub by_shape: CorotatedVector,
    /// `∂²U/∂b²`, J.
    pub by_b: f64,
    /// `∂²U/∂e∂b` by the strain of each axial point, J; 0 for small strain with the tension center on the axis.
    pub by_axial: [f64; 3],
}

impl Condensation {
    /// At the configuration of `evaluation`, with the second derivatives there.
    pub fn new(
        evaluation: &Evaluation,
        gradients: &Gradients,
        couplings: &Couplings,
        rigidities: &[Rigidities; 3],
    ) -> Self {
        let (mut forces, mut by_b, mut by_axial) = (Forces::default(), 0.0, [0.0; 3]);
        for (g, point) in evaluation.element.bending.iter().enumerate() {
            let ([gamma1, gamma2], [with_1, with_2]) = (evaluation.gammahat[g], rigidities[g].with_axial);
            let bent = (with_1 * gamma2 - with_2 * gamma1) * shape(point.xi);
            // `b` is a part of `α` and, as `T` is, of the torsion.
            let PointCouplings { own: [by_1, by_2, by_alpha], twist } = couplings.points[g];
            let (turn, twist_b) = (shape(point.xi), shape_xi(point.xi));
            let torsion = rigidities[g].torsion * point.torsion_by_twist * point.torsion_by_twist * twist_b;
            forces.curvatures[g] = [by_1[2] * turn + twist[0] * twist_b, by_2[2] * turn + twist[1] * twist_b];
            forces.alpha[g] = by_alpha[2] * turn + twist[2] * twist_b;
            forces.twist += twist[2] * turn + torsion;
            by_b += forces.alpha[g] * turn + (twist[2] * turn + torsion) * twist_b;
            for (sum, share) in by_axial.iter_mut().zip(point.from_axial) {
                *sum += bent * share;
            }
        }
        Self { by_shape: gradients.sum(&forces), by_b, by_axial }
    }

    /// `∂b/∂q`, 14×1: how `b` follows the coordinates.
    pub fn bubble_q(&self, evaluation: &Evaluation) -> ElementVector {
        let strain = evaluation.element.stiffness.strain;
        let mut by_q = evaluation.kinematics.shape.gradient(&self.by_shape);
        for (m, point) in evaluation.element.axial.iter().enumerate() {
            by_q += spread(&point.shape_x, &(evaluation.slopes[m].strain_p(strain) * self.by_axial[m]));
        }
        -by_q / self.by_b
    }

    /// Applies the static condensation of `b` to `by`, the derivatives with respect to the corotated coordinates of a
    /// quantity that changes by `share` with `b`.
    #[inline]
    pub fn condense_row(&self, share: f64, by: &mut CorotatedVector) {
        let factor = share / self.by_b;
        by.iter_mut().zip(&self.by_shape).for_each(|(by, by_shape)| *by -= by_shape * factor);
    }

    /// Applies the static condensation of `b` to `second`, the second derivatives with respect to the corotated
    /// coordinates.
    pub fn condense(&self, second: &mut CorotatedMatrix) {
        for (column, by_shape) in second.iter_mut().zip(self.by_shape) {
            self.condense_row(by_shape, column);
        }
    }
}
