//! The constrained midpoint integrator in position-momentum form (MECHANICS 7.1), with elastic forces that work as much
//! as the energy changes (7.6).
//!
//! A step from `q_k, P_k` solves `P_k − M Dq/h − h/2 f(qm) + C = 0` and `g(q_{k+1}) = 0`, `f = dU/dq − F + Gᵀ λ`,
//! `qm = q_k + Dq/2`, for `Dq` and `Λ = h λ/2`. Momentum and references then move on to the new charts (gyroscopic.rs),
//! and what would alternate is taken out of the momentum.
//!
//! Constraint forces act in the middle of the step like all others. MECHANICS 7.1 has `h G(q_k)ᵀ λ` instead, which
//! treats the stiffness that multipliers give a joint as an explicit method would: it is stable only for
//! `h² λ·g_qq/M < 4`. A hinge that transmits 10 N m to a node of 1e-7 kg m² (a four-bar linkage with a tilted hinge)
//! breaks that: seen at 1, 2 and 4 ms, not at 0.2 ms.

mod bounded;
mod scratch;
mod solution;
mod time_error;

use self::bounded::Bound;
use self::scratch::{Scratch, Start, configurations, time_step};
use self::time_error::{Estimator, Taken};
use super::start::Dynamics;
use crate::error::Error;
use crate::mechanics::beam::configuration::Dissipation;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::energy_balance::{Energies, Losses};
use crate::mechanics::state::lists::Lists;
use crate::mechanics::state::pace::Pace;
use crate::mechanics::state::time_error::TimeError;
use crate::mechanics::state::{Prediction, State, rate_leads, viscous_rates};
use crate::mechanics::system::System;
use crate::mechanics::system::gyroscopic;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::Singular;
use crate::solve::newton::Problem;
use crate::solve::newton::kkt::Kkt;
use crate::solve::newton::prediction;
use crate::solve::step::integrator::Integrator;
use crate::solve::step::limits;
use crate::solve::step::linearized::{Linearized, Span};
use crate::solve::step::pacing::Pacing;
use crate::solve::step::projection::Projection;
use crate::solve::step::spare::Spare;
use crate::solve::step::switching;
use crate::solve::step::tally::Tally;

/// Smallest spectral radius: below it the other two factors by which a strain far too fast for the step may change,
/// 0.58 and more, are larger.
pub const SMALLEST_RADIUS: f64 = 0.6;

/// Integrator and its scratch memory; nothing in it outlives a step.
#[derive(Debug)]
pub struct Midpoint {
    /// Of the largest step, and the length of that, s.
    dissipation: Dissipation,
    largest_step: f64,
    /// None: the steps are given.
    pacing: Option<Pacing>,
    /// Steps of its own choice, by their limits.
    tally: Tally,
    tolerance: f64,
    /// Most iterations of a step; none: as many as it needs.
    bound: Option<Bound>,
    kkt: Kkt,
    right: Vec<f64>,
    projection: Projection,
    scratch: Scratch,
    /// None: the system has elements whose steps it does not know.
    estimator: Option<Estimator>,
    /// The motion at the end of the step in the making; empty before the first step. The prediction and the error of
    /// the steps are in the state alone: a rejected step does not change them.
    next: State,
}

impl Midpoint {
    /// For `system`; the amplitude of a strain far too fast for the step is multiplied by `spectral_radius` (0.6 to 1)
    /// a step, by 1 none is ever lost. `largest_step` is the length of the steps but for those that end earlier, s;
    /// Newton may leave `tolerance` of a step.
    pub fn new(system: &System, spectral_radius: f64, largest_step: f64, tolerance: f64) -> Self {
        assert!((SMALLEST_RADIUS..=1.0).contains(&spectral_radius), "a spectral radius of {spectral_radius}");
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        let mut kkt = Kkt::for_steps(system);
        Self {
            dissipation: Dissipation::new(spectral_radius),
            largest_step,
            pacing: None,
            tally: Tally::default(),
            tolerance,
            bound: None,
            right: vec![0.0; coordinates + conditions],
            projection: Projection::new(system, &mut kkt),
            kkt,
            scratch: Scratch::new(system),
            estimator: Estimator::new(system, spectral_radius),
            next: State::default(),
        }
    }

