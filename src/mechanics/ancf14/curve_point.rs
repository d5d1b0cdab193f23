//! One point of the curve inside the element: curvatures and twist rate of the frame carried there from the first node, as functions
//! of `P = r'` and `W = r''` in the components of that node's frame, with two derivatives (MECHANICS 2.15, 8).

use super::relative::RelativeShape;
use crate::math::{Mat3, Vec3};

/// `κ1`, `κ2` (1/m) and the twist rate `ω` (rad/m) of the frame carried to one point of the curve (2.15).
#[derive(Clone, Copy, Debug)]
pub struct CurvePoint {
    /// `|r'|`, 1.
    pub stretch: f64,
    /// `κ1`, `κ2`, 1/m.
    pub curvatures: [f64; 2],
    /// `ω`, rad/m.
    pub twist_rate: f64,
    p: Vec3,
    w: Vec3,
    h: f64,
}

/// What the first derivatives at one point of the curve are made of, in the letters of MECHANICS 8.
#[derive(Clone, Copy, Debug)]
pub struct CurveGradients<'a> {
    point: &'a CurvePoint,
    per_stretch: f64,
    per_area: f64,
    n: Vec3,
    d: Vec3,
    h_p: Vec3,
    h_w: Vec3,
}

impl CurvePoint {
    /// The point of the element `shape` where the shape functions have the derivatives `shape_x` and `shape_xx`.
    #[inline]
    pub fn new(shape: &RelativeShape, shape_x: &[f64; 4], shape_xx: &[f64; 4]) -> Self {
        let (p, w) = (shape.interpolate(shape_x), shape.interpolate(shape_xx));
        let stretch = p.norm();
        let (per_stretch, depth) = (1.0 / stretch, stretch + p[0]);
        let per_depth = 1.0 / depth;
        let h = (w[0] + p.dot(&w) * per_stretch) * per_depth;
        let curvatures = [(w[1] - p[1] * h) * per_stretch, (w[2] - p[2] * h) * per_stretch];
        let twist_rate = (p[2] * w[1] - p[1] * w[2]) * (per_stretch * per_depth);
        Self { stretch, curvatures, twist_rate, p, w, h }
    }

    /// What its first derivatives are made of (MECHANICS 8).
    #[inline]
    pub fn gradients(&self) -> CurveGradients<'_> {
        let (per_stretch, per_depth) = (1.0 / self.stretch, 1.0 / (self.stretch + self.p[0]));
        let per_area = per_stretch * per_depth;
        let n = self.p * per_stretch;
        let d = n + Vec3::x();
        let h_p = (self.w - n * n.dot(&self.w)) * per_area - d * (self.h * per_depth);
        CurveGradients { point: self, per_stretch, per_area, n, d, h_p, h_w: d * per_depth }
    }

    /// `(∂F/∂P, ∂F/∂W)` of `F = c·(κ1, κ2, ω)`.
    #[inline]
    pub fn gradient(&self, c: &[f64; 3]) -> (Vec3, Vec3) {
        let gradients = self.gradients();
        let (kappa_p, kappa_w) = gradients.curvature([c[0], c[1]]);
        let (omega_p, omega_w) = gradients.twist_rate();
        (kappa_p + omega_p * c[2], kappa_w + omega_w * c[2])
    }
}

impl CurveGradients<'_> {
    /// `(∂K/∂P, ∂K/∂W)` of `K = c·(κ1, κ2)`.
    #[inline]
    pub fn curvature(&self, c: [f64; 2]) -> (Vec3, Vec3) {
        let point = self.point;
        let across = (c[0] * point.p[1] + c[1] * point.p[2]) * self.per_stretch;
        let kappa = (c[0] * point.curvatures[0] + c[1] * point.curvatures[1]) * self.per_stretch;
        let axis = Vec3::new(0.0, c[0], c[1]) * self.per_stretch;
        (-axis * point.h - self.h_p * across - self.n * kappa, axis - self.h_w * across)
    }

    /// `(∂ω/∂P, ∂ω/∂W)`.
    #[inline]
    pub fn twist_rate(&self) -> (Vec3, Vec3) {
        let (p, w) = (&self.point.p, &self.point.w);
        (
            Vec3::new(0.0, -w[2], w[1]) * self.per_area
                - (self.n * self.per_stretch + self.h_w) * self.point.twist_rate,
            Vec3::new(0.0, p[2], -p[1]) * self.per_area,
        )
    }

    /// `∂²F/∂P²`, of which the lower triangle counts, and `∂²F/∂P∂W` of `F = c·(κ1, κ2, ω)`; `∂²F/∂W²` is zero (MECHANICS 8).
    #[inline]
    pub fn hessian(&self, c: &[f64; 3]) -> (Mat3, Mat3) {
        let &Self { point, per_stretch, per_area, n, d, h_p, h_w } = self;
        let &CurvePoint { stretch, curvatures, twist_rate, p, w, h } = point;
        let (kappa_p, kappa_w) = self.curvature([c[0], c[1]]);
        let (omega_p, omega_w) = self.twist_rate();
        let depth = stretch + p[0];
        let along = n.dot(&w);
        // Both curvatures at once, K = c1 κ1 + c2 κ2; `across` = (c1 P1 + c2 P2)/(|P| D).
        let kappa = c[0] * curvatures[0] + c[1] * curvatures[1];
        let across = (c[0] * p[1] + c[1] * p[2]) * per_area;
        let rate = c[2] * per_area;
        let rate_area_p = (n * depth + d * stretch) * rate;
        // What multiplies Q = (I − n nᵀ)/|P|.
        let q = (across * (along * per_stretch + h) - kappa * per_stretch - rate * twist_rate * (depth + stretch))
            * per_stretch;
        let with_n = (w - n * along) * (across * per_stretch * per_stretch)
            - kappa_p * per_stretch
            - d * (rate * twist_rate)
            - n * (0.5 * q);
        let across = across * per_stretch;
        let w_with_n = n * across - kappa_w * per_stretch;
        let (mut pp, mut pw) = (Mat3::zeros(), Mat3::zeros());
        for i in 0..3 {
            for j in 0..3 {
                if i >= j {
                    pp[(i, j)] = (n[i] * with_n[j] + with_n[i] * n[j])
                        - (h_p[i] * kappa_w[j] + kappa_w[i] * h_p[j])
                        - (omega_p[i] * rate_area_p[j] + rate_area_p[i] * omega_p[j]);
                }
                pw[(i, j)] = n[i] * w_with_n[j] - kappa_w[i] * h_w[j] - rate_area_p[i] * omega_w[j];
            }
            pp[(i, i)] += q;
            pw[(i, i)] -= across;
        }
        pw[(2, 1)] += rate;
        pw[(1, 2)] -= rate;
        (pp, pw)
    }
}
