//! The way back from the strains of the bending points to the element's corotated shape (MECHANICS 8). Strains are
//! functions of `κ1`, `κ2`, `α` of each bending point and of `T`: their derivatives by these ([`Forces`],
//! [`Couplings`]) and those of these by the shape ([`Gradients`]) are all there is. Elastic and viscous resultants go
//! the same way.

use super::Kinematics;
use super::corotated::{self, ANGLE, COROTATED, CorotatedChange, CorotatedMatrix, CorotatedVector, TWIST};
use super::curve_point::CurveGradients;
use crate::math::Mat3;
use crate::mechanics::beam::ancf14::element::{Element, Evaluation};
use crate::mechanics::beam::ancf14::strain::{Resultants, Rigidities};

/// How many numbers strains are made of: `κ1`, `κ2`, `α` of each bending point in turn, and `T`.
const PARTS: usize = 10;
/// Place of `T` among them.
const TOTAL: usize = 9;

/// First derivatives, by the corotated shape, of what strains are made of.
#[derive(Clone, Debug)]
pub struct Gradients<'a> {
    curves: [CurveGradients<'a>; 3],
    parts: [CorotatedVector; PARTS],
}

impl<'a> Gradients<'a> {
    /// Of `element` at the configuration of `kinematics`.
    #[inline]
    pub fn new(element: &Element, kinematics: &'a Kinematics) -> Self {
        let [first, middle, last] = &kinematics.points;
        let curves = [first.gradients(), middle.gradients(), last.gradients()];
        let rules = &element.bending;
        let spread = |g: usize, (by_p, by_w)| corotated::spread(&rules[g].shape_x, &rules[g].shape_xx, &by_p, &by_w);
        let kappa = |g: usize, q: usize| spread(g, curves[g].curvature(q));
        let rate = |g: usize| spread(g, curves[g].twist_rate());
        let rates = [rate(0), rate(1), rate(2)];
        let with_rates = |mut sum: CorotatedVector, weights: &[f64; 3], sign: f64| {
            for (rate, weight) in rates.iter().zip(weights) {
                add_times(&mut sum, sign * weight, rate);
            }
            sum
        };
        let mut between = [0.0; COROTATED];
        between[TWIST] = 1.0;
        let twist = with_rates(between, &element.rate_weights, 1.0);
        let alpha = |g: usize| {
            let mut sum = times(rules[g].xi, &twist);
            sum[ANGLE] += 1.0;
            with_rates(sum, &rules[g].collocation, -1.0)
        };
        let parts = [
            kappa(0, 1),
            kappa(0, 2),
            alpha(0),
            kappa(1, 1),
            kappa(1, 2),
            alpha(1),
            kappa(2, 1),
            kappa(2, 2),
            alpha(2),
            twist,
        ];
        Self { curves, parts }
    }

    /// Gradient of the weighted sum `factors`: the same to the last bit as [`Factors::gradient`].
    #[inline]
    pub fn weighted(&self, factors: &Factors, element: &Element) -> CorotatedVector {
        factors.gradient_on(element, &self.curves)
    }

    /// Gradient of what has the derivatives `forces`.
    #[inline]
    pub fn sum(&self, forces: &Forces) -> CorotatedVector {
        let mut sum = times(forces.twist, &self.parts[TOTAL]);
        for g in 0..3 {
            let ([by_1, by_2], by_alpha) = (forces.curvatures[g], forces.alpha[g]);
            for (i, factor) in [by_1, by_2, by_alpha].into_iter().enumerate() {
                add_times(&mut sum, factor, &self.parts[3 * g + i]);
            }
        }
        sum
    }

    /// Of `g1`, `g2`, `tau` of bending point `g`.
    pub fn strains(&self, evaluation: &Evaluation, g: usize) -> [CorotatedVector; 3] {
        let ([cos, sin], [gamma1, gamma2]) = (evaluation.turn[g], evaluation.gammahat[g]);
        let strain = |[by_1, by_2]: [f64; 2], by_alpha: f64, by_twist: f64| {
            let mut forces = Forces { twist: by_twist, ..Forces::default() };
            (forces.curvatures[g], forces.alpha[g]) = ([by_1, by_2], by_alpha);
            self.sum(&forces)
        };
        let by_twist = evaluation.element.bending[g].torsion_by_twist;
        [strain([cos, sin], gamma2, 0.0), strain([-sin, cos], -gamma1, 0.0), strain([0.0, 0.0], 0.0, by_twist)]
    }

