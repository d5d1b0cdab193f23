//! Secants of functions of a point: directions `n̄` with `n̄·(y₁ − y₀) = f(y₁) − f(y₀)` over a step from `y₀` to `y₁`.
//!
//! A chain of functions has the chain of their secants.

use crate::math::{Mat3, Vec3};

/// Lengths, over those of the shape, below which directions are round-off.
pub(super) const NO_LENGTH: f64 = 1e-300;
/// Share of the size of a shape that a way must have for what its middle misses to be more than round-off.
const LEAST_WAY: f64 = 1e-7;

/// A direction over a step, and its derivative with respect to the point at the end.
#[derive(Clone, Copy, Debug)]
pub struct Secant {
    /// `n̄`; its length is not 1 where the normal turns over the step.
    pub direction: Vec3,
    /// `∂n̄/∂y₁`, 1/m.
    pub by_end: Mat3,
}

/// A function at one point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Local {
    pub value: f64,
    pub gradient: Vec3,
    /// Derivative of the gradient.
    pub curvature: Mat3,
}

/// The part of the way of a number that lies above 0, over the whole way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub share: f64,
    /// Its derivative with respect to the number at the end.
    pub by_end: f64,
}

/// `y` without its part along the axis.
pub(super) fn across(y: &Vec3) -> Vec3 {
    Vec3::new(0.0, y.y, y.z)
}

/// Distance from the axis, m.
pub(super) fn axis_distance(y: &Vec3) -> f64 {
    (y.y * y.y + y.z * y.z).sqrt()
}

/// A point in the plane through it and the axis: its position along the axis and its distance from that.
pub(super) fn in_meridian(y: &Vec3) -> Vec3 {
    Vec3::new(y.x, axis_distance(y), 0.0)
}

impl Share {
    pub(super) fn over(start: f64, end: f64) -> Self {
        if start > 0.0 && end > 0.0 {
            return Self { share: 1.0, by_end: 0.0 };
        }
        if start <= 0.0 && end <= 0.0 {
            return Self { share: 0.0, by_end: 0.0 };
        }
        let way = end - start;
        let share = (end.max(0.0) - start.max(0.0)) / way;
        Self { share, by_end: (f64::from(end > 0.0) - share) / way }
    }
}

impl Secant {
    /// A function that does not change, or one that changes the same everywhere.
    pub(super) fn constant(direction: Vec3) -> Self {
        Self { direction, by_end: Mat3::zeros() }
    }

    /// The secant of `|y|`, `(y₀ + y₁)/(|y₀| + |y₁|)`.
    pub(super) fn of_norm(start: &Vec3, end: &Vec3) -> Self {
        let (length, sum) = (end.norm().max(NO_LENGTH), (start.norm() + end.norm()).max(NO_LENGTH));
        let direction = (start + end) / sum;
        Self { direction, by_end: (Mat3::identity() - direction * (end / length).transpose()) / sum }
    }

    /// The secant of a function of the point in the plane through the axis, by its own secant there.
    pub(super) fn of_meridian(start: &Vec3, end: &Vec3, inner: &Self) -> Self {
        let radial = Self::of_norm(&across(start), &across(end));
        let out = across(end) / axis_distance(end).max(NO_LENGTH);
        let by_point = inner.by_end.column(0) * Vec3::x().transpose() + inner.by_end.column(1) * out.transpose();
        let mut by_end = radial.direction * by_point.row(1);
        by_end += radial.by_end * Mat3::from_diagonal(&Vec3::new(0.0, 1.0, 1.0)) * inner.direction.y;
        let along = by_end.row(0) + by_point.row(0);
        by_end.set_row(0, &along);
        Self { direction: Vec3::x() * inner.direction.x + radial.direction * inner.direction.y, by_end }
    }

    /// The secant of a function that has different pieces at both ends, of a shape of this `size`: the gradient in the
    /// middle, and along the way what that misses.
    pub(super) fn of_pieces(local: impl Fn(&Vec3) -> Local, start: &Vec3, end: &Vec3, size: f64) -> Self {
        let middle = local(&((start + end) * 0.5));
        let (way, by_middle) = (end - start, middle.curvature * 0.5);
        let square = way.norm_squared();
        if square < (LEAST_WAY * size).powi(2) {
            return Self { direction: middle.gradient, by_end: by_middle };
        }
        let [first, last] = [start, end].map(&local);
        let missed = (last.value - first.value - middle.gradient.dot(&way)) / square;
        let missed_by_end =
            (last.gradient - middle.gradient - by_middle.tr_mul(&way)) / square - way * (2.0 * missed / square);
        Self {
            direction: middle.gradient + way * missed,
            by_end: by_middle + way * missed_by_end.transpose() + Mat3::identity() * missed,
        }
    }
}
