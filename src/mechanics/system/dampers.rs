//! What dampers add to the equations: those in the material of beams, and the damping matrix of springs too.

use super::equations::add_corner;
use crate::math::blocks::Blocks;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;

impl System {
    /// The elements whose material is damped, with their numbers.
    fn damped_elements(&self) -> impl Iterator<Item = (usize, &AnyElement)> + '_ {
        self.mesh.elements.iter().enumerate().filter(|(_, element)| element.damping() != 0.0)
    }

    /// Whether the material of a beam has damping.
    pub fn has_material_damping(&self) -> bool {
        self.damped_elements().next().is_some()
    }

    /// Adds the viscous forces of the beams' material at an instant, with the velocities `velocity`.
    pub(super) fn add_material_damping(&self, c: &Configuration, velocity: &[f64], forces: &mut [f64]) {
        for (_, element) in self.damped_elements() {
            element.add_damping(&c.beams, velocity, forces);
        }
    }

    /// [`Self::add_material_damping`], and `scale` times its derivative by the coordinates.
    pub(super) fn add_material_damping_and_tangent(
        &self,
        c: &Configuration,
        velocity: &[f64],
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        for (number, element) in self.damped_elements() {
            element.add_damping_and_tangent(&c.beams, velocity, scale, forces, tangent.block_mut(number));
        }
    }

    /// Adds `factor` times the derivative of the forces by the velocities, at an instant, to the first blocks of `tangent`.
    pub fn add_damping_matrix(&self, c: &Configuration, factor: f64, tangent: &mut Blocks) {
        for (number, element) in self.damped_elements() {
            element.add_damping_matrix(&c.beams, factor, tangent.block_mut(number));
        }
        let points: usize = self.loads.iter().map(|load| load.points.len()).sum();
        let first = self.mesh.elements.len() + self.bodies.len() + points;
        for (number, spring) in self.springs.iter().enumerate().filter(|(_, spring)| spring.damping != 0.0) {
            let counts = self.sides(spring.coordinate).map(|marker| marker.coordinates(&self.mesh).len());
            for (place, part) in
                spring.damping_matrix(&self.relative_coordinates[spring.coordinate], c).iter().enumerate()
            {
                add_corner(tangent.block_mut(first + 4 * number + place), counts[place / 2], part, factor);
            }
        }
    }
}
