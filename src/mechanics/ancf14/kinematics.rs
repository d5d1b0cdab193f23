//! The frame inside the element: one minimal rotation from the first node, plus the integral of its twist rate (MECHANICS 2.7-2.15, 8).

use super::coordinates::{ELEMENT, ElementMatrix, ElementVector, NODE, P, SHAPE_PLACES, THETA, interpolate};
use super::element::Element;
use super::frame::NodeFrame;
use crate::math::rotation::{carry, half_turn, half_turn_by_first, half_turn_by_second};
use crate::math::{Mat3, Vec3};
use nalgebra::SMatrix;

/// Holonomy angle of the second node's frame against the first node's carried by one minimal rotation (2.7).
#[derive(Clone, Copy, Debug)]
pub struct Holonomy {
    /// `β`, rad, on the branch of the last accepted state.
    pub angle: f64,
    k: Vec3,
    by_t0: Mat3,
    by_t1: Mat3,
}

impl Holonomy {
    /// Between the frames of an element's nodes; `previous` is the angle of the last accepted state, rad.
    pub fn new(first: &NodeFrame, second: &NodeFrame, previous: f64) -> Self {
        let k = half_turn(&first.t, &second.t);
        let u_c = carry(&first.t, &second.t, &first.u);
        let (s, c) = (second.u.dot(&second.t.cross(&u_c)), second.u.dot(&u_c));
        let (sin, cos) = previous.sin_cos();
        Self {
            angle: previous + (s * cos - c * sin).atan2(c * cos + s * sin),
            k,
            by_t0: half_turn_by_first(&first.t, &second.t, &k),
            by_t1: half_turn_by_second(&first.t, &second.t, &k),
        }
    }

    /// `(∂β/∂p_0, ∂β/∂p_1)`, rad (2.8).
    pub fn gradient(&self, first: &NodeFrame, second: &NodeFrame) -> (Vec3, Vec3) {
        ((self.k + first.k) / first.stretch, (self.k - second.k) / second.stretch)
    }

    /// Adds `factor ∂²β/∂q²` to `sum`, 14×14: the blocks `H_00, H_01, H_11` of (2.9).
    pub fn add_hessian(&self, sum: &mut ElementMatrix, first: &NodeFrame, second: &NodeFrame, factor: f64) {
        let (l0, l1) = (first.stretch, second.stretch);
        let h_00 = (self.by_t0 + first.k_t) * first.t_p() / l0 - (self.k + first.k) * first.t.transpose() / (l0 * l0);
        let h_01 = self.by_t1 * second.t_p() / l0;
        let h_11 =
            (self.by_t1 - second.k_t) * second.t_p() / l1 - (self.k - second.k) * second.t.transpose() / (l1 * l1);
        for (row, column, block) in
            [(P, P, h_00), (P, NODE + P, h_01), (NODE + P, P, h_01.transpose()), (NODE + P, NODE + P, h_11)]
        {
            let mut view = sum.fixed_view_mut::<3, 3>(row, column);
            view += block * factor;
        }
    }
}

/// A scalar of a point of the curve and its derivatives by `P` and `W`, the components of `r'` and `r''` in the first node's frame.
#[derive(Clone, Copy, Debug)]
pub struct PointScalar {
    /// Its value.
    pub value: f64,
    by_p: Vec3,
    by_w: Vec3,
}

/// `κ1`, `κ2` (1/m) and the twist rate `ω` (rad/m) of the frame carried to one point of the curve (2.15).
#[derive(Clone, Copy, Debug)]
pub struct CurvePoint {
    /// `r'` in space, 1.
    pub p: Vec3,
    /// `r''` in space, 1/m.
    pub w: Vec3,
    /// `|r'|`, 1.
    pub stretch: f64,
    /// `κ1`, `κ2`, `ω`.
    pub scalars: [PointScalar; 3],
    local_p: Vec3,
    local_w: Vec3,
    h: f64,
    h_p: Vec3,
    h_w: Vec3,
}

