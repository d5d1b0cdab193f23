//! How the error that the lengths of steps cause grows over a step (MECHANICS 7.8).
//!
//! The exact motion solves the equations of a step but for a remainder of third order in its length. So does the
//! computed one, without that remainder: their difference `ε` follows from it by the tangent of the step, which has
//! been factorized for the step itself. The residual of a motion that is moved by a small multiple of `ε` has all that
//! this takes: one evaluation of the forces and one back-substitution.

mod source;

use super::scratch::{Scratch, Start};
use super::{Span, Step};
use crate::mechanics::beam::configuration::Dissipation;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::state::State;
use crate::mechanics::state::time_error::{Passed, TimeError};
use crate::mechanics::system::System;
use crate::mechanics::system::fluids::FluidAt;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::gyroscopic;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::middle_forces::Middle;
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::projection::Projection;

/// How far the neighboring motion is moved, as [`System::motion_size`] measures: so little that it is linear (what its
/// square adds is round-off of axial strains), so much that what Newton has left of the step does not matter.
const REACH: f64 = 1e-5;
/// Largest multiple of the error that the neighboring motion is moved by: an error this far below [`REACH`] is
/// round-off.
const LARGEST_MULTIPLE: f64 = 1e3;
/// An error of this many times the system's size is not carried on: it says all that it can.
const LARGEST_ERROR: f64 = 1e3;
/// Share of the trapezoidal rule's error: the integral over a step minus it is `-h³/12` of the second derivative.
const TRAPEZOIDAL: f64 = 1.0 / 12.0;
/// Share of the midpoint rule's error, likewise.
const MIDPOINT: f64 = 1.0 / 24.0;
/// How far the mean of two ends is from the middle, of `h²` times the second derivative.
const MEAN: f64 = 1.0 / 8.0;
/// Velocities are cleared of what no step resolves every so many steps: of it every solution with the tangent, which is
/// that of a neighboring point, leaves some.
const CLEARING: u64 = 4;
/// Least weight of the strain rates in the dissipation with which the error of what the step does not resolve stays
/// bounded: that of a spectral radius of 0.95 is more.
const LEAST_DAMPING: f64 = 0.01;

/// Scratch memory of the estimate; nothing in it outlives a step.
#[derive(Debug)]
pub struct Estimator {
    /// A second right-hand side, then the source and what it adds to the momentum, then the velocities of the error.
    filtered: Vec<f64>,
    /// Third and fourth derivatives of the motion.
    jerk: Vec<f64>,
    snap: Vec<f64>,
    /// Size of the source, as [`System::motion_size`] has it.
    source_size: f64,
    /// The outcome of the last call of [`Self::carry`], and the length of its step, s.
    found: Found,
    step: f64,
    /// What the conditions ask of the error of the velocities.
    targets: Vec<f64>,
    gradients: Vec<JointGradient>,
    /// The frames that joints depend on.
    joint_frames: Vec<usize>,
    /// Forces that differ between the step and the middle of its time.
    lags: Lags,
    /// The start of the neighboring motion.
    start: Moved,
    /// Of the neighboring motion, with memory that the step lends it ([`Self::borrow_from`]).
    scratch: Scratch,
}

/// Forces that differ between the step and the middle of its time ([`System::add_lagging_forces`]).
#[derive(Debug, Default)]
struct Lags {
    /// The frames that they depend on.
    frames: Vec<usize>,
    /// What they read in the middle of the time.
    middles: Vec<Middle>,
    /// What the next step is to know of it, as [`TimeError::relative`].
    relative: Vec<Passed>,
}

/// A neighboring motion, in the charts of a state.
#[derive(Debug, Default)]
struct Moved {
    q: Vec<f64>,
    velocity: Vec<f64>,
    strain_rates: Vec<f64>,
    /// Forces remember the way from the start of the step to here: what sticks, or winds up, holds against the error.
    memory: Vec<f64>,
}

impl Moved {
    /// The start of a step from it.
    fn beside<'a>(&'a self, state: &'a State) -> Start<'a> {
        let Self { q, velocity, strain_rates, memory } = self;
        Start { q, velocity, strain_rates, memory, state }
    }
}

/// How carrying the error over a step ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// The error at the end of the step is known.
    Error,
    /// The error is too large to be carried on, and stays that of the start.
    Unbounded,
    /// The tangent gives no accurate solution: the error stays that of the start, and its source is found anew from
    /// here on.
    Nothing,
}

