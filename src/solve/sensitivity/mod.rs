//! Derivatives of a communication step by what the host gives: how the state at its end changes with each input.
//!
//! The step is repeated, and each of its internal steps differentiated where it ended. An internal step solves
//! `R(z, s, u) = 0` for its unknowns `z` from the state `s` before it, and the state after it is `s' = F(z, s, u)`. For
//! every input
//!
//! ```text
//! R_z dz = −R_s ds − R_u du,   ds' = F_z dz + F_s ds + F_u du
//! ```
//!
//! with the factorized tangent for `R_z`: one factorization an internal step serves all inputs. Derivatives of `R` and
//! `F` along a direction are central differences of fourth order of these explicit functions, without any iteration:
//! with steps of `REACH` of the system's size and of a radian what they leave out is about 1e-12 of the derivative,
//! what rounding adds a little more; slender beams take smaller steps ([`System::straight_reach`]). A second solve
//! takes out what the tangent leaves out. Velocities that follow by projection, and the response of the end, are solved
//! for alike.

pub mod mover;
mod pass;

use self::mover::Step;
use self::pass::{Pass, Scratch, add_scaled, set_moved};
use crate::error::Error;
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::variation::Variation;
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::integrator::Integrator;
use crate::solve::step::linearized::{Linearized, Span};
use crate::solve::step::response::{Responder, Response};
use crate::solve::step::tally::Tally;

/// Largest change of a coordinate for differences: over the system's size, or rad.
const REACH: f64 = 1e-3;
/// Offsets and weights of the central difference of fourth order.
pub const STENCIL: [(f64, f64); 4] = [(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)];
/// What the host gives, as the sensitivities ask for it.
pub trait Inputs {
    /// Number of inputs.
    fn count(&self) -> usize;

    /// The change of input `number` that changes a motion by about the system's size or a radian, or a load by about
    /// itself.
    fn unit(&self, number: usize) -> f64;

    /// Sets `targets` to what the host wants with input `number` changed by `change`.
    fn aim(&self, number: usize, change: f64, targets: &mut Targets);
}

/// How a state depends on each input; scratch memory for the way there.
#[derive(Debug)]
pub struct Sensitivity {
    columns: Vec<Column>,
    /// `[M Gᵀ; G 0]` at the end of a step.
    flow: Kkt,
    responder: Responder,
    /// The state before the internal step.
    before: State,
    scratch: Scratch,
}

#[derive(Debug, Default)]
struct Column {
    variation: Variation,
    response: Response,
}

impl Sensitivity {
    /// Of a system that starts a communication step at `start`, which depends on none of the `inputs` of that step.
    pub fn new(system: &System, start: &State, inputs: &impl Inputs) -> Self {
        let mut columns: Vec<Column> = Vec::new();
        columns.resize_with(inputs.count(), Column::default);
        columns.iter_mut().for_each(|column| column.variation.set_zero(start));
        let size = system.coordinates() + system.constraints();
        let (flow, responder) = (Kkt::for_projections(system), Responder::new(system));
        Self { columns, flow, responder, before: State::default(), scratch: Scratch::new(size) }
    }