    /// The same with steps of its own choice.
    ///
    /// # Errors
    /// It does not know the error of a step of this system.
    pub fn paced(self, pacing: Pacing) -> Result<Self, Error> {
        if !self.knows_error() {
            return Err(Error::StepNotGiven);
        }
        Ok(Self { pacing: Some(pacing), ..self })
    }

    /// The counts of its steps by their limits; none: the steps are given.
    pub fn limits(&self) -> Option<&Tally> {
        self.pacing.map(|_| &self.tally)
    }

    /// Whether it knows the error of its steps.
    pub fn knows_error(&self) -> bool {
        self.estimator.is_some()
    }

    /// Memory that it does not need between two steps.
    pub fn spare(&mut self) -> Spare<'_> {
        Spare { state: &mut self.next, frames: &mut self.scratch.frames_middle }
    }
}

impl Dynamics for Midpoint {
    fn kkt(&mut self) -> &mut Kkt {
        &mut self.kkt
    }

    /// The first step knows no step before it: the dissipation counts all of its change as unpredicted.
    fn begin(&mut self, _system: &System, state: &mut State) -> Result<(), Error> {
        (self.tally, self.bound) = (Tally::default(), self.bound.map(Bound::begin));
        state.strain_rates.fill(0.0);
        rate_leads::clear(&mut state.lists);
        state.velocity_lead.clear();
        viscous_rates::clear(state);
        state.prediction = Prediction::default();
        state.time_error = TimeError::default();
        state.pace = Pace::default();
        Ok(())
    }
}

impl Integrator for Midpoint {
    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        self.scratch.prepare(system, state, step, end);
        self.scratch.predict(state, step);
        let turned = limits::check_frames(system, state, &self.scratch.prescribed_end, step, end)?;
        let dissipation = self.dissipation(state, step);
        // All that is left may fail: the state changes at the very end.
        let mut next = std::mem::take(&mut self.next);
        next.copy_motion_from(state);
        next.pace.turned = turned;
        let span = Span { step, end };
        let solved = self.solve(system, state, dissipation, span, &mut next);
        let solved = solved.and_then(|solved| self.judge(system, state, dissipation, span, &mut next).map(|()| solved));
        state.statistics.iterations = next.statistics.iterations;
        let (convergence, found) = match solved {
            Ok(solved) => solved,
            Err(reason) => {
                self.next = next;
                return Err(reason);
            }
        };
        let energy_before = self.scratch.energies(system, state);
        let work = found.work + self.scratch.finish(system, state, &mut next, span);
        let account = state.balance.account.map(|account| {
            let begin = account.energy.unwrap_or_else(|| self.scratch.whole_energy(system, state));
            (self.scratch.work(system, state, dissipation, span, &next), begin)
        });
        self.scratch.continue_rates(state, span.step, &mut next);
        let knew_error = state.time_error.is_known();
        self.carry_error(system, state, dissipation, span, &mut next);
        // Those of the middle are no longer needed.
        self.projection.expect(&self.scratch.increment, step, &state.velocity, &mut next.lists.velocity);
        let is_wet = system.is_in_fluid() && system.is_struck(end, step);
        self.projection.wet(is_wet);
        if is_wet {
            self.scratch.expect(&state.velocity, step, &mut next.lists.velocity);
        }
        let frames = &mut self.scratch.frames_middle;
        let outcome = self.projection.set_velocity(system, &mut self.kkt, frames, &mut next);
        if outcome.is_ok() {
            let kinetic = match is_wet {
                true => self.scratch.strike(system, &mut next),
                false => self.steady(system, &mut next),
            };
            if !is_wet {
                self.scratch.lead(system, state, step, &mut next);
            }
            let transport = self.scratch.transport_energies(system, state, &next);
            next.time_error = std::mem::take(&mut state.time_error);
            next.prediction = std::mem::take(&mut state.prediction);
            self.set_error(system, &mut next);
            let Scratch { increment, forces: room, .. } = &mut self.scratch;
            let (velocities, prediction) = ([&*state.velocity, &*next.lists.velocity], &mut next.prediction);
            prediction::learn(system, velocities, increment, step, &convergence, (prediction, room));
            next.balance.last = Some(energy_before);
            if system.is_sudden(end, step) {
                next.balance.skip_jump();
                if system.is_struck(end, step) {
                    next.balance.strike();
                }
                next.time_error.known = 0;
                viscous_rates::jump(&mut next);
                if let Some(pacing) = self.pacing {
                    pacing.jump(&mut next);
                }
            }
            let losses = if self.dissipation == Dissipation::default() { Losses::None } else { Losses::Numerical };
            let energies = Energies { kinetic: kinetic + transport[1], elastic: found.elastic };
            let winding = transport[1] - transport[0];
            next.balance.account(end, work + winding, energies, system.energy_noise(), losses);
            if let Some((mut work, begin)) = account {
                work.drives += winding;
                next.balance.add_work(&work, [begin, self.scratch.whole_energy_of_end(system, state, &next)]);
            }
            std::mem::swap(state, &mut next);
        } else if !knew_error {
            state.time_error = TimeError::default();
        }
        self.next = next;
        outcome
    }

    fn switch(&mut self, system: &System, state: &mut State, time: f64) -> Result<bool, Error> {
        let switched = switching::switch(system, &mut self.kkt, state, time)?;
        if let Some(pacing) = self.pacing.filter(|_| switched) {
            pacing.jump(state);
        }
        Ok(switched)
    }

    fn tally(&mut self) -> Option<&mut Tally> {
        Some(&mut self.tally)
    }
}

