//! The ramp from one equilibrium to the next: loads, gravity, drives and moving frames change together, in increments
//! that Newton can follow.

use super::Statics;
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::solve::step::limits;

/// The ramp gives up when its increment falls below this share.
const SMALLEST_SHARE: f64 = 1.0 / 4096.0;
/// An increment that took at most this many iterations may grow.
const EASY: usize = 6;

/// What a ramp changes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Way {
    /// Excitation, drives and frames.
    Whole,
    /// The excitation: drives and frames are at the target.
    Excitation,
}

impl Statics {
    /// Takes `state` to the equilibrium of `time`, s, by a ramp of what acts, drives and frames where need be.
    pub(super) fn ramp(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        system.excite(time, &state.targets, &mut self.target);
        system.prescribe(state, time, &mut self.target_motion);
        if system.is_in_fluid() && system.follows_no_potential(&self.target) && state.excitation.drag == 0.0 {
            // A line that is laid is near its equilibrium in still water, and near none under a trace of its weight.
            let (drawn, dragged) = (state.clone(), std::mem::replace(&mut self.target.drag, 0.0));
            let found = self.ramp_on(system, state, time, Way::Whole);
            self.target.drag = dragged;
            if found.and_then(|()| self.ramp_on(system, state, time, Way::Excitation)).is_ok() {
                return Ok(());
            }
            // What weighs nothing is held by the current alone.
            let statistics = state.statistics;
            state.clone_from(&drawn);
            state.statistics = statistics;
        }
        self.ramp_on(system, state, time, Way::Whole)
    }

    /// Ramps what acts, and, as `way` says, drives and frames, from those of `state` to the target.
    fn ramp_on(&mut self, system: &System, state: &mut State, time: f64, way: Way) -> Result<(), Error> {
        self.begin.clone_from(state);
        let (mut share, mut increment) = (0.0, 1.0);
        while share < 1.0 {
            let next = f64::min(share + increment, 1.0);
            self.current.set_between(&state.excitation, &self.target, next);
            let moved = match way {
                Way::Whole => self.move_to(system, next, share, time),
                Way::Excitation => Ok(()),
            };
            match moved.and_then(|()| self.solve(system, state, time)) {
                Ok(()) => {
                    share = next;
                    if self.convergence.is_some_and(|convergence| convergence.iterations <= EASY) {
                        increment *= 2.0;
                    }
                }
                // Smaller increments do not help against these; an iteration that runs away is another matter.
                Err(reason @ Error::NotFinite { .. }) if system.undefined(time).is_some() => return Err(reason),
                Err(reason) if self.holding.is_hopeless => return Err(reason),
                Err(reason) => {
                    state.statistics.rejected += 1;
                    increment = 0.5 * f64::min(increment, 1.0 - share);
                    if increment < SMALLEST_SHARE {
                        // Not even under a trace of the loads: it is no matter of them.
                        if share == 0.0 {
                            if matches!(reason, Error::Singular { .. }) {
                                return Err(reason);
                            }
                            self.examine(system, state, time).inspect_err(|_| self.holding.has_met_free = true)?;
                        }
                        // The equilibrium that the ramp began with: the state is the iterate that led nowhere.
                        let doubt = system.doubt_of_strain(&self.scratch.frames.of(system, &self.begin));
                        return Err(Error::RampStuck { time, share, doubt, reason: Box::new(reason) });
                    }
                }
            }
        }
        self.arrive(state);
        Ok(())
    }

    /// Sets the current motion to where drives and frames are at `share` of the way, coming from `last`.
    ///
    /// # Errors
    /// A frame turns too far at once.
    pub(super) fn move_to(&mut self, system: &System, share: f64, last: f64, time: f64) -> Result<(), Error> {
        let begin = &self.begin;
        let way = time - begin.time;
        if way > 0.0 {
            // Along their own way: the shortest one would lose turns.
            system.prescribe(begin, begin.time + share * way, &mut self.current_motion);
            limits::check_frames(system, begin, &self.current_motion, (share - last) * way, time)?;
            if share == 1.0 {
                self.current_motion.copy_from(&self.target_motion);
            }
            self.current_motion.stop();
        } else {
            self.current_motion.set_between(&begin.prescribed, &self.target_motion, share);
        }
        Ok(())
    }

    /// The whole excitation is reached.
    pub(super) fn arrive(&self, state: &mut State) {
        state.excitation.copy_from(&self.target);
        // The rates of drives are where a host's next rates start from.
        state.prescribed.drives.clone_from(&self.target_motion.drives);
    }
}
