//! What dampers add to the equations: those in the material of beams, and the damping matrix of springs too.

use super::equations::add_corner;
use crate::math::blocks::Blocks;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::fluid::Fluid;
use crate::mechanics::force::spring::Spring;
use crate::mechanics::geometry::marker_jacobian::MarkerMatrix;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;
use crate::mechanics::system::System;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::tangent_layout::TangentLayout;

impl System {
    /// Whether a spring or a material has damping.
    pub fn is_damped(&self) -> bool {
        self.springs.iter().any(Spring::is_damped)
            || self.contacts.iter().any(|contact| contact.law.is_damped())
            || self.beam_contacts.iter().any(|contact| contact.law.is_damped())
            || self.foundations.iter().any(|own| own.bedding.is_damped())
            || self.ropes.iter().any(|own| own.elasticity.damping != 0.0)
            || self.has_material_damping()
            || self.has_mass_damping()
            || self.fluids.iter().any(Fluid::drags)
    }

    /// The elements whose material is damped, with their numbers.
    fn damped_elements(&self) -> impl Iterator<Item = (usize, &AnyElement)> + '_ {
        self.mesh.elements.iter().enumerate().filter(|(_, element)| element.is_damped())
    }

    /// The numbers of the elements that are damped in proportion to their mass, with the rates, 1/s.
    fn dragged_elements(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let beams = self.beams.iter().filter(|beam| beam.mass_damping != 0.0);
        beams.flat_map(|beam| beam.element_range().map(|number| (number, beam.mass_damping)))
    }

    /// Adds the forces of damping in proportion to mass, `a M v`; over a step the velocity is the change of the
    /// coordinates over its length.
    pub(super) fn add_mass_damping(&self, c: &Configuration, passage: &Passage, forces: &mut [f64]) {
        let (vector, duration) = match passage {
            Passage::Rest | Passage::Corrected(_) => return,
            Passage::Instant { velocity, .. } => (*velocity, 1.0),
            Passage::Step(step) => (step.increment, step.duration),
        };
        for (number, rate) in self.dragged_elements() {
            self.add_element_mass_times(number, MassAt::from(c), rate / duration, vector, forces);
        }
    }

    /// Adds `scale` times the derivative of [`Self::add_mass_damping`], over a step twice that with respect to the
    /// coordinates at its end.
    pub(super) fn add_mass_damping_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        tangent: &mut Blocks,
    ) {
        let Passage::Step(step) = passage else { return };
        let layout = TangentLayout::of(self);
        for (number, rate) in self.dragged_elements() {
            let block = tangent.block_mut(layout.element(number));
            self.add_element_mass(number, MassAt::from(c), 2.0 * scale * rate / step.duration, block);
        }
    }

    /// Energy that damping in proportion to mass takes over a step that changes the coordinates by `increment` in
    /// `duration` s, J.
    pub(super) fn taken_by_mass_damping(&self, c: &Configuration, increment: &[f64], duration: f64) -> f64 {
        self.mass_damping_form(c, increment, duration)
    }

    /// Power that damping in proportion to mass takes, W.
    pub(super) fn power_of_mass_damping(&self, c: &Configuration, velocity: &[f64]) -> f64 {
        self.mass_damping_form(c, velocity, 1.0)
    }

    /// `a xᵀ M x/duration` of the change `change` of the coordinates.
    fn mass_damping_form(&self, c: &Configuration, change: &[f64], duration: f64) -> f64 {
        let form = |(number, rate): (usize, f64)| {
            let extent = self.mesh.elements[number].extent(c.beams.drives);
            rate * extent / duration * self.element_mass_form(number, c.beams.frames, change)
        };
        self.dragged_elements().map(form).sum()
    }

    /// Whether a beam is damped in proportion to its mass.
    pub fn has_mass_damping(&self) -> bool {
        self.dragged_elements().next().is_some()
    }

    /// Whether the material of a beam has damping.
    pub fn has_material_damping(&self) -> bool {
        self.damped_elements().next().is_some()
    }

    /// Sets `strain_rates` to the rates of all strains at `c` with the velocities `velocity`; those of relative
    /// coordinates stay.
    pub fn set_strain_rates(&self, c: &Configuration, velocity: &[f64], strain_rates: &mut [f64]) {
        self.mesh.elements.iter().for_each(|element| element.set_strain_rates(&c.beams, velocity, strain_rates));
    }

    /// Adds the viscous forces of the beams' material at an instant, with the velocities `velocity`, or with the rates
    /// of strains where they are given.
    pub(super) fn add_material_damping(
        &self,
        c: &Configuration,
        velocity: &[f64],
        strain_rates: Option<&[f64]>,
        forces: &mut [f64],
    ) {
        for (_, element) in self.damped_elements() {
            element.add_damping(&c.beams, velocity, strain_rates, forces);
        }
    }

    /// [`Self::add_material_damping`] with the velocities, and its derivatives with respect to the coordinates and to
    /// the velocities, times `scales`.
    #[inline(never)]
    pub(super) fn add_material_damping_and_tangent(
        &self,
        c: &Configuration,
        velocity: &[f64],
        scales: [f64; 2],
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        let layout = TangentLayout::of(self);
        for (number, element) in self.damped_elements() {
            let block = tangent.block_mut(layout.element(number));
            element.add_damping_and_tangent(&c.beams, velocity, scales, forces, block);
        }
    }

    /// Adds `factor` times the derivative of the forces, but for those of the beams' material, with respect to the
    /// velocities, at an instant with the velocities `velocity` under `excitation`, to the first blocks of `tangent`.
    pub fn add_damping_matrix(
        &self,
        c: &Configuration,
        (velocity, excitation): (&[f64], &Excitation),
        factor: f64,
        tangent: &mut Blocks,
    ) {
        self.add_effort_damping(c, velocity, excitation, factor, tangent);
        self.add_fluid_damping(c, velocity, excitation, factor, tangent);
        self.add_spring_and_mass_damping(c, factor, tangent, |spring, coordinate| {
            spring.damping_matrix(coordinate, c, velocity)
        });
        self.add_contact_damping(c, velocity, factor, tangent);
        self.add_beam_contact_damping(c, velocity, factor, tangent);
        self.add_foundation_damping(c, velocity, factor, tangent);
        self.add_rope_damping(c, velocity, factor, tangent);
    }

    /// Sets the first blocks of `tangent` to the derivative of all forces with respect to the velocities at rest, under
    /// `excitation`, without dry friction.
    pub fn set_damping_at_rest(&self, c: &Configuration, excitation: &Excitation, tangent: &mut Blocks) {
        let rest = vec![0.0; self.coordinates()];
        self.set_material_damping_at_rest(c, tangent);
        self.add_effort_damping(c, &rest, excitation, 1.0, tangent);
        self.add_fluid_damping(c, &rest, excitation, 1.0, tangent);
        self.add_spring_and_mass_damping(c, 1.0, tangent, |spring, coordinate| spring.damping_at_rest(coordinate, c));
        self.add_contact_damping(c, &rest, 1.0, tangent);
        self.add_beam_contact_damping(c, &rest, 1.0, tangent);
        self.add_foundation_damping(c, &rest, 1.0, tangent);
        self.add_rope_damping(c, &rest, 1.0, tangent);
    }

    /// Sets the first blocks of `tangent` to the derivative of all forces with respect to the velocities, at an instant
    /// with the velocities `velocity` under `excitation`; those of inertia are left out.
    pub fn set_damping(&self, c: &Configuration, velocity: &[f64], excitation: &Excitation, tangent: &mut Blocks) {
        let mut forces = vec![0.0; self.coordinates()];
        tangent.clear();
        self.add_material_damping_and_tangent(c, velocity, [0.0, 1.0], &mut forces, tangent);
        self.add_damping_matrix(c, (velocity, excitation), 1.0, tangent);
    }

    /// [`Self::set_damping_at_rest`] of the beams' material alone.
    pub fn set_material_damping_at_rest(&self, c: &Configuration, tangent: &mut Blocks) {
        let rest = vec![0.0; self.coordinates()];
        let mut forces = rest.clone();
        tangent.clear();
        self.add_material_damping_and_tangent(c, &rest, [0.0, 1.0], &mut forces, tangent);
    }

    /// Adds `factor` times the damping matrices of the masses of beams, and of springs as `of_spring` gives them.
    #[inline(never)]
    fn add_spring_and_mass_damping(
        &self,
        c: &Configuration,
        factor: f64,
        tangent: &mut Blocks,
        of_spring: impl Fn(&Spring, &RelativeCoordinate) -> [MarkerMatrix; 4],
    ) {
        let layout = TangentLayout::of(self);
        for (number, rate) in self.dragged_elements() {
            let block = tangent.block_mut(layout.element(number));
            self.add_element_mass(number, MassAt::from(c), factor * rate, block);
        }
        for (number, spring) in self.springs.iter().enumerate().filter(|(_, spring)| spring.is_damped()) {
            let counts = self.sides(spring.coordinate).map(|marker| marker.coordinates(&self.mesh).len());
            let parts = of_spring(spring, &self.relative_coordinates[spring.coordinate]);
            for (pair, (block, part)) in layout.spring(number).zip(&parts).enumerate() {
                add_corner(tangent.block_mut(block), counts[pair / 2], part, factor);
            }
        }
    }
}