impl CurvePoint {
    /// The point where `r' = p` and `r'' = w`, seen from the frame with the axes `axes = [t u v]` of the first node.
    pub fn new(axes: &Mat3, p: Vec3, w: Vec3) -> Self {
        let (local_p, local_w) = (axes.tr_mul(&p), axes.tr_mul(&w));
        let stretch = local_p.norm();
        let along = local_p.dot(&local_w) / stretch;
        let depth = stretch + local_p[0];
        let n = local_p / stretch;
        let d = n + Vec3::x();
        let h = (local_w[0] + along) / depth;
        let h_p = (local_w - n * along) / (stretch * depth) - d * (h / depth);
        let h_w = d / depth;
        let curvature = |axis: usize| {
            let e = Vec3::ith(axis, 1.0);
            let value = (local_w[axis] - local_p[axis] * h) / stretch;
            PointScalar {
                value,
                by_p: -(e * h + h_p * local_p[axis]) / stretch - n * (value / stretch),
                by_w: (e - h_w * local_p[axis]) / stretch,
            }
        };
        let area = stretch * depth;
        let omega = (local_p[2] * local_w[1] - local_p[1] * local_w[2]) / area;
        let twist_rate = PointScalar {
            value: omega,
            by_p: Vec3::new(0.0, -local_w[2], local_w[1]) / area - (n / stretch + d / depth) * omega,
            by_w: Vec3::new(0.0, local_p[2], -local_p[1]) / area,
        };
        Self { p, w, stretch, scalars: [curvature(1), curvature(2), twist_rate], local_p, local_w, h, h_p, h_w }
    }

    /// `∂²F/∂P²` and `∂²F/∂P∂W` of `F = c·(κ1, κ2, ω)`, in the first node's frame; `∂²F/∂W²` is zero (MECHANICS 8).
    fn second_derivatives(&self, c: &[f64; 3]) -> (Mat3, Mat3) {
        let (stretch, n) = (self.stretch, self.local_p / self.stretch);
        let depth = stretch + self.local_p[0];
        let along = self.local_p.dot(&self.local_w) / stretch;
        let q = (Mat3::identity() - n * n.transpose()) / stretch;
        let d = n + Vec3::x();
        let w_n = self.local_w * n.transpose();
        // μ = P·W/|P|, h = (b0 + μ)/D.
        let mu_pp =
            (n * n.transpose() * (2.0 * along) - w_n - w_n.transpose()) / (stretch * stretch) - q * (along / stretch);
        let h_d = self.h_p * d.transpose();
        let h_pp = (mu_pp - h_d - h_d.transpose() - q * self.h) / depth;
        let h_pw = (q - d * self.h_w.transpose()) / depth;
        let mut pp = Mat3::zeros();
        let mut pw = Mat3::zeros();
        for axis in [1, 2] {
            let kappa = &self.scalars[axis - 1];
            let e = Vec3::ith(axis, 1.0);
            let a = self.local_p[axis];
            let e_h = e * self.h_p.transpose();
            let k_n = kappa.by_p * n.transpose();
            pp -=
                (e_h + e_h.transpose() + h_pp * a + k_n + k_n.transpose() + q * kappa.value) * (c[axis - 1] / stretch);
            pw -= (e * self.h_w.transpose() + h_pw * a + n * kappa.by_w.transpose()) * (c[axis - 1] / stretch);
        }
        let omega = &self.scalars[2];
        let area = stretch * depth;
        let area_p = n * depth + d * stretch;
        let n_d = n * d.transpose();
        let area_pp = q * (depth + stretch) + n_d + n_d.transpose();
        let o_a = omega.by_p * area_p.transpose();
        let exchange = Vec3::z() * Vec3::y().transpose() - Vec3::y() * Vec3::z().transpose();
        pp -= (o_a + o_a.transpose() + area_pp * omega.value) * (c[2] / area);
        pw += (exchange - area_p * omega.by_w.transpose()) * (c[2] / area);
        (pp, pw)
    }
}

