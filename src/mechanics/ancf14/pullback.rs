//! The way back from the strains of the bending points to the element's relative shape (MECHANICS 8): their first derivatives, and
//! gradient and Hessian of any weighted sum of them. Elastic and viscous resultants go the same way.

use super::element::{Element, Evaluation};
use super::kinematics::Kinematics;
use super::relative::{self, ANGLE, RelativeMatrix, RelativeVector, TWIST};
use super::strain::Resultants;

/// First derivatives, by the relative shape, of the strains and of what they are made of.
#[derive(Clone, Debug)]
pub struct Gradients {
    /// Of κ1, κ2, ω of each bending point.
    pub points: [[RelativeVector; 3]; 3],
    /// Of `T`, rad.
    pub twist: RelativeVector,
    /// Of α at each bending point, rad.
    pub alpha: [RelativeVector; 3],
    /// Of `g1`, `g2`, `tau` of each bending point.
    pub strains: [[RelativeVector; 3]; 3],
}

impl Gradients {
    /// At the configuration of `evaluation`.
    pub fn new(evaluation: &Evaluation) -> Self {
        let none = [RelativeVector::zeros(); 3];
        let mut all = Self { points: [none; 3], twist: none[0], alpha: none, strains: [none; 3] };
        let rules = &evaluation.element.bending;
        for (g, rule) in rules.iter().enumerate() {
            let point = evaluation.kinematics.points[g].gradients();
            let spread = |(by_p, by_w)| relative::spread(&rule.shape_x, &rule.shape_xx, &by_p, &by_w);
            all.points[g][0] = spread(point.curvature([1.0, 0.0]));
            all.points[g][1] = spread(point.curvature([0.0, 1.0]));
            all.points[g][2] = spread(point.twist_rate());
        }
        all.twist = all.rate(&evaluation.element.rate_weights);
        all.twist[TWIST] += 1.0;
        for (g, rule) in rules.iter().enumerate() {
            all.alpha[g] = all.twist * rule.xi - all.rate(&rule.collocation);
            all.alpha[g][ANGLE] += 1.0;
            let ([kappa1, kappa2, _], alpha) = (&all.points[g], &all.alpha[g]);
            let ([cos, sin], [gamma1, gamma2]) = (evaluation.turn[g], evaluation.gammahat[g]);
            all.strains[g][0] = kappa1 * cos + kappa2 * sin + alpha * gamma2;
            all.strains[g][1] = kappa2 * cos - kappa1 * sin - alpha * gamma1;
            all.strains[g][2] = all.twist * rule.torsion_by_twist;
        }
        all
    }

    /// Of `Σ_g weight_g ω_g`.
    fn rate(&self, weights: &[f64; 3]) -> RelativeVector {
        self.points[0][2] * weights[0] + self.points[1][2] * weights[1] + self.points[2][2] * weights[2]
    }
}

/// A weighted sum of strains, as a sum over what the strains are made of.
#[derive(Clone, Copy, Debug)]
pub struct Factors {
    /// Factors of κ1, κ2, ω of each bending point: `c1, c2, c3` of MECHANICS 8.
    pub points: [[f64; 3]; 3],
    /// `λ_T`, N m.
    pub twist: f64,
    /// `Σ_g λ_alpha_g`, N m.
    pub alpha: f64,
}

impl Factors {
    /// Of `Σ_g resultants_g · (g1, g2, tau)_g + Σ_m torques_m taum_m`, quadrature weights included; the last resultant, of the
    /// axial strain, has no part in it.
    #[inline]
    pub fn new(evaluation: &Evaluation, resultants: &[Resultants; 3], torques: &[f64; 3]) -> Self {
        let element = evaluation.element;
        let mut by_alpha = [0.0; 3];
        let mut twist = 0.0;
        for (g, rule) in element.bending.iter().enumerate() {
            let [gamma1, gamma2] = evaluation.gammahat[g];
            by_alpha[g] = resultants[g][0] * gamma2 - resultants[g][1] * gamma1;
            twist += resultants[g][2] * rule.torsion_by_twist + by_alpha[g] * rule.xi;
        }
        for (torque, point) in torques.iter().zip(&element.axial) {
            twist += torque * point.torsion_by_twist;
        }
        let mut points = [[0.0; 3]; 3];
        for g in 0..3 {
            let ([cos, sin], [n1, n2]) = (evaluation.turn[g], [resultants[g][0], resultants[g][1]]);
            let by_rate: f64 = (0..3).map(|h| by_alpha[h] * element.bending[h].collocation[g]).sum();
            points[g] = [n1 * cos - n2 * sin, n1 * sin + n2 * cos, element.rate_weights[g] * twist - by_rate];
        }
        Self { points, twist, alpha: by_alpha.iter().sum() }
    }

