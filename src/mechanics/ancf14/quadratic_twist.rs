//! Quadratic twist: `α += 4 b ξ (1 − ξ)` with one internal coordinate `b` an element, which has no mass and stands where
//! `∂U/∂b = 0` (MECHANICS 5.3). It makes the twist of order 4 where the torque changes along the beam.
//!
//! `b` is found anew from 0 at every evaluation: it is a function of the coordinates, no state. The gradient by the coordinates
//! is the one at `b` held; the Hessian is condensed, `U_qq − U_qb U_qbᵀ / U_bb`. The total twist and the mean torsion of the axial
//! points do not change with `b`.

use super::coordinates::{ElementColumns, ElementVector, spread};
use super::element::Evaluation;
use super::pullback::Gradients;
use super::relative::RelativeVector;
use super::strain::{Resultants, Rigidities, Strains};

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
        evaluation.set_bubble(evaluation.bubble + correction);
        if correction.abs() < TOLERANCE {
            return;
        }
    }
    evaluation.set_bubble(f64::NAN);
}

/// `(∂U/∂b, ∂²U/∂b²)`, J and J.
fn derivatives(evaluation: &Evaluation) -> (f64, f64) {
    let (mut force, mut stiffness) = (0.0, 0.0);
    for g in 0..3 {
        let (resultants, rigidities) = (evaluation.resultants(g), evaluation.rigidities(g));
        let strains_b = strains_b(evaluation, g);
        force += resultants.dot(&strains_b);
        stiffness += stiffness_of_point(evaluation, g, &resultants, &rigidities, &strains_b);
    }
    (force, stiffness)
}

/// What Saint-Venant torsion alone gives to `∂²U/∂b²`, J.
fn torsion_stiffness(evaluation: &Evaluation) -> f64 {
    let points = evaluation.element.bending.iter().enumerate();
    points
        .map(|(g, point)| point.weight * evaluation.element.stiffness.torsion * strains_b(evaluation, g)[2].powi(2))
        .sum()
}

/// `∂(g1, g2, tau, e)/∂b` at bending point `g`.
fn strains_b(evaluation: &Evaluation, g: usize) -> Strains {
    let point = &evaluation.element.bending[g];
    let ([gamma1, gamma2], turn) = (evaluation.gammahat[g], shape(point.xi));
    let torsion = shape_xi(point.xi) * point.torsion_by_twist;
    Strains::new(gamma2 * turn, -gamma1 * turn, torsion, 0.0)
}

/// Share of bending point `g` in `∂²U/∂b²`; resultants and rigidities include the quadrature weight.
fn stiffness_of_point(
    evaluation: &Evaluation,
    g: usize,
    resultants: &Resultants,
    rigidities: &Rigidities,
    strains_b: &Strains,
) -> f64 {
    let ([gamma1, gamma2], turn) = (evaluation.gammahat[g], shape(evaluation.element.bending[g].xi));
    strains_b.dot(&(rigidities * strains_b)) - (resultants[0] * gamma1 + resultants[1] * gamma2) * turn * turn
}

/// Second derivatives of the energy by `b` and everything else: what is condensed.
#[derive(Clone, Copy, Debug)]
pub struct Condensation {
    /// `∂²U/∂q∂b`, 14×1.
    by_q: ElementVector,
    /// `∂²U/∂b²`, J.
    by_b: f64,
    /// `∂²U/∂e∂b` by the Green strain of each axial point, J; 0 for small strain.
    by_green: [f64; 3],
}

impl Condensation {
    /// At the configuration of `evaluation`, whose first derivatives are `gradients`.
    pub fn new(evaluation: &Evaluation, gradients: &Gradients) -> Self {
        let (mut by_shape, mut by_b, mut by_green) = (RelativeVector::zeros(), 0.0, [0.0; 3]);
        for (g, point) in evaluation.element.bending.iter().enumerate() {
            let (resultants, rigidities) = (evaluation.resultants(g), evaluation.rigidities(g));
            let strains_b = strains_b(evaluation, g);
            let resultants_b = rigidities * strains_b;
            let ([g1_x, g2_x, tau_x], turn) = (&gradients.strains[g], shape(point.xi));
            by_shape += g1_x * (resultants_b[0] - resultants[1] * turn)
                + g2_x * (resultants_b[1] + resultants[0] * turn)
                + tau_x * resultants_b[2];
            by_b += stiffness_of_point(evaluation, g, &resultants, &rigidities, &strains_b);
            for (sum, share) in by_green.iter_mut().zip(point.from_axial) {
                *sum += resultants_b[3] * share;
            }
        }
        let mut by_q = evaluation.kinematics.shape.gradient(&by_shape);
        for (m, point) in evaluation.element.axial.iter().enumerate() {
            by_q += spread(&point.shape_x, &(evaluation.slopes[m].green_strain_p() * by_green[m]));
        }
        Self { by_q, by_b, by_green }
    }

    /// `∂b/∂q`, 14×1: how `b` follows the coordinates.
    pub fn bubble_q(&self) -> ElementVector {
        -self.by_q / self.by_b
    }

    /// Takes off `hessian` (over a step: twice the derivative by the coordinates at its end) what `b` gives way.
    pub fn condense(&self, evaluation: &Evaluation, scale: f64, hessian: &mut ElementColumns) {
        let mut by_end = self.by_q;
        for (m, point) in evaluation.element.axial.iter().enumerate() {
            by_end += spread(&point.shape_x, &(evaluation.slopes[m].green_strain_increment() * self.by_green[m]));
        }
        for (column, by_end) in hessian.iter_mut().zip(&by_end) {
            let factor = -scale / self.by_b * by_end;
            for row in 0..column.len() {
                column[row] += self.by_q[row] * factor;
            }
        }
    }
}
