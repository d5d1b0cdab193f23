//! Frames along a curve: Bishop's, which does not twist, and beside it the one of Serret and Frenet, which is not
//! always there.
//!
//! Bishop's frame is carried by one minimal rotation (MECHANICS 2.2), which needs neither a branch nor an arccosine,
//! and then turned by what that rotation twists on the way, `−∫ω ds` with `ω = −t_0·(r' × r'')/(|r'|² (1 + t_0·t))`
//! (2.11): the solid angle between the path of the tangent and the great circle that the rotation takes. The integral
//! is good to `ROUND_OFF`, whatever the number of steps.

use super::Vec3;
use super::curve::Curve;
use super::rotation::carry;
use crate::math::elementary::{atan2, sin_cos};

/// Error of the angle of one stretch, rad: the round-off of `r'` and `r''`.
const ROUND_OFF: f64 = 1e-15;
/// Largest turning of the tangent in one minimal rotation, rad: a right angle is far from the singular half turn.
const LARGEST_TURNING: f64 = std::f64::consts::FRAC_PI_2;
/// Halvings of a stretch at most: what turns further in less is a kink.
const DEEPEST: u32 = 50;

/// The unit normal `normal` of the curve at `from`, carried to `to` without twist.
pub fn carried(curve: &Curve, from: f64, to: f64, normal: &Vec3) -> Vec3 {
    stretch(curve, from, to, normal, 0)
}

fn stretch(curve: &Curve, from: f64, to: f64, normal: &Vec3, depth: u32) -> Vec3 {
    let turning = curve.integral(&|s| curve.tangent_rate(s).norm(), from, to, 1e-3);
    if turning > LARGEST_TURNING && depth < DEEPEST {
        let middle = 0.5 * (from + to);
        let halfway = stretch(curve, from, middle, normal, depth + 1);
        return stretch(curve, middle, to, &halfway, depth + 1);
    }
    let tangent = curve.tangent(to);
    let u = carry(&curve.tangent(from), &tangent, normal);
    let (sin, cos) = sin_cos(turn(curve, from, to));
    (u * cos + tangent.cross(&u) * sin).normalize()
}

/// `−∫ω ds`, rad: the angle about the tangent at `to` from a normal that one minimal rotation brings there from `from`
/// to the same normal carried without twist. Where pieces of the curve meet at an angle, the normal goes round the
/// corner by a minimal rotation.
///
/// In between the tangent stays less than half a turn from where it begins.
pub fn turn(curve: &Curve, from: f64, to: f64) -> f64 {
    let base = curve.tangent(from);
    let rate = |s: f64| {
        let [_, first, second] = curve.at(s);
        let speed = first.norm();
        base.dot(&first.cross(&second)) / (speed * (speed + base.dot(&first)))
    };
    let corner = |limit: f64| {
        let (before, after) = (curve.tangent(limit.next_down()), curve.tangent(limit));
        // The solid angle of the triangle of the three tangents.
        2.0 * atan2(base.dot(&before.cross(&after)), 1.0 + base.dot(&before) + before.dot(&after) + after.dot(&base))
    };
    curve.integral(&rate, from, to, ROUND_OFF) + curve.limits_between(from, to).map(corner).sum::<f64>()
}

/// The Serret-Frenet frame at a point of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frenet {
    /// Unit tangent.
    pub tangent: Vec3,
    /// Unit normal, towards the center of curvature.
    pub normal: Vec3,
    /// Unit binormal, `tangent × normal`.
    pub binormal: Vec3,
    /// Curvature, 1/m.
    pub curvature: f64,
}

/// What of the Serret-Frenet frame is not defined at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undefined {
    /// The tangent: the curve stands still.
    Tangent,
    /// The normal: the curve is straight here, at an inflexion or along a straight piece.
    Normal,
}

/// Of `r' × r''` what is round-off, relative to its factors.
const STRAIGHT: f64 = 1e-14;

