//! Memory for what elements have at the start of a step, which the step computes once.

use crate::mechanics::beam::ancf14::over_step::EndStrains;

/// What all elements with holonomy angles have at the start of a step.
#[derive(Clone, Debug, Default)]
pub struct StepStarts {
    pub(super) list: Vec<EndStrains>,
}

impl StepStarts {
    /// By the number of the holonomy angle.
    pub fn list(&self) -> &[EndStrains] {
        &self.list
    }
}
