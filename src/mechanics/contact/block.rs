//! The distance from a box: from its faces, its edges and its corners.
//!
//! Outside it is `|m|` with `m_i = max(|y_i| − h_i, 0)`, a chain that has exact secants. Inside it is that from the
//! nearest face, which another one may be at the other end of a step.

use super::secant::{Local, NO_LENGTH, Secant, Share};
use crate::math::{Mat3, Vec3};

/// A face, and how far a point is above it.
#[derive(Clone, Copy, Debug)]
struct Face {
    axis: usize,
    sign: f64,
    height: f64,
}

/// Distance of `y` from a box that reaches as far as `half` from its middle, m.
pub(super) fn distance(half: &Vec3, y: &Vec3) -> f64 {
    outside(half, y).norm() + Face::nearest(half, y).height.min(0.0)
}

/// How far `y` is beyond the box along each axis.
fn outside(half: &Vec3, y: &Vec3) -> Vec3 {
    y.zip_map(half, |y, half| (y.abs() - half).max(0.0))
}

impl Face {
    /// The face that `y` is nearest to from inside.
    fn nearest(half: &Vec3, y: &Vec3) -> Self {
        let height = y.abs() - half;
        let axis = height.imax();
        Self { axis, sign: 1_f64.copysign(y[axis]), height: height[axis] }
    }

    fn normal(&self) -> Vec3 {
        Vec3::ith(self.axis, self.sign)
    }

    fn local(half: &Vec3, y: &Vec3) -> Local {
        let face = Self::nearest(half, y);
        let gradient = if face.height <= 0.0 { face.normal() } else { Vec3::zeros() };
        Local { value: face.height.min(0.0), gradient, curvature: Mat3::zeros() }
    }
}

/// A number of the face, the edge or the corner that `y` is nearest to; inside of what face it is under.
pub(super) fn part(half: &Vec3, y: &Vec3) -> usize {
    let face = Face::nearest(half, y);
    let digit = |axis: usize| match face.height > 0.0 {
        true => usize::from(y[axis] > half[axis]) + 2 * usize::from(y[axis] < -half[axis]),
        false if axis == face.axis => 1 + usize::from(face.sign < 0.0),
        false => 0,
    };
    digit(0) + 3 * (digit(1) + 3 * digit(2))
}

/// The secant of the distance.
pub(super) fn secant(half: &Vec3, start: &Vec3, end: &Vec3) -> Secant {
    let (out, depth) = (secant_outside(half, start, end), secant_of_depth(half, start, end));
    Secant { direction: out.direction + depth.direction, by_end: out.by_end + depth.by_end }
}

fn secant_outside(half: &Vec3, start: &Vec3, end: &Vec3) -> Secant {
    let inner = Secant::of_norm(&outside(half, start), &outside(half, end));
    let mut found = Secant::constant(Vec3::zeros());
    let slope = |axis: usize| f64::from(end[axis] > half[axis]) - f64::from(end[axis] < -half[axis]);
    for axis in 0..3 {
        let above = Share::over(start[axis] - half[axis], end[axis] - half[axis]);
        let below = Share::over(-start[axis] - half[axis], -end[axis] - half[axis]);
        let share = above.share - below.share;
        found.direction[axis] = inner.direction[axis] * share;
        // Inside, directions have no length, and their derivatives no bound.
        if share != 0.0 {
            (0..3).for_each(|other| found.by_end[(axis, other)] = inner.by_end[(axis, other)] * slope(other) * share);
        }
        found.by_end[(axis, axis)] += inner.direction[axis] * (above.by_end + below.by_end);
    }
    found
}

fn secant_of_depth(half: &Vec3, start: &Vec3, end: &Vec3) -> Secant {
    let [first, last] = [start, end].map(|y| Face::nearest(half, y));
    if first.height > 0.0 && last.height > 0.0 {
        return Secant::constant(Vec3::zeros());
    }
    if first.axis != last.axis || first.sign != last.sign {
        return Secant::of_pieces(|y| Face::local(half, y), start, end, half.max());
    }
    let outside = Share::over(first.height, last.height);
    let mut found = Secant::constant(last.normal() * (1.0 - outside.share));
    found.by_end[(last.axis, last.axis)] = -outside.by_end;
    found
}

/// Whether the way from `start` to `end` leads through a box.
pub(super) fn is_crossed(half: &Vec3, start: &Vec3, end: &Vec3) -> bool {
    let (mut enter, mut leave) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let [from, to] = within(half[axis], start[axis], end[axis]);
        (enter, leave) = (enter.max(from), leave.min(to));
    }
    enter < leave
}

/// The part of a way, by its shares, on which a number is between `-half` and `half`.
pub(super) fn within(half: f64, start: f64, end: f64) -> [f64; 2] {
    let way = end - start;
    if way.abs() < NO_LENGTH {
        return if start.abs() < half { [0.0, 1.0] } else { [1.0, 0.0] };
    }
    let [one, other] = [-half, half].map(|border| (border - start) / way);
    [one.min(other).max(0.0), one.max(other).min(1.0)]
}
