//! Forces of turning loads, actuators, dampers and laws in the middle of the time of a step, beside those that the step
//! takes: sources of the time-step error (MECHANICS 7.8).
//!
//! A step takes these forces at the means of its ends. In the middle of its time coordinates are `h²/8` of their
//! acceleration less, and rates `h²/24` of its derivative. The sizes of elastic forces of beams and of springs without
//! a law are not among them, as the estimate knows the rates of their strains; the directions of springs are.

use super::System;
use super::equations::add;
use crate::mechanics::force::actuator::{self, EffortGuide};
use crate::mechanics::force::load::Load;
use crate::mechanics::geometry::marker_jacobian::MarkerVector;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};

/// A relative coordinate in the middle of the time of a step.
#[derive(Clone, Copy, Debug, Default)]
pub struct Middle {
    /// Its value, m or rad.
    pub value: f64,
    /// Its rate, m/s or rad/s.
    pub rate: f64,
    /// The second derivative of the force of laws on it by time as differences of the motion have it, N/s² or N m/s².
    pub bend: f64,
    /// The force of a spring on it over the step, N or N m.
    pub tension: f64,
}

/// A relative coordinate over a step.
#[derive(Clone, Copy, Debug)]
pub struct Mean {
    /// Its value, m or rad.
    pub value: f64,
    /// Its rate, m/s or rad/s.
    pub rate: f64,
    /// The force of a spring on it, N or N m.
    pub tension: f64,
    /// The force of a law on it, N or N m.
    pub force: f64,
}

/// Where forces read relative coordinates.
#[derive(Clone, Copy, Debug)]
pub enum Sight<'a> {
    /// As a step takes them.
    Step(&'a TimeStep<'a>),
    /// In the middle of its time, by their numbers.
    Middle(&'a [Middle]),
}

impl System {
    /// Whether a force may differ between the step and the middle of its time.
    pub fn has_lagging_forces(&self) -> bool {
        !self.actuators.is_empty()
            || self.is_in_fluid()
            || self.loads.iter().any(Load::may_turn)
            || self.springs.iter().any(|own| !own.is_idle())
            || self.has_contacts()
            || !self.foundations.is_empty()
            || !self.ropes.is_empty()
    }

    /// The frames of nodes that these forces depend on, by their numbers.
    pub fn frames_of_lagging_forces(&self) -> Vec<usize> {
        let loads = self.loads.iter().filter(|load| load.may_turn());
        let points = loads.flat_map(|load| load.markers(&self.mesh));
        let springs = self.springs.iter().map(|spring| spring.coordinate);
        let sides = springs.chain(self.actuators.iter().map(|own| own.coordinate)).flat_map(|own| self.sides(own));
        self.frames_of(points.chain(sides.copied()))
    }

    /// Adds `factor` times the forces, internal minus external, that differ between the means of a step and the middle
    /// of its time, at `c`.
    pub fn add_lagging_forces(
        &self,
        c: &Configuration,
        sight: Sight,
        excitation: &Excitation,
        factor: f64,
        forces: &mut [f64],
    ) {
        for (load, given) in self.loads.iter().zip(excitation.loads()).filter(|(load, _)| load.may_turn()) {
            if !load.is_constant(given.0) {
                load.each_force(c, given, |range, own| {
                    forces[range].iter_mut().zip(own).for_each(|(sum, own)| *sum -= factor * own);
                });
            }
        }
        match sight {
            // Without damping, whose rates the middle of the time does not know.
            Sight::Step(step) => {
                let passage = Passage::Step(TimeStep { duration: f64::INFINITY, ..*step });
                self.add_normal_forces(c, &passage, factor, forces);
                self.add_foundation_forces(c, &passage, factor, forces);
                self.add_rope_forces(c, &passage, factor, forces);
            }
            Sight::Middle(_) => {
                self.add_normal_forces(c, &Passage::Rest, factor, forces);
                self.add_foundation_forces(c, &Passage::Rest, factor, forces);
                self.add_rope_forces(c, &Passage::Rest, factor, forces);
            }
        }
        let mut take = |marker: &Marker, part: &MarkerVector, factor: f64| {
            let range = marker.coordinates(&self.mesh);
            add(forces, range.start, &(part * factor).as_slice()[..range.len()]);
        };
        for (own, given) in self.actuators.iter().zip(&excitation.efforts) {
            let effort = match (&own.guide, sight) {
                (EffortGuide::Law(law), Sight::Middle(middles)) => {
                    let readings = law.readings.iter().map(|own| {
                        let Middle { value, rate, .. } = middles[own.coordinate];
                        if own.is_rate { rate } else { value }
                    });
                    given * (law.function)(excitation.time, &readings.collect::<Vec<_>>(), usize::MAX)[0]
                }
                (_, Sight::Step(step)) => self.effort(own, c, &Passage::Step(*step), *given, excitation.time),
                (EffortGuide::Signal(_) | EffortGuide::Host, Sight::Middle(_)) => *given,
            };
            let parts = actuator::force(&self.relative_coordinates[own.coordinate], c, effort);
            for (marker, part) in self.sides(own.coordinate).into_iter().zip(&parts) {
                take(marker, part, -factor);
            }
        }
    }

