//! Scalars measured between two markers: what springs act on, drives prescribe, and joints show as their coordinate.
//!
//! Angles are read near their last accepted value, so that they go on over any number of turns.

use super::pose_gradient::{PoseGradient, of_side, pull_back};
use super::{Marker, own_velocity};
use crate::math::Vec3;
use crate::math::elementary::{acos, atan2};
use crate::mechanics::geometry::marker_jacobian::{MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose::{PLACE, Pose, VECTORS, axis_vector};
use crate::mechanics::geometry::pose_pair::{PairHessian, PairVector};
use crate::mechanics::marker::configuration::Configuration;
use std::f64::consts::PI;

/// What is measured of b relative to a.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Measure {
    /// Position of b relative to that of a along this axis of a, m.
    Distance(usize),
    /// Turn of b against a about this axis, right-handed, rad.
    Angle(usize),
    /// Distance of the two positions, m.
    Length,
    /// This component, in a's axes, of the rotation vector of b against a, rad; below half a turn.
    Rotation(usize),
}

/// A measure between two markers.
#[derive(Clone, Debug, PartialEq)]
pub struct RelativeCoordinate {
    /// One side.
    pub a: Marker,
    /// The other side.
    pub b: Marker,
    /// What is measured.
    pub measure: Measure,
}

impl RelativeCoordinate {
    /// The poses of both sides, as far as the measure sees them: a length sees no axes.
    fn poses(&self, c: &Configuration) -> [Pose; 2] {
        let pose = |marker: &Marker| if self.measure == Measure::Length { marker.placed(c) } else { marker.pose(c) };
        [pose(&self.a), pose(&self.b)]
    }

    /// How [`Self::poses`] move.
    fn pose_q(&self, marker: &Marker, c: &Configuration) -> PoseGradient {
        if self.measure == Measure::Length { marker.placed_q(c) } else { marker.pose_q(c) }
    }

    /// Its value: an angle near `previous`, rad or m.
    pub fn value(&self, c: &Configuration, previous: f64) -> f64 {
        let [a, b] = self.poses(c);
        self.measure.value(&a, &b, previous)
    }

    /// Its rate, m/s or rad/s.
    pub fn rate(&self, c: &Configuration, velocity: &[f64]) -> f64 {
        let [a, b] = self.poses(c);
        self.measure.gradient(&a, &b).dot(&self.pose_rates(c, velocity))
    }

    /// Its second derivative by time, m/s² or rad/s², at the velocities of all coordinates and their derivatives
    /// `acceleration`.
    pub fn acceleration(&self, c: &Configuration, velocity: &[f64], acceleration: &[f64]) -> f64 {
        let [a, b] = self.poses(c);
        let rates = self.pose_rates(c, velocity);
        let mut hessian = PairHessian::default();
        self.measure.add_hessian(&a, &b, 1.0, &mut hessian);
        let mut own = PairVector::zeros();
        for (side, marker) in [&self.a, &self.b].into_iter().enumerate() {
            let of_side = marker.pose_acceleration(c, velocity, acceleration);
            own.fixed_columns_mut::<VECTORS>(VECTORS * side).copy_from(&of_side);
        }
        hessian.times(&rates).dot(&rates) + self.measure.gradient(&a, &b).dot(&own)
    }

    /// Its change when the coordinates of its sides change by `change`, to first order.
    pub fn change(&self, c: &Configuration, change: &[f64]) -> f64 {
        let sides = self.gradient(c).into_iter().zip([&self.a, &self.b]);
        sides.map(|(by_side, marker)| by_side.dot(&own_velocity(c, marker, change))).sum()
    }

    /// Its derivative with respect to the coordinates of both its sides, 24×1 each.
    pub fn gradient(&self, c: &Configuration) -> [MarkerVector; 2] {
        let [a, b] = self.poses(c);
        let by_poses = self.measure.gradient(&a, &b);
        [(0, &self.a), (1, &self.b)]
            .map(|(number, marker)| self.pose_q(marker, c).generalized(&of_side(&by_poses, number)))
    }

    /// `factor` times its second derivative with respect to the coordinates of both its sides, blocks `aa, ab, ba, bb`.
    pub fn hessian(&self, c: &Configuration, factor: f64) -> [MarkerMatrix; 4] {
        let mut blocks = [MarkerMatrix::zeros(); 4];
        self.set_hessian(c, factor, &mut blocks);
        blocks
    }

    /// Sets `blocks`, which are 0, to [`Self::hessian`]: these 18 KB are once on the stack then.
    pub fn set_hessian(&self, c: &Configuration, factor: f64, blocks: &mut [MarkerMatrix; 4]) {
        let [a, b] = self.poses(c);
        let by_poses = self.measure.gradient(&a, &b);
        let mut hessian = PairHessian::default();
        self.measure.add_hessian(&a, &b, factor, &mut hessian);
        let sides = [&self.a, &self.b].map(|marker| self.pose_q(marker, c));
        pull_back(c, [&self.a, &self.b], &sides, &(by_poses * factor), &hessian, blocks);
    }