/// The step that an error is carried over.
#[derive(Clone, Copy, Debug)]
pub struct Taken<'a> {
    /// The state at its start.
    pub state: &'a State,
    pub dissipation: Dissipation,
    pub span: Span,
    /// Positions, frames and forces of its solution.
    pub solution: &'a Scratch,
    /// Rates of strains over it.
    pub strain_rates: &'a [f64],
}

impl Estimator {
    /// For `system`; none where its elements tell no rates of their strains, or where the numerical dissipation is too
    /// small to hold the error of what no step resolves.
    pub fn new(system: &System, spectral_radius: f64) -> Option<Self> {
        let damping = Dissipation::new(spectral_radius).by_last_step;
        (system.mesh.tells_strain_rates() && damping >= LEAST_DAMPING).then(|| Self::of(system))
    }

    fn of(system: &System) -> Self {
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        Self {
            filtered: vec![0.0; coordinates + conditions],
            jerk: vec![0.0; coordinates],
            snap: vec![0.0; coordinates],
            source_size: 0.0,
            found: Found::Nothing,
            step: 0.0,
            targets: vec![0.0; conditions],
            gradients: Vec::new(),
            joint_frames: system.joint_frames(),
            lags: Lags { frames: system.frames_of_lagging_forces(), ..Lags::default() },
            start: Moved::default(),
            scratch: Scratch::borrowing(system),
        }
    }

    /// `S⁻¹ M h³ j/12` (MECHANICS 7.9), 2 sizes as [`System::motion_sizes`] has them: the error that the step `taken`
    /// adds by itself, without the part that it does not resolve. None: it is the first step of a motion. Not-a-number:
    /// the tangent gives no accurate solution. Behind a jump `h j` is the jump of the accelerations. `right` is scratch
    /// memory, as long as coordinates and conditions.
    pub fn own_error(&mut self, system: &System, kkt: &mut Kkt, taken: &Taken, right: &mut [f64]) -> Option<[f64; 2]> {
        if taken.state.prediction.known == 0 {
            return None;
        }
        let (h, error) = (taken.span.step, &taken.state.time_error);
        self.find_jerk(taken, if error.known < 1 { h } else { 0.5 * (h + error.step) });
        let coordinates = self.jerk.len();
        let scale = TRAPEZOIDAL * h * h * h;
        self.filtered.iter_mut().zip(&self.jerk).for_each(|(own, jerk)| *own = scale * jerk);
        let solution = taken.solution;
        let mass = MassAt::new(&solution.prescribed_middle.drives, &solution.frames_middle)
            .wet_in(&solution.q_middle, &solution.excitation);
        system.mass_times(mass, &self.filtered[..coordinates], &mut right[..coordinates]);
        right[coordinates..].fill(0.0);
        match kkt.solve_roughly(right) {
            Ok(()) => Some(system.motion_sizes(&right[..coordinates])),
            Err(Singular) => Some([f64::NAN; 2]),
        }
    }

    /// Lets the neighboring motion use the memory that the step of `solution` no longer needs while `work` is done.
    pub fn borrow_from(&mut self, solution: &mut Scratch, work: impl FnOnce(&mut Self, &Scratch)) {
        solution.exchange(&mut self.scratch);
        work(self, solution);
        solution.exchange(&mut self.scratch);
    }

    /// Carries the error of the start of the step `taken` to its end, for [`Self::arrive`]; called within
    /// [`Self::borrow_from`]. `kkt` has the tangent of the step. `velocity` (as long as the coordinates) and `right`
    /// (coordinates and conditions) are scratch memory; `right` must not change until the arrival.
    pub fn carry(&mut self, system: &System, kkt: &mut Kkt, taken: &Taken, [velocity, right]: [&mut Vec<f64>; 2]) {
        velocity.clone_from(&taken.state.time_error.velocity);
        self.source_size = 0.0;
        self.found = self.advance(system, kkt, taken, velocity, right).unwrap_or(Found::Nothing);
        if self.found != Found::Error {
            self.filtered[..velocity.len()].copy_from_slice(velocity);
        }
    }

