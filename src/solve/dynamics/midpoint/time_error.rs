//! How the error that the lengths of steps cause grows over a step (MECHANICS 7.8).
//!
//! The exact motion solves the equations of a step but for a remainder of third order in its length. So does the computed one, without that remainder:
//! their difference `ε` follows from it by the tangent of the step, which has been factorized for the step itself. The residual of a motion that is moved by
//! a small multiple of `ε` has all that this takes: one evaluation of the forces and one back-substitution.

use super::scratch::Scratch;
use super::{Span, Step};
use crate::mechanics::beam::configuration::Dissipation;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::state::State;
use crate::mechanics::state::time_error::TimeError;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::gyroscopic;
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::projection::Projection;

/// How far the neighboring motion is moved, as [`System::motion_size`] measures: so little that it is linear (what its square adds is round-off of axial strains), so
/// much that what Newton has left of the step does not matter.
const REACH: f64 = 1e-5;
/// Largest multiple of the error that the neighboring motion is moved by: an error this far below [`REACH`] is round-off.
const LARGEST_MULTIPLE: f64 = 1e3;
/// An error of this many times the system's size is not carried on: it says all that it can.
const LARGEST_ERROR: f64 = 1e3;
/// Share of the trapezoidal rule's error: the integral over a step minus it is `-h³/12` of the second derivative.
const TRAPEZOIDAL: f64 = 1.0 / 12.0;
/// Share of the midpoint rule's error, likewise.
const MIDPOINT: f64 = 1.0 / 24.0;
/// How far the mean of two ends is from the middle, of `h²` times the second derivative.
const MEAN: f64 = 1.0 / 8.0;
/// Velocities are cleared of what no step resolves every so many steps: of it every solution with the tangent, which is that of a neighboring point, leaves some.
const CLEARING: u64 = 4;
/// Least weight of the strain rates in the dissipation with which the error of what the step does not resolve stays bounded: that of a spectral radius of 0.95 is more.
const LEAST_DAMPING: f64 = 0.01;

/// Scratch memory of the estimate; nothing in it outlives a step.
#[derive(Debug)]
pub struct Estimator {
    right: Vec<f64>,
    /// A second right-hand side, then the source.
    filtered: Vec<f64>,
    /// Third and fourth derivatives of the motion.
    jerk: Vec<f64>,
    snap: Vec<f64>,
    /// Size of the source, as [`System::motion_size`] has it.
    source_size: f64,
    mass: Vec<f64>,
    /// What the conditions ask of the error of the velocities.
    targets: Vec<f64>,
    gradients: Vec<JointGradient>,
    /// The frames that joints depend on.
    joint_frames: Vec<usize>,
    /// The start of the neighboring motion.
    start: Option<State>,
    /// Of the neighboring motion, with memory that the step lends it ([`Scratch::lend`]).
    scratch: Scratch,
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
    /// For `system`; none where its elements tell no rates of their strains, or where the numerical dissipation is too small to hold the error of what no step resolves.
    pub fn new(system: &System, spectral_radius: f64) -> Option<Self> {
        let damping = Dissipation::new(spectral_radius).by_last_step;
        (system.mesh.tells_strain_rates() && damping >= LEAST_DAMPING).then(|| Self::of(system))
    }

    fn of(system: &System) -> Self {
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        Self {
            right: vec![0.0; coordinates + conditions],
            filtered: vec![0.0; coordinates + conditions],
            jerk: vec![0.0; coordinates],
            snap: vec![0.0; coordinates],
            source_size: 0.0,
            mass: vec![0.0; coordinates],
            targets: vec![0.0; conditions],
            gradients: Vec::new(),
            joint_frames: system.joint_frames(),
            start: None,
            scratch: Scratch::borrowing(system),
        }
    }