    /// Derivative of its rate with respect to the coordinates of both sides at fixed velocities, 24×1 each.
    pub fn rate_gradient(&self, c: &Configuration, velocity: &[f64]) -> [MarkerVector; 2] {
        let [a, b] = self.poses(c);
        let by_poses = self.measure.gradient(&a, &b);
        let mut hessian = PairHessian::default();
        self.measure.add_hessian(&a, &b, 1.0, &mut hessian);
        let turned = hessian.times(&self.pose_rates(c, velocity));
        [(0, &self.a), (1, &self.b)].map(|(number, marker)| {
            let (own, pose_q) = (own_velocity(c, marker, velocity), self.pose_q(marker, c));
            let mut bend = MarkerMatrix::zeros();
            pose_q.add_bend(marker, c, &of_side(&by_poses, number), &mut bend);
            pose_q.generalized(&of_side(&turned, number)) + bend.tr_mul(&own)
        })
    }

    /// How fast the poses of both sides change, 24×1.
    fn pose_rates(&self, c: &Configuration, velocity: &[f64]) -> PairVector {
        let rate = |marker: &Marker| {
            self.pose_q(marker, c).times(&own_velocity(c, marker, velocity)) + marker.pose_t(c)[0].vectors()
        };
        let mut rates = PairVector::zeros();
        for (side, marker) in [&self.a, &self.b].into_iter().enumerate() {
            rates.fixed_columns_mut::<VECTORS>(VECTORS * side).copy_from(&rate(marker));
        }
        rates
    }
}

impl Measure {
    /// The measure at two poses; an angle is the one nearest to `previous`.
    pub fn value(self, a: &Pose, b: &Pose, previous: f64) -> f64 {
        let apart = b.place - a.place;
        match self {
            Self::Distance(axis) => a.axis(axis).dot(&apart),
            Self::Angle(axis) => {
                let (sine, cosine) = turn(axis);
                near(atan2(sine.value(a, b), cosine.value(a, b)), previous)
            }
            Self::Length => apart.norm(),
            Self::Rotation(component) => {
                let [factor, _, _] = rotation_factor(cosine_of_rotation().value(a, b));
                factor * sine_of_rotation(component).value(a, b)
            }
        }
    }

    /// Its derivative by the vectors of both poses.
    pub fn gradient(self, a: &Pose, b: &Pose) -> PairVector {
        match self {
            Self::Distance(axis) => {
                let mut sum = PairVector::zeros();
                sum.set_column(axis_vector(axis), &(b.place - a.place));
                sum.set_column(PLACE, &-a.axis(axis));
                sum.set_column(VECTORS + PLACE, &a.axis(axis));
                sum
            }
            Self::Angle(axis) => {
                let (sine, cosine) = turn(axis);
                let (s, c) = (sine.value(a, b), cosine.value(a, b));
                (sine.gradient(a, b) * c - cosine.gradient(a, b) * s) / (s * s + c * c)
            }
            Self::Length => {
                let apart = b.place - a.place;
                let mut sum = PairVector::zeros();
                sum.set_column(PLACE, &(-apart / apart.norm()));
                sum.set_column(VECTORS + PLACE, &(apart / apart.norm()));
                sum
            }
            Self::Rotation(component) => {
                let (sine, cosine) = (sine_of_rotation(component), cosine_of_rotation());
                let [factor, slope, _] = rotation_factor(cosine.value(a, b));
                sine.gradient(a, b) * factor + cosine.gradient(a, b) * (slope * sine.value(a, b))
            }
        }
    }

    /// Adds `factor` times the product of its derivative with itself to what [`Self::add_hessian`] has added: the bend
    /// of a function of it.
    pub fn add_square(self, a: &Pose, b: &Pose, factor: f64, sum: &mut PairHessian) {
        if factor == 0.0 {
            return;
        }
        match self {
            Self::Angle(axis) => {
                // Its derivative is a sum of those of cosine and sine, whose products are there.
                let (sine, cosine) = turn(axis);
                let (s, c) = (sine.value(a, b), cosine.value(a, b));
                let over = factor / ((s * s + c * c) * (s * s + c * c));
                sum.add_weights([s * s, -s * c, c * c].map(|weight| weight * over));
            }
            Self::Distance(_) | Self::Length | Self::Rotation(_) => {
                sum.set_products([self.gradient(a, b), PairVector::zeros()], [factor, 0.0, 0.0]);
            }
        }
    }