    /// Finds the error at the end of the step, in the charts of its start. `velocity` has its velocities at the start.
    ///
    /// # Errors
    /// The tangent gives no accurate solution.
    fn advance(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        taken: &Taken,
        velocity: &mut [f64],
        right: &mut [f64],
    ) -> Result<Found, Singular> {
        let (h, error) = (taken.span.step, &taken.state.time_error);
        if taken.state.statistics.steps.is_multiple_of(CLEARING) {
            self.clear(system, kkt, taken.solution, velocity, right)?;
        }
        let mean = 0.5 * (h + error.step);
        self.find_source(system, taken, error, mean);
        let Some(multiple) = self.multiple(system, [&error.position, velocity], h) else {
            return Ok(Found::Unbounded);
        };
        self.depart(system, taken, velocity, right, (multiple, mean));
        let Self { filtered, jerk, scratch, start, joint_frames, .. } = self;
        let (coordinates, state, start) = (jerk.len(), taken.state, start.beside(taken.state));
        // All that the step adds to its dissipation is in the strain rates of the neighboring motion, which `depart`
        // sets.
        let dissipation = taken.dissipation;
        if error.known > 0 {
            // Joints act where they are at the mean of both ends, (h²/8)·acceleration from where they are at the middle
            // of the time.
            let own = taken.solution.increment.iter().zip(&taken.state.velocity);
            let means = start.q.iter().zip(&scratch.increment).map(|(q, increment)| q + 0.5 * increment);
            let at_middle = &mut right[..coordinates];
            for (value, (mean, (increment, velocity))) in at_middle.iter_mut().zip(means.zip(own)) {
                *value = mean - multiple * 2.0 * MEAN * h * (increment / h - velocity);
            }
            let configuration =
                scratch.frames_middle.at_frames(system, joint_frames, at_middle, state, &scratch.prescribed_middle);
            system.constraint_gradients(&configuration, &mut scratch.gradients_middle);
        }
        scratch.place(system, start);
        scratch.act(system, start, dissipation, h);
        if error.known == 0 {
            scratch.differentiate(system, state);
        }
        Step { system, start, dissipation, step: h, scratch }.balance(right);
        for (right, source) in right.iter_mut().zip(&filtered[..coordinates]) {
            *right += multiple * source;
        }
        kkt.solve_roughly(right)?;
        self.measure(taken, velocity, right, multiple);
        Ok(Found::Error)
    }

    /// By which multiple of the error the neighboring motion is moved; none where the error has no bound any more.
    /// `error` are its positions and its velocities.
    fn multiple(&self, system: &System, error: [&[f64]; 2], h: f64) -> Option<f64> {
        let [position, velocity] = error.map(|list| system.motion_size(list));
        let size = position.max(h * velocity).max(self.source_size);
        (size < LARGEST_ERROR).then(|| (system.smooth_reach(REACH) / size.max(f64::MIN_POSITIVE)).min(LARGEST_MULTIPLE))
    }

