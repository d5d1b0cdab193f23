//! The frame inside the element: one minimal rotation from the first node, plus the integral of its twist rate (MECHANICS 2.7-2.15, 8).

use super::coordinates::THETA;
use super::curve_point::CurvePoint;
use super::element::{BendingPoint, Element};
use super::frame::NodeFrame;
use super::relative::RelativeShape;
use crate::math::rotation::{carry, half_turn, half_turn_by_first, half_turn_by_second};
use crate::math::{Mat3, Vec3};

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
        let (sin, cos) = previous.sin_cos();
        Self { angle: previous + (s * cos - c * sin).atan2(c * cos + s * sin), k: half_turn(&first.t, &second.t) }
    }

    /// `(∂β/∂p_0, ∂β/∂p_1)`, rad (2.8).
    #[inline]
    pub fn gradient(&self, first: &NodeFrame, second: &NodeFrame) -> (Vec3, Vec3) {
        ((self.k + first.k) / first.stretch, (self.k - second.k) / second.stretch)
    }

    /// `∂²β/∂p_0²`, `∂²β/∂p_0∂p_1`, `∂²β/∂p_1²`, rad: the blocks `H_00, H_01, H_11` of (2.9).
    #[inline]
    pub fn hessian(&self, first: &NodeFrame, second: &NodeFrame) -> [Mat3; 3] {
        let (l0, l1) = (first.stretch, second.stretch);
        let by_t0 = half_turn_by_first(&first.t, &second.t, &self.k);
        let by_t1 = half_turn_by_second(&first.t, &second.t, &self.k);
        [
            (first.by_p(&(by_t0 + first.k_t)) - (self.k + first.k) * first.t.transpose() / l0) / l0,
            second.by_p(&by_t1) / l0,
            (second.by_p(&(by_t1 - second.k_t)) - (self.k - second.k) * second.t.transpose() / l1) / l1,
        ]
    }
}

/// Everything first order that an element's energy needs, at one configuration.
#[derive(Clone, Debug)]
pub struct Kinematics<'a> {
    /// The element as its first node sees it.
    pub shape: RelativeShape<'a>,
    /// The three bending points.
    pub points: [CurvePoint; 3],
    /// Total twist `T`, rad (2.12).
    pub twist: f64,
    /// `α` at the bending points, rad (2.13).
    pub alpha: [f64; 3],
}

impl<'a> Kinematics<'a> {
    /// Of the element with coordinates `q` (14), nodes' frames and last accepted holonomy angle `previous`, rad.
    #[inline]
    pub fn new(element: &Element, q: &[f64], frames: [&'a NodeFrame; 2], previous: f64) -> Self {
        let shape = RelativeShape::new(q, frames, previous);
        let [first, middle, last] = &element.bending;
        let point = |rule: &BendingPoint| CurvePoint::new(&shape, &rule.shape_x, &rule.shape_xx);
        let points = [point(first), point(middle), point(last)];
        let mut kinematics = Self { shape, points, twist: 0.0, alpha: [0.0; 3] };
        kinematics.twist = kinematics.shape.twist + kinematics.weighted_rate(&element.rate_weights);
        for (g, rule) in element.bending.iter().enumerate() {
            kinematics.alpha[g] = kinematics.alpha_at(q, rule.xi, &rule.collocation);
        }
        kinematics
    }

    /// `Σ_g weight_g ω_g`.
    fn weighted_rate(&self, weights: &[f64; 3]) -> f64 {
        weights.iter().zip(&self.points).map(|(weight, point)| weight * point.twist_rate).sum()
    }

    /// Angle of the section against the frame carried from the first node, at `xi`, rad (2.13); `collocation` is `l A_h(ξ)`, m.
    pub fn alpha_at(&self, q: &[f64], xi: f64, collocation: &[f64; 3]) -> f64 {
        q[THETA] + xi * self.twist - self.weighted_rate(collocation)
    }
}
