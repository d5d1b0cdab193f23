//! Steps whose work is bounded, for real time: so many iterations with a factorization each, and one refinement.

use super::solution::{REMAINDER, REMAINDER_OF_FIRST};
use super::{Midpoint, Step};
use crate::error::Error;
use crate::mechanics::beam::configuration::Dissipation;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::work::StepEnergy;
use crate::solve::newton::refinement::SURPRISE;
use crate::solve::newton::{self, Convergence, Goal, Limit};
use crate::solve::step::linearized::Span;

/// The steps that the bound has cut off since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutOff {
    /// Steps whose last correction was above the tolerance.
    pub steps: u64,
    /// The largest of these corrections.
    pub largest: f64,
}

impl Midpoint {
    /// The same with at most `iterations` iterations a step, 1 or more: a step takes what they leave.
    pub fn bounded(self, iterations: usize) -> Self {
        Self { bound: Some(iterations), ..self }
    }

    /// The steps that the bound has cut off; none: there is no bound.
    pub fn cut_off(&self) -> Option<CutOff> {
        self.bound.map(|_| self.cut_off)
    }

    /// Solves for the step over `span` from `state` as far as `bound` iterations and a refinement lead. All else as in
    /// [`Self::solve`].
    ///
    /// # Errors
    /// A number is not finite, the matrix is singular, or the elements cannot bear the end.
    pub(super) fn solve_within(
        &mut self,
        bound: usize,
        system: &System,
        state: &State,
        dissipation: Dissipation,
        span: Span,
        next: &mut State,
    ) -> Result<(Convergence, StepEnergy), Error> {
        let size = [REMAINDER, REMAINDER_OF_FIRST].map(|share| share * self.tolerance);
        let goal = Goal::Remainder { size, expected: state.prediction.shrinking, refinements: 1 };
        let mut problem =
            Step { system, start: state.into(), dissipation, step: span.step, scratch: &mut self.scratch };
        let (counted, control) = (&mut next.statistics.iterations, (goal, Limit::Ends(bound)));
        let mut convergence =
            newton::solve(system, &mut problem, &mut self.kkt, &mut self.right, control, span.end, counted)?;
        self.scratch.place(system, state.into());
        next.pace.turned = next.pace.turned.max(self.scratch.check(system, state, span.end)?);
        let found = self.scratch.evaluate(system, state, dissipation, span, next);
        let left = self.find_refinement(system, state, dissipation, span.step);
        if left.is_finite() {
            convergence.measure(left);
            self.scratch.correct(&self.right);
            self.scratch.place(system, state.into());
        }
        // Where Newton has reached its goal, a refinement may be a little larger than it: more follow otherwise.
        let most = if convergence.refinements > 0 { SURPRISE * self.tolerance } else { self.tolerance };
        if left.is_nan() || left > most {
            self.cut_off.steps += 1;
            self.cut_off.largest = self.cut_off.largest.max(left);
        }
        Ok((convergence, found))
    }
}