    /// Sets the start of the neighboring motion, its increment as predicted, and the momentum over the step that its
    /// momentum at the start and the source have beyond the motion's, without the multiple. `velocity` are the
    /// velocities of the error.
    fn depart(
        &mut self,
        system: &System,
        taken: &Taken,
        velocity: &[f64],
        right: &mut [f64],
        (multiple, mean): (f64, f64),
    ) {
        let Taken { state, dissipation, span: Span { step: h, .. }, solution, strain_rates } = *taken;
        let error = &state.time_error;
        let start = &mut self.start;
        start.q.clone_from(&state.q);
        start.velocity.clone_from(&state.velocity);
        start.strain_rates.clone_from(&state.strain_rates);
        for (list, change) in [(&mut start.q, &*error.position), (&mut start.velocity, velocity)] {
            list.iter_mut().zip(change).for_each(|(value, change)| *value += multiple * change);
        }
        // The mass is that of the start for both: a winch changes it over the step, by a share that is of higher order
        // in the source.
        let moved = right.iter_mut().zip(velocity).zip(&self.filtered);
        moved.for_each(|((moved, velocity), source)| *moved = h * velocity + source);
        let coordinates = velocity.len();
        let Scratch { q_middle, frames_middle, forces: of_water, .. } = &mut self.scratch;
        let mass = MassAt::new(&state.prescribed.drives, frames_middle);
        if system.is_in_fluid() {
            // Its momentum is none of the state: it enters by the source alone.
            of_water.fill(0.0);
            let Excitation { time, seen, .. } = &solution.excitation;
            let at = FluidAt { q: q_middle, time: *time, seen };
            system.add_added_mass_times(at, &self.filtered[..coordinates], of_water);
        }
        system.mass_times(mass, &right[..coordinates], &mut self.filtered[..coordinates]);
        if system.is_in_fluid() {
            self.filtered.iter_mut().zip(&*of_water).for_each(|(sum, own)| *sum += own);
        }
        // Strains at the middle are taken as the means of the ends, and the dissipation is none of the exact motion:
        // both show in the changes of the strain rates.
        if error.known > 0 {
            let Dissipation { by_last_step, by_start } = dissipation;
            let by_change = by_last_step + MEAN * h / mean;
            let scale = multiple / by_last_step;
            let rates = strain_rates.iter().zip(&state.strain_rates).zip(&self.scratch.predicted_rates);
            for (memory, ((now, last), first)) in start.strain_rates.iter_mut().zip(rates) {
                *memory += scale * (by_change * (now - last) + by_start * (now - first));
            }
        }
        if system.has_lagging_forces() {
            self.add_lags(system, taken, mean);
        }
        let Self { start, scratch, .. } = self;
        scratch.excitation.clone_from(&solution.excitation);
        scratch.prescribed_middle.copy_from(&solution.prescribed_middle);
        scratch.prescribed_end.copy_from(&solution.prescribed_end);
        let first = scratch.frames_start.at(system, &start.q, state, &state.prescribed);
        if !state.lists.memory.is_empty() {
            start.memory.clone_from(&state.lists.memory);
            system.remember(&first, None, &mut start.memory);
        }
        system.begin_step(&first, &solution.prescribed_middle.drives, &start.velocity, &mut scratch.starts, None);
        // The dissipation is that of the step, as far as it knows the start: its rates there stay.
        let known = velocity.iter().zip(&error.acceleration).zip(&solution.increment);
        for (increment, ((velocity, acceleration), own)) in scratch.increment.iter_mut().zip(known) {
            *increment = own + multiple * (h * velocity + 0.5 * h * h * acceleration);
        }
        let known = error.multipliers.iter().zip(&solution.impulses);
        for (impulse, (multiplier, own)) in scratch.impulses.iter_mut().zip(known) {
            *impulse = own + multiple * 0.5 * h * multiplier;
        }
    }

    /// Turns `right`, the correction of the neighboring motion, into the change of the error's positions, and its
    /// multipliers; sets its velocities and accelerations at the end of the step, where `velocity` are those at its
    /// start.
    fn measure(&mut self, taken: &Taken, velocity: &[f64], right: &mut [f64], multiple: f64) {
        let h = taken.span.step;
        let Self { filtered, jerk, snap, scratch: Scratch { increment, impulses: moved_impulses, .. }, .. } = self;
        let (corrections, impulses) = right.split_at_mut(jerk.len());
        let moved = increment.iter_mut().zip(corrections).zip(&taken.solution.increment);
        let derivatives = jerk.iter().zip(&*snap);
        let moving = filtered.iter_mut().zip(velocity).zip(derivatives);
        for (((moved, change), own), ((after, before), (jerk, snap))) in moved.zip(moving) {
            *change = (*moved + *change - own) / multiple;
            *after = 2.0 * (*change + TRAPEZOIDAL * h * h * h * in_middle(*jerk, *snap, h)) / h - before;
            // The increment of the neighboring motion is no longer needed.
            *moved = (*after - before) / h;
        }
        let known = moved_impulses.iter().zip(&taken.solution.impulses);
        for (multiplier, (moved, own)) in impulses.iter_mut().zip(known) {
            *multiplier = 2.0 / h * (moved + *multiplier - own) / multiple;
        }
        self.step = h;
    }

    /// Sets `error`, that of the start of the step that [`Self::carry`] was called with, to that of its end, `right`
    /// being as that call has left it.
    pub fn arrive(&mut self, system: &System, solution: &Scratch, error: &mut TimeError, right: &[f64]) {
        let (changes, multipliers) = right.split_at(self.jerk.len());
        if self.scratch.is_viscous {
            error.rates.resize(changes.len(), 0.0);
        }
        error.velocity.copy_from_slice(&self.filtered[..changes.len()]);
        match self.found {
            Found::Error => {
                error.position.iter_mut().zip(changes).for_each(|(position, change)| *position += change);
                error.acceleration.clone_from(&self.scratch.increment);
                for (rate, change) in error.rates.iter_mut().zip(changes) {
                    let mean = change / self.step;
                    // The error of a strain that viscosity stops within far less than a step alternates: the mean of
                    // two does not.
                    *rate = if error.known == 0 { mean } else { 0.5 * (*rate + mean) };
                }
                error.multipliers.copy_from_slice(multipliers);
                std::mem::swap(&mut error.jerk, &mut self.jerk);
                std::mem::swap(&mut error.snap, &mut self.snap);
                if system.has_lagging_forces() {
                    std::mem::swap(&mut error.relative, &mut self.lags.relative);
                }
                error.known = (error.known + 1).min(3);
                error.step = self.step;
            }
            Found::Unbounded => {}
            Found::Nothing => error.known = 0,
        }
        change_charts(system, solution, error);
    }

