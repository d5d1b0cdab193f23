//! Energies and momenta of a system.

use crate::math::Vec3;
use crate::math::vectors::vec3;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::force::spring::Spring;
use crate::mechanics::geometry::pose::axis_place;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::winches::is_at_rest;
use std::ops::Range;

/// A part that has mass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// A beam, by its number.
    Beam(usize),
    /// A body, by its number.
    Body(usize),
}

impl System {
    /// Strain energy of beams and energy of springs, J.
    pub fn elastic_energy(&self, c: &Configuration) -> f64 {
        self.with_stored_energy(self.mesh.elements.iter().map(|element| element.energy(&c.beams)).sum(), c)
    }

    /// The strain energy `beams` of the beams, J, and that of springs, contacts, foundations and ropes.
    pub(super) fn with_stored_energy(&self, beams: f64, c: &Configuration) -> f64 {
        let energy = |spring: &Spring| spring.energy(&self.relative_coordinates[spring.coordinate], c);
        let whole = self.springs.iter().fold(beams, |sum, spring| sum + energy(spring));
        let whole = if self.has_contacts() { whole + self.contact_energy(c) } else { whole };
        let whole = if self.foundations.is_empty() { whole } else { whole + self.foundation_energy(c) };
        if self.ropes.is_empty() { whole } else { whole + self.rope_energy(c) }
    }

    /// Kinetic energy with the velocities `velocity` at `c`, J.
    pub fn kinetic_energy(&self, c: &Configuration, velocity: &[f64]) -> f64 {
        let of_mesh = self.kinetic_energy_of_mesh(MassAt::from(c), velocity);
        if self.winches.is_empty() { of_mesh } else { of_mesh + self.transport_energy(c, velocity) }
    }

    /// `vᵀ M v / 2`, J.
    pub fn kinetic_energy_of_mesh(&self, at: MassAt, velocity: &[f64]) -> f64 {
        let elements = self.mesh.elements.iter().enumerate();
        let form = |number| self.element_mass_form(number, at.frames, velocity);
        let beams: f64 = elements.map(|(number, element)| element.extent(at.drives) * form(number)).sum();
        let bodies = self.bodies.iter().flat_map(|body| {
            let own = velocity[body.start..body.start + BODY].iter().enumerate();
            own.map(|(local, velocity)| body.inertia(local) * velocity * velocity)
        });
        0.5 * bodies.fold(beams, |sum, product| sum + product)
    }

    /// `−Σ m g·r`, J; zero at the origin.
    pub fn gravity_energy(&self, c: &Configuration) -> f64 {
        // From +0: without gravity the energy is 0, not −0.
        let beams = self.mesh.elements.iter().fold(0.0, |sum, element| sum - self.weight_form(element, c));
        let bodies = self.bodies.iter();
        let energy = bodies.fold(beams, |sum, body| sum - body.mass * self.gravity.dot(&vec3(c.beams.q, body.start)));
        if self.is_near() { energy } else { energy - self.mass_at(c) * self.gravity.dot(&self.origin) }
    }

    /// Strain energy of a part, J: a body has none.
    pub fn elastic_energy_of(&self, part: Part, c: &Configuration) -> f64 {
        self.elements_of(part).iter().fold(0.0, |sum, element| sum + element.energy(&c.beams))
    }

    /// Work of the weight of `element` at `c` against that at the origin, J.
    fn weight_form(&self, element: &AnyElement, c: &Configuration) -> f64 {
        element.extent(c.beams.drives) * element.weight_form(&self.gravity, c.beams.q)
    }

    /// The share of a part in [`System::kinetic_energy`], J.
    pub fn kinetic_energy_of(&self, part: Part, c: &Configuration, velocity: &[f64]) -> f64 {
        let twice = |number: usize| {
            let extent = self.mesh.elements[number].extent(c.beams.drives);
            extent * self.element_mass_form(number, c.beams.frames, velocity)
        };
        let beam = self.element_numbers(part).fold(0.0, |sum, number| sum + twice(number));
        let Part::Body(body) = part else {
            let paid_out = self.elements_of(part).iter().filter_map(AnyElement::paid_out);
            let transports = paid_out.filter(|_| !is_at_rest(velocity));
            return transports.fold(0.5 * beam, |sum, own| sum + own.transport_energy(&c.beams, velocity));
        };
        let body = &self.bodies[body];
        let own = velocity[body.start..body.start + BODY].iter().enumerate();
        0.5 * own.fold(0.0, |sum, (local, velocity)| sum + body.inertia(local) * velocity * velocity)
    }

    /// The share of a part in [`System::gravity_energy`], J; zero at the origin.
    pub fn gravity_energy_of(&self, part: Part, c: &Configuration) -> f64 {
        let energy = match part {
            Part::Beam(_) => self.elements_of(part).iter().fold(0.0, |sum, element| sum - self.weight_form(element, c)),
            Part::Body(body) => {
                let body = &self.bodies[body];
                0.0 - body.mass * self.gravity.dot(&vec3(c.beams.q, body.start))
            }
        };
        if self.is_near() { energy } else { energy - self.mass_of(part, c) * self.gravity.dot(&self.origin) }
    }

    /// Mass of everything at `c`, kg.
    fn mass_at(&self, c: &Configuration) -> f64 {
        self.winches
            .iter()
            .fold(self.mass, |sum, winch| sum + self.mass_of(Part::Beam(winch.beam), c) - self.beam_masses[winch.beam])
    }

    /// Mass of a part at `c`, kg.
    fn mass_of(&self, part: Part, c: &Configuration) -> f64 {
        match part {
            Part::Beam(beam) => {
                self.beam_masses[beam] * self.mesh.elements[self.beams[beam].first_element].extent(c.beams.drives)
            }
            Part::Body(body) => self.bodies[body].mass,
        }
    }

    /// The elements of a part.
    fn elements_of(&self, part: Part) -> &[AnyElement] {
        &self.mesh.elements[self.element_numbers(part)]
    }

    /// The numbers of the elements of a part.
    fn element_numbers(&self, part: Part) -> Range<usize> {
        match part {
            Part::Beam(beam) => self.beams[beam].element_range(),
            Part::Body(_) => 0..0,
        }
    }

    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m²/s): `Σ P_r`, `Σ r × P_r` and what nodes
    /// add by their slopes and sections (MECHANICS 7.2); of a body `Σ r × P_r + d × P_d`.
    pub fn momentum(&self, q: &[f64], momentum: &[f64]) -> (Vec3, Vec3) {
        let (mut linear, mut angular) = (Vec3::zeros(), Vec3::zeros());
        for node in &self.mesh.nodes {
            linear += node.place(momentum);
            angular += node.angular_momentum(q, momentum);
        }
        for body in &self.bodies {
            linear += vec3(momentum, body.start);
            for place in [0, axis_place(0), axis_place(1), axis_place(2)] {
                angular += vec3(q, body.start + place).cross(&vec3(momentum, body.start + place));
            }
        }
        if !self.is_near() {
            angular += self.origin.cross(&linear);
        }
        (linear, angular)
    }

    /// Whether positions in the state are global ones.
    fn is_near(&self) -> bool {
        self.origin == Vec3::zeros()
    }

    /// The global position of `position` in the state, m.
    pub fn global(&self, position: Vec3) -> Vec3 {
        if self.is_near() { position } else { self.origin + position }
    }
}
