//! The internal steps of a communication step, of equal length or as the solver chooses them.

use crate::error::Error;
use crate::math::resolution::Sight;
use crate::mechanics::state::State;
use crate::mechanics::system::{AT_BREAK, System};
use crate::solve::step::integrator::{Integrator, grid_step};
use crate::solve::step::pacing::Pacing;

/// The internal steps of a communication step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Plan {
    /// Where their counting begins, s, and the number of the first one.
    pub(super) begin: f64,
    pub(super) first: f64,
    /// Where the first one begins, s.
    pub(super) from: f64,
    /// Where the last one ends, s.
    pub(super) end: f64,
    /// Length of each, s.
    pub(super) step: f64,
    pub(super) count: u64,
    /// None: the steps are these.
    pub(super) pacing: Option<Pacing>,
    /// The steps end where they reach this time, s; infinite: at the end.
    pub(super) stop: f64,
}

impl Plan {
    /// Takes them all.
    pub(super) fn march(
        &self,
        integrator: &mut impl Integrator,
        system: &System,
        state: &mut State,
    ) -> Result<(), Error> {
        let mut number = 0;
        while !self.part(number, integrator, system, state)? && state.time < self.stop {
            number += 1;
        }
        Ok(())
    }

    /// Takes step `number`, from 0, where the ones before it have led to `state`; returns whether it was the last one.
    pub(super) fn part(
        &self,
        number: u64,
        integrator: &mut impl Integrator,
        system: &System,
        state: &mut State,
    ) -> Result<bool, Error> {
        if let Some(pacing) = self.pacing {
            return pacing.advance(integrator, system, state, [self.from, self.end]);
        }
        let number = number + 1;
        if number > self.count {
            return Ok(true);
        }
        let is_last = number == self.count;
        let next = if is_last { self.end } else { self.begin + (self.first + number as f64) * self.step };
        let margin = AT_BREAK * self.step;
        let whole = march_to_last_break(integrator, system, state, next, margin)?;
        let step = if whole { self.step } else { next - state.time };
        integrator.switch(system, state, state.time + margin)?;
        grid_step(integrator, system, state, step, next)?;
        // Results show what holds from this instant on.
        integrator.switch(system, state, state.time + margin)?;
        Ok(is_last)
    }
}

/// Takes `state` to the last break before `next`, s, from one to the next, and in parts over pulses in between; breaks
/// within `margin` s of an end count as that end. Returns whether there is none.
fn march_to_last_break<I: Integrator>(
    integrator: &mut I,
    system: &System,
    state: &mut State,
    next: f64,
    margin: f64,
) -> Result<bool, Error> {
    let mut whole = true;
    while I::RESOLVES_TIME
        && let Some(time) = step_end(system, state.time, next, margin)
    {
        let step = time - state.time;
        integrator.switch(system, state, state.time + margin)?;
        grid_step(integrator, system, state, step, time)?;
        whole = false;
    }
    Ok(whole)
}

/// The first time after `from` and before `next`, s, at which a step has to end.
fn step_end(system: &System, from: f64, next: f64, margin: f64) -> Option<f64> {
    let end = system.break_between(from, next, margin).unwrap_or(next);
    let end = system.switch_between(from, end, margin).unwrap_or(end);
    let sight = if end < next { Sight::Changes } else { Sight::Pulses };
    let end = system.seen_until(from, end, sight);
    (end < next).then_some(end)
}