    /// `S⁻¹ M h³ j/12` (MECHANICS 7.9), 2 sizes as [`System::motion_sizes`] has them: the error that the step `taken` adds by itself, without the part that it does not resolve. None: it is the
    /// first step of a motion. Not-a-number: the tangent gives no accurate solution. Behind a jump `h j` is the jump of the accelerations.
    pub fn own_error(&mut self, system: &System, kkt: &mut Kkt, taken: &Taken, error: &TimeError) -> Option<[f64; 2]> {
        if taken.state.prediction.known == 0 {
            return None;
        }
        let h = taken.span.step;
        self.find_jerk(taken, if error.known < 1 { h } else { 0.5 * (h + error.step) });
        let coordinates = self.jerk.len();
        let scale = TRAPEZOIDAL * h * h * h;
        self.filtered.iter_mut().zip(&self.jerk).for_each(|(own, jerk)| *own = scale * jerk);
        let drives = &taken.solution.prescribed_middle.drives;
        system.mass_times(drives, &self.filtered[..coordinates], &mut self.right[..coordinates]);
        self.right[coordinates..].fill(0.0);
        match kkt.solve_roughly(&mut self.right) {
            Ok(()) => Some(system.motion_sizes(&self.right[..coordinates])),
            Err(Singular) => Some([f64::NAN; 2]),
        }
    }

    /// Scratch memory of the neighboring motion. While [`Self::carry`] runs it needs what the step can lend.
    pub fn scratch(&mut self) -> &mut Scratch {
        &mut self.scratch
    }

    /// Carries `error`, that of the start of the step `taken`, to its end, but for the projection of its velocities; `kkt` has the tangent of the step.
    pub fn carry(&mut self, system: &System, kkt: &mut Kkt, taken: &Taken, error: &mut TimeError) {
        error.resize(system.coordinates(), system.constraints());
        if self.scratch.is_viscous {
            error.rates.resize(system.coordinates(), 0.0);
        }
        self.source_size = 0.0;
        // Without an accurate solution the error stays that of the start, and its source is found anew from here on.
        if self.advance(system, kkt, taken, error).is_err() {
            error.known = 0;
        }
        change_charts(system, taken.solution, error);
    }

    /// Sets `error` to that at the end of the step, in the charts of its start.
    ///
    /// # Errors
    /// The tangent gives no accurate solution.
    fn advance(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        taken: &Taken,
        error: &mut TimeError,
    ) -> Result<(), Singular> {
        let h = taken.span.step;
        if taken.state.statistics.steps.is_multiple_of(CLEARING) {
            self.clear(system, kkt, taken.solution, &mut error.velocity)?;
        }
        let mean = 0.5 * (h + error.step);
        self.find_source(system, taken, error, mean);
        let Some(multiple) = self.multiple(system, error, h) else { return Ok(()) };
        self.depart(system, taken, error, multiple, mean);
        let Self { right, filtered, scratch, start: Some(start), mass, joint_frames, .. } = self else {
            return Ok(());
        };
        // All that the step adds to its dissipation is in the strain rates of the neighboring motion, which `depart` sets.
        let dissipation = taken.dissipation;
        if error.known > 0 {
            // Joints act where they are at the mean of both ends, (h²/8)·acceleration from where they are at the middle of the time.
            let own = taken.solution.increment.iter().zip(&taken.state.velocity);
            let means = start.q.iter().zip(&scratch.increment).map(|(q, increment)| q + 0.5 * increment);
            let at_middle = &mut filtered[..mass.len()];
            for (value, (mean, (increment, velocity))) in at_middle.iter_mut().zip(means.zip(own)) {
                *value = mean - multiple * 2.0 * MEAN * h * (increment / h - velocity);
            }
            let configuration =
                scratch.frames_middle.of_joints(system, joint_frames, at_middle, start, &scratch.prescribed_middle);
            system.constraint_gradients(&configuration, &mut scratch.gradients_middle);
        }
        scratch.place(system, start);
        scratch.act(system, start, dissipation, h);
        if error.known == 0 {
            scratch.differentiate(system, start);
        }
        Step { system, state: start, dissipation, step: h, scratch }.balance(right);
        for (right, source) in right.iter_mut().zip(&*mass) {
            *right += multiple * source;
        }
        kkt.solve_roughly(right)?;
        self.arrive(taken, error, multiple);
        Ok(())
    }

