//! Damping of the material at an instant, as Newton's iteration takes it where the twist is linear (MECHANICS 3.8): the
//! energy and the damping then have the same strains, and one gradient and one Hessian are those of both.
//!
//! With the viscous resultants `N = c W D J v` added to those of the energy, and the rigidities `W D` multiplied by
//! `1 + c v_q` where the velocities change by `v_q` with the coordinates, gradient and Hessian contain the viscous
//! force `Jᵀ N` and of its derivative `N·Hess e + Jᵀ c W D J v_q`. What is left is `Jᵀ c W D ∂(J v)/∂q`, which is not
//! symmetric:
//!
//! - The axial strains have it exactly: `c W EA e_q ė_q`; the products with the curvatures that a tension center off
//!   the axis adds are left out.
//! - For bending and torsion `∂(J v)/∂q = J W_ω` while the element turns as a whole, with the angular velocity `ω` of
//!   the section of its first node: strains do not see such a turn. The Hessian is multiplied from the right by
//!   `1 + τ W_ω`, `τ = c/(1 + c v_q)`, the share of the damping in its rigidities. What deforms the element is left
//!   out: in a step it turns its ends much less against each other than all of it.
//!
//! The force is exact, so that the solution is. Derivatives of a step have the exact tangent, that of damping.rs.

use super::coordinates::{NODE, P, THETA, slopes};
use super::element::Evaluation;
use super::frame::NodeFrame;
use super::over_step::{Added, Turn};
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};

impl Evaluation<'_> {
    /// Adds the damping of the material with the velocities `velocity` (14), which change by `velocity_by_q` with the
    /// coordinates, 1/s.
    pub fn set_damping(&mut self, velocity: &[f64], velocity_by_q: f64) {
        let rates = self.element.strain_rates_with(self, velocity, 0.0);
        self.added = Added::at_instant(self.element, &rates, velocity_by_q);
        let slope_rates = slopes(&self.element.axial[1].shape_x, velocity);
        let change = |m: usize| self.axial_rate_change(m, &slope_rates[m]);
        self.added.axial_rate_changes = Some([change(0), change(1), change(2)]);
        let span = self.element.stiffness.damping / (1.0 + self.added.stiffening);
        self.turn_from_end = Some(Turn::after(span, self.kinematics.shape.frames, velocity));
    }

    /// `c W EA ∂ė/∂r'` of axial point `m`, where the slope has the rate `slope_rate`, 1/s: N m.
    fn axial_rate_change(&self, m: usize, slope_rate: &Vec3) -> Vec3 {
        let (element, point) = (self.element, &self.element.axial[m]);
        let [tension, _] = element.viscosities();
        self.slopes[m].strain_pp(element.stiffness.strain)
            * slope_rate
            * (tension * point.weight * point.stiffness.axial)
    }

    /// What the damping of the material takes with the velocities `velocity` (14), W.
    pub fn viscous_power(&self, velocity: &[f64]) -> f64 {
        let rates = self.element.strain_rates_with(self, velocity, 0.0);
        Added { rates, ..Added::default() }.taken(self.element, 1.0)
    }
}

impl Turn {
    /// [`Self::new`] between now and `span` s later, to first order, of an element with the velocities `velocity` (14)
    /// and the frames `frames` of its nodes.
    fn after(span: f64, frames: [&NodeFrame; 2], velocity: &[f64]) -> Self {
        let changes = [P, NODE + P].map(|place| vec3(velocity, place) * span);
        let turn = frames[0].turn_p() * changes[0] + frames[0].t * (velocity[THETA] * span);
        let spin = |node: usize| {
            let frame = frames[node];
            (turn.cross(&frame.k) - frame.k_p() * changes[node]) / frame.stretch
        };
        Self { rotation: Mat3::identity() - turn.cross_matrix(), spin: [spin(0), spin(1)] }
    }
}
