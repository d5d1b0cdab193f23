//! The way back from the strains to the coordinates (MECHANICS 8): first derivatives of the strains of the bending points, and
//! gradient and Hessian of any weighted sum of them. Elastic and viscous resultants go the same way.

use super::coordinates::{ELEMENT, ElementMatrix, ElementVector, NODE, P, THETA};
use super::element::Evaluation;
use super::strain::Resultants;
use nalgebra::{SMatrix, SVector};

/// First derivatives, by the coordinates, of what the strains are made of.
#[derive(Clone, Debug)]
pub struct Gradients {
    /// `∂(κ1, κ2, ω)/∂q` at the bending points, 14×9: three columns a point.
    pub points: SMatrix<f64, ELEMENT, 9>,
    /// `∂T/∂q`, rad.
    pub twist: ElementVector,
}

impl Gradients {
    /// At the configuration of `evaluation`.
    pub fn new(evaluation: &Evaluation) -> Self {
        let (element, kinematics, [first, second]) = (evaluation.element, &evaluation.kinematics, evaluation.frames);
        let points = kinematics.point_gradients(element);
        let twist = kinematics.twist_gradient(element, first, second, &points);
        Self { points, twist }
    }

    /// Of the strains of bending point `g`.
    pub fn section(&self, evaluation: &Evaluation, g: usize) -> SectionGradients {
        let (element, point) = (evaluation.element, &evaluation.element.bending[g]);
        let (sin, cos) = evaluation.alpha[g].sin_cos();
        let j0 = point.reference_stretch;
        let mut alpha = self.twist * point.xi - evaluation.kinematics.rate_gradient(&point.collocation, &self.points);
        alpha[THETA] += 1.0;
        let (kappa1_q, kappa2_q) = (self.points.column(3 * g), self.points.column(3 * g + 1));
        let j1 = (kappa1_q * cos + kappa2_q * sin) / j0;
        let j2 = (kappa2_q * cos - kappa1_q * sin) / j0;
        let [gamma1, gamma2] = evaluation.gammahat[g];
        let mut strains = SMatrix::<f64, ELEMENT, 4>::zeros();
        strains.set_column(0, &(j1 + alpha * gamma2));
        strains.set_column(1, &(j2 - alpha * gamma1));
        strains.set_column(2, &(self.twist / (element.length * j0)));
        SectionGradients { strains, alpha, j1, j2 }
    }
}

/// First derivatives, by the coordinates, at one bending point.
#[derive(Clone, Debug)]
pub struct SectionGradients {
    /// `∂(g1, g2, tau)/∂q` and a column of zeros in the place of the axial strain, 14×4.
    pub strains: SMatrix<f64, ELEMENT, 4>,
    /// `∂α/∂q`, rad.
    alpha: ElementVector,
    /// `∂gammahat_1/∂q` and `∂gammahat_2/∂q` at a frozen angle α, 1/m.
    j1: ElementVector,
    j2: ElementVector,
}

impl SectionGradients {
    /// `∂/∂q` of `resultants · ∂(g1, g2)/∂α` at frozen resultants, 14×1.
    pub fn turn_gradient(&self, gammahat: &[f64; 2], resultants: &Resultants) -> ElementVector {
        let (n1, n2) = (resultants[0], resultants[1]);
        self.j2 * n1 - self.j1 * n2 - self.alpha * (n1 * gammahat[0] + n2 * gammahat[1])
    }

    /// Adds to `sum` what the turn of the section by α gives to the Hessian of `resultants · (g1, g2)` (MECHANICS 8).
    pub fn add_turn_hessian(&self, gammahat: &[f64; 2], resultants: &Resultants, sum: &mut ElementMatrix) {
        let (n1, n2) = (resultants[0], resultants[1]);
        let turned = (self.j2 * n1 - self.j1 * n2) - self.alpha * (0.5 * (n1 * gammahat[0] + n2 * gammahat[1]));
        let product = turned * self.alpha.transpose();
        *sum += product + product.transpose();
    }
}

/// A weighted sum of strains, as a sum over what the strains are made of.
#[derive(Clone, Copy, Debug)]
pub struct Factors {
    /// Factors of κ1, κ2, ω of each bending point: `c1, c2, c3` of MECHANICS 8.
    points: [[f64; 3]; 3],
    /// `λ_T`, N m.
    twist: f64,
    /// `Σ_g λ_alpha_g`, N m.
    alpha: f64,
}

impl Factors {
    /// Of `Σ_g resultants_g · (g1, g2, tau)_g + Σ_m torques_m taum_m`, quadrature weights included; the last resultant, of the
    /// axial strain, has no part in it.
    pub fn new(evaluation: &Evaluation, resultants: &[Resultants; 3], torques: &[f64; 3]) -> Self {
        let element = evaluation.element;
        let mut by_alpha = [0.0; 3];
        let mut twist = 0.0;
        for (g, point) in element.bending.iter().enumerate() {
            let [gamma1, gamma2] = evaluation.gammahat[g];
            by_alpha[g] = resultants[g][0] * gamma2 - resultants[g][1] * gamma1;
            twist += resultants[g][2] / (element.length * point.reference_stretch) + by_alpha[g] * point.xi;
        }
        for (torque, point) in torques.iter().zip(&element.axial) {
            twist += torque / (element.length * point.reference_stretch);
        }
        let points = std::array::from_fn(|g| {
            let (sin, cos) = evaluation.alpha[g].sin_cos();
            let j0 = element.bending[g].reference_stretch;
            let by_rate: f64 = (0..3).map(|h| by_alpha[h] * element.bending[h].collocation[g]).sum();
            [
                (resultants[g][0] * cos - resultants[g][1] * sin) / j0,
                (resultants[g][0] * sin + resultants[g][1] * cos) / j0,
                element.rate_weights[g] * twist - by_rate,
            ]
        });
        Self { points, twist, alpha: by_alpha.iter().sum() }
    }

    /// Gradient of the sum, 14×1.
    pub fn gradient(&self, evaluation: &Evaluation, gradients: &Gradients) -> ElementVector {
        let mut sum = gradients.points * SVector::<f64, 9>::from_iterator(self.points.iter().flatten().copied());
        // λ_T multiplies the whole gradient of T; its share through ω stands in the factors already.
        let (by_p0, by_p1) = evaluation.kinematics.holonomy.gradient(evaluation.frames[0], evaluation.frames[1]);
        let mut slope = sum.fixed_rows_mut::<3>(P);
        slope += by_p0 * self.twist;
        let mut slope = sum.fixed_rows_mut::<3>(NODE + P);
        slope += by_p1 * self.twist;
        sum[THETA] += self.alpha - self.twist;
        sum[NODE + THETA] += self.twist;
        sum
    }

    /// Second derivatives of κ1, κ2, ω and β at frozen factors, 14×14; with [`SectionGradients::add_turn_hessian`] the Hessian of the sum.
    pub fn frame_hessian(&self, evaluation: &Evaluation) -> ElementMatrix {
        let mut sum = ElementMatrix::zeros();
        let (kinematics, [start, end]) = (&evaluation.kinematics, evaluation.frames);
        for (g, point) in evaluation.element.bending.iter().enumerate() {
            let (curve, factors) = (&kinematics.points[g], &self.points[g]);
            kinematics.base.add_hessian(&mut sum, start, curve, factors, &point.shape_x, &point.shape_xx);
        }
        kinematics.holonomy.add_hessian(&mut sum, start, end, self.twist);
        sum
    }
}