    /// Sets the derivatives of the motion, and the source: what the exact motion leaves of the equation of the step, but for the part in strains, over the mass.
    fn find_source(&mut self, system: &System, taken: &Taken, error: &TimeError, mean: f64) {
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
            // Differences lie half a step and a whole one behind the middle of this step. What turns would be accelerated by derivatives that lag.
            let ahead = if error.known < 3 { *snap } else { 2.0 * *snap - snap_before };
            *source = cube * (0.5 * h * MIDPOINT * ahead - TRAPEZOIDAL * in_middle(*jerk, *snap, h));
        }
        self.source_size = system.motion_size(&self.filtered[..self.jerk.len()]);
    }

    /// Sets the third derivatives of the motion, 1/s³ each: the change of the mean acceleration since the last step over `mean` s, the time between the middles of both.
    fn find_jerk(&mut self, taken: &Taken, mean: f64) {
        let (h, state) = (taken.span.step, taken.state);
        let motion = taken.solution.increment.iter().zip(&state.velocity).zip(&state.prediction.acceleration);
        for (jerk, ((increment, velocity), before)) in self.jerk.iter_mut().zip(motion) {
            *jerk = (2.0 * (increment / h - velocity) / h - before) / mean;
        }
    }

    /// By which multiple of the error the neighboring motion is moved; none where the error has no bound any more.
    fn multiple(&self, system: &System, error: &TimeError, h: f64) -> Option<f64> {
        let [position, velocity] = [&error.position, &error.velocity].map(|list| system.motion_size(list));
        let size = position.max(h * velocity).max(self.source_size);
        (size < LARGEST_ERROR).then(|| (REACH / size.max(f64::MIN_POSITIVE)).min(LARGEST_MULTIPLE))
    }

    /// Sets the start of the neighboring motion, its increment as predicted, and the momentum over the step that its momentum at the start and the source have beyond the motion's,
    /// without the multiple.
    fn depart(&mut self, system: &System, taken: &Taken, error: &TimeError, multiple: f64, mean: f64) {
        let Taken { state, dissipation, span: Span { step: h, .. }, solution, strain_rates } = *taken;
        let start = self.start.get_or_insert_default();
        start.copy_motion_from(state);
        for (list, change) in [(&mut start.q, &error.position), (&mut start.velocity, &error.velocity)] {
            list.iter_mut().zip(change).for_each(|(value, change)| *value += multiple * change);
        }
        // The mass is that of the start for both: a winch changes it over the step, by a share that is of higher order in the source.
        let moved = self.right.iter_mut().zip(&error.velocity).zip(&self.filtered);
        moved.for_each(|((moved, velocity), source)| *moved = h * velocity + source);
        system.mass_times(&state.prescribed.drives, &self.right[..self.mass.len()], &mut self.mass);
        // Strains at the middle are taken as the means of the ends, and the dissipation is none of the exact motion: both show in the changes of the strain rates.
        if error.known > 0 {
            let Dissipation { by_last_step, by_start } = dissipation;
            let by_change = by_last_step + MEAN * h / mean;
            let scale = multiple / by_last_step;
            let rates = strain_rates.iter().zip(&state.strain_rates).zip(&self.scratch.start_rates);
            for (memory, ((now, last), first)) in start.strain_rates.iter_mut().zip(rates) {
                *memory += scale * (by_change * (now - last) + by_start * (now - first));
            }
        }
        let scratch = &mut self.scratch;
        scratch.excitation.clone_from(&solution.excitation);
        scratch.prescribed_middle.copy_from(&solution.prescribed_middle);
        scratch.prescribed_end.copy_from(&solution.prescribed_end);
        let first = scratch.frames_start.of(system, start);
        system.begin_step(&first, &solution.prescribed_middle.drives, &start.velocity, &mut scratch.starts, None);
        // The dissipation is that of the step, as far as it knows the start: its rates there stay.
        let known = error.velocity.iter().zip(&error.acceleration).zip(&solution.increment);
        for (increment, ((velocity, acceleration), own)) in scratch.increment.iter_mut().zip(known) {
            *increment = own + multiple * (h * velocity + 0.5 * h * h * acceleration);
        }
        let known = error.multipliers.iter().zip(&solution.impulses);
        for (impulse, (multiplier, own)) in scratch.impulses.iter_mut().zip(known) {
            *impulse = own + multiple * 0.5 * h * multiplier;
        }
    }

    /// Sets the error at the end of the step, in the charts of its start, by the correction of the neighboring motion.
    fn arrive(&self, taken: &Taken, error: &mut TimeError, multiple: f64) {
        let h = taken.span.step;
        let (correction, impulses) = self.right.split_at(self.jerk.len());
        let changes = self.scratch.increment.iter().zip(correction).zip(&taken.solution.increment);
        let changes = changes.map(|((moved, correction), own)| (moved + correction - own) / multiple);
        let derivatives = self.jerk.iter().zip(&self.snap);
        let moving = error.velocity.iter_mut().zip(&mut error.acceleration).zip(derivatives);
        for ((change, position), ((velocity, acceleration), (jerk, snap))) in
            changes.clone().zip(&mut error.position).zip(moving)
        {
            let before = *velocity;
            let after = 2.0 * (change + TRAPEZOIDAL * h * h * h * in_middle(*jerk, *snap, h)) / h - before;
            *position += change;
            *velocity = after;
            *acceleration = (after - before) / h;
        }
        for (rate, change) in error.rates.iter_mut().zip(changes) {
            // The error of a strain that viscosity stops within far less than a step alternates: the mean of two does not.
            *rate = if error.known == 0 { change / h } else { 0.5 * (*rate + change / h) };
        }
        for (index, correction) in impulses.iter().enumerate() {
            let own = taken.solution.impulses[index];
            error.multipliers[index] = 2.0 / h * (self.scratch.impulses[index] + correction - own) / multiple;
        }
        error.jerk.clone_from(&self.jerk);
        error.snap.clone_from(&self.snap);
        error.known = (error.known + 1).min(3);
        error.step = h;
    }

    /// Projects the velocities of the error at the end of a step, `next`, as `projection` has just projected those of the motion, on those that the constraints allow the
    /// neighboring motion: `G ε_v = −(∂G/∂q ε) v`. The matrix of `kkt` is that of the projection where it was solved with; `frames` is scratch memory.
    pub fn project(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        projection: &mut Projection,
        frames: &mut FrameCache,
        next: &mut State,
    ) {
        let h = next.time_error.step;
        let Some(multiple) = self.multiple(system, &next.time_error, h).filter(|_| system.constraints() > 0) else {
            return;
        };
        let Self { right, targets, mass: moved, gradients, joint_frames, .. } = self;
        let places = moved.iter_mut().zip(next.q.iter().zip(&next.time_error.position));
        places.for_each(|(moved, (own, change))| *moved = own + multiple * change);
        let neighbor = frames.of_joints(system, joint_frames, moved, next, &next.prescribed);
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

    /// Takes out of `velocity`, the error of the velocities at the start of a step, what the step does not resolve; what `G` makes of it stays. `F = S⁻¹ M` is 1 where the
    /// motion is slow for the step, 0 where it is far too fast, and `2 F - F²` leaves of the slow one all but the fourth order.
    fn clear(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        solution: &Scratch,
        velocity: &mut [f64],
    ) -> Result<(), Singular> {
        let Self { right, filtered, targets, .. } = self;
        let coordinates = velocity.len();
        targets.fill(0.0);
        system.add_constraint_rates(&solution.gradients_end, velocity, targets);
        let drives = &solution.prescribed_middle.drives;
        system.mass_times(drives, velocity, &mut right[..coordinates]);
        right[coordinates..].copy_from_slice(targets);
        kkt.solve_roughly(right)?;
        system.mass_times(drives, &right[..coordinates], &mut filtered[..coordinates]);
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

/// Takes `error` from the charts of the start of a step to those of its end, where a turn of a tangent alone turns no section.
fn change_charts(system: &System, solution: &Scratch, error: &mut TimeError) {
    let TimeError { position, velocity, rates, acceleration, .. } = error;
    for list in [position, velocity, rates, acceleration].into_iter().filter(|list| !list.is_empty()) {
        gyroscopic::change_charts_of_change(system, &solution.frames_end, list);
    }
}
