//! A given course of steps: those that an earlier run has taken, each divided into equal parts (MECHANICS 7.9).
//!
//! The errors of a motion fall with the square of its steps only where the steps of two runs stand in one ratio at
//! every time. An accuracy that is asked for moves the ends of the steps, and where results are wanted often it changes
//! nothing: rows bound the steps then. Divided steps keep all ends of the run before, those at rows, breaks and
//! switches among them.

use super::integrator::{Integrator, grid_step};
use super::tally::Tally;
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::{AT_BREAK, System};
use std::sync::Arc;

/// The times at which steps end, in their order.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Course {
    ends: Arc<[f64]>,
}

impl Course {
    /// The steps that end at `ends`, the first of which begins at `start`, s, each divided into `parts` equal ones.
    pub fn divided(start: f64, ends: &[f64], parts: u32) -> Self {
        let begins = std::iter::once(start).chain(ends.iter().copied());
        let divided = begins.zip(ends).flat_map(|(begin, end)| {
            let inner = (1..parts).map(move |part| begin + (end - begin) * f64::from(part) / f64::from(parts));
            inner.chain(std::iter::once(*end))
        });
        Self { ends: divided.collect() }
    }

    /// How many steps it has.
    pub fn count(&self) -> usize {
        self.ends.len()
    }

    /// Takes `state` to `end`, s. A step that fails is halved; beyond the course there is one step to `end`.
    ///
    /// # Errors
    /// A part of a step failed at the smallest size; `state` is where the last good one ended, which callers must
    /// discard.
    pub fn advance(
        &self,
        integrator: &mut impl Integrator,
        system: &System,
        state: &mut State,
        end: f64,
    ) -> Result<(), Error> {
        while state.time < end {
            self.part(integrator, system, state, end)?;
        }
        Ok(())
    }

    /// Takes one step on the way to `end`, s, as [`Self::advance`] does; returns whether that is reached.
    ///
    /// # Errors
    /// As of [`Self::advance`].
    pub fn part(
        &self,
        integrator: &mut impl Integrator,
        system: &System,
        state: &mut State,
        end: f64,
    ) -> Result<bool, Error> {
        let next = self.ends.partition_point(|own| *own <= state.time);
        let step_end = self.ends.get(next).map_or(end, |own| own.min(end));
        let step = step_end - state.time;
        integrator.switch(system, state, state.time + AT_BREAK * step)?;
        grid_step(integrator, system, state, step, step_end)?;
        // Results show what holds from this instant on.
        integrator.switch(system, state, state.time + AT_BREAK * step)?;
        Ok(state.time >= end)
    }
}

/// An integrator whose steps are looked at.
pub struct Noting<'a, I, F> {
    /// Takes the steps.
    pub integrator: &'a mut I,
    /// Looks at the state at the end of each, and where a switch has changed something.
    pub look: F,
}

/// The reason to look at a state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Event {
    /// A step has ended there.
    StepEnd,
    /// Something has engaged or been released.
    Switch,
}

impl<I: Integrator, F: FnMut(Event, &System, &State)> Integrator for Noting<'_, I, F> {
    const RESOLVES_TIME: bool = I::RESOLVES_TIME;

    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        self.integrator.step(system, state, step, end)?;
        (self.look)(Event::StepEnd, system, state);
        Ok(())
    }

    fn switch(&mut self, system: &System, state: &mut State, time: f64) -> Result<bool, Error> {
        let changed = self.integrator.switch(system, state, time)?;
        if changed {
            (self.look)(Event::Switch, system, state);
        }
        Ok(changed)
    }

    fn tally(&mut self) -> Option<&mut Tally> {
        self.integrator.tally()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Divided steps keep the ends of the whole ones, in every bit.
    #[test]
    fn divided_steps_are_nested() {
        let ends = [0.1, 0.4, 0.7000000000000001];
        let course = Course::divided(0.05, &ends, 3);
        assert_eq!(course.count(), 9);
        assert!([2, 5, 8].into_iter().zip(ends).all(|(place, end)| course.ends[place] == end));
        assert!(course.ends.windows(2).all(|pair| pair[0] < pair[1]));
        let first = course.ends[0];
        assert!((first - (0.05 + 0.05 / 3.0)).abs() < 1e-15, "{first}");
    }
}