impl Midpoint {
    /// The numerical dissipation of a step of `step` s from `state`.
    fn dissipation(&self, state: &State, step: f64) -> Dissipation {
        let largest = if self.pacing.is_some() { state.pace.damping_step.max(step) } else { self.largest_step };
        self.dissipation.over(step, largest)
    }

    /// Refuses the converged step where its error is too large.
    ///
    /// # Errors
    /// It is.
    fn judge(
        &mut self,
        system: &System,
        state: &State,
        dissipation: Dissipation,
        span: Span,
        next: &mut State,
    ) -> Result<(), Error> {
        let (Some(pacing), Some(estimator)) = (self.pacing, &mut self.estimator) else { return Ok(()) };
        let State { lists, pace, .. } = next;
        let taken = Taken { state, dissipation, span, solution: &self.scratch, strain_rates: &lists.strain_rates };
        let error = estimator.own_error(system, &mut self.kkt, &taken, &mut self.right);
        pacing.judge(pace, error, span.step, state.time)?;
        if error.is_some() && self.tally.is_due() {
            let coordinates = system.coordinates();
            self.tally.look(system.largest_change(&self.right[..coordinates], pace.range), coordinates);
        }
        pacing.include(system, &self.scratch.increment, pace);
        Ok(())
    }

    /// Carries the error of the start of the converged step, whose lists are made if there are none yet, to its end,
    /// with the tangent of its last iteration; the velocities of `next` are scratch memory. [`Self::set_error`] has the
    /// result.
    fn carry_error(
        &mut self,
        system: &System,
        state: &mut State,
        dissipation: Dissipation,
        span: Span,
        next: &mut State,
    ) {
        let Self { estimator: Some(estimator), kkt, scratch, right, .. } = self else { return };
        state.time_error.resize(system.coordinates(), system.constraints(), system.relative_coordinates.len());
        let Lists { strain_rates, velocity, .. } = &mut next.lists;
        estimator.borrow_from(scratch, |estimator, solution| {
            let taken = Taken { state, dissipation, span, solution, strain_rates };
            estimator.carry(system, kkt, &taken, [velocity, right]);
        });
        // The neighboring motion has overwritten them. A second set of frames would take more memory than this takes
        // time.
        scratch.frames_end.set(system, &next.q, &state.triads);
    }