    /// Gradient of the sum.
    pub fn gradient(&self, element: &Element, kinematics: &Kinematics) -> RelativeVector {
        let mut sum = RelativeVector::zeros();
        for (g, rule) in element.bending.iter().enumerate() {
            let (by_p, by_w) = kinematics.points[g].gradient(&self.points[g]);
            sum += relative::spread(&rule.shape_x, &rule.shape_xx, &by_p, &by_w);
        }
        sum[TWIST] = self.twist;
        sum[ANGLE] = self.alpha;
        sum
    }

    /// Adds to `sum` the Hessian of the sum at frozen factors; with [`FactorGradients::add_hessian`] it is all of it.
    pub fn add_hessian(&self, element: &Element, kinematics: &Kinematics, sum: &mut RelativeMatrix) {
        for (g, rule) in element.bending.iter().enumerate() {
            let (pp, pw) = kinematics.points[g].hessian(&self.points[g]);
            relative::add_spread(&rule.shape_x, &rule.shape_xx, &pp, &pw, sum);
        }
    }
}

/// First derivatives of [`Factors`] by the relative shape, resultants included.
#[derive(Clone, Debug)]
pub struct FactorGradients {
    points: [[RelativeVector; 3]; 3],
    twist: RelativeVector,
    alpha: RelativeVector,
}

impl FactorGradients {
    /// Of the `factors` of `resultants`, which have the derivatives `resultants_x` themselves; `torque_by_twist` is what
    /// `Σ_m torques_m/(l J0_m)` has by `T`, N m.
    pub fn new(
        evaluation: &Evaluation,
        gradients: &Gradients,
        factors: &Factors,
        resultants: &[Resultants; 3],
        resultants_x: &[[RelativeVector; 3]; 3],
        torque_by_twist: f64,
    ) -> Self {
        let none = [RelativeVector::zeros(); 3];
        let mut all = Self { points: [none; 3], twist: gradients.twist * torque_by_twist, alpha: none[0] };
        let (rules, mut by_alpha) = (&evaluation.element.bending, none);
        for (g, rule) in rules.iter().enumerate() {
            let ([gamma1, gamma2], [n1, n2]) = (evaluation.gammahat[g], [resultants[g][0], resultants[g][1]]);
            let ([n1_x, n2_x, torque_x], [g1_x, g2_x, _]) = (&resultants_x[g], &gradients.strains[g]);
            by_alpha[g] = n1_x * gamma2 - n2_x * gamma1 + g2_x * n1 - g1_x * n2;
            all.twist += torque_x * rule.torsion_by_twist + by_alpha[g] * rule.xi;
            all.alpha += by_alpha[g];
        }
        for (g, [n1_x, n2_x, _]) in resultants_x.iter().enumerate() {
            let ([cos, sin], alpha, [c1, c2, _]) = (evaluation.turn[g], &gradients.alpha[g], factors.points[g]);
            all.points[g][0] = n1_x * cos - n2_x * sin - alpha * c2;
            all.points[g][1] = n1_x * sin + n2_x * cos + alpha * c1;
            all.points[g][2] = all.twist * evaluation.element.rate_weights[g]
                - by_alpha[0] * rules[0].collocation[g]
                - by_alpha[1] * rules[1].collocation[g]
                - by_alpha[2] * rules[2].collocation[g];
        }
        all
    }

    /// Adds to `sum` the part of the Hessian in which the factors change.
    pub fn add_hessian(&self, gradients: &Gradients, sum: &mut RelativeMatrix) {
        for column in 0..TWIST {
            // Gathered beside the matrix: the processor keeps them at hand.
            let mut gathered = [0.0; TWIST + 1];
            for g in 0..3 {
                for i in 0..3 {
                    let (of_point, change) = (&gradients.points[g][i].data.0[0], self.points[g][i][column]);
                    for row in 0..gathered.len() {
                        gathered[row] += of_point[row] * change;
                    }
                }
            }
            for row in 0..gathered.len() {
                sum[(row, column)] += gathered[row];
            }
        }
        for column in 0..=ANGLE {
            sum[(TWIST, column)] += self.twist[column];
            sum[(ANGLE, column)] += self.alpha[column];
        }
    }
}
