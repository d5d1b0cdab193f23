//! The axial forces of the tangent while Newton iterates to an equilibrium (MECHANICS 7.12).
//!
//! A correction that turns a slope by a small angle `w` leaves an axial strain of `w²/2`. Its force is large compared
//! with those that bend a slender beam, and the next correction removes it: a tangent that contains it is that of
//! another beam. The axial forces that stiffen a beam sideways are therefore those that the last correction was to lead
//! to, to first order, as if they were unknowns of their own (Magisano, Leonetti, Garcea: Advantages of the mixed
//! format in geometrically nonlinear analysis of beams and shells using solid finite elements, International Journal
//! for Numerical Methods in Engineering 109, 2017). Residuals are exact, and so is the solution.

use super::coordinates::slopes;
use super::element::Evaluation;
use super::strain::Strain;

impl Evaluation<'_> {
    /// Takes the axial forces of the Hessian from the strains that `correction` (14), the last one of its coordinates,
    /// was to lead to.
    pub(super) fn set_correction(&mut self, correction: &[f64]) {
        let turns = slopes(&self.element.axial[1].shape_x, correction);
        for (excess, (slope, turn)) in self.added.excess.iter_mut().zip(self.slopes.iter().zip(&turns)) {
            *excess = match self.element.stiffness.strain {
                Strain::Small => {
                    let before = slope.middle - turn;
                    let stretch = before.norm();
                    (slope.middle.norm() - stretch - before.dot(turn) / stretch) / slope.reference_stretch
                }
                Strain::Large | Strain::LargeTruncated => 0.5 * turn.norm_squared() / slope.reference_square,
            };
        }
    }
}
