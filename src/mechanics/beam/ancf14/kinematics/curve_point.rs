//! One point of the curve inside the element: curvatures and twist rate of the frame carried there from the first node,
//! as functions of `P = r'` and `W = r''` in the components of that node's frame, with two derivatives (MECHANICS 2.15,
//! 8).

use super::corotated::CorotatedShape;
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
    omega_p: Vec3,
}

impl CurvePoint {
    /// The point of the element `shape` where the shape functions have the derivatives `shape_x` and `shape_xx`.
    #[inline]
    pub fn new(shape: &CorotatedShape, shape_x: &[f64; 4], shape_xx: &[f64; 4]) -> Self {
        let (p, w) = (shape.interpolate(shape_x), shape.interpolate(shape_xx));
        let stretch = p.norm();
        let (per_stretch, depth) = (1.0 / stretch, stretch + p[0]);
        let per_depth = 1.0 / depth;
        let h = (w[0] + p.dot(&w) * per_stretch) * per_depth;
        let curvatures = [(w[1] - p[1] * h) * per_stretch, (w[2] - p[2] * h) * per_stretch];
        let twist_rate = (p[2] * w[1] - p[1] * w[2]) * (per_stretch * per_depth);
        Self { stretch, curvatures, twist_rate, p, w, h }
    }

    /// Changes of `κ1`, `κ2` and of `ω` with small changes of `P` and `W`, 1/m and rad/m.
    #[inline]
    pub fn along(&self, by_p: &Vec3, by_w: &Vec3) -> ([f64; 2], f64) {
        let &Self { stretch, curvatures, twist_rate, p, w, h } = self;
        let (per_stretch, per_depth) = (1.0 / stretch, 1.0 / (stretch + p[0]));
        let by_stretch = p.dot(by_p) * per_stretch;
        let by_depth = by_stretch + by_p[0];
        // Of `P·W/|P|`, which is `h D − W1`.
        let by_slope = (by_p.dot(&w) + p.dot(by_w) - (h * (stretch + p[0]) - w[0]) * by_stretch) * per_stretch;
        let by_h = (by_w[0] + by_slope - h * by_depth) * per_depth;
        let kappa = |q: usize| (by_w[q] - by_p[q] * h - p[q] * by_h - curvatures[q - 1] * by_stretch) * per_stretch;
        let area = by_p[2] * w[1] + p[2] * by_w[1] - by_p[1] * w[2] - p[1] * by_w[2];
        let rate = area * per_stretch * per_depth - twist_rate * (by_stretch * per_stretch + by_depth * per_depth);
        ([kappa(1), kappa(2)], rate)
    }

    /// What its first derivatives are made of (MECHANICS 8).
    #[inline]
    pub fn gradients(&self) -> CurveGradients<'_> {
        let (per_stretch, per_depth) = (1.0 / self.stretch, 1.0 / (self.stretch + self.p[0]));
        let per_area = per_stretch * per_depth;
        let n = self.p * per_stretch;
        let d = n + Vec3::x();
        let h_p = (self.w - n * n.dot(&self.w)) * per_area - d * (self.h * per_depth);
        let h_w = d * per_depth;
        let mut omega_p = (n * per_stretch + h_w) * -self.twist_rate;
        omega_p[1] -= self.w[2] * per_area;
        omega_p[2] += self.w[1] * per_area;
        CurveGradients { point: self, per_stretch, per_area, n, d, h_p, h_w, omega_p }
    }
}

