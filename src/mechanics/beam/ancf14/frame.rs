//! The frame of a node: a reference triad carried in time, turned by the slope and by `theta` (MECHANICS 2.1-2.6).

use super::coordinates::{P, THETA};
use crate::math::elementary::sin_cos;
use crate::math::rotation::{carry, half_turn, normal_projector};
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerMatrix};
use crate::mechanics::geometry::triad::Triad;

/// The frame of a node at a configuration, relative to its reference triad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeFrame {
    /// `|p|`, 1.
    pub stretch: f64,
    /// Tangent `t = p / |p|` (2.1).
    pub t: Vec3,
    /// `u = P(t_r, t) u_r` (2.3).
    pub u: Vec3,
    /// `v = t × u`.
    pub v: Vec3,
    /// `k = kb(t_r, t)`; the `s` of (2.5) is `−k`.
    pub k: Vec3,
    /// Cosine and sine of `theta`, which turns the section about `t` from `u` and `v`.
    pub turn: [f64; 2],
}

impl NodeFrame {
    /// The frame of the node with coordinates `q` (7) and reference `triad`.
    #[inline]
    pub fn new(q: &[f64], triad: &Triad) -> Self {
        let p = vec3(q, P);
        let stretch = p.norm();
        let t = p / stretch;
        let u = carry(&triad.t, &t, &triad.u);
        let v = t.cross(&u);
        let k = half_turn(&triad.t, &t);
        let (sin, cos) = sin_cos(q[THETA]);
        Self { stretch, t, u, v, k, turn: [cos, sin] }
    }

    /// Section axes `[t y z]` (2.4).
    #[inline]
    pub fn section(&self) -> Mat3 {
        let Self { t, u, v, turn: [cos, sin], .. } = self;
        Mat3::from_columns(&[*t, u * *cos + v * *sin, v * *cos - u * *sin])
    }

    /// `∂t/∂p = (I − t tᵀ)/|p|`, 3×3.
    #[inline]
    pub fn t_p(&self) -> Mat3 {
        normal_projector(&self.t) / self.stretch
    }

    /// `∂k/∂p = E ∂t/∂p`, 3×3, with `E` of (2.9): `([t]×/2 − t kᵀ + (k lᵀ + l kᵀ)/2)/|p|`, `l = k × t`.
    pub fn k_p(&self) -> Mat3 {
        let l = self.k.cross(&self.t);
        let half = (self.t.cross_matrix() + self.k * l.transpose() + l * self.k.transpose()) * 0.5;
        (half - self.t * self.k.transpose()) / self.stretch
    }

    /// `k` along `u` and `v`; there is nothing of it along `t`.
    #[inline]
    pub fn k_local(&self) -> [f64; 2] {
        [self.u.dot(&self.k), self.v.dot(&self.k)]
    }

    /// `∂φ/∂p change`, rad, of a small change of `p`; both in the axes `[t u v]`.
    #[inline]
    pub fn turn_along(&self, change: &Vec3) -> Vec3 {
        let [k_u, k_v] = self.k_local();
        Vec3::new(-k_u * change[1] - k_v * change[2], -change[2], change[1]) / self.stretch
    }

    /// What [`Self::k_local`] changes by with a small change of `p`, which makes the axes `[t u v]` turn by `turn`; all
    /// in these axes.
    pub fn k_local_along(&self, change: &Vec3, turn: &Vec3) -> [f64; 2] {
        let [k_u, k_v] = self.k_local();
        let (by_k, by_l) = (k_u * change[1] + k_v * change[2], k_v * change[1] - k_u * change[2]);
        let half = 0.5 / self.stretch;
        [
            half * (k_u * by_l + k_v * by_k - change[2]) + k_v * turn[0],
            half * (k_v * by_l - k_u * by_k + change[1]) - k_u * turn[0],
        ]
    }

