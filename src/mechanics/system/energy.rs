//! Energies and momenta of a system.

use crate::math::Vec3;
use crate::math::vectors::vec3;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::geometry::pose::axis_place;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;

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
        let beams: f64 = self.mesh.elements.iter().map(|element| element.energy(&c.beams)).sum();
        self.springs
            .iter()
            .fold(beams, |sum, spring| sum + spring.energy(&self.relative_coordinates[spring.coordinate], c))
    }

    /// `vᵀ M v / 2`, J.
    pub fn kinetic_energy(&self, velocity: &[f64]) -> f64 {
        let beams: f64 = self.mesh.elements.iter().map(|element| element.mass_form(velocity)).sum();
        let bodies = self.bodies.iter().flat_map(|body| {
            let own = velocity[body.start..body.start + BODY].iter().enumerate();
            own.map(|(local, velocity)| body.inertia(local) * velocity * velocity)
        });
        0.5 * bodies.fold(beams, |sum, product| sum + product)
    }

    /// `−Σ m g·r`, J; zero at the origin.
    pub fn gravity_energy(&self, q: &[f64]) -> f64 {
        // From +0: without gravity the energy is 0, not −0.
        let beams = self.mesh.elements.iter().fold(0.0, |sum, element| sum - element.weight_form(&self.gravity, q));
        let energy =
            self.bodies.iter().fold(beams, |sum, body| sum - body.mass * self.gravity.dot(&vec3(q, body.start)));
        if self.is_near() { energy } else { energy - self.mass * self.gravity.dot(&self.origin) }
    }

    /// Strain energy of a part, J: a body has none.
    pub fn elastic_energy_of(&self, part: Part, c: &Configuration) -> f64 {
        self.elements_of(part).iter().fold(0.0, |sum, element| sum + element.energy(&c.beams))
    }

    /// The share of a part in [`System::kinetic_energy`], J.
    pub fn kinetic_energy_of(&self, part: Part, velocity: &[f64]) -> f64 {
        let beam = self.elements_of(part).iter().fold(0.0, |sum, element| sum + element.mass_form(velocity));
        let Part::Body(body) = part else { return 0.5 * beam };
        let body = &self.bodies[body];
        let own = velocity[body.start..body.start + BODY].iter().enumerate();
        0.5 * own.fold(0.0, |sum, (local, velocity)| sum + body.inertia(local) * velocity * velocity)
    }

    /// The share of a part in [`System::gravity_energy`], J; zero at the origin.
    pub fn gravity_energy_of(&self, part: Part, q: &[f64]) -> f64 {
        let energy = match part {
            Part::Beam(_) => {
                self.elements_of(part).iter().fold(0.0, |sum, element| sum - element.weight_form(&self.gravity, q))
            }
            Part::Body(body) => {
                let body = &self.bodies[body];
                0.0 - body.mass * self.gravity.dot(&vec3(q, body.start))
            }
        };
        if self.is_near() { energy } else { energy - self.mass_of(part) * self.gravity.dot(&self.origin) }
    }

    /// Mass of a part, kg.
    fn mass_of(&self, part: Part) -> f64 {
        match part {
            Part::Beam(beam) => self.beam_masses[beam],
            Part::Body(body) => self.bodies[body].mass,
        }
    }

    /// The elements of a part.
    fn elements_of(&self, part: Part) -> &[AnyElement] {
        match part {
            Part::Beam(beam) => &self.mesh.elements[self.beams[beam].element_range()],
            Part::Body(_) => &[],
        }
    }

    /// Linear momentum (kg m/s) and angular momentum about the origin (kg m²/s): `Σ P_r`, `Σ r × P_r` and what nodes add by their
    /// slopes and sections (MECHANICS 7.2); of a body `Σ r × P_r + d × P_d`.
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
