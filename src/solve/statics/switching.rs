//! Increments of a static path with switches: an equilibrium has what is engaged at its time, and what engages holds
//! where the last equilibrium stands.

use super::Statics;
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::{AT_BREAK, System};

impl Statics {
    /// The equilibrium of `end`, s, after an increment of `step` s from `state`.
    ///
    /// # Errors
    /// Those of [`Statics::find`]; `state` is as it was but for counts.
    pub(super) fn step_switching(
        &mut self,
        system: &System,
        state: &mut State,
        step: f64,
        end: f64,
    ) -> Result<(), Error> {
        self.find_engaged(system, state, end, end + AT_BREAK * step)
    }

    /// The equilibrium of `end`, s, after `state`, with what is engaged at `instant`, s.
    ///
    /// # Errors
    /// Those of [`Statics::find`]; `state` is as it was but for counts.
    pub fn find_engaged(&mut self, system: &System, state: &mut State, end: f64, instant: f64) -> Result<(), Error> {
        if !system.switches_at(state, instant) {
            return self.find(system, state, end);
        }
        let before = state.clone();
        system.switch(state, instant);
        // Stability is that of other motions.
        self.forget();
        let outcome = self.find(system, state, end);
        if outcome.is_err() {
            let tried = state.statistics;
            state.clone_from(&before);
            state.statistics = tried;
        }
        outcome
    }
}
