//! The way back from the strains of the bending points to the element's relative shape (MECHANICS 8). Strains are functions of `κ1`, `κ2`,
//! `α` of each bending point and of `T`: their derivatives by these ([`Forces`], [`Couplings`]) and those of these by the shape
//! ([`Gradients`]) are all there is. Elastic and viscous resultants go the same way.

use super::curve_point::CurveGradients;
use super::element::{Element, Evaluation};
use super::kinematics::Kinematics;
use super::relative::{self, ANGLE, RELATIVE, RelativeMatrix, RelativeVector, TWIST};
use super::strain::{Resultants, Rigidities};

/// First derivatives, by the relative shape, of what strains are made of.
#[derive(Clone, Debug)]
pub struct Gradients<'a> {
    curves: [CurveGradients<'a>; 3],
    /// Of κ1, κ2 of each bending point.
    curvatures: [[RelativeVector; 2]; 3],
    /// Of α at each bending point, rad.
    alpha: [RelativeVector; 3],
    /// Of `T`, rad.
    twist: RelativeVector,
}

impl<'a> Gradients<'a> {
    /// Of `element` at the configuration of `kinematics`.
    #[inline]
    pub fn new(element: &Element, kinematics: &'a Kinematics) -> Self {
        let [first, middle, last] = &kinematics.points;
        let curves = [first.gradients(), middle.gradients(), last.gradients()];
        let none = [0.0; RELATIVE];
        let mut all = Self { curves, curvatures: [[none; 2]; 3], alpha: [none; 3], twist: none };
        let mut rates = [none; 3];
        for (g, rule) in element.bending.iter().enumerate() {
            let curve = &all.curves[g];
            let spread = |(by_p, by_w)| relative::spread(&rule.shape_x, &rule.shape_xx, &by_p, &by_w);
            all.curvatures[g] = [spread(curve.curvature(1)), spread(curve.curvature(2))];
            rates[g] = spread(curve.twist_rate());
        }
        all.twist[TWIST] = 1.0;
        for (rate, weight) in rates.iter().zip(element.rate_weights) {
            add_times(&mut all.twist, weight, rate);
        }
        for (alpha, rule) in all.alpha.iter_mut().zip(&element.bending) {
            alpha[ANGLE] = 1.0;
            add_times(alpha, rule.xi, &all.twist);
            for (rate, weight) in rates.iter().zip(rule.collocation) {
                add_times(alpha, -weight, rate);
            }
        }
        all
    }

    /// Gradient of what has the derivatives `forces`.
    #[inline]
    pub fn sum(&self, forces: &Forces) -> RelativeVector {
        let mut sum = self.twist.map(|by| by * forces.twist);
        for g in 0..3 {
            let ([kappa1, kappa2], [by_1, by_2]) = (&self.curvatures[g], forces.curvatures[g]);
            add_times(&mut sum, by_1, kappa1);
            add_times(&mut sum, by_2, kappa2);
            add_times(&mut sum, forces.alpha[g], &self.alpha[g]);
        }
        sum
    }

    /// Of `g1`, `g2`, `tau` of bending point `g`.
    pub fn strains(&self, evaluation: &Evaluation, g: usize) -> [RelativeVector; 3] {
        let ([cos, sin], [gamma1, gamma2]) = (evaluation.turn[g], evaluation.gammahat[g]);
        let strain = |[by_1, by_2]: [f64; 2], by_alpha: f64, by_twist: f64| {
            let mut forces = Forces { twist: by_twist, ..Forces::default() };
            (forces.curvatures[g], forces.alpha[g]) = ([by_1, by_2], by_alpha);
            self.sum(&forces)
        };
        let by_twist = evaluation.element.bending[g].torsion_by_twist;
        [strain([cos, sin], gamma2, 0.0), strain([-sin, cos], -gamma1, 0.0), strain([0.0, 0.0], 0.0, by_twist)]
    }

    /// Adds to the lower triangle of `sum` the Hessian of the weighted sum `factors`, at frozen factors; with [`Self::add_couplings`] it is all of it.
    #[inline]
    pub fn add_frozen(&self, factors: &Factors, element: &Element, sum: &mut RelativeMatrix) {
        for (g, rule) in element.bending.iter().enumerate() {
            let (pp, pw) = self.curves[g].hessian(&factors.points[g]);
            relative::add_spread(&rule.shape_x, &rule.shape_xx, &pp, &pw, sum);
        }
    }