    /// The derivative by `p` of what has the derivative `by_t` by the tangent: `by_t ∂t/∂p`, 3×3.
    #[inline]
    fn by_p(&self, by_t: &Mat3) -> Mat3 {
        (by_t - by_t * self.t * self.t.transpose()) / self.stretch
    }

    /// Components of `vector` along `t`, `u`, `v`.
    #[inline]
    pub fn components(&self, vector: &Vec3) -> Vec3 {
        Vec3::new(self.t.dot(vector), self.u.dot(vector), self.v.dot(vector))
    }

    /// The vector with these components along `t`, `u`, `v`.
    #[inline]
    pub fn in_space(&self, components: &Vec3) -> Vec3 {
        self.t * components[0] + self.u * components[1] + self.v * components[2]
    }

    /// `∂φ/∂p`, 3×3: turn of the section by the slope, `([t]× − t kᵀ)/|p|` (2.5). By `theta` it is `t`.
    #[inline]
    pub fn turn_p(&self) -> Mat3 {
        (self.t.cross_matrix() - self.t * self.k.transpose()) / self.stretch
    }

    /// `∂φ/∂q`, 3×7 and columns of zeros: turn of the section.
    pub fn turn_q(&self) -> ByCoordinates {
        let mut turn_q = ByCoordinates::zeros();
        turn_q.fixed_columns_mut::<3>(P).copy_from(&self.turn_p());
        turn_q.set_column(THETA, &self.t);
        turn_q
    }

    /// Adds `∂(turn_qᵀ m)/∂q`, 7×7, of the moment `moment` (N m) frozen in space to `sum`.
    pub fn add_moment_stiffness(&self, moment: &Vec3, sum: &mut MarkerMatrix) {
        let (by_p, along_p) = self.moment_force_p(moment);
        let mut slopes = sum.fixed_view_mut::<3, 3>(P, P);
        slopes += by_p;
        let mut angle = sum.fixed_view_mut::<1, 3>(THETA, P);
        angle += along_p.transpose();
    }

    /// `∂φ/∂pᵀ moment`, N m, all in the axes `[t u v]`: nothing of it is along `t`.
    #[inline]
    pub fn turn_force(&self, moment: &Vec3) -> Vec3 {
        let [k_u, k_v] = self.k_local();
        Vec3::new(0.0, moment[2] - k_u * moment[0], -moment[1] - k_v * moment[0]) / self.stretch
    }

    /// `[Q_p, Q_theta]`: generalized force of the spatial moment `moment`, N m (MECHANICS 3.5).
    #[inline]
    pub fn moment_force(&self, moment: &Vec3) -> (Vec3, f64) {
        let along = self.t.dot(moment);
        // Both terms are normal to t, so that the projector of 3.5 changes nothing.
        ((moment.cross(&self.t) - self.k * along) / self.stretch, along)
    }

    /// The moment, N m, whose generalized force is `[Q_p, Q_theta]`: the way back of [`Self::moment_force`]. What of
    /// `Q_p` is along the tangent stretches the slope, and belongs to no moment.
    pub fn moment_of(&self, by_slope: &Vec3, by_angle: f64) -> Vec3 {
        self.t.cross(&(by_slope * self.stretch + self.k * by_angle)) + self.t * by_angle
    }

    /// `(∂Q_p/∂p, ∂Q_theta/∂p)` at a moment frozen in space (MECHANICS 3.5).
    #[inline]
    pub fn moment_force_p(&self, moment: &Vec3) -> (Mat3, Vec3) {
        let (force, along) = self.moment_force(moment);
        let across = (moment - self.t * along) / self.stretch;
        let turn = self.by_p(&moment.cross_matrix()) - self.k_p() * along - self.k * across.transpose();
        let by_p = (turn - force * self.t.transpose()) / self.stretch;
        (by_p, across)
    }

    /// The reference triad of the next step: this frame at `theta` = 0 (2.6), made orthonormal against round-off.
    pub fn carried(&self) -> Triad {
        Triad::new(&self.t, &self.u)
    }
}