    /// What [`Self::strains`] of all bending points change by with a small change of the corotated shape: `H_i ṡ` of
    /// each strain (MECHANICS 3.8).
    pub fn strain_changes(&self, evaluation: &Evaluation, change: &CorotatedChange) -> [[CorotatedVector; 3]; 3] {
        let rules = &evaluation.element.bending;
        // Of the curvatures and the twist rate of a point, and of their gradients.
        let point = |g: usize| {
            let (p, w) = (change.interpolate(&rules[g].shape_x), change.interpolate(&rules[g].shape_xx));
            let gradient = |factors: [f64; 3]| {
                let (pp, pw) = self.curves[g].hessian(&factors);
                let mirrored = Mat3::from_fn(|i, j| if i < j { pp[(j, i)] } else { pp[(i, j)] });
                corotated::spread(&rules[g].shape_x, &rules[g].shape_xx, &(mirrored * p + pw * w), &pw.tr_mul(&p))
            };
            let gradients = [gradient([1.0, 0.0, 0.0]), gradient([0.0, 1.0, 0.0]), gradient([0.0, 0.0, 1.0])];
            (evaluation.kinematics.points[g].along(&p, &w), gradients)
        };
        let points = [point(0), point(1), point(2)];
        let weighted = |weights: &[f64; 3]| {
            let (mut value, mut gradient) = (0.0, [0.0; COROTATED]);
            for (weight, ((_, rate), [_, _, by_shape])) in weights.iter().zip(&points) {
                value += weight * rate;
                add_times(&mut gradient, *weight, by_shape);
            }
            (value, gradient)
        };
        let (between, twist_gradient) = weighted(&evaluation.element.rate_weights);
        let twist = change.twist + between;
        [0, 1, 2].map(|g| {
            let ([cos, sin], [gamma1, gamma2], rule) = (evaluation.turn[g], evaluation.gammahat[g], &rules[g]);
            let (([by_1, by_2], _), [of_1, of_2, _]) = &points[g];
            let (carried, carried_gradient) = weighted(&rule.collocation);
            let alpha = change.angle + rule.xi * twist - carried;
            let mut of_alpha = times(rule.xi, &twist_gradient);
            add_times(&mut of_alpha, -1.0, &carried_gradient);
            let changes = [cos * by_1 + sin * by_2 + gamma2 * alpha, cos * by_2 - sin * by_1 - gamma1 * alpha];
            let [kappa_1, kappa_2, by_alpha] = [0, 1, 2].map(|i| &self.parts[3 * g + i]);
            let strain = |[cos, sin]: [f64; 2], gamma: f64, gamma_change: f64| {
                let mut sum = times(cos, of_1);
                add_times(&mut sum, sin, of_2);
                add_times(&mut sum, gamma, &of_alpha);
                add_times(&mut sum, -sin * alpha, kappa_1);
                add_times(&mut sum, cos * alpha, kappa_2);
                add_times(&mut sum, gamma_change, by_alpha);
                sum
            };
            let torsion = times(rule.torsion_by_twist, &twist_gradient);
            [strain([cos, sin], gamma2, changes[1]), strain([-sin, cos], -gamma1, -changes[0]), torsion]
        })
    }

    /// Adds to the lower triangle of `sum` the Hessian of the weighted sum `factors`, at frozen factors; with
    /// [`Self::add_couplings`] it is all of it.
    #[inline]
    pub fn add_frozen(&self, factors: &Factors, element: &Element, sum: &mut CorotatedMatrix) {
        for (g, rule) in element.bending.iter().enumerate() {
            let (pp, pw) = self.curves[g].hessian(&factors.points[g]);
            corotated::add_spread(&rule.shape_x, &rule.shape_xx, &pp, &pw, sum);
        }
    }

