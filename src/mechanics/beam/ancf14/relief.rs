//! Strains without stress that an element has followed: heat and prestress that would be stress if it had not deformed.
//!
//! A strain without stress `e_0` leaves the stress of `e = e(q) − e_0`. The part of `e_0` that the deformation since
//! the drawing, `e + e_0`, follows is relieved: the smaller one of both where they have one sign. A held beam relieves
//! nothing, a free one all.

use super::element::Evaluation;
use crate::math::quadrature::LOBATTO_POINTS;

/// What an element has relieved.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Relief {
    /// Strain energy, J.
    pub energy: f64,
    /// Axial force, N.
    pub force: f64,
    /// Bending moment or torque, N m.
    pub moment: f64,
    /// Axial strain, 1.
    pub strain: f64,
    /// Curvature or torsion, 1/m or rad/m.
    pub curvature: f64,
}

impl Evaluation<'_> {
    /// What the element has relieved; none where all its strains are stress.
    pub fn relief(&self) -> Option<Relief> {
        let element = self.element;
        if element.prestress.is_none() && element.heating.is_none() {
            return None;
        }
        let mut relief = Relief::default();
        for m in 0..LOBATTO_POINTS.len() {
            let (point, free) = (&element.axial[m], self.slopes[m].natural);
            let strain = followed(free, self.axial_strain(m));
            relief.strain = relief.strain.max(strain);
            relief.force = relief.force.max(point.stiffness.axial * strain);
            relief.energy += 0.5 * point.weight * point.stiffness.axial * strain * strain;
        }
        for (g, (point, strains)) in element.bending.iter().zip(&self.strains).enumerate() {
            let beyond = element.prestress.as_ref().map_or([0.0; 3], |own| own.beyond[g]);
            let [of_heat_1, of_heat_2] = self.natural.curvature[g];
            let free = [beyond[0] + of_heat_1, beyond[1] + of_heat_2, beyond[2]];
            let rigidities = [point.stiffness.bending_z, point.stiffness.bending_y, point.stiffness.torsion];
            for k in 0..free.len() {
                let curvature = followed(free[k], strains[k]);
                relief.curvature = relief.curvature.max(curvature);
                relief.moment = relief.moment.max(rigidities[k] * curvature);
                relief.energy += 0.5 * point.weight * rigidities[k] * curvature * curvature;
            }
        }
        Some(relief)
    }
}

/// Size of the part of the strain without stress `free` that the deformation follows where the strain of stress is
/// `strain`.
fn followed(free: f64, strain: f64) -> f64 {
    let deformation = strain + free;
    if deformation * free > 0.0 { deformation.abs().min(free.abs()) } else { 0.0 }
}