    /// Adds `factor` times its second derivative by the vectors of both poses.
    pub fn add_hessian(self, a: &Pose, b: &Pose, factor: f64, sum: &mut PairHessian) {
        match self {
            Self::Distance(axis) => {
                sum.add_product(axis_vector(axis), PLACE, -factor);
                sum.add_product(axis_vector(axis), VECTORS + PLACE, factor);
            }
            Self::Angle(axis) => {
                let (sine, cosine) = turn(axis);
                let (s, c) = (sine.value(a, b), cosine.value(a, b));
                let square = s * s + c * c;
                sine.add_hessian(factor * c / square, sum);
                cosine.add_hessian(-factor * s / square, sum);
                let (same, mixed) = (2.0 * s * c, s * s - c * c);
                let over = factor / (square * square);
                sum.set_products([cosine.gradient(a, b), sine.gradient(a, b)], [same, mixed, -same].map(|w| w * over));
            }
            Self::Length => {
                let length = (b.place - a.place).norm();
                for (one, other, sign) in
                    [(PLACE, PLACE, 1.0), (PLACE, VECTORS + PLACE, -1.0), (VECTORS + PLACE, VECTORS + PLACE, 1.0)]
                {
                    sum.add_product(one, other, sign * factor / length);
                }
                sum.set_products([self.gradient(a, b), PairVector::zeros()], [-factor / length, 0.0, 0.0]);
            }
            Self::Rotation(component) => {
                let (sine, cosine) = (sine_of_rotation(component), cosine_of_rotation());
                let s = sine.value(a, b);
                let [own, slope, bend] = rotation_factor(cosine.value(a, b));
                sine.add_hessian(factor * own, sum);
                cosine.add_hessian(factor * slope * s, sum);
                let weights = [0.0, factor * slope, factor * bend * s];
                sum.set_products([sine.gradient(a, b), cosine.gradient(a, b)], weights);
            }
        }
    }
}

/// `angle` plus the whole turns that bring it nearest to `previous`, rad.
pub fn near(angle: f64, previous: f64) -> f64 {
    angle + 2.0 * PI * ((previous - angle) / (2.0 * PI)).round()
}

/// A sum of products of an axis of a and an axis of b: factor, axis of a, axis of b.
struct Products<const N: usize> {
    terms: [(f64, usize, usize); N],
    constant: f64,
}

impl<const N: usize> Products<N> {
    fn value(&self, a: &Pose, b: &Pose) -> f64 {
        self.constant + self.terms.iter().map(|(factor, i, j)| factor * a.axis(*i).dot(&b.axis(*j))).sum::<f64>()
    }

    fn gradient(&self, a: &Pose, b: &Pose) -> PairVector {
        let mut sum = PairVector::zeros();
        for (factor, i, j) in self.terms {
            add(&mut sum, axis_vector(i), &(b.axis(j) * factor));
            add(&mut sum, VECTORS + axis_vector(j), &(a.axis(i) * factor));
        }
        sum
    }

    fn add_hessian(&self, scale: f64, sum: &mut PairHessian) {
        for (factor, i, j) in self.terms {
            sum.add_product(axis_vector(i), VECTORS + axis_vector(j), scale * factor);
        }
    }
}

/// Twice sine and cosine of the turn of b against a about `axis`.
fn turn(axis: usize) -> (Products<2>, Products<2>) {
    let (j, k) = ((axis + 1) % 3, (axis + 2) % 3);
    let sine = Products { terms: [(1.0, k, j), (-1.0, j, k)], constant: 0.0 };
    let cosine = Products { terms: [(1.0, j, j), (1.0, k, k)], constant: 0.0 };
    (sine, cosine)
}

/// Component of the axis of the turn of b against a in a's axes, times the sine of its angle.
fn sine_of_rotation(component: usize) -> Products<2> {
    let (j, k) = ((component + 1) % 3, (component + 2) % 3);
    Products { terms: [(0.5, k, j), (-0.5, j, k)], constant: 0.0 }
}

/// Cosine of the angle of the turn of b against a.
fn cosine_of_rotation() -> Products<3> {
    Products { terms: [(0.5, 0, 0), (0.5, 1, 1), (0.5, 2, 2)], constant: -0.5 }
}

/// `f = acos(c)/sqrt(1 − c²)`, the angle over its sine, with its first two derivatives by the cosine `c`.
fn rotation_factor(c: f64) -> [f64; 3] {
    let x = 1.0 - c;
    if x < SMALL_TURN {
        // Σ n!/(2n+1)!! xⁿ: the closed form loses digits here.
        let (mut sums, mut term) = ([0.0; 3], 1.0);
        for n in 0..SERIES {
            let order = f64::from(n);
            sums[0] += term * x.powi(n);
            sums[1] -= if n > 0 { order * term * x.powi(n - 1) } else { 0.0 };
            sums[2] += if n > 1 { order * (order - 1.0) * term * x.powi(n - 2) } else { 0.0 };
            term *= (order + 1.0) / (2.0 * order + 3.0);
        }
        return sums;
    }
    let square = (1.0 - c) * (1.0 + c);
    let f = acos(c) / square.sqrt();
    let f_c = (c * f - 1.0) / square;
    [f, f_c, (f + 3.0 * c * f_c) / square]
}

/// Below this `1 − cos` the series is used: its ratio is at most a tenth there.
const SMALL_TURN: f64 = 0.2;
/// Terms of the series: what is left out is below round-off at [`SMALL_TURN`], in the second derivative too.
const SERIES: i32 = 20;

fn add(sum: &mut PairVector, vector: usize, value: &Vec3) {
    let mut column = sum.column_mut(vector);
    column += value;
}
