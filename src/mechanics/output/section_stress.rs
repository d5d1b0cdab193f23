//! Outputs of a section that is watched: twist, forces and moments, strains, stress.

use super::section_loads::{ElementBalance, SectionLoads, SectionWrench};
use crate::mechanics::beam::resultants::{self, Fiber, SectionStrains};
use crate::mechanics::beam::section::Outline;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::{Facing, Section, Sensor};
use crate::mechanics::system::System;

/// The fiber of a point that bears most: on which side of the point, and where in the section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WorstFiber {
    facing: Facing,
    fiber: Fiber,
}

/// A section with its forces.
#[derive(Clone, Copy, Debug)]
pub struct LoadedSection<'a> {
    section: &'a Section,
    balance: ElementBalance<'a>,
    /// Force and moment that it transmits.
    pub wrench: SectionWrench,
}

impl LoadedSection<'_> {
    /// Strains of the section; viscous stress is no part of what they bear.
    pub fn strains(&self) -> SectionStrains {
        self.balance.strains(self.section, &self.wrench)
    }
}

impl Sensor {
    /// Material twist from the beam's start to here (off the beams 0), undeformed value taken off, rad: the sum of
    /// `l tau` (MECHANICS, trap 16).
    pub fn twist(&self, system: &System, c: &Configuration) -> f64 {
        let (Some((beam, _)), Some((element, xi))) = (self.on_beam, self.places().next()) else { return 0.0 };
        let elements = &c.mesh.elements;
        let before = &elements[system.beams[beam].first_element..element];
        before.iter().map(|element| element.twist(&c.beams, 1.0)).sum::<f64>() + elements[element].twist(&c.beams, xi)
    }

    /// The section on the sensor's own side; none off the beams.
    pub fn section<'a>(&'a self, loads: &'a SectionLoads) -> Option<LoadedSection<'a>> {
        self.facing(loads, self.facing)
    }

    /// The section on the side `facing`, or on the only side.
    fn facing<'a>(&'a self, loads: &'a SectionLoads, facing: Facing) -> Option<LoadedSection<'a>> {
        let section = match facing {
            Facing::Before => self.sections().first(),
            Facing::After => self.sections().last(),
        }?;
        let balance = loads.of_element(section.element);
        Some(LoadedSection { section, balance, wrench: balance.section(section.xi, facing) })
    }

    /// Largest von Mises stress over the section's outline on either side, Pa. None without an outline.
    pub fn stress(&self, loads: &SectionLoads) -> Option<f64> {
        let stresses = self.sides().filter_map(|facing| self.on_side(loads, facing, resultants::largest_stress));
        stresses.reduce(f64::max)
    }

    /// The fiber that bears this stress.
    pub fn worst_fiber(&self, loads: &SectionLoads) -> Option<WorstFiber> {
        let read = |outline: &Outline, young: f64, torque: f64, strains: &SectionStrains| {
            let stress = resultants::largest_stress(outline, young, torque, strains)?;
            Some((stress, Fiber::worst(outline, young, torque, strains)?))
        };
        let fibers = self.sides().filter_map(|facing| {
            self.on_side(loads, facing, read).map(|(stress, fiber)| (stress, WorstFiber { facing, fiber }))
        });
        fibers.reduce(|a, b| if b.0 > a.0 { b } else { a }).map(|(_, fiber)| fiber)
    }

    /// The stress of a fiber that bears the largest one in a state nearby, Pa.
    pub fn stress_of(&self, worst: &WorstFiber, loads: &SectionLoads) -> Option<f64> {
        self.on_side(loads, worst.facing, |outline, young, torque, strains| {
            worst.fiber.stress(outline, young, torque, strains)
        })
    }

    /// The sides on which there is a section.
    fn sides(&self) -> impl Iterator<Item = Facing> + use<> {
        let count = self.sections().len();
        [Facing::Before, Facing::After].into_iter().skip(2 - count.min(2))
    }

    /// The value that `read` gives for the outline, Young's modulus, torque and strains of the section on one side. The
    /// strains are those that the whole stress would have in a linear law.
    fn on_side<T>(
        &self,
        loads: &SectionLoads,
        facing: Facing,
        read: impl FnOnce(&Outline, f64, f64, &SectionStrains) -> Option<T>,
    ) -> Option<T> {
        let ((beam, fraction), loaded) = (self.on_beam?, self.facing(loads, facing)?);
        let beam = &loads.joints.system.beams[beam];
        let strains = loaded.balance.stress_strains(loaded.section, &loaded.wrench);
        read(&beam.section_at(fraction).outline, beam.young, loaded.wrench.moment[0], &strains)
    }
}