    /// Projects the velocities of the error at the end of a step, `next`, as `projection` has just projected those of
    /// the motion, on those that the constraints allow the neighboring motion: `G ε_v = −(∂G/∂q ε) v`. The matrix of
    /// `kkt` is that of the projection where it was solved with; `frames` and `right` are scratch memory.
    pub fn project(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        projection: &mut Projection,
        (frames, right): (&mut FrameCache, &mut [f64]),
        next: &mut State,
    ) {
        let TimeError { position, velocity, step, .. } = &next.time_error;
        let multiple = self.multiple(system, [position, velocity], *step);
        let Some(multiple) = multiple.filter(|_| system.constraints() > 0) else { return };
        let Self { targets, filtered, gradients, joint_frames, .. } = self;
        let moved = &mut filtered[..next.q.len()];
        let places = moved.iter_mut().zip(next.q.iter().zip(&next.time_error.position));
        places.for_each(|(moved, (own, change))| *moved = own + multiple * change);
        let neighbor = frames.at_frames(system, joint_frames, moved, next, &next.prescribed);
        system.constraint_gradients(&neighbor, gradients);
        targets.fill(0.0);
        system.add_constraint_rates(gradients, &next.velocity, targets);
        targets.iter_mut().for_each(|target| *target = -*target);
        system.add_constraint_rates(projection.constraint_momenta(system).0, &next.velocity, targets);
        targets.iter_mut().for_each(|target| *target /= multiple);
        let error = &mut next.time_error;
        if projection.correct_velocity(system, kkt, targets, &mut error.velocity, right).is_err() {
            error.known = 0;
        }
    }

    /// Takes out of `velocity`, the error of the velocities at the start of a step, what the step does not resolve;
    /// what `G` makes of it stays. `F = S⁻¹ M` is 1 where the motion is slow for the step, 0 where it is far too fast,
    /// and `2 F - F²` leaves of the slow one all but the fourth order.
    fn clear(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        solution: &Scratch,
        velocity: &mut [f64],
        right: &mut [f64],
    ) -> Result<(), Singular> {
        let Self { filtered, targets, scratch, .. } = self;
        let coordinates = velocity.len();
        targets.fill(0.0);
        system.add_constraint_rates(&solution.gradients_end, velocity, targets);
        let mass = MassAt::new(&solution.prescribed_middle.drives, &scratch.frames_middle)
            .wet_in(&scratch.q_middle, &solution.excitation);
        system.mass_times(mass, velocity, &mut right[..coordinates]);
        right[coordinates..].copy_from_slice(targets);
        kkt.solve_roughly(right)?;
        system.mass_times(mass, &right[..coordinates], &mut filtered[..coordinates]);
        filtered[coordinates..].copy_from_slice(targets);
        kkt.solve_roughly(filtered)?;
        for (velocity, (once, twice)) in velocity.iter_mut().zip(right.iter().zip(&*filtered)) {
            *velocity = 2.0 * once - twice;
        }
        Ok(())
    }
}

/// The third derivative in the middle of a step of `h` s, 1/s³: `jerk` lies half a step behind.
fn in_middle(jerk: f64, snap: f64, h: f64) -> f64 {
    jerk + 0.5 * h * snap
}

/// Takes `error` from the charts of the start of a step to those of its end, where a turn of a tangent alone turns no
/// section.
fn change_charts(system: &System, solution: &Scratch, error: &mut TimeError) {
    let TimeError { position, velocity, rates, acceleration, .. } = error;
    for list in [position, velocity, rates, acceleration].into_iter().filter(|list| !list.is_empty()) {
        gyroscopic::change_charts_of_change(system, &solution.frames_end, list);
    }
}
