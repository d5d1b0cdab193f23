//! A communication step: all at once, or part by part, an internal step each, for a host that looks in between and may
//! end it there.
//!
//! Both ways take the same internal steps, and a failure on the way brings the state back to where the communication
//! step began.

use super::derivatives::Derived;
use super::plan::Plan;
use super::solver::Solver;
use super::{Simulation, failure, wrong};
use crate::fmi::{Failure, Model};
use crate::model::builder;

/// A communication step that is taken part by part.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnderWay {
    plan: Plan,
    /// Parts that are taken.
    parts: u64,
    /// Its end as the host said it, s.
    end: f64,
}

impl Simulation {
    /// Advances to `end`, s.
    pub(super) fn advance_at_once(&mut self, end: f64) -> Result<(), Failure> {
        if !self.depart(end)? {
            return Ok(());
        }
        let outcome = self.go_to(end).and_then(|()| self.measure());
        self.arrive(outcome, end, f64::INFINITY)
    }

    /// Begins a step to `end`, s, to be taken by [`Self::part`].
    pub(super) fn begin(&mut self, end: f64) -> Result<(), Failure> {
        self.under_way = None;
        if !self.depart(end)? {
            return Ok(());
        }
        match self.runner.depart(end) {
            Ok(plan) => {
                self.under_way = Some(UnderWay { plan, parts: 0, end });
                Ok(())
            }
            Err(error) => self.arrive(Err(failure(&error)), end, f64::INFINITY),
        }
    }

    /// Takes the next part; returns whether the end is reached.
    pub(super) fn part(&mut self) -> Result<bool, Failure> {
        // None: the step was too short to be taken.
        let Some(UnderWay { plan, parts, end }) = self.under_way.take() else { return Ok(true) };
        self.derived = Derived::default();
        let taken = self.runner.take_part(&plan, parts).map_err(|error| failure(&error));
        if matches!(taken, Ok(false)) {
            self.under_way = Some(UnderWay { plan, parts: parts + 1, end });
            return Ok(false);
        }
        let outcome = taken.and_then(|_| self.measure());
        self.arrive(outcome, end, f64::INFINITY)?;
        Ok(true)
    }

    /// Ends the step where it is.
    pub(super) fn end_early(&mut self) -> Result<(), Failure> {
        let Some(UnderWay { end, .. }) = self.under_way.take() else { return Ok(()) };
        self.derived = Derived::default();
        let outcome = self.measure();
        self.arrive(outcome, end, self.runner.state.time)
    }

    /// Keeps the state, and aims at what the host gives for the step to `end`, s; false where nothing moves: the step
    /// is too short.
    fn depart(&mut self, end: f64) -> Result<bool, Failure> {
        if end - self.runner.state.time < self.shortest_step() {
            // The last step is what it was.
            self.inputs.end_step();
            return Ok(false);
        }
        // A host may move both limits of a stop, one after the other: only now they must fit.
        if self.runner.stale
            && let Some(objection) = self.document.crossed_limits().or_else(|| self.document.negative_damping())
        {
            return Err(wrong(objection));
        }
        self.forget_step();
        self.warn_of_quaternions([self.runner.state.time, end]);
        let runner = &mut self.runner;
        runner.settle(&self.document);
        runner.keep();
        let begin = runner.state.time;
        runner.state.targets.depart(begin, &runner.state.prescribed);
        let line = |number| self.inputs.line(number);
        let origin = runner.system.origin;
        builder::aim(&self.document, &origin, line, [begin, end], &mut runner.state.targets);
        Ok(true)
    }

    /// Concludes a step to `end`, s, that the host ended at `stop`, s, or that failed.
    fn arrive(&mut self, outcome: Result<(), Failure>, end: f64, stop: f64) -> Result<(), Failure> {
        if outcome.is_err() {
            self.runner.go_back();
            // They were those of this state before the step, so that they can be read.
            let _ = self.tell_results();
            self.warnings.extend(self.watch.judge(&self.runner.system, &self.table));
        }
        if let Solver::Statics(statics) = &mut self.runner.solver {
            self.warnings.extend(statics.take_remarks());
        }
        if outcome.is_ok() {
            self.last.known = true;
            self.last.inputs.copy_from(&self.inputs);
            (self.last.end, self.last.stop) = (end, stop);
            if self.companion.is_some() {
                self.hand_over(self.last.inputs.parts().map(<[f64]>::to_vec));
            }
        }
        self.inputs.end_step();
        outcome
    }
}
