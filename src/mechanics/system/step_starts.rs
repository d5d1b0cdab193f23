//! Memory for what elements have at the start of a step, which the step computes once.

use crate::mechanics::beam::ancf14::over_step::StepStart;

/// What all elements with holonomy angles have at the start of a step.
#[derive(Clone, Debug, Default)]
pub struct StepStarts {
    pub(super) list: Vec<StepStart>,
}

impl StepStarts {
    /// By the number of the holonomy angle.
    pub fn list(&self) -> &[StepStart] {
        &self.list
    }
}