    /// Adds to the lower triangle of `sum` the part of the Hessian in which the factors change, by `couplings`.
    #[inline]
    pub fn add_couplings(&self, couplings: &Couplings, sum: &mut RelativeMatrix) {
        // How the derivative by each of what strains are made of changes with the shape.
        let mut changes = [[0.0; RELATIVE]; 10];
        changes[9] = self.twist.map(|by| by * couplings.twist_twist);
        let mut parts = changes;
        parts[9] = self.twist;
        for (g, of_point) in couplings.points.iter().enumerate() {
            let [kappa1, kappa2] = self.curvatures[g];
            let own = [kappa1, kappa2, self.alpha[g]];
            for i in 0..3 {
                let mut change = self.twist.map(|by| by * of_point.twist[i]);
                for j in 0..3 {
                    add_times(&mut change, of_point.own[i][j], &own[j]);
                }
                (parts[3 * g + i], changes[3 * g + i]) = (own[i], change);
                add_times(&mut changes[9], of_point.twist[i], &own[i]);
            }
        }
        add_products::<0>(&parts, &changes, sum);
        add_products::<2>(&parts, &changes, sum);
        add_products::<4>(&parts, &changes, sum);
        add_products::<6>(&parts, &changes, sum);
        add_products::<8>(&parts, &changes, sum);
    }
}

/// Adds two columns of `Σ_k parts_k changes_kᵀ` to the lower triangle of `sum`, those from `FIRST` on. Gathered beside the matrix: the
/// processor keeps them at hand.
#[inline]
fn add_products<const FIRST: usize>(
    parts: &[RelativeVector; 10],
    changes: &[RelativeVector; 10],
    sum: &mut RelativeMatrix,
) {
    let mut gathered = [[0.0; RELATIVE]; 2];
    for (part, change) in parts.iter().zip(changes) {
        for row in FIRST..RELATIVE {
            gathered[0][row] += part[row] * change[FIRST];
            gathered[1][row] += part[row] * change[FIRST + 1];
        }
    }
    for row in FIRST..RELATIVE {
        sum[FIRST][row] += gathered[0][row];
        sum[FIRST + 1][row] += gathered[1][row];
    }
}

/// Derivatives of a function of the strains by what strains are made of.
#[derive(Clone, Copy, Debug, Default)]
pub struct Forces {
    /// By κ1 and κ2 of each bending point: `c1, c2` of MECHANICS 8.
    pub curvatures: [[f64; 2]; 3],
    /// By α of each bending point: `λ_alpha`, N m.
    pub alpha: [f64; 3],
    /// By `T`, through torsion alone, N m; the rest of `λ_T` is in `α`.
    pub twist: f64,
}

impl Forces {
    /// Of `Σ_g resultants_g · (g1, g2, tau)_g + Σ_m torques_m taum_m`, quadrature weights included; the last resultant, of the
    /// axial strain, has no part in it.
    #[inline]
    pub fn new(evaluation: &Evaluation, resultants: &[Resultants; 3], torques: &[f64; 3]) -> Self {
        let mut all = Self::default();
        for (torque, point) in torques.iter().zip(&evaluation.element.axial) {
            all.twist += torque * point.torsion_by_twist;
        }
        for (g, rule) in evaluation.element.bending.iter().enumerate() {
            let [n1, n2, torque, _] = resultants[g].into();
            all.add_moments(evaluation, g, [n1, n2]);
            all.twist += torque * rule.torsion_by_twist;
        }
        all
    }

    /// Adds what derivatives by `g1` and `g2` of bending point `g` give.
    #[inline]
    pub fn add_moments(&mut self, evaluation: &Evaluation, g: usize, [n1, n2]: [f64; 2]) {
        let ([cos, sin], [gamma1, gamma2]) = (evaluation.turn[g], evaluation.gammahat[g]);
        let [by_1, by_2] = &mut self.curvatures[g];
        *by_1 += n1 * cos - n2 * sin;
        *by_2 += n1 * sin + n2 * cos;
        self.alpha[g] += n1 * gamma2 - n2 * gamma1;
    }

    /// The same by the curvatures and rates of the points and the angles of the nodes, of which `T` and `α` are made.
    #[inline]
    pub fn factors(&self, element: &Element) -> Factors {
        let rules = &element.bending;
        let twist = self.twist + rules.iter().zip(&self.alpha).map(|(rule, by_alpha)| by_alpha * rule.xi).sum::<f64>();
        let point = |g: usize| {
            let by_rate: f64 =
                rules.iter().zip(&self.alpha).map(|(rule, by_alpha)| by_alpha * rule.collocation[g]).sum();
            let [by_1, by_2] = self.curvatures[g];
            [by_1, by_2, element.rate_weights[g] * twist - by_rate]
        };
        let points = [point(0), point(1), point(2)];
        Factors { points, twist, alpha: self.alpha.iter().sum() }
    }
}

