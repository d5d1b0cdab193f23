//! Actuators in the equations: their forces, and the tangent of those that follow coordinates.

use super::System;
use super::equations::{add, add_corner, copy_corner};
use super::tangent_layout::TangentLayout;
use crate::math::blocks::{Block, Blocks};
use crate::mechanics::force::actuator::{self, Actuator, EffortGuide};
use crate::mechanics::force::effort_law::{EffortLaw, Reading, Way};
use crate::mechanics::geometry::marker_jacobian::{MarkerMatrix, MarkerVector};
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::{Configuration, Passage};

impl System {
    /// The effort of an actuator at `time`, s, as the system passes through `c`, N m or N; `given` is what
    /// [`Actuator::at`] gives.
    pub fn effort(&self, actuator: &Actuator, c: &Configuration, passage: &Passage, given: f64, time: f64) -> f64 {
        match &actuator.guide {
            EffortGuide::Law(law) => given * law.over(&self.way(law, c, passage, time)),
            EffortGuide::Signal(_) | EffortGuide::Host => given,
        }
    }

    /// The readings of an effort as the system passes through `c`.
    fn way(&self, law: &EffortLaw, c: &Configuration, passage: &Passage, time: f64) -> Way {
        let (all, readings) = (&self.relative_coordinates, law.readings.iter());
        let halves = match passage {
            Passage::Step(step) if law.has_corners => {
                Some(readings.clone().map(|reading| reading.half_of_way(all, step)).collect())
            }
            _ => None,
        };
        Way { time, values: readings.map(|reading| reading.value(all, c, passage)).collect(), halves }
    }

    /// All actuators with their efforts.
    pub(super) fn efforts<'a>(
        &'a self,
        c: &'a Configuration<'a>,
        passage: &'a Passage<'a>,
        excitation: &'a Excitation,
    ) -> impl Iterator<Item = (&'a Actuator, f64)> {
        let given = self.actuators.iter().zip(&excitation.efforts);
        given.map(move |(own, given)| (own, self.effort(own, c, passage, *given, excitation.time)))
    }

    /// Takes the forces of actuators from `forces`.
    pub(super) fn subtract_efforts(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        forces: &mut [f64],
    ) {
        for (actuator, effort) in self.efforts(c, passage, excitation) {
            let parts = actuator::force(&self.relative_coordinates[actuator.coordinate], c, -effort);
            for (marker, part) in self.sides(actuator.coordinate).into_iter().zip(&parts) {
                let range = marker.coordinates(&self.mesh);
                add(forces, range.start, &part.as_slice()[..range.len()]);
            }
        }
    }

    /// Sets the blocks of actuators in `tangent` to `-scale` times the derivative of their forces with respect to the
    /// coordinates (over a step: twice that with respect to those at its end).
    #[inline(never)]
    pub(super) fn set_effort_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        scale: f64,
        tangent: &mut Blocks,
    ) {
        let layout = TangentLayout::of(self);
        for (number, (actuator, effort)) in self.efforts(c, passage, excitation).enumerate() {
            let counts = self.counts(actuator.coordinate);
            let parts = actuator::force_q(&self.relative_coordinates[actuator.coordinate], c, effort);
            for (pair, (block, part)) in layout.actuator(number).zip(&parts).enumerate() {
                copy_corner(tangent.block_mut(block), counts[pair / 2], part, -scale);
            }
        }
        self.each_reading(
            c,
            passage,
            excitation,
            |first, count, parts| {
                for (pair, part) in parts.iter().enumerate() {
                    copy_corner(tangent.block_mut(first + 2 * pair), count[pair / 2], part, -scale);
                    tangent.block_mut(first + 2 * pair + 1).fill(0.0);
                }
            },
            |reading, c, passage| reading.gradient(&self.relative_coordinates, c, passage),
        );
    }

    /// Adds `-factor` times the derivative of the forces of actuators with respect to the velocities, at the instant
    /// `c`, to their blocks in `tangent`.
    #[inline(never)]
    pub(super) fn add_effort_damping(
        &self,
        c: &Configuration,
        velocity: &[f64],
        excitation: &Excitation,
        factor: f64,
        tangent: &mut Blocks,
    ) {
        let passage = Passage::with_velocity(velocity);
        self.each_reading(
            c,
            &passage,
            excitation,
            |first, count, parts| {
                for (pair, part) in parts.iter().enumerate() {
                    add_corner(tangent.block_mut(first + 2 * pair), count[pair / 2], part, -factor);
                }
            },
            |reading, c, _| match reading.is_rate {
                true => self.relative_coordinates[reading.coordinate].gradient(c),
                false => [MarkerVector::zeros(); 2],
            },
        );
    }

    /// Calls `take` for each reading of each actuator with the first of its blocks, the numbers of rows of both sides
    /// of the actuator, and `∂x/∂q ∂e/∂y ∂y/∂q`, of the coordinate `x` of the actuator and what `gradient` gives for
    /// the reading `y`, blocks of both sides of `x` by both of `y`.
    fn each_reading(
        &self,
        c: &Configuration,
        passage: &Passage,
        excitation: &Excitation,
        mut take: impl FnMut(usize, [usize; 2], &[MarkerMatrix; 4]),
        gradient: impl Fn(Reading, &Configuration, &Passage) -> [MarkerVector; 2],
    ) {
        let mut first = TangentLayout::of(self).first_reading();
        for (actuator, given) in self.actuators.iter().zip(&excitation.efforts) {
            let EffortGuide::Law(law) = &actuator.guide else { continue };
            let way = self.way(law, c, passage, excitation.time);
            let own = self.relative_coordinates[actuator.coordinate].gradient(c);
            for (index, reading) in law.readings.iter().enumerate() {
                let slope = law.slope(&way, index);
                let other = gradient(*reading, c, passage);
                let mut parts = [MarkerMatrix::zeros(); 4];
                for (number, part) in parts.iter_mut().enumerate() {
                    part.ger(given * slope, &own[number / 2], &other[number % 2], 0.0);
                }
                take(first, self.counts(actuator.coordinate), &parts);
                first += TangentLayout::OF_READING;
            }
        }
    }

    /// The numbers of coordinates of both sides of a relative coordinate.
    fn counts(&self, coordinate: usize) -> [usize; 2] {
        self.sides(coordinate).map(|marker| marker.coordinates(&self.mesh).len())
    }

    /// Appends the blocks of readings: of each pair of sides that of the derivative, then its mirror image, which stays
    /// 0, so that the pattern is symmetric.
    pub(super) fn push_reading_blocks(&self, blocks: &mut Blocks) {
        for actuator in &self.actuators {
            let own = self.sides(actuator.coordinate).map(|marker| marker.coordinates(&self.mesh));
            for reading in actuator.readings() {
                let other = self.sides(reading.coordinate).map(|marker| marker.coordinates(&self.mesh));
                for number in 0..4 {
                    let (rows, columns) = (&own[number / 2], &other[number % 2]);
                    let (row, column) = (rows.start, columns.start);
                    blocks.push_mirrored(Block { row, column, rows: rows.len(), columns: columns.len() });
                }
            }
        }
    }
}