    /// Adds `factor` times by how much forces of springs over `step`, whose middle is `c`, exceed those in the middle
    /// of its time, but for what [`Self::subtract_turned_springs`] takes.
    pub fn add_lags_of_springs(
        &self,
        c: &Configuration,
        step: &TimeStep,
        middles: &[Middle],
        factor: f64,
        forces: &mut [f64],
    ) {
        for spring in self.springs.iter().filter(|spring| !spring.is_idle()) {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            let Middle { value, rate, bend, .. } = middles[spring.coordinate];
            // Differences of the motion have the law's part as well.
            let known = if spring.law.is_some() { step.duration * step.duration / 24.0 * bend } else { 0.0 };
            let lag = spring.lag(coordinate, c, step, [value, rate]) + known;
            let own = coordinate.gradient(c).map(|side| side * lag);
            let whole = spring.gradient(coordinate, c, &Passage::Step(*step));
            for (marker, part) in self.sides(spring.coordinate).into_iter().zip(&[own[0] + whole[0], own[1] + whole[1]])
            {
                let range = marker.coordinates(&self.mesh);
                add(forces, range.start, &(part * factor).as_slice()[..range.len()]);
            }
        }
    }

    /// Subtracts `factor` times the forces of springs over a step, in the directions that they have at `c`, in the
    /// middle of its time.
    pub fn subtract_turned_springs(&self, c: &Configuration, middles: &[Middle], factor: f64, forces: &mut [f64]) {
        for spring in self.springs.iter().filter(|spring| !spring.is_idle()) {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            let tension = middles[spring.coordinate].tension;
            for (marker, part) in self.sides(spring.coordinate).into_iter().zip(&coordinate.gradient(c)) {
                let range = marker.coordinates(&self.mesh);
                add(forces, range.start, &(part * (-factor * tension)).as_slice()[..range.len()]);
            }
        }
    }

    /// Calls `take` with the number of each relative coordinate that these forces depend on, and with its means over
    /// `step`, whose middle is `c`.
    pub fn each_mean_of_step(&self, c: &Configuration, step: &TimeStep, mut take: impl FnMut(usize, Mean)) {
        let springs = self.springs.iter().filter(|spring| !spring.is_idle()).map(|spring| {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            let tension = spring.tension(coordinate, c, &Passage::Step(*step));
            (spring.coordinate, tension, if spring.law.is_some() { tension } else { 0.0 })
        });
        let readings = self.actuators.iter().flat_map(|own| own.readings().iter().map(|own| own.coordinate));
        // A spring on a coordinate that an actuator reads comes after it: it knows the force as well.
        for (number, tension, force) in readings.map(|number| (number, 0.0, 0.0)).chain(springs) {
            let [start, end] =
                [step.start, step.end].map(|c| self.relative_coordinates[number].value(c, c.relative_values[number]));
            take(number, Mean { value: 0.5 * (start + end), rate: (end - start) / step.duration, tension, force });
        }
    }
}