    /// Repeats the communication step `step` and differentiates it. `state` is at its end, and is so again; `march`
    /// takes its internal steps with the integrator that it is given.
    ///
    /// # Errors
    /// The step cannot be repeated, or its linear systems are singular.
    pub fn of_step<I: Linearized, N: Inputs>(
        &mut self,
        integrator: &mut I,
        system: &System,
        step: Step<'_, N>,
        state: &mut State,
        march: impl FnOnce(&mut Differentiated<'_, I, N>, &mut State) -> Result<(), Error>,
    ) -> Result<(), Error> {
        if !I::MEMORY {
            let span = Span { step: 0.0, end: state.time };
            return self.pass(integrator, system, &step, state, span);
        }
        let targets = state.targets.clone();
        state.clone_from(step.start);
        state.targets = targets;
        let mut differentiated = Differentiated { integrator, step, sensitivity: self, failure: None };
        march(&mut differentiated, state)?;
        differentiated.failure.map_or(Ok(()), Err)
    }

    /// The states and responses around `after` and `response` along input `number`, each with its weight: weighted and
    /// summed, whatever is read off them is differentiated by that input.
    pub fn look(
        &mut self,
        system: &System,
        step: Step<'_, impl Inputs>,
        (after, response): (&State, &Response),
        number: usize,
        mut read: impl FnMut(&State, &Response, f64),
    ) {
        let Column { variation, response: own } = &self.columns[number];
        let unit = step.reach(system, number, variation, &[], 0.0);
        let mut moved_response = response.clone();
        for (offset, weight) in STENCIL {
            let by = offset * unit;
            set_moved(&mut moved_response.acceleration, &response.acceleration, &own.acceleration, by);
            set_moved(&mut moved_response.multipliers, &response.multipliers, &own.multipliers, by);
            let moved = self.scratch.mover.move_from(system, &step, number, after, variation, by);
            read(moved, &moved_response, weight / unit);
        }
    }

    /// Takes the derivatives over the internal step from the state before it, which is kept, to `after`.
    fn pass<I: Linearized>(
        &mut self,
        integrator: &mut I,
        system: &System,
        step: &Step<'_, impl Inputs>,
        after: &State,
        span: Span,
    ) -> Result<(), Error> {
        let Self { columns, flow, scratch, before, .. } = self;
        let from = if I::MEMORY { &*before } else { after };
        let mut pass = Pass { integrator, system, step, from, after, span, flow, scratch };
        pass.prepare(before)?;
        for (number, column) in columns.iter_mut().enumerate() {
            if !I::MEMORY {
                column.variation.set_zero(after);
            }
            pass.differentiate(number, &mut column.variation)?;
        }
        Ok(())
    }

    /// Takes the derivatives from the state before switches have changed, which is kept, to `after`.
    fn pass_switch(
        &mut self,
        integrator: &mut impl Linearized,
        system: &System,
        step: &Step<'_, impl Inputs>,
        after: &State,
        time: f64,
    ) -> Result<(), Error> {
        let Self { columns, scratch, before, .. } = self;
        let Scratch { mover, variation, arrived, .. } = scratch;
        for (number, column) in columns.iter_mut().enumerate() {
            let unit = step.reach(system, number, &column.variation, &[], 0.0);
            variation.set_zero(after);
            for (offset, weight) in STENCIL {
                arrived.clone_from(mover.move_from(system, step, number, before, &column.variation, offset * unit));
                integrator.switch(system, arrived, time)?;
                variation.add_between(system, weight / unit, after, arrived);
            }
            std::mem::swap(&mut column.variation, variation);
        }
        Ok(())
    }

    /// Takes the derivatives of the response of the state `after` the communication step, which is `response`.
    ///
    /// # Errors
    /// The acceleration of a drive or frame is not finite.
    pub fn of_response<I: Linearized>(
        &mut self,
        system: &System,
        step: Step<'_, impl Inputs>,
        after: &State,
        response: &Response,
    ) -> Result<(), Error> {
        let Self { columns, flow, responder, scratch, .. } = self;
        let Scratch { right, sum, mover, .. } = scratch;
        for (number, column) in columns.iter_mut().enumerate() {
            let Column { variation, response: own } = column;
            if I::PROJECTS {
                let unit = step.reach(system, number, variation, &[], 0.0);
                sum.fill(0.0);
                for (offset, weight) in STENCIL {
                    let moved = mover.move_from(system, &step, number, after, variation, offset * unit);
                    responder.balance(system, moved, response, right)?;
                    add_scaled(sum, right, weight / unit);
                }
                let inaccurate = |Singular| Error::Singular {
                    time: after.time,
                    what: String::from("the derivatives of a response"),
                };
                flow.solve_again(sum).map_err(inaccurate)?;
                let (acceleration, multipliers) = sum.split_at(system.coordinates());
                own.acceleration = acceleration.to_vec();
                own.multipliers = multipliers.to_vec();
            } else {
                own.multipliers.clone_from(&variation.lists.multipliers);
                own.acceleration.clone_from(&variation.lists.acceleration);
                own.acceleration.resize(system.coordinates(), 0.0);
            }
        }
        Ok(())
    }
}

/// The states around `state` along its motion with the accelerations `acceleration`, each with its weight: weighted and
/// summed, whatever is read off their positions and velocities is differentiated by time.
pub fn along_motion(system: &System, state: &State, acceleration: &[f64], mut read: impl FnMut(&State, f64)) {
    let mut variation = Variation::default();
    variation.set_zero(state);
    variation.lists.q.copy_from_slice(&state.velocity);
    variation.lists.velocity.copy_from_slice(acceleration);
    let speed = f64::max(system.correction_size(&state.velocity).0, state.prescribed.fastest(system.size));
    let unit = if speed > 0.0 { REACH / speed.max(f64::MIN_POSITIVE) } else { 1.0 };
    let (mut moved, mut frames) = (State::default(), FrameCache::default());
    for (offset, weight) in STENCIL {
        let by = offset * unit;
        moved.clone_from(state);
        moved.prescribed.drift(by);
        variation.apply(system, by, &mut moved, &mut frames);
        read(&moved, weight / unit);
    }
}

/// An integrator that differentiates the steps that it takes.
#[derive(Debug)]
pub struct Differentiated<'a, I, N> {
    integrator: &'a mut I,
    step: Step<'a, N>,
    sensitivity: &'a mut Sensitivity,
    /// What went wrong with the derivatives: it must not halve the step.
    failure: Option<Error>,
}

impl<I: Linearized, N: Inputs> Integrator for Differentiated<'_, I, N> {
    const RESOLVES_TIME: bool = I::RESOLVES_TIME;

    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        self.sensitivity.before.clone_from(state);
        self.integrator.step(system, state, step, end)?;
        if self.failure.is_none() {
            let passed = self.sensitivity.pass(self.integrator, system, &self.step, state, Span { step, end });
            self.failure = passed.err();
        }
        Ok(())
    }

    fn switch(&mut self, system: &System, state: &mut State, time: f64) -> Result<bool, Error> {
        self.sensitivity.before.clone_from(state);
        let switched = self.integrator.switch(system, state, time)?;
        if switched && self.failure.is_none() {
            let passed = self.sensitivity.pass_switch(self.integrator, system, &self.step, state, time);
            self.failure = passed.err();
        }
        Ok(switched)
    }

    fn tally(&mut self) -> Option<&mut Tally> {
        self.integrator.tally()
    }
}