/// The Serret-Frenet frame at the parameter `s`.
///
/// # Errors
/// It is not defined: the curve stands still or is straight there.
pub fn frenet(curve: &Curve, s: f64) -> Result<Frenet, Undefined> {
    let [_, first, second] = curve.at(s);
    let speed = first.norm();
    let area = first.cross(&second);
    if speed == 0.0 {
        return Err(Undefined::Tangent);
    }
    if area.norm() <= STRAIGHT * speed * second.norm() {
        return Err(Undefined::Normal);
    }
    let (tangent, binormal) = (first / speed, area.normalize());
    Ok(Frenet { tangent, normal: binormal.cross(&tangent), binormal, curvature: area.norm() / speed.powi(3) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::jet::Jet;
    use std::f64::consts::TAU;
    use std::sync::Arc;

    fn curve(range: [f64; 2], coordinates: impl Fn(Jet) -> [Jet; 3] + Send + Sync + 'static) -> Curve {
        Curve::new(Arc::new(move |s| coordinates(Jet::variable(s))), range, Vec::new())
    }

    fn number(value: f64) -> Jet {
        Jet::constant(value)
    }

    /// Against Frenet's frame Bishop's turns back by the integral of the torsion, `b s/(a² + b²)` along a helix: 2.5
    /// turns, one call or many, to round-off. The paper's chain of rotations through points errs by the square of their
    /// distance.
    #[test]
    fn bishop_turns_against_frenet_by_the_torsion() {
        let (a, b) = (0.7, 0.4);
        let helix = curve([0.0, 5.0], move |s| {
            let angle = number(0.5 * TAU) * s;
            [number(a) * angle.cos(), number(a) * angle.sin(), number(b) * angle]
        });
        let start = frenet(&helix, 0.0).expect("a helix is curved");
        assert!((start.curvature - a / (a * a + b * b)).abs() < 1e-15);
        for (from, to) in [(0.0, 5.0), (0.0, 0.3), (1.2, 1.7)] {
            let begin = frenet(&helix, from).expect("curved");
            let end = frenet(&helix, to).expect("curved");
            let torsion = b / (a * a + b * b) * 0.5 * TAU * (to - from) * a.hypot(b);
            let expected = end.normal * torsion.cos() - end.binormal * torsion.sin();
            let once = carried(&helix, from, to, &begin.normal);
            assert!((once - expected).norm() < 1e-13, "{from} to {to}: {:e}", (once - expected).norm());
            let mut often = begin.normal;
            for k in 0..10 {
                let at = |k: i32| from + (to - from) * f64::from(k) / 10.0;
                often = carried(&helix, at(k), at(k + 1), &often);
            }
            assert!((often - expected).norm() < 1e-13, "{from} to {to} in steps: {:e}", (often - expected).norm());
        }
    }

    /// Along a straight piece nothing turns, and Frenet's frame is not there: it must say so, not give a direction.
    #[test]
    fn straight_pieces_carry_the_frame_unchanged() {
        // Not at equal speed: the second derivative is along the line, and no curvature.
        let line = curve([0.1, 1.0], |s| [s * s, number(2.0) * s * s, number(-1.0) * s * s]);
        let normal = Vec3::new(2.0, -1.0, 0.0).normalize();
        assert!((carried(&line, 0.1, 1.0, &normal) - normal).norm() < 1e-15);
        assert_eq!(frenet(&line, 0.5), Err(Undefined::Normal));
        let still = curve([0.0, 1.0], |s| [s * s, s * s * s, number(0.0)]);
        assert_eq!(frenet(&still, 0.0), Err(Undefined::Tangent));
    }

    /// At the inflexion of a planar curve Frenet's normal flips over; Bishop's stays in the plane and across it.
    #[test]
    fn bishop_passes_an_inflexion() {
        let cubic = curve([-1.0, 1.0], |s| [s, s * s * s, number(0.0)]);
        let (before, after) = (frenet(&cubic, -1e-3).expect("curved"), frenet(&cubic, 1e-3).expect("curved"));
        assert!(before.normal.dot(&after.normal) < -0.999 && before.binormal.dot(&after.binormal) < -0.999);
        assert_eq!(frenet(&cubic, 0.0), Err(Undefined::Normal));
        let carried_normal = carried(&cubic, -1.0, 1.0, &Vec3::z());
        assert!((carried_normal - Vec3::z()).norm() < 1e-15);
        let start = frenet(&cubic, -1.0).expect("curved");
        let end = frenet(&cubic, 1.0).expect("curved");
        assert!((carried(&cubic, -1.0, 1.0, &start.normal) + end.normal).norm() < 1e-14);
    }

    /// Round a corner between two pieces the frame goes by a minimal rotation: one call over the corner, or one to it
    /// and one from it.
    #[test]
    fn bishop_goes_round_corners() {
        let coordinates = |s: f64| {
            let s = Jet::variable(s);
            let bent = s - number(1.0);
            // A helix-like piece, then one that leaves it at an angle of some degrees.
            match s.value < 1.0 {
                true => [s, (s * number(0.8)).sin(), (s * number(0.8)).cos()],
                false => [s, number(0.8_f64.sin()) + number(0.4) * bent, number(0.8_f64.cos()) - bent * bent],
            }
        };
        let bent = Curve::new(Arc::new(coordinates), [0.0, 2.0], vec![1.0]);
        let normal = bent.tangent(0.0).cross(&Vec3::z()).normalize();
        let once = carried(&bent, 0.0, 1.6, &normal);
        let round = carried(&bent, 1.0, 1.6, &carried(&bent, 0.0, 1.0, &normal));
        assert!((once - round).norm() < 1e-14, "{:e}", (once - round).norm());
        let before = carried(&bent, 0.0, 1.0_f64.next_down(), &normal);
        let after = carry(&bent.tangent(1.0_f64.next_down()), &bent.tangent(1.0), &before);
        let twice = carried(&bent, 1.0, 1.6, &after);
        assert!((once - twice).norm() < 1e-14, "{:e}", (once - twice).norm());
        assert!(bent.tangent(1.0).dot(&bent.tangent(1.0_f64.next_down())) < 0.99);
    }
}
