//! The share of a round section that is below the surface, and the parts of an element that this divides it into.
//!
//! A section across the unit tangent `t` whose axis is `d` above the surface is cut at the distance `d/c`,
//! `c = √(1 − t_z²)`, from its middle: it is dry from `d = R c` on, wet from `d = −R c` on, and a segment of the circle
//! is wet between. Where the axis crosses the surface steeply, that range is short: quadrature with points at fixed
//! positions would see forces jump. The range is a part of the element of its own, with a rule of its own.

use crate::math::elementary::acos;
use crate::math::quadrature::{FOUR_POINTS, FOUR_WEIGHTS};
use std::f64::consts::PI;

/// Least `c`: the surface cuts a vertical beam along a line as thin as this times its radius.
const LEAST_SINE: f64 = 1e-3;
/// Positions at which crossings are looked for: the points of the rule, and both ends.
const LOOKED_AT: [f64; 6] = [0.0, FOUR_POINTS[0], FOUR_POINTS[1], FOUR_POINTS[2], FOUR_POINTS[3], 1.0];
/// Most crossings that a cubic curve has: three with each limit of the range, and both ends.
const MOST_PARTS: usize = 8;
/// Halvings of the interval that has a crossing: more than a double has digits.
const HALVINGS: usize = 54;

/// The axis at a position in an element.
#[derive(Clone, Copy, Debug)]
pub struct AxisPoint {
    /// Height above the surface, m.
    pub height: f64,
    /// z of the unit tangent, 1.
    pub rise: f64,
    /// Radius of the section, m.
    pub radius: f64,
}

impl AxisPoint {
    /// Half the range of heights in which the section is wet in part, m.
    fn reach(&self) -> f64 {
        self.radius * (1.0 - self.rise * self.rise).max(LEAST_SINE * LEAST_SINE).sqrt()
    }

    /// Above zero: it is dry.
    fn above(&self) -> f64 {
        self.height - self.reach()
    }

    /// Below zero: it is all wet.
    fn below(&self) -> f64 {
        self.height + self.reach()
    }

    /// Share of the section that is wet, and its derivative with respect to the height, 1/m.
    pub fn share(&self) -> (f64, f64) {
        let reach = self.reach().max(f64::MIN_POSITIVE);
        let x = (self.height / reach).clamp(-1.0, 1.0);
        let chord = (1.0 - x * x).sqrt();
        ((acos(x) - x * chord) / PI, -2.0 * chord / (PI * reach))
    }
}

/// A point of the quadrature over what is wet of an element.
#[derive(Clone, Copy, Debug)]
pub struct WetPoint {
    /// Place in the element, 0 to 1.
    pub xi: f64,
    /// Weight, as a share of the element.
    pub weight: f64,
    /// Share of the section that is wet, 0 to 1.
    pub share: f64,
    /// Its derivative with respect to the height of the axis, 1/m.
    pub share_z: f64,
}

/// Calls `take` with the points of the quadrature over the wet part of an element up to `end` (0 to 1), whose axis is
/// `axis`.
pub fn each_wet_point(end: f64, axis: impl Fn(f64) -> AxisPoint, mut take: impl FnMut(WetPoint)) {
    let looked_at = LOOKED_AT.map(|xi| axis(end * xi));
    let is_wet = |point: &AxisPoint| point.below() <= 0.0;
    let mut part = |[from, to]: [f64; 2], is_partly: bool| {
        for (point, weight) in FOUR_POINTS.into_iter().zip(FOUR_WEIGHTS) {
            let xi = from + (to - from) * point;
            let (share, share_z) = if is_partly { axis(xi).share() } else { (1.0, 0.0) };
            take(WetPoint { xi, weight: weight * (to - from), share, share_z });
        }
    };
    if looked_at.iter().all(is_wet) {
        return part([0.0, end], false);
    }
    if looked_at.iter().all(|point| point.above() >= 0.0) {
        return;
    }
    let (mut limits, mut count) = ([end; MOST_PARTS], 1);
    limits[0] = 0.0;
    for limit in [AxisPoint::above, AxisPoint::below] {
        for (pair, at) in looked_at.windows(2).zip(LOOKED_AT.windows(2)) {
            let is_low = limit(&pair[0]) <= 0.0;
            if is_low != (limit(&pair[1]) <= 0.0) && count < MOST_PARTS - 1 {
                limits[count] = crossing([end * at[0], end * at[1]], |xi| (limit(&axis(xi)) <= 0.0) == is_low);
                count += 1;
            }
        }
    }
    let limits = &mut limits[..=count];
    limits.sort_by(f64::total_cmp);
    for ends in limits.windows(2) {
        let middle = axis(0.5 * (ends[0] + ends[1]));
        if ends[1] > ends[0] && middle.above() < 0.0 {
            part([ends[0], ends[1]], !is_wet(&middle));
        }
    }
}

/// Where `is_first` ends between two positions.
fn crossing([mut from, mut to]: [f64; 2], is_first: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (from + to);
        *(if is_first(middle) { &mut from } else { &mut to }) = middle;
    }
    0.5 * (from + to)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn volume(height: impl Fn(f64) -> f64, rise: f64) -> f64 {
        let mut sum = 0.0;
        each_wet_point(
            1.0,
            |xi| AxisPoint { height: height(xi), rise, radius: 0.1 },
            |point| sum += point.weight * point.share,
        );
        sum
    }

    /// The wet part of a straight beam is as long as the axis below the surface, steep or flat, by symmetry; the
    /// tolerance is that of the rule for the circular segment.
    #[test]
    fn wet_lengths() {
        for (slope, rise) in [(1.0, 1.0), (2.0, 0.9), (3.0, 0.2), (0.4, 0.05)] {
            let wet = volume(|xi| slope * (xi - 0.4), rise);
            assert!((wet - 0.4).abs() < 2e-4, "{slope}: {wet}");
            assert!((volume(|xi| slope * (0.4 - xi), rise) - 0.6).abs() < 2e-4);
        }
        assert_eq!(volume(|_| 0.2, 0.0), 0.0);
        assert!((volume(|_| -0.2, 0.0) - 1.0).abs() < 1e-15);
        // Half of a level cylinder with its axis in the surface.
        assert!((volume(|_| 0.0, 0.0) - 0.5).abs() < 1e-15);
    }

    /// A sagging beam is wet in its middle, and a hogging one at its ends.
    #[test]
    fn two_crossings() {
        let bow = |xi: f64| (xi - 0.5) * (xi - 0.5) - 0.09;
        assert!((volume(bow, 1.0) - 0.6).abs() < 1e-4);
        assert!((volume(|xi| -bow(xi), 1.0) - 0.4).abs() < 1e-4);
    }
}
