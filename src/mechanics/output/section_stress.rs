//! Twist and stress of a section that is watched.

use crate::mechanics::beam::resultants::{self, Fiber, SectionStrains};
use crate::mechanics::beam::section::Outline;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::system::System;

impl Sensor {
    /// Material twist from the beam's start to here (off the beams 0), undeformed value taken off, rad: the sum of
    /// `l tau` (MECHANICS, trap 16).
    pub fn twist(&self, system: &System, c: &Configuration) -> f64 {
        let (Some((beam, _)), Some((element, xi))) = (self.on_beam, self.places().next()) else { return 0.0 };
        let elements = &c.mesh.elements;
        let before = &elements[system.beams[beam].first_element..element];
        before.iter().map(|element| element.twist(&c.beams, 1.0)).sum::<f64>() + elements[element].twist(&c.beams, xi)
    }

    /// Largest von Mises stress over the section's outline, Pa; at an inner node of the mean strains. None without an
    /// outline.
    pub fn stress(&self, system: &System, c: &Configuration) -> Option<f64> {
        self.on_section(system, c, resultants::largest_stress)
    }

    /// The axial force that alone would cause this stress, N.
    pub fn stress_as_force(&self, system: &System, c: &Configuration) -> Option<f64> {
        let (beam, fraction) = self.on_beam?;
        Some(self.stress(system, c)? * system.beams[beam].section_at(fraction).area)
    }

    /// The fiber of the section that bears this stress.
    pub fn worst_fiber(&self, system: &System, c: &Configuration) -> Option<Fiber> {
        self.on_section(system, c, Fiber::worst)
    }

    /// The stress of a fiber that bears the largest one in a state nearby, Pa.
    pub fn stress_of(&self, fiber: &Fiber, system: &System, c: &Configuration) -> Option<f64> {
        self.on_section(system, c, |outline, young, torque, strains| fiber.stress(outline, young, torque, strains))
    }

    /// What `read` makes of the outline, Young's modulus, torque and strains of the section.
    fn on_section<T>(
        &self,
        system: &System,
        c: &Configuration,
        read: impl FnOnce(&Outline, f64, f64, &SectionStrains) -> Option<T>,
    ) -> Option<T> {
        let (Some((beam, fraction)), Some((element, xi))) = (self.on_beam, self.places().next()) else { return None };
        let beam = &system.beams[beam];
        let strains = self.strains(c);
        let torque = c.mesh.elements[element].torsion_rigidity(xi) * strains.torsion;
        read(&beam.section_at(fraction).outline, beam.young, torque, &strains)
    }
}
