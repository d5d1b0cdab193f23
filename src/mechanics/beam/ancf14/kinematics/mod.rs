//! The frame inside the element: one minimal rotation from the first node, plus the integral of its twist rate
//! (MECHANICS 2.7-2.15, 8).

pub mod corotated;
pub mod curve_point;
pub mod points;
pub mod section_point;
pub mod strain_derivatives;

use self::corotated::CorotatedShape;
use self::curve_point::CurvePoint;
use self::points::BendingPoint;
use super::coordinates::THETA;
use super::element::Element;
use super::frame::NodeFrame;
use crate::math::elementary::atan2;
use crate::math::rotation::{carry, half_turn};
use crate::math::{Mat3, Vec3};
use std::f64::consts::TAU;

/// Holonomy angle of the second node's frame against the first node's carried by one minimal rotation (2.7).
#[derive(Clone, Copy, Debug)]
pub struct Holonomy {
    /// `β`, rad, on the branch of the last accepted state.
    pub angle: f64,
    k: Vec3,
}

impl Holonomy {
    /// Between the frames of an element's nodes; `previous` is the angle of the last accepted state, rad.
    #[inline]
    pub fn new(first: &NodeFrame, second: &NodeFrame, previous: f64) -> Self {
        let u_c = carry(&first.t, &second.t, &first.u);
        let (s, c) = (second.u.dot(&second.t.cross(&u_c)), second.u.dot(&u_c));
        let angle = atan2(s, c);
        let turns = (previous - angle) / TAU;
        // Nearly always less than half a turn: to round it is a call of the C library where processors have no
        // instruction for it.
        let turns = if turns.abs() < 0.5 { 0.0_f64.copysign(turns) } else { turns.round() };
        Self { angle: angle + TAU * turns, k: half_turn(&first.t, &second.t) }
    }

    /// `(∂β/∂p_0, ∂β/∂p_1)`, rad (2.8).
    #[inline]
    pub fn gradient(&self, first: &NodeFrame, second: &NodeFrame) -> (Vec3, Vec3) {
        ((self.k + first.k) / first.stretch, (self.k - second.k) / second.stretch)
    }

    /// First and second derivatives in the axes of the first frame.
    ///
    /// Each part of (2.9) is `∂kb/∂t (I − t tᵀ) = [t]×/2 − t kᵀ + (k lᵀ + l kᵀ)/2`, `l = k × t`, of a turn `k` to the
    /// tangent `t` or away from it; what is not symmetric cancels in the derivatives by the same slope twice.
    #[inline]
    pub fn local(&self, first: &NodeFrame, second: &NodeFrame) -> LocalHolonomy {
        let (per_0, per_1) = (1.0 / first.stretch, 1.0 / second.stretch);
        let [k0_u, k0_v] = first.k_local();
        let [u, v] = [first.u.dot(&self.k), first.v.dot(&self.k)];
        let (t, k1) = (first.components(&second.t), first.components(&second.k));
        let k = Vec3::new(0.0, u, v);
        let (l, l1) = (Vec3::new(u * t[2] - v * t[1], v * t[0], -u * t[0]), k1.cross(&t));
        let change = k - k1;
        let square = 0.5 * per_0 * per_0;
        let (square_1, both) = (per_1 * per_1, per_0 * per_1);
        let mut p1_p1 = Mat3::zeros();
        for j in 0..3 {
            for i in j..3 {
                let turned = 0.5 * (k[i] * l[j] + l[i] * k[j] - k1[i] * l1[j] - l1[i] * k1[j]);
                p1_p1[(i, j)] = (turned - t[i] * change[j] - change[i] * t[j]) * square_1;
            }
        }
        LocalHolonomy {
            p0: Vec3::new(0.0, u + k0_u, v + k0_v) * per_0,
            p1: change * per_1,
            p0_p0: [
                2.0 * (k0_u * k0_v - u * v) * square,
                (k0_v * k0_v - k0_u * k0_u + u * u - v * v) * square,
                2.0 * (u * v - k0_u * k0_v) * square,
            ],
            p0_p1: [
                (Vec3::new(t[2], 0.0, -t[0]) * 0.5 + l * (0.5 * u) + k * (0.5 * l[1] - t[1])) * both,
                (Vec3::new(-t[1], t[0], 0.0) * 0.5 + l * (0.5 * v) + k * (0.5 * l[2] - t[2])) * both,
            ],
            p1_p1,
        }
    }
}

/// Derivatives of the holonomy angle in the axes `[t u v]` of the first frame, rad.
#[derive(Clone, Copy, Debug)]
pub struct LocalHolonomy {
    /// `∂β/∂p_0`; nothing along `t`.
    pub p0: Vec3,
    /// `∂β/∂p_1`.
    pub p1: Vec3,
    /// `∂²β/∂p_0²`: `uu`, `vu`, `vv`. Along `t` it is 0 with `t`, and `−∂β/∂p_0/|p_0|` with the others.
    pub p0_p0: [f64; 3],
    /// Rows `u` and `v` of `∂²β/∂p_0∂p_1`; the first one is 0.
    pub p0_p1: [Vec3; 2],
    /// `∂²β/∂p_1²`; the lower triangle counts.
    pub p1_p1: Mat3,
}

/// Everything first order that an element's energy needs, at one configuration.
#[derive(Clone, Debug)]
pub struct Kinematics<'a> {
    /// The element as its first node sees it.
    pub shape: CorotatedShape<'a>,
    /// The three bending points.
    pub points: [CurvePoint; 3],
    /// Total twist `T`, rad (2.12).
    pub twist: f64,
    /// `α` at the bending points, rad (2.13).
    pub alpha: [f64; 3],
}

impl<'a> Kinematics<'a> {
    /// Of the element with coordinates `q` (14), nodes' frames and last accepted holonomy angle `previous`, rad.
    #[inline(always)]
    pub fn new(element: &Element, q: &[f64], frames: [&'a NodeFrame; 2], previous: f64) -> Self {
        let shape = CorotatedShape::new(q, frames, previous);
        let [first, middle, last] = &element.bending;
        let point = |rule: &BendingPoint| CurvePoint::new(&shape, &rule.shape_x, &rule.shape_xx);
        let points = [point(first), point(middle), point(last)];
        let twist = shape.twist + weighted_rate(&element.rate_weights, &points);
        let alpha = |rule: &BendingPoint| alpha_at(q, (rule.xi, &rule.collocation), twist, &points);
        let alpha = [alpha(first), alpha(middle), alpha(last)];
        Self { shape, points, twist, alpha }
    }

    /// Angle of the section against the frame carried from the first node, at `xi`, rad (2.13); `collocation` is
    /// `l A_h(ξ)`, m.
    pub fn alpha_at(&self, q: &[f64], xi: f64, collocation: &[f64; 3]) -> f64 {
        alpha_at(q, (xi, collocation), self.twist, &self.points)
    }
}

/// `Σ_g weight_g ω_g`.
#[inline(always)]
fn weighted_rate(weights: &[f64; 3], points: &[CurvePoint; 3]) -> f64 {
    weights[0] * points[0].twist_rate + weights[1] * points[1].twist_rate + weights[2] * points[2].twist_rate
}

/// [`Kinematics::alpha_at`] with the total twist `twist`, rad.
#[inline(always)]
fn alpha_at(q: &[f64], (xi, collocation): (f64, &[f64; 3]), twist: f64, points: &[CurvePoint; 3]) -> f64 {
    q[THETA] + xi * twist - weighted_rate(collocation, points)
}