/// A weighted sum of the curvatures and rates of the bending points and of the angles between and at the nodes.
#[derive(Clone, Copy, Debug)]
pub struct Factors {
    /// Of κ1, κ2, ω of each bending point: `c1, c2, c3` of MECHANICS 8.
    pub points: [[f64; 3]; 3],
    /// Of `T_0`: `λ_T`, N m.
    pub twist: f64,
    /// Of `θ_0`: `Σ_g λ_alpha_g`, N m.
    pub alpha: f64,
}

impl Factors {
    /// Gradient of the sum; it takes less than [`Gradients`] do.
    #[inline]
    pub fn gradient(&self, element: &Element, kinematics: &Kinematics) -> RelativeVector {
        let mut sum = [0.0; RELATIVE];
        for (g, rule) in element.bending.iter().enumerate() {
            let (by_p, by_w) = kinematics.points[g].gradient(&self.points[g]);
            add_times(&mut sum, 1.0, &relative::spread(&rule.shape_x, &rule.shape_xx, &by_p, &by_w));
        }
        sum[TWIST] = self.twist;
        sum[ANGLE] = self.alpha;
        sum
    }
}

/// Second derivatives of a function of the strains by what strains are made of.
#[derive(Clone, Copy, Debug)]
pub struct Couplings {
    /// Of each bending point.
    pub points: [PointCouplings; 3],
    /// By `T` twice, N m.
    pub twist_twist: f64,
}

/// Second derivatives by what the strains of a bending point are made of.
#[derive(Clone, Copy, Debug)]
pub struct PointCouplings {
    /// By κ1, κ2, α twice.
    pub own: [[f64; 3]; 3],
    /// By κ1, κ2, α, and by `T`.
    pub twist: [f64; 3],
}

impl Couplings {
    /// Of a function of the strains with the derivatives `resultants` and the second derivatives `rigidities`; `torque_by_twist` is
    /// what `Σ_m torques_m/(l J0_m)` has by `T`, N m.
    #[inline]
    pub fn new(
        evaluation: &Evaluation,
        resultants: &[Resultants; 3],
        rigidities: &[Rigidities; 3],
        torque_by_twist: f64,
    ) -> Self {
        let point = |g: usize| PointCouplings::new(evaluation, g, &resultants[g], &rigidities[g]);
        let points = [point(0), point(1), point(2)];
        let torsion = evaluation.element.bending.iter().zip(rigidities);
        let by_torsion = torsion.map(|(rule, rigidities)| rigidities.torsion * rule.torsion_by_twist.powi(2));
        Self { points, twist_twist: torque_by_twist + by_torsion.sum::<f64>() }
    }
}

impl PointCouplings {
    /// Of bending point `g`.
    #[inline]
    fn new(evaluation: &Evaluation, g: usize, resultants: &Resultants, rigidities: &Rigidities) -> Self {
        let ([cos, sin], [gamma1, gamma2]) = (evaluation.turn[g], evaluation.gammahat[g]);
        let ([n1, n2, _, _], [d11, d22], d12) = ((*resultants).into(), rigidities.bending, rigidities.cross);
        let [d1t, d2t] = rigidities.with_torsion.map(|by| by * evaluation.element.bending[g].torsion_by_twist);
        // What κ1, κ2 and α change the two moments by.
        let [p1, p2] = [d11 * cos - d12 * sin, d12 * cos - d22 * sin];
        let [q1, q2] = [d11 * sin + d12 * cos, d12 * sin + d22 * cos];
        let [r1, r2] = [d11 * gamma2 - d12 * gamma1, d12 * gamma2 - d22 * gamma1];
        let cross = p1 * sin + p2 * cos;
        let alpha_1 = r1 * cos - r2 * sin - n1 * sin - n2 * cos;
        let alpha_2 = r1 * sin + r2 * cos + n1 * cos - n2 * sin;
        let alpha_alpha = (r1 - n2) * gamma2 - (r2 + n1) * gamma1;
        Self {
            own: [
                [p1 * cos - p2 * sin, cross, alpha_1],
                [cross, q1 * sin + q2 * cos, alpha_2],
                [alpha_1, alpha_2, alpha_alpha],
            ],
            twist: [d1t * cos - d2t * sin, d1t * sin + d2t * cos, d1t * gamma2 - d2t * gamma1],
        }
    }
}

/// `sum += factor values`.
#[inline]
fn add_times(sum: &mut RelativeVector, factor: f64, values: &RelativeVector) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}
