//! Sources of the error: what the exact motion leaves of the equation of a step.

use super::super::Span;
use super::super::scratch::{Start, configurations, time_step};
use super::{Estimator, Lags, MEAN, MIDPOINT, TRAPEZOIDAL, Taken, in_middle};
use crate::mechanics::state::time_error::{Passed, TimeError};
use crate::mechanics::system::System;
use crate::mechanics::system::middle_forces::{Mean, Middle, Sight};

impl Estimator {
    /// Sets the derivatives of the motion, and the source: what the exact motion leaves of the equation of the step,
    /// but for the part in strains, over the mass.
    pub(super) fn find_source(&mut self, system: &System, taken: &Taken, error: &TimeError, mean: f64) {
        let h = taken.span.step;
        if error.known < 1 || taken.state.prediction.known < 1 {
            for list in [&mut self.jerk, &mut self.filtered, &mut self.snap] {
                list.fill(0.0);
            }
            self.source_size = 0.0;
            return;
        }
        self.find_jerk(taken, mean);
        let cube = h * h * h;
        let Self { jerk, snap, filtered: source, .. } = self;
        let before = error.jerk.iter().zip(&error.snap);
        let found = snap.iter_mut().zip(&mut *source);
        for ((jerk, (jerk_before, snap_before)), (snap, source)) in jerk.iter().zip(before).zip(found) {
            *snap = if error.known < 2 { 0.0 } else { (jerk - jerk_before) / mean };
            // Differences lie half a step and a whole one behind the middle of this step. What turns would be
            // accelerated by derivatives that lag.
            let ahead = if error.known < 3 { *snap } else { 2.0 * *snap - snap_before };
            *source = cube * (0.5 * h * MIDPOINT * ahead - TRAPEZOIDAL * in_middle(*jerk, *snap, h));
        }
        self.source_size = system.motion_size(&self.filtered[..self.jerk.len()]);
    }

    /// Sets the third derivatives of the motion, 1/s³ each: the change of the mean acceleration since the last step
    /// over `mean` s, the time between the middles of both.
    pub(super) fn find_jerk(&mut self, taken: &Taken, mean: f64) {
        let (h, state) = (taken.span.step, taken.state);
        let motion = taken.solution.increment.iter().zip(&state.velocity).zip(&state.prediction.acceleration);
        for (jerk, ((increment, velocity), before)) in self.jerk.iter_mut().zip(motion) {
            *jerk = (2.0 * (increment / h - velocity) / h - before) / mean;
        }
    }

    /// Adds to the source, in momentum, by what forces over the step differ from those in the middle of its time. The
    /// scratch memory still has the configurations of the step.
    pub(super) fn add_lags(&mut self, system: &System, taken: &Taken, mean: f64) {
        let Taken { state, dissipation, span: Span { step: h, .. }, solution, .. } = *taken;
        let (error, from) = (&state.time_error, Start::from(state));
        let Self { lags: Lags { frames, middles, relative }, scratch, filtered, jerk, snap, .. } = self;
        let [start, middle, end] = configurations(
            system,
            from,
            [&scratch.q_middle, &scratch.q_end],
            [&scratch.frames_start, &scratch.frames_middle, &scratch.frames_end],
            [&solution.prescribed_middle, &solution.prescribed_end],
        );
        let known = (&*scratch.predicted_rates, &scratch.starts);
        let step = time_step(from, [&start, &end], &solution.increment, known, h, dissipation);
        relative.clone_from(&error.relative);
        middles.clear();
        middles.resize(relative.len(), Middle::default());
        system.each_mean_of_step(&middle, &step, |number, Mean { value, rate, tension, force }| {
            let before = &error.relative[number];
            let difference =
                |least: u8, now: f64, before: f64| if error.known < least { 0.0 } else { (now - before) / mean };
            let acceleration = difference(1, rate, before.rate);
            let jerk = difference(2, acceleration, before.acceleration);
            let first = difference(1, force, before.forces[0]);
            let second = difference(2, first, before.forces[1]);
            let bend = if error.known < 3 { second } else { 2.0 * second - before.forces[2] };
            let value = value - MEAN * h * h * in_middle(acceleration, jerk, h);
            middles[number] = Middle { value, rate: rate - MIDPOINT * h * h * jerk, bend, tension };
            relative[number] = Passed { rate, acceleration, forces: [force, first, second] };
        });
        if error.known < 1 {
            return;
        }
        let factor = 0.5 * h * h;
        let source = &mut filtered[..jerk.len()];
        system.add_lags_of_springs(&middle, &step, middles, factor, source);
        system.add_lagging_forces(&middle, Sight::Step(&step), &solution.excitation, factor, source);
        let in_water = system.is_in_fluid();
        if in_water {
            // Not needed before the neighboring motion departs.
            let (velocity, acceleration) = (&mut scratch.increment, &mut scratch.mass_increment);
            let own = velocity.iter_mut().zip(&mut *acceleration);
            for ((velocity, acceleration), (increment, before)) in
                own.zip(solution.increment.iter().zip(&state.velocity))
            {
                *velocity = increment / h;
                *acceleration = 2.0 * (*velocity - before) / h;
            }
            system.add_fluid_at((&scratch.q_middle, velocity, acceleration), &solution.excitation, factor, source);
            for (velocity, (jerk, snap)) in velocity.iter_mut().zip(jerk.iter().zip(&*snap)) {
                *velocity -= MIDPOINT * h * h * in_middle(*jerk, *snap, h);
            }
        }
        for (q, (increment, velocity)) in
            scratch.q_middle.iter_mut().zip(solution.increment.iter().zip(&state.velocity))
        {
            *q -= 2.0 * MEAN * h * (increment / h - velocity);
        }
        if in_water {
            let moving = (&scratch.q_middle[..], &scratch.increment[..], &scratch.mass_increment[..]);
            system.add_fluid_at(moving, &solution.excitation, -factor, source);
        }
        let (q, prescribed) = (&scratch.q_middle, &solution.prescribed_middle);
        let middle = scratch.frames_middle.at_frames(system, frames, q, state, prescribed);
        system.add_lagging_forces(&middle, Sight::Middle(middles), &solution.excitation, -factor, source);
        system.subtract_turned_springs(&middle, middles, factor, source);
    }
}
