//! How far the results are off while a run goes on, and what follows from that: longer steps, corrected results; and
//! what they come to between rows.

use super::Simulation;
use super::runner::Runner;
use crate::model::run::between::{Between, LowAndHigh};
use crate::model::variables::Source;

impl Simulation {
    /// Lets the steps that follow be longer while the results are far more exact than asked for.
    pub(super) fn ease(&mut self) {
        let Some(pacing) = self.runner.pacing else { return };
        let state = &self.runner.state;
        if !pacing.is_due(&state.pace, state.time) {
            return;
        }
        let errors = self.accuracy.errors(&self.columns, &self.measures(), false);
        let Some(error) = errors.iter().map(|own| own.error).reduce(f64::max) else { return };
        let state = &mut self.runner.state;
        pacing.ease(&mut state.pace, error, state.time);
    }

    /// Looks how far the results of the state that is reached are off.
    pub(super) fn look(&mut self) {
        let Runner { system, state, responder, solver, .. } = &mut self.runner;
        let Some(spare) = solver.spare() else { return };
        let results = (&*self.results, self.document.simulation.correction);
        let (known, memory) = ((&*self.columns, &*self.table), (&mut self.looker, spare));
        self.accuracy.look(known, (system, state), responder.as_deref_mut(), results, memory);
    }

    /// Takes the time-step error out of the results, as computed, if the file asks for it.
    pub(super) fn correct(&mut self) {
        if self.document.simulation.correction {
            let Runner { system, state, responder, solver, .. } = &mut self.runner;
            let Some(spare) = solver.spare() else { return };
            let (known, memory) = ((&*self.columns, &*self.table), (&mut self.looker, spare));
            self.accuracy.correct(known, (system, state), responder.as_deref_mut(), &mut self.results, memory);
        }
    }

    /// Looks at the results of all steps from now on, those between the rows among them. Results that are corrected
    /// are left out: the correction is that of rows.
    pub fn look_at_all_steps(&mut self) {
        if !self.document().simulation.correction {
            self.between = Some(Box::default());
        }
    }

    /// Includes the results that were read off the state that is reached, as computed.
    pub(super) fn note_results(&mut self) {
        if let Some(between) = &mut self.between {
            between.include_results(self.runner.state.time, &self.results);
        }
    }

    /// A row has been told: extremes begin anew.
    pub fn begin_row(&mut self) {
        self.between.iter_mut().for_each(|between| between.begin_row());
    }

    /// The extremes of all results since [`Self::begin_row`], whatever communication steps led here; empty: nobody
    /// looks.
    pub fn between_rows(&self) -> &[LowAndHigh] {
        self.between.as_deref().map_or(&[], Between::extremes)
    }

    /// Those of the variable with this value reference; none: it is no result, or nobody looks.
    pub fn extremes_between_rows(&self, reference: usize) -> Option<LowAndHigh> {
        let Source::Result(number) = self.table.sources[reference] else { return None };
        self.between_rows().get(number).copied()
    }
}