/// The first node's frame as the point scalars see it: axes, and how they turn with the node's slope.
#[derive(Clone, Copy, Debug)]
pub struct Base {
    /// `[t u v]` of the first node.
    pub axes: Mat3,
    /// `∂φ/∂p_0` of the frame at `theta` = 0, 3×3: `A` of MECHANICS 8.
    pub turn_p: Mat3,
}

impl Base {
    /// Of the first node's frame.
    pub fn new(first: &NodeFrame) -> Self {
        Self { axes: Mat3::from_columns(&[first.t, first.u, first.v]), turn_p: first.turn_p() }
    }

    /// `∂F/∂q`, 14×1, of a point scalar `F`, the turn of the base included (MECHANICS 8).
    pub fn gradient(
        &self,
        point: &CurvePoint,
        scalar: &PointScalar,
        shape_x: &[f64; 4],
        shape_xx: &[f64; 4],
    ) -> ElementVector {
        let (psi_p, psi_w) = (self.axes * scalar.by_p, self.axes * scalar.by_w);
        let mut sum = ElementVector::zeros();
        for (a, place) in SHAPE_PLACES.into_iter().enumerate() {
            sum.fixed_rows_mut::<3>(place).copy_from(&(psi_p * shape_x[a] + psi_w * shape_xx[a]));
        }
        let turn = -(point.p.cross(&psi_p) + point.w.cross(&psi_w));
        let mut slope = sum.fixed_rows_mut::<3>(P);
        slope += self.turn_p.tr_mul(&turn);
        sum
    }

    /// Adds `∂²F/∂q²`, 14×14, of `F = c·(κ1, κ2, ω)` at `point` to `sum` (MECHANICS 8).
    pub fn add_hessian(
        &self,
        sum: &mut ElementMatrix,
        first: &NodeFrame,
        point: &CurvePoint,
        c: &[f64; 3],
        shape_x: &[f64; 4],
        shape_xx: &[f64; 4],
    ) {
        let (local_pp, local_pw) = point.second_derivatives(c);
        let h_pp = self.axes * local_pp * self.axes.transpose();
        let h_pw = self.axes * local_pw * self.axes.transpose();
        let (mut by_p, mut by_w) = (Vec3::zeros(), Vec3::zeros());
        for (factor, scalar) in c.iter().zip(&point.scalars) {
            by_p += scalar.by_p * *factor;
            by_w += scalar.by_w * *factor;
        }
        let (psi_p, psi_w) = (self.axes * by_p, self.axes * by_w);
        let turn = -(point.p.cross(&psi_p) + point.w.cross(&psi_w));
        let (p_cross, w_cross) = (point.p.cross_matrix(), point.w.cross_matrix());
        let h_pphi = h_pp * p_cross + h_pw * w_cross - psi_p.cross_matrix();
        let h_wphi = h_pw.tr_mul(&p_cross) - psi_w.cross_matrix();
        let h_phiphi = -(p_cross * h_pphi + w_cross * h_wphi);
        for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
            for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
                let mut block = sum.fixed_view_mut::<3, 3>(row, column);
                block += h_pp * (shape_x[a] * shape_x[b])
                    + h_pw * (shape_x[a] * shape_xx[b])
                    + h_pw.transpose() * (shape_xx[a] * shape_x[b]);
            }
            let with_base = (h_pphi * shape_x[a] + h_wphi * shape_xx[a]) * self.turn_p;
            let mut column = sum.fixed_view_mut::<3, 3>(row, P);
            column += with_base;
            let mut mirror = sum.fixed_view_mut::<3, 3>(P, row);
            mirror += with_base.transpose();
        }
        let mut slope = sum.fixed_view_mut::<3, 3>(P, P);
        // The moment `turn` on the base, at frozen size, is the same form as a spatial moment on the node without its theta part.
        slope += self.turn_p.tr_mul(&h_phiphi) * self.turn_p + first.moment_force_p(&turn).0;
    }
}

