//! Bodies in fluids in the equations of a system: their forces, and the mass that moves with them.

use super::System;
use super::fluids::FluidAt;
use super::tangent_layout::TangentLayout;
use crate::math::Vec3;
use crate::math::blocks::Blocks;
use crate::math::vectors::{add_vec3, vec3};
use crate::mechanics::beam::ancf14::fluid_load::ByCoordinates;
use crate::mechanics::fluid::medium::Medium;
use crate::mechanics::fluid::wet_body::{Around, Floating, OnBody, WetBody};
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, Passage};

/// The fluid at the center of a body as it passes; equilibria have no waves.
fn around(medium: &Medium, position: &Vec3, excitation: &Excitation, is_still: bool) -> Around {
    let Excitation { gravity, time, drag: share, .. } = *excitation;
    let seen = if is_still { medium.still(position, time) } else { medium.seen(position, time) };
    Around { seen, gravity, share, side: medium.side }
}

/// How a body moves as `passage` says.
fn moving(start: usize, c: &Configuration, passage: &Passage) -> (Floating, bool) {
    match passage {
        Passage::Rest | Passage::Corrected(_) => (Floating::with(start, c.beams.q, None, None), true),
        Passage::Instant { velocity, .. } => (Floating::with(start, c.beams.q, Some(velocity), None), false),
        Passage::Step(step) => {
            let velocity = vec3(step.increment, start) / step.duration;
            let lead = if step.velocity_lead.is_empty() { Vec3::zeros() } else { vec3(step.velocity_lead, start) };
            let acceleration = (velocity - vec3(step.velocity, start) - lead) * (2.0 / step.duration);
            (Floating { velocity, acceleration, ..Floating::with(start, c.beams.q, None, None) }, false)
        }
    }
}

impl System {
    /// The bodies in fluids, each with its fluid.
    fn wet_bodies(&self) -> impl Iterator<Item = (&WetBody, &Medium)> {
        self.fluids.iter().flat_map(|fluid| fluid.bodies.iter().map(|own| (own, &fluid.medium)))
    }

    /// Calls `take` with each body in a fluid and the force on it, as `passage` says.
    pub(super) fn each_wet_body(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        mut take: impl FnMut(&WetBody, &OnBody),
    ) {
        for (own, medium) in self.wet_bodies() {
            let (moving, is_still) = moving(own.start, c, passage);
            take(own, &own.force(&moving, &around(medium, &moving.position, excitation, is_still)));
        }
    }

    /// Adds `factor` times the forces of fluids on bodies, internal minus external, with these coordinates,
    /// velocities and accelerations.
    #[inline(never)]
    pub(super) fn add_fluid_on_bodies_at(
        &self,
        (q, velocity, acceleration): (&[f64], &[f64], &[f64]),
        excitation: &Excitation,
        factor: f64,
        forces: &mut [f64],
    ) {
        for (own, medium) in self.wet_bodies() {
            let moving = Floating::with(own.start, q, Some(velocity), Some(acceleration));
            let found = own.force(&moving, &around(medium, &moving.position, excitation, false));
            add_vec3(forces, own.start, &(found.force * -factor));
        }
    }

    /// Adds the forces of fluids on bodies, internal minus external, and `scale` times their derivative with respect
    /// to the coordinates to the blocks of bodies in `tangent`; over a step twice that with respect to the coordinates
    /// at its end.
    #[inline(never)]
    pub(super) fn add_fluid_on_bodies_and_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        let (layout, by) = (TangentLayout::of(self), ByCoordinates::of(&passage.of_beams()));
        self.each_wet_body(c, passage, excitation, |own, found| {
            add_vec3(forces, own.start, &-found.force);
            found.add_tangent([by.velocity, by.acceleration], -scale, tangent.block_mut(layout.body(own.body)));
        });
    }

    /// Adds `factor` times the derivative of the forces of fluids on bodies with respect to their velocities to the
    /// blocks of bodies in `tangent`.
    #[inline(never)]
    pub(super) fn add_fluid_damping_of_bodies(
        &self,
        c: &Configuration,
        velocity: &[f64],
        excitation: &Excitation,
        factor: f64,
        tangent: &mut Blocks,
    ) {
        let layout = TangentLayout::of(self);
        self.each_wet_body(c, &Passage::with_velocity(velocity), excitation, |own, found| {
            OnBody::add_of_center(&found.by_velocity, -factor, tangent.block_mut(layout.body(own.body)));
        });
    }

    /// The added mass of bodies at `at`, in global axes, kg.
    fn each_added_mass(&self, at: FluidAt, mut take: impl FnMut(&WetBody, &OnBody)) {
        for (own, medium) in self.wet_bodies().filter(|(own, _)| own.added.amax() > 0.0) {
            let moving = Floating::with(own.start, at.q, None, None);
            let seen = medium.seen(&moving.position, at.time);
            let fluid = Around { seen, gravity: Vec3::zeros(), share: 1.0, side: medium.side };
            take(own, &own.force(&moving, &fluid));
        }
    }

    /// Adds `factor` times the added mass matrix of bodies to their blocks in `tangent`.
    #[inline(never)]
    pub(super) fn add_added_mass_of_bodies(&self, at: FluidAt, factor: f64, tangent: &mut Blocks) {
        let layout = TangentLayout::of(self);
        self.each_added_mass(at, |own, found| {
            OnBody::add_of_center(&found.added, factor, tangent.block_mut(layout.body(own.body)));
        });
    }

    /// Adds the product of the added mass matrix of bodies with `vector` to `product`; returns `vectorᵀ M_a vector`.
    #[inline(never)]
    pub(super) fn add_added_mass_of_bodies_times(&self, at: FluidAt, vector: &[f64], product: &mut [f64]) -> f64 {
        let mut form = 0.0;
        self.each_added_mass(at, |own, found| {
            let value = vec3(vector, own.start);
            let momentum = found.added * value;
            form += momentum.dot(&value);
            add_vec3(product, own.start, &momentum);
        });
        form
    }
}
