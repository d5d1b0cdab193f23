//! Lines and warnings about the runs of a model.

use super::{End, Outcome};
use crate::model::run::accuracy::percent;

impl Outcome {
    /// The line about the runs: `3 runs, 24 elements, accuracy reached: 0.060 %`.
    pub fn line(&self) -> String {
        let Self { runs, elements, chooses_mesh, worst, .. } = self;
        let plural = if *runs == 1 { "" } else { "s" };
        let (mesh, what) = if *chooses_mesh {
            (format!(", {elements} elements"), "accuracy")
        } else {
            (String::new(), "accuracy of the steps")
        };
        let reached = worst.as_ref().map_or_else(
            || String::from("nothing to judge"),
            |worst| match worst.error {
                error if error > 1.0 => String::from("not known"),
                error => percent(error),
            },
        );
        format!("{runs} run{plural}{mesh}, {what} reached: {reached}")
    }

    /// The warning about results that did not reach the accuracy; none: they did.
    pub fn warning(&self) -> Option<String> {
        let worst = self.worst.as_ref()?;
        let (name, size, runs) = (&worst.name, worst.size(), self.runs);
        let off = format!("{name} is off by {size} of its range after {runs} runs");
        match &self.end {
            End::Reached => None,
            // A single run has warned by its own estimates.
            End::Budget | End::Failed(_) if runs == 1 => None,
            End::Budget => Some(format!(
                "{off}, as their differences tell: the next run would exceed the budget of {} times the cost of the \
                 first one. Give a larger --budget",
                self.budget
            )),
            End::Failed(reason) => Some(format!(
                "{off}, as their differences tell: the next run, with finer steps or meshes, failed ({reason})"
            )),
            End::Sensitive if !self.is_motion => Some(format!(
                "{off}, and finer meshes bring the runs no nearer to each other: the equilibrium may be next to a \
                 limit point, or the result may have no limit, as a strain at the point of a load. Read it further \
                 from joints and loads, or end the load earlier"
            )),
            End::Sensitive => Some(format!(
                "{off}, and finer steps bring the runs no nearer to each other: small differences grow in this \
                 motion, so that no steps give the same rows to the end. Judge a shorter time, or means over many runs"
            )),
        }
    }
}
