//! One step of the grid: halved and tried again when it fails, whole again after a few good ones (MECHANICS 7.4).

use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::solve::step::tally::Tally;

/// Steps go down to `2^-MOST_HALVINGS` of the step size.
pub const MOST_HALVINGS: u32 = 10;
/// Whole steps without failure after which a halving is taken back.
const GOOD_STEPS: u32 = 5;

/// Something that takes one step.
pub trait Integrator {
    /// Whether what happens within a step counts: its steps end where a load or a drive goes over from one piece to the
    /// next.
    const RESOLVES_TIME: bool = true;

    /// Takes `state` from its time to `end`, `step` s later.
    ///
    /// # Errors
    /// The step failed: `state` is as it was, but for the counts of iterations.
    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error>;

    /// Engages and releases what is to be so at `time`, s, the instant of `state` but for rounding. Returns whether
    /// anything changed.
    ///
    /// # Errors
    /// What engages is redundant; callers must discard `state`.
    fn switch(&mut self, system: &System, state: &mut State, time: f64) -> Result<bool, Error>;

    /// The counts of its steps by their limits, if it can choose its steps.
    fn tally(&mut self) -> Option<&mut Tally>;
}

/// Takes `state` over one step of the grid, from its time to `end`, `step` s later, in as many parts as it needs.
///
/// # Errors
/// A part failed even at the smallest size; `state` is where the last good part ended, which callers must discard.
pub fn grid_step(
    integrator: &mut impl Integrator,
    system: &System,
    state: &mut State,
    step: f64,
    end: f64,
) -> Result<(), Error> {
    let whole = 1_u32 << MOST_HALVINGS;
    let start = state.time;
    let mut done = 0;
    let mut failed = false;
    while done < whole {
        let part = whole >> state.halving;
        let size = step * f64::from(part) / f64::from(whole);
        // Never a running sum: the parts of a step end where the step's own numbers say.
        let part_end =
            if done + part == whole { end } else { start + step * f64::from(done + part) / f64::from(whole) };
        match integrator.step(system, state, size, part_end) {
            Ok(()) => done += part,
            Err(reason) => {
                failed = true;
                state.statistics.rejected += 1;
                state.good_steps = 0;
                if state.halving == MOST_HALVINGS {
                    return Err(Error::StepTooSmall {
                        time: state.instant(),
                        step: size,
                        parts: whole,
                        reason: Box::new(reason),
                    });
                }
                state.halving += 1;
            }
        }
    }
    if !failed && state.halving > 0 {
        state.good_steps += 1;
        if state.good_steps == GOOD_STEPS {
            state.halving -= 1;
            state.good_steps = 0;
        }
    }
    Ok(())
}