    /// Adds to the lower triangle of `sum` the part of the Hessian in which the factors change, by `couplings`.
    #[inline]
    pub fn add_couplings(&self, couplings: &Couplings, sum: &mut CorotatedMatrix) {
        let parts = &self.parts;
        // How the derivative by each of what strains are made of changes with the shape.
        let change = |g: usize, i: usize| {
            let of_point = &couplings.points[g];
            let mut sum = times(of_point.twist[i], &parts[TOTAL]);
            for (j, factor) in of_point.own[i].into_iter().enumerate() {
                add_times(&mut sum, factor, &parts[3 * g + j]);
            }
            sum
        };
        let changes = [
            change(0, 0),
            change(0, 1),
            change(0, 2),
            change(1, 0),
            change(1, 1),
            change(1, 2),
            change(2, 0),
            change(2, 1),
            change(2, 2),
            self.sum(&couplings.by_twist()),
        ];
        add_products::<0>(parts, &changes, sum);
        add_products::<2>(parts, &changes, sum);
        add_products::<4>(parts, &changes, sum);
        add_products::<6>(parts, &changes, sum);
        add_products::<8>(parts, &changes, sum);
    }
}

/// Adds two columns of `Σ_k parts_k changes_kᵀ` to the lower triangle of `sum`, those from `FIRST` on. Gathered beside
/// the matrix: the processor keeps them at hand.
#[inline]
fn add_products<const FIRST: usize>(
    parts: &[CorotatedVector; PARTS],
    changes: &[CorotatedVector; PARTS],
    sum: &mut CorotatedMatrix,
) {
    let mut gathered = [[0.0; COROTATED]; 2];
    for (part, change) in parts.iter().zip(changes) {
        for row in FIRST..COROTATED {
            gathered[0][row] += part[row] * change[FIRST];
            gathered[1][row] += part[row] * change[FIRST + 1];
        }
    }
    for row in FIRST..COROTATED {
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
    /// Of `Σ_g resultants_g · (g1, g2, tau)_g + Σ_m torques_m taum_m`, quadrature weights included; the last resultant,
    /// of the axial strain, has no part in it.
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
    /// Gradient of the sum; it takes less than [`Gradients::new`].
    #[inline]
    pub fn gradient(&self, element: &Element, kinematics: &Kinematics) -> CorotatedVector {
        let [first, middle, last] = &kinematics.points;
        self.gradient_on(element, &[first.gradients(), middle.gradients(), last.gradients()])
    }

    #[inline]
    fn gradient_on(&self, element: &Element, curves: &[CurveGradients; 3]) -> CorotatedVector {
        let mut sum = [0.0; COROTATED];
        for (g, rule) in element.bending.iter().enumerate() {
            let (by_p, by_w) = curves[g].gradient(&self.points[g]);
            add_times(&mut sum, 1.0, &corotated::spread(&rule.shape_x, &rule.shape_xx, &by_p, &by_w));
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
    /// Of a function of the strains with the derivatives `resultants` and the second derivatives `rigidities`;
    /// `torque_by_twist` is what `Σ_m torques_m/(l J0_m)` has by `T`, N m.
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

    /// What the derivative by `T` has for derivatives.
    #[inline]
    fn by_twist(&self) -> Forces {
        let [first, middle, last] = [&self.points[0].twist, &self.points[1].twist, &self.points[2].twist];
        Forces {
            curvatures: [[first[0], first[1]], [middle[0], middle[1]], [last[0], last[1]]],
            alpha: [first[2], middle[2], last[2]],
            twist: self.twist_twist,
        }
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

/// `factor values`.
#[inline]
fn times(factor: f64, values: &CorotatedVector) -> CorotatedVector {
    let mut product = *values;
    product.iter_mut().for_each(|value| *value *= factor);
    product
}

/// `sum += factor values`.
#[inline]
fn add_times(sum: &mut CorotatedVector, factor: f64, values: &CorotatedVector) {
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * value;
    }
}