impl CurveGradients<'_> {
    /// `(∂F/∂P, ∂F/∂W)` of `F = c·(κ1, κ2, ω)`.
    #[inline]
    pub fn gradient(&self, c: &[f64; 3]) -> (Vec3, Vec3) {
        let &Self { point, per_stretch, per_area, n, h_p, h_w, omega_p, .. } = self;
        let across = (c[0] * point.p[1] + c[1] * point.p[2]) * per_stretch;
        let kappa = (c[0] * point.curvatures[0] + c[1] * point.curvatures[1]) * per_stretch;
        let rate = c[2] * per_area;
        let (mut by_p, mut by_w) = (omega_p * c[2] - h_p * across - n * kappa, -h_w * across);
        for q in 1..3 {
            by_p[q] -= c[q - 1] * point.h * per_stretch;
            by_w[q] += c[q - 1] * per_stretch;
        }
        by_w[1] += point.p[2] * rate;
        by_w[2] -= point.p[1] * rate;
        (by_p, by_w)
    }

    /// `(∂κ/∂P, ∂κ/∂W)` of one of the curvatures, number `q` (1 or 2).
    #[inline]
    pub fn curvature(&self, q: usize) -> (Vec3, Vec3) {
        let point = self.point;
        let (across, kappa) = (point.p[q] * self.per_stretch, point.curvatures[q - 1] * self.per_stretch);
        let (mut by_p, mut by_w) = (-self.h_p * across - self.n * kappa, -self.h_w * across);
        by_p[q] -= point.h * self.per_stretch;
        by_w[q] += self.per_stretch;
        (by_p, by_w)
    }

    /// `(∂ω/∂P, ∂ω/∂W)`; the latter has nothing along the first axis.
    #[inline]
    pub fn twist_rate(&self) -> (Vec3, Vec3) {
        let p = &self.point.p;
        (self.omega_p, Vec3::new(0.0, p[2] * self.per_area, -p[1] * self.per_area))
    }

    /// `∂²F/∂P²`, of which the lower triangle counts, and `∂²F/∂P∂W` of `F = c·(κ1, κ2, ω)`; `∂²F/∂W²` is zero.
    ///
    /// What MECHANICS 8 says, sorted by the vectors that it is made of: with `x` the first axis, `d = n + x`,
    /// `a = (0, c1, c2)`, `m = (0, P2, −P1)`, `A = a·P/(|P| D)`, `s = c3/(|P| D)`, and `(x, y) = x yᵀ + y xᵀ`,
    /// `F_PP = q I + (n, z1) + (x, z2) − (h_P, a)/|P|`,
    /// `F_PW = n z3ᵀ + x z4ᵀ − a dᵀ/(|P| D) − A/|P| I + s (e2 e1ᵀ − e1 e2ᵀ)`.
    #[inline]
    pub fn hessian(&self, c: &[f64; 3]) -> (Mat3, Mat3) {
        let &Self { point, per_stretch, per_area, n, d, h_p, h_w, omega_p } = self;
        let &CurvePoint { stretch, curvatures, twist_rate, p, w, h } = point;
        let depth = stretch + p[0];
        let kappa = (c[0] * curvatures[0] + c[1] * curvatures[1]) * per_stretch;
        let across = (c[0] * p[1] + c[1] * p[2]) * per_area;
        let per_length = across * per_stretch;
        let rate = c[2] * per_area;
        let both = rate * (depth + stretch);
        let turned = h * per_length - rate * twist_rate;
        let q = (across * (n.dot(&w) * per_stretch + h) - kappa - both * twist_rate) * per_stretch;
        let axis = [c[0] * per_stretch, c[1] * per_stretch];

        let mut z1 =
            h_p * (2.0 * per_length * depth + across) + n * (kappa * per_stretch - 0.5 * q + turned) - omega_p * both;
        z1[0] += turned;
        z1[1] += axis[0] * h * per_stretch;
        z1[2] += axis[1] * h * per_stretch;
        let z2 = h_p * across - omega_p * (rate * stretch);
        let mut pp = Mat3::zeros();
        pp[(0, 0)] = 2.0 * (n[0] * z1[0] + z2[0]) + q;
        pp[(1, 0)] = n[1] * z1[0] + n[0] * z1[1] + z2[1] - h_p[0] * axis[0];
        pp[(2, 0)] = n[2] * z1[0] + n[0] * z1[2] + z2[2] - h_p[0] * axis[1];
        pp[(1, 1)] = 2.0 * (n[1] * z1[1] - h_p[1] * axis[0]) + q;
        pp[(2, 1)] = n[2] * z1[1] + n[1] * z1[2] - h_p[1] * axis[1] - h_p[2] * axis[0];
        pp[(2, 2)] = 2.0 * (n[2] * z1[2] - h_p[2] * axis[1]) + q;

        let z4 = h_w * across;
        let mut z3 = n * (2.0 * per_length) + z4;
        z3[0] += per_length;
        z3[1] -= axis[0] * per_stretch + p[2] * both * per_area;
        z3[2] -= axis[1] * per_stretch - p[1] * both * per_area;
        let (about_1, about_2) = (c[0] * per_area, c[1] * per_area);
        let mut pw = n * z3.transpose();
        for j in 0..3 {
            pw[(0, j)] += z4[j];
            pw[(1, j)] -= about_1 * d[j];
            pw[(2, j)] -= about_2 * d[j];
            pw[(j, j)] -= per_length;
        }
        let across_rate = rate * stretch * per_area;
        pw[(0, 1)] -= p[2] * across_rate;
        pw[(0, 2)] += p[1] * across_rate;
        pw[(2, 1)] += rate;
        pw[(1, 2)] -= rate;
        (pp, pw)
    }
}