    /// Sets the error at the end of a step, `next`, from that of its start as [`Self::carry_error`] has carried it, and
    /// projects its velocities as those of the motion have been.
    fn set_error(&mut self, system: &System, next: &mut State) {
        let Self { estimator: Some(estimator), projection, kkt, scratch, right, .. } = self else { return };
        estimator.arrive(system, scratch, &mut next.time_error, right);
        estimator.project(system, kkt, projection, (&mut scratch.frames_middle, right), next);
    }

    /// Takes out of the momentum at the end of a step what would alternate for ever. The midpoint rule turns the part
    /// that the constraints do not allow, `ν`, into `c − ν`, with a smooth `c` of second order in the step: its rest is
    /// `c/2`, the mean of one `ν` and the next. Taking that mean, a jump of a drive is gone after a step, and smooth
    /// motions keep their energy (taking all of `ν` away would cost some of it at every step). Linear and angular
    /// momentum do not change. Returns the kinetic energy, J.
    fn steady(&self, system: &System, state: &mut State) -> f64 {
        let (gradients, constraint_momenta) = self.projection.constraint_momenta(system);
        let Lists { momentum, velocity, constraint_momenta: own_momenta, .. } = &mut state.lists;
        for (own, own_now) in own_momenta.iter_mut().zip(constraint_momenta) {
            *own = 0.5 * (*own + own_now);
        }
        // `M v` as what is left of the momentum: round-off of `M⁻¹` would add up over the steps.
        system.add_constraint_forces(gradients, constraint_momenta, -1.0, momentum);
        let kinetic = 0.5 * velocity.iter().zip(&*momentum).map(|(v, p)| v * p).sum::<f64>();
        system.add_constraint_forces(gradients, own_momenta, 1.0, momentum);
        kinetic
    }
}

/// One step as Newton sees it.
struct Step<'a> {
    system: &'a System,
    start: Start<'a>,
    dissipation: Dissipation,
    step: f64,
    scratch: &'a mut Scratch,
}

impl<'a> Step<'a> {
    /// The step over `span` at given unknowns.
    fn at(
        scratch: &'a mut Scratch,
        system: &'a System,
        state: &'a State,
        dissipation: Dissipation,
        span: Span,
        unknowns: &[f64],
    ) -> Self {
        scratch.prepare(system, state, span.step, span.end);
        let (increment, impulses) = unknowns.split_at(scratch.increment.len());
        scratch.increment.copy_from_slice(increment);
        scratch.impulses.copy_from_slice(impulses);
        Step { system, start: state.into(), dissipation, step: span.step, scratch }
    }

    /// Minus the residual at the current unknowns, whose forces, positions and gradients are known, into `right`;
    /// conditions at the end.
    fn balance(&mut self, right: &mut [f64]) {
        let (system, state, h) = (self.system, self.start.state, self.step);
        let scratch = &mut *self.scratch;
        let end = system.configuration(&scratch.q_end, &scratch.frames_end, state, &scratch.prescribed_end);
        system.constraint_conditions(&end, &mut scratch.conditions);
        system.add_constraint_forces(&scratch.gradients_middle, &scratch.impulses, 2.0 / h, &mut scratch.forces);

        let (residual, conditions) = right.split_at_mut(state.q.len());
        let known = state.momentum.iter().zip(&scratch.mass_increment).zip(&scratch.forces);
        for (residual, ((momentum, mass_increment), force)) in residual.iter_mut().zip(known) {
            *residual = h * momentum - mass_increment - 0.5 * h * h * force;
        }
        let frames = [&scratch.frames_start, &scratch.frames_middle, &scratch.frames_end];
        gyroscopic::add_forces(system, frames, &scratch.mass_increment, &scratch.forces, h, h, residual);
        for (target, condition) in conditions.iter_mut().zip(&scratch.conditions) {
            *target = -condition;
        }
    }
}