/// Everything first order that an element's energy needs, at one configuration.
#[derive(Clone, Debug)]
pub struct Kinematics {
    /// The first node's frame.
    pub base: Base,
    /// Holonomy of the nodes' frames.
    pub holonomy: Holonomy,
    /// The three bending points.
    pub points: [CurvePoint; 3],
    /// Total twist `T`, rad (2.12).
    pub twist: f64,
    /// `α` at the bending points, rad (2.13).
    pub alpha: [f64; 3],
}

impl Kinematics {
    /// Of the element with coordinates `q` (14), nodes' frames and last accepted holonomy angle `previous`, rad.
    pub fn new(element: &Element, q: &[f64], first: &NodeFrame, second: &NodeFrame, previous: f64) -> Self {
        let base = Base::new(first);
        let holonomy = Holonomy::new(first, second, previous);
        let points = std::array::from_fn(|g| {
            let rule = &element.bending[g];
            CurvePoint::new(&base.axes, interpolate(&rule.shape_x, q), interpolate(&rule.shape_xx, q))
        });
        let mut kinematics = Self { base, holonomy, points, twist: 0.0, alpha: [0.0; 3] };
        kinematics.twist =
            q[NODE + THETA] - q[THETA] + holonomy.angle + kinematics.weighted_rate(&element.rate_weights);
        kinematics.alpha = std::array::from_fn(|g| {
            let rule = &element.bending[g];
            q[THETA] + rule.xi * kinematics.twist - kinematics.weighted_rate(&rule.collocation)
        });
        kinematics
    }

    /// `Σ_g weight_g ω_g`.
    fn weighted_rate(&self, weights: &[f64; 3]) -> f64 {
        weights.iter().zip(&self.points).map(|(weight, point)| weight * point.scalars[2].value).sum()
    }

    /// Angle of the section against the frame carried from the first node, at `xi`, rad (2.13); `collocation` is `l A_h(ξ)`, m.
    pub fn alpha_at(&self, q: &[f64], xi: f64, collocation: &[f64; 3]) -> f64 {
        q[THETA] + xi * self.twist - self.weighted_rate(collocation)
    }

    /// `∂(κ1, κ2, ω)/∂q` at the bending points, 14×9: three columns a point.
    pub fn point_gradients(&self, element: &Element) -> SMatrix<f64, ELEMENT, 9> {
        let mut columns = SMatrix::<f64, ELEMENT, 9>::zeros();
        for (g, (point, rule)) in self.points.iter().zip(&element.bending).enumerate() {
            for (i, scalar) in point.scalars.iter().enumerate() {
                columns.set_column(3 * g + i, &self.base.gradient(point, scalar, &rule.shape_x, &rule.shape_xx));
            }
        }
        columns
    }

    /// `∂T/∂q`, 14×1, given [`Self::point_gradients`].
    pub fn twist_gradient(
        &self,
        element: &Element,
        first: &NodeFrame,
        second: &NodeFrame,
        points: &SMatrix<f64, ELEMENT, 9>,
    ) -> ElementVector {
        let mut sum = self.rate_gradient(&element.rate_weights, points);
        let (by_p0, by_p1) = self.holonomy.gradient(first, second);
        let mut slope = sum.fixed_rows_mut::<3>(P);
        slope += by_p0;
        let mut slope = sum.fixed_rows_mut::<3>(NODE + P);
        slope += by_p1;
        sum[THETA] -= 1.0;
        sum[NODE + THETA] += 1.0;
        sum
    }

    /// `∂(Σ_g weight_g ω_g)/∂q`, 14×1.
    pub fn rate_gradient(&self, weights: &[f64; 3], points: &SMatrix<f64, ELEMENT, 9>) -> ElementVector {
        points.column(2) * weights[0] + points.column(5) * weights[1] + points.column(8) * weights[2]
    }
}
