//! Elastic foundations in a system: forces, tangent, energy.

use super::System;
use super::tangent_layout::TangentLayout;
use crate::math::Vec3;
use crate::math::blocks::Blocks;
use crate::math::vectors::add_vec3;
use crate::mechanics::beam::ancf14::coordinates::SHAPE_PLACES;
use crate::mechanics::force::foundation::{Bearing, Bedding, Foundation};
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};

/// What a foundation does to the beam.
#[derive(Clone, Copy, Debug, Default)]
pub struct FoundationLoads {
    /// Force on the beam, N.
    pub force: Vec3,
    /// Moment on the beam about the origin, N m.
    pub moment: Vec3,
    /// Elastic energy, J.
    pub energy: f64,
}

impl System {
    /// Calls `take` with the number of each element on a foundation, the first of its coordinates, and the force at
    /// each of its points.
    fn each_bearing(&self, c: &Configuration, passage: &Passage, mut take: impl FnMut(usize, usize, &Bearing)) {
        for foundation in &self.foundations {
            self.each_bearing_of(foundation, c, passage, &mut take);
        }
    }

    fn each_bearing_of(
        &self,
        foundation: &Foundation,
        c: &Configuration,
        passage: &Passage,
        take: &mut impl FnMut(usize, usize, &Bearing),
    ) {
        for bed in &foundation.beds {
            let element = &self.mesh.elements[bed.element];
            let start = element.coordinates().start;
            foundation.each_bearing(bed, element, (c, passage), 1.0, &mut |own| take(bed.element, start, own));
        }
    }

    /// Adds `factor` times the forces of foundations, internal minus external, at `c` as `passage` says.
    #[inline(never)]
    pub(super) fn add_foundation_forces(&self, c: &Configuration, passage: &Passage, factor: f64, forces: &mut [f64]) {
        self.each_bearing(c, passage, |_, start, own| add_force(own, start, factor, forces));
    }

    /// [`Self::add_foundation_forces`], and adds `scale` times their derivative to the blocks of elements; over a step
    /// twice the derivative by the coordinates at its end.
    #[inline(never)]
    pub(super) fn add_foundations_and_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        let layout = TangentLayout::of(self);
        self.each_bearing(c, passage, |number, start, own| {
            add_force(own, start, 1.0, forces);
            own.add_to(&own.stiffness, scale, tangent.block_mut(layout.element(number)));
        });
    }

    /// Adds `factor` times the derivative of the forces with respect to the velocities, at an instant with the
    /// velocities `velocity`, to the first blocks of `tangent`.
    pub(super) fn add_foundation_damping(
        &self,
        c: &Configuration,
        velocity: &[f64],
        factor: f64,
        tangent: &mut Blocks,
    ) {
        let layout = TangentLayout::of(self);
        self.each_bearing(c, &Passage::with_velocity(velocity), |number, _, own| {
            own.add_to(&own.damping, factor, tangent.block_mut(layout.element(number)));
        });
    }

    /// Whether a foundation may lift off.
    pub fn pushes_on_one_side(&self) -> bool {
        self.foundations.iter().any(|own| matches!(own.bedding, Bedding::Pushing { .. }))
    }

    /// Elastic energy of all foundations at `c`, J.
    pub(super) fn foundation_energy(&self, c: &Configuration) -> f64 {
        let mut sum = 0.0;
        self.each_bearing(c, &Passage::Rest, |_, _, own| sum += own.energy);
        sum
    }

    /// Adds the forces of foundations over `step`, whose middle is `c`. Returns the elastic energy at its end and what
    /// damping takes, J.
    pub(super) fn finish_foundations(&self, c: &Configuration, step: &TimeStep, forces: &mut [f64]) -> [f64; 2] {
        if self.foundations.is_empty() {
            return [0.0; 2];
        }
        let mut dissipated = 0.0;
        self.each_bearing(c, &Passage::Step(*step), |_, start, own| {
            add_force(own, start, 1.0, forces);
            dissipated += own.dissipated;
        });
        [self.foundation_energy(step.end), dissipated]
    }

    /// Calls `take` with the force at each point of foundations under element `number` up to `end`, 0 to 1.
    pub fn each_bearing_on(
        &self,
        number: usize,
        c: &Configuration,
        passage: &Passage,
        end: f64,
        mut take: impl FnMut(&Bearing),
    ) {
        for foundation in &self.foundations {
            let Some(bed) = foundation.bed(number) else { continue };
            foundation.each_bearing(bed, &self.mesh.elements[number], (c, passage), end, &mut take);
        }
    }

    /// Sums of foundation `number` at `c`.
    pub fn foundation_loads(&self, number: usize, c: &Configuration, passage: &Passage) -> FoundationLoads {
        let mut found = FoundationLoads::default();
        self.each_bearing_of(&self.foundations[number], c, passage, &mut |element, _, own| {
            let q = &c.beams.q[self.mesh.elements[element].coordinates()];
            found.force += own.force;
            found.moment += (own.position(q) + self.origin).cross(&own.force);
            found.energy += own.energy;
        });
        found
    }
}

/// Adds `factor` times the internal force of a point of the element whose coordinates begin at `start`.
fn add_force(own: &Bearing, start: usize, factor: f64, forces: &mut [f64]) {
    for (weight, first) in own.weights.iter().zip(SHAPE_PLACES) {
        add_vec3(forces, start + first, &(own.force * (-factor * weight)));
    }
}
