//! Steps whose work is bounded, for real time: so many iterations with a factorization each, and one refinement.

use super::Midpoint;
use crate::solve::newton::Limit;
use crate::solve::newton::refinement::SURPRISE;
use crate::solve::step::limits;

/// A bound on the iterations of a step, and the steps that it has cut off since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bound {
    /// Most iterations of a step.
    pub iterations: usize,
    /// Steps whose last correction was above the tolerance.
    pub cut_off: u64,
    /// The largest of these corrections.
    pub largest: f64,
}

impl Bound {
    /// The same at the start.
    pub(super) fn begin(self) -> Self {
        Self { iterations: self.iterations, ..Self::default() }
    }

    /// Counts a step whose last correction was `size`; Newton `has_converged`, or was cut off.
    pub(super) fn count(&mut self, size: f64, has_converged: bool, tolerance: f64) {
        // Where Newton has converged, a refinement may be a little larger: without a bound more of them follow.
        if size > if has_converged { SURPRISE * tolerance } else { tolerance } {
            self.cut_off += 1;
            self.largest = self.largest.max(size);
        }
    }
}

impl Midpoint {
    /// The same with at most `iterations` iterations a step, 1 or more: a step takes what they leave.
    pub fn bounded(self, iterations: usize) -> Self {
        Self { bound: Some(Bound { iterations, ..Bound::default() }), ..self }
    }

    /// The bound on the iterations of a step, with the steps that it has cut off; none: there is no bound.
    pub fn bound(&self) -> Option<&Bound> {
        self.bound.as_ref()
    }

    /// How many iterations a step may take.
    pub(super) fn limit(&self) -> Limit {
        self.bound.map_or(Limit::Fails(limits::ITERATIONS), |bound| Limit::Ends(bound.iterations))
    }
}
