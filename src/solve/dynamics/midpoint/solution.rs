//! How the equations of a step are solved: by Newton's iteration, and refinements with the matrix of its last iteration
//! (MECHANICS 7.6).

use super::{Midpoint, Step};
use crate::error::Error;
use crate::mechanics::beam::configuration::Dissipation;
use crate::mechanics::state::{Shrinking, State};
use crate::mechanics::system::System;
use crate::mechanics::system::work::StepEnergy;
use crate::solve::linear::Singular;
use crate::solve::newton::refinement::{self, Promise};
use crate::solve::newton::{self, Convergence, Goal};
use crate::solve::step::linearized::Span;

/// What Newton may leave of a step before it is refined, as a share of the tolerance.
const REMAINDER: f64 = 0.3;
/// The same as a share of the tolerance times the first correction, which is of the size of the step's own error: with
/// the default tolerance a hundred-thousandth of that.
const REMAINDER_OF_FIRST: f64 = 1e3;
/// With how many matrices a step is tried. The refinements of the last one need not shrink: what several matrices leave
/// alike is round-off.
const MOST_MATRICES: usize = 4;

impl Midpoint {
    /// Solves for the step over `span` from `state`, and refines the solution. Counts iterations, and sets the rates of
    /// strains, in `next`. Returns how the iteration went, and what the step does to the energies.
    ///
    /// # Errors
    /// Newton does not converge, or the elements cannot bear the end.
    pub(super) fn solve(
        &mut self,
        system: &System,
        state: &State,
        dissipation: Dissipation,
        span: Span,
        next: &mut State,
    ) -> Result<(Convergence, StepEnergy), Error> {
        let mut size = [REMAINDER, REMAINDER_OF_FIRST].map(|share| share * self.tolerance);
        // A bound on the work takes one matrix and one refinement, whatever they leave.
        let (is_bounded, limit) = (self.bound.is_some(), self.limit());
        let (matrices, mut refinements) = if is_bounded { (1, 1) } else { (MOST_MATRICES, refinement::MOST) };
        let mut expected = state.prediction.shrinking;
        let mut learned: Option<Convergence> = None;
        let (begun, mut refused) = (next.statistics.iterations, None);
        let round_off = refinement::round_off(system.motion_size(&state.q));
        for matrix in 1..=matrices {
            let mut problem =
                Step { system, start: state.into(), dissipation, step: span.step, scratch: &mut self.scratch };
            let control = (Goal::Remainder { size, expected, refinements }, limit);
            let counted = &mut next.statistics.iterations;
            let mut convergence =
                newton::solve(system, &mut problem, &mut self.kkt, &mut self.right, control, span.end, counted)?;
            self.scratch.place(system, state.into());
            next.pace.turned = next.pace.turned.max(self.scratch.check(system, state, span.end)?);
            let bound = size[0] + size[1] * convergence.corrections[0];
            let has_converged = convergence.refinements > 0;
            let is_known = is_bounded || expected != Shrinking::default();
            let promise = match is_bounded {
                true => Promise::NONE,
                false => Promise { bound, round_off, shrinks: matrix < MOST_MATRICES },
            };
            convergence.refinements = if is_bounded { 1 } else { convergence.refinements };
            let found = self.refine(system, state, dissipation, span, next, (&mut convergence, promise, is_known));
            let learned = learned.get_or_insert(convergence);
            // The first correction of another iteration is what the one before had left.
            if refused.is_some() {
                learned.corrections[1] = learned.corrections[1].max(convergence.corrections[0]);
            }
            match found {
                Ok((found, size)) => {
                    if let Some(bound) = &mut self.bound {
                        bound.count(size, has_converged, self.tolerance);
                    }
                    return Ok((*learned, found));
                }
                Err(size) => refused = Some(size),
            }
            // Corrections so far do not tell how they shrink: now two more of this step decide.
            size = [bound, 0.0];
            (expected, refinements) = (Shrinking::default(), 1);
        }
        let iterations = (next.statistics.iterations - begun) as usize;
        Err(newton::not_converged(
            system,
            &self.right,
            (iterations, refused.unwrap_or_default()),
            span.end,
            self.tolerance,
        ))
    }

    /// Refines what an iteration has found, and holds the refinements to `promise`. `is_known`: how corrections shrink
    /// was known before. Returns what the step does to the energies, and the size of the last
    /// refinement.
    ///
    /// # Errors
    /// A refinement of this size is larger than promised: it is not made, and another iteration has to follow.
    fn refine(
        &mut self,
        system: &System,
        state: &State,
        dissipation: Dissipation,
        span: Span,
        next: &mut State,
        (convergence, promise, is_known): (&mut Convergence, Promise, bool),
    ) -> Result<(StepEnergy, f64), f64> {
        let (mut left, mut before) = (convergence.refinements, None);
        loop {
            let found = self.scratch.evaluate(system, state, dissipation, span, next);
            let size = self.find_refinement(system, state, dissipation, span.step);
            // Of a first correction this small, round-off decides how it shrinks.
            if before.is_none() && size.is_finite() && convergence.corrections[0] > REMAINDER * self.tolerance {
                convergence.measure(size);
            }
            let largest = refinement::largest_remainder(convergence.made(), promise.bound, left);
            if !promise.is_kept(size, before, largest) {
                return Err(size);
            }
            self.scratch.correct(&self.right);
            self.scratch.place(system, state.into());
            left -= 1;
            // Where nothing was known, or less was expected, a second one has to show that they shrink.
            if left == 0 && before.is_none() && !(is_known && promise.keeps_pace(size, convergence.made())) {
                left = 1;
            }
            if left == 0 {
                return Ok((found, size));
            }
            before = Some(size);
        }
    }

    /// Solves for one more correction of the converged step, into `self.right`, with the tangent of the last iteration
    /// and the residual that its forces leave: what remains after it is smaller by another ratio of corrections, and
    /// joints hold to round-off. Far less work than an iteration. Returns the size of that correction.
    fn find_refinement(&mut self, system: &System, state: &State, dissipation: Dissipation, step: f64) -> f64 {
        let mut problem = Step { system, start: state.into(), dissipation, step, scratch: &mut self.scratch };
        problem.balance(&mut self.right);
        match self.kkt.solve_roughly(&mut self.right) {
            Ok(()) => system.motion_size(&self.right),
            Err(Singular) => f64::INFINITY,
        }
    }
}