impl Problem for Step<'_> {
    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64 {
        let (system, from, h) = (self.system, self.start, self.step);
        let scratch = &mut *self.scratch;
        scratch.place(system, from);

        let [start, middle, end] = configurations(
            system,
            from,
            [&scratch.q_middle, &scratch.q_end],
            [&scratch.frames_start, &scratch.frames_middle, &scratch.frames_end],
            [&scratch.prescribed_middle, &scratch.prescribed_end],
        );
        let step = time_step(
            from,
            [&start, &end],
            &scratch.increment,
            (&scratch.predicted_rates, &scratch.starts),
            h,
            self.dissipation,
        );
        system.forces_and_tangent(
            &middle,
            &Passage::Step(step),
            &scratch.excitation,
            0.25 * h * h,
            &mut scratch.forces,
            &mut kkt.blocks,
        );
        system.add_mass(MassAt::from(&middle), 1.0, &mut kkt.blocks);
        system.constraint_gradients(&end, &mut scratch.gradients_end);
        kkt.set_curvatures_and_gradients(system, &middle, &scratch.impulses, 0.5 * h, &mut scratch.gradients_middle);
        let (frames, drives) = ([&scratch.frames_start, &scratch.frames_end], &scratch.prescribed_middle.drives);
        gyroscopic::add_tangent(system, frames, drives, &scratch.mass_increment, h, &mut kkt.blocks);
        self.balance(right);
        kkt.set_constraints(system, &self.scratch.gradients_middle, &self.scratch.gradients_end, h);
        from.state.time + 0.5 * h
    }

    fn undefined_law(&self) -> Option<String> {
        let Self { system, start: Start { q, state, .. }, step, scratch, .. } = self;
        let start = system.configuration(q, &scratch.frames_start, state, &state.prescribed);
        let end = system.configuration(&scratch.q_end, &scratch.frames_end, state, &scratch.prescribed_end);
        system.undefined_law(&end, |coordinate, previous| {
            (coordinate.value(&end, previous) - coordinate.value(&start, previous)) / step
        })
    }

    fn correct(&mut self, correction: &[f64]) {
        self.scratch.correct(correction);
    }
}

impl Linearized for Midpoint {
    const MEMORY: bool = true;
    const PROJECTS: bool = true;

    fn unknowns(&self, _after: &State, unknowns: &mut Vec<f64>) {
        unknowns.clear();
        unknowns.extend(self.scratch.increment.iter().chain(&self.scratch.impulses));
    }

    fn factorize(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64]) -> Result<(), Error> {
        let dissipation = self.dissipation(state, span.step);
        let Self { scratch, kkt, right, .. } = self;
        let mut problem = Step::at(scratch, system, state, dissipation, span, unknowns);
        problem.linearize(kkt, right);
        kkt.factorize(system, span.end)
    }

    fn solve(&mut self, right: &mut [f64]) -> Result<(), Singular> {
        self.kkt.solve_again(right)
    }

    fn balance(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], right: &mut [f64]) {
        let dissipation = self.dissipation(state, span.step);
        let mut problem = Step::at(&mut self.scratch, system, state, dissipation, span, unknowns);
        problem.scratch.place(system, state.into());
        problem.scratch.act(system, state.into(), dissipation, span.step);
        problem.scratch.differentiate(system, state);
        problem.balance(right);
    }

    fn conclude(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], next: &mut State) {
        let mut right = std::mem::take(&mut self.right);
        self.balance(system, state, span, unknowns, &mut right);
        self.right = right;
        next.clone_from(state);
        let constraint_forces = |scratch: &mut Scratch| {
            let Scratch { gradients_middle, impulses, forces, .. } = scratch;
            system.add_constraint_forces(gradients_middle, impulses, 2.0 / span.step, forces);
        };
        let dissipation = self.dissipation(state, span.step);
        self.scratch.evaluate(system, state, dissipation, span, next);
        constraint_forces(&mut self.scratch);
        self.scratch.finish(system, state, next, span);
        if next.balance.account.is_some() {
            let work = self.scratch.work(system, state, dissipation, span, next);
            next.balance.account.iter_mut().for_each(|account| account.work.add(&work, 1.0));
        }
        self.scratch.continue_rates(state, span.step, next);
        // The velocity at the end, which is not known yet, takes its half off.
        next.lists.velocity.fill(0.0);
        self.scratch.lead(system, state, span.step, next);
    }
}
