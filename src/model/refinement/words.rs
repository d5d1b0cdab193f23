//! Lines and warnings about the runs of a model.

use super::{End, Outcome};
use crate::model::run::accuracy::at_most;

/// Runs aim at what a reader expects, to be right to twice that: a result that is off by less is not warned of where
/// they end early.
const WARNED: f64 = 2.0;

impl Outcome {
    /// The line about the runs: `3 runs, 24 elements, accuracy reached: 0.060 %`.
    pub fn line(&self) -> String {
        let Self { runs, elements, chooses_mesh, keeps_steps, worst, .. } = self;
        let plural = if *runs == 1 { "" } else { "s" };
        let (mesh, what) = match (chooses_mesh, keeps_steps) {
            (true, false) => (format!(", {elements} elements"), "accuracy"),
            (true, true) => (format!(", {elements} elements"), "accuracy of the mesh"),
            (false, _) => (String::new(), "accuracy of the steps"),
        };
        let reached = worst.as_ref().map_or_else(
            || String::from("nothing to judge"),
            |worst| match worst.error {
                error if error > 1.0 => String::from("not known"),
                error => at_most(error),
            },
        );
        // As the warning about the shortfall says it.
        let is_reached = self.end == End::Reached || worst.as_ref().is_none_or(|worst| worst.excess() <= WARNED);
        match is_reached {
            true => format!("{runs} run{plural}{mesh}, {what} reached: {reached}"),
            false => format!("{runs} run{plural}{mesh}, {what} not reached: {reached}"),
        }
    }

    /// The results that did not reach the accuracy, in a sentence, of a single run too; none: all did, or nearly.
    pub fn shortfall(&self) -> Option<String> {
        let worst = self.worst.as_ref().filter(|worst| self.end != End::Reached && worst.excess() > WARNED)?;
        let off = || {
            let reason = match &self.end {
                End::Failed(reason) => format!("a finer run failed ({reason})"),
                _ => String::from("a further run would exceed the budget"),
            };
            format!("{} is off by {} of its range: {reason}", worst.name, worst.size())
        };
        Some(self.warning().unwrap_or_else(off))
    }

    /// The warning about results that did not reach the accuracy; none: they did.
    pub fn warning(&self) -> Option<String> {
        let worst = self.worst.as_ref()?;
        let (name, size, runs) = (&worst.name, worst.size(), self.runs);
        let plural = if runs == 1 { "" } else { "s" };
        let off = format!("{name} is off by {size} of its range after {runs} run{plural}");
        match &self.end {
            End::Reached => None,
            // A single run has warned by its own estimates.
            End::Budget | End::Failed(_) if runs == 1 && !self.is_path => None,
            End::Budget | End::Failed(_) if worst.excess() <= WARNED => None,
            End::Budget => Some(format!(
                "{off}, as their differences tell: the next run would exceed the budget of {} times the cost of the \
                 first one. Give a larger --budget",
                rounded(self.budget)
            )),
            End::Failed(reason) => Some(format!(
                "{off}, as their differences tell: the next run, with finer steps or meshes, failed ({reason})"
            )),
            End::Sensitive if !self.is_motion => Some(format!(
                "{off}, and finer meshes bring the runs no nearer to each other: the equilibrium may be next to a \
                 limit point, or the result may have no limit, as a strain at the point of a load. Read it further \
                 from joints and loads, or end the load earlier"
            )),
            End::Ringing => Some(format!(
                "{off}, and finer steps bring the runs no nearer to each other, while the motion itself is right: a \
                 vibration of this result is too fast for the steps, which lose its phase. Give the material damping, \
                 let speeds and loads begin smoothly, begin a rotation with initial = \"steady\", or judge its mean"
            )),
            End::Sensitive => Some(format!(
                "{off}, and finer steps bring the runs no nearer to each other: small differences grow in this \
                 motion, so that no steps give the same rows to the end. Judge a shorter time, or means over many runs"
            )),
        }
    }
}

/// A budget as users give it: tenths below 100, whole numbers above.
fn rounded(budget: f64) -> f64 {
    if budget < 100.0 { (10.0 * budget).round() / 10.0 } else { budget.round() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::run::accuracy::Inexact;

    /// A line has no error of 0.000000 %.
    #[test]
    fn tiny_errors_are_told_as_less() {
        let line = |error: f64| {
            let worst = Some(Inexact { name: String::from("tip.position"), error, is_rough: false });
            let (end, budget) = (End::Reached, 20.0);
            Outcome {
                runs: 1,
                elements: 8,
                chooses_mesh: true,
                keeps_steps: false,
                is_motion: true,
                is_path: false,
                worst,
                end,
                budget,
            }
            .line()
        };
        assert!(line(1e-13).ends_with("accuracy reached: less than 0.00010 %"), "{}", line(1e-13));
        assert!(line(2.5e-3).ends_with("accuracy reached: 0.25 %"));
    }

    /// A run that ends off by more than it is warned of has not reached its accuracy.
    #[test]
    fn accuracies_that_are_missed_are_not_told_as_reached() {
        let line = |error: f64, end: End| {
            let worst = Some(Inexact { name: String::from("tip.position"), error, is_rough: false });
            let (chooses_mesh, is_motion, is_path, budget) = (true, true, false, 20.0);
            Outcome { runs: 3, elements: 96, chooses_mesh, keeps_steps: false, is_motion, is_path, worst, end, budget }
                .line()
        };
        assert_eq!(line(0.05, End::Budget), "3 runs, 96 elements, accuracy not reached: 5.0 %");
        assert_eq!(line(0.008, End::Budget), "3 runs, 96 elements, accuracy reached: 0.80 %");
    }

    /// A run that its budget ends is warned of beyond 1 %, and a path by arc length after its first run too: it has no
    /// other estimate.
    #[test]
    fn runs_that_end_early_are_warned_of_beyond_their_bar() {
        let warns = |error: f64, runs: u32, is_path: bool| {
            let worst = Some(Inexact { name: String::from("tip.position"), error, is_rough: false });
            let (chooses_mesh, is_motion) = (true, !is_path);
            let outcome = Outcome {
                runs,
                elements: 8,
                chooses_mesh,
                keeps_steps: false,
                is_motion,
                is_path,
                worst,
                end: End::Budget,
                budget: 20.0,
            };
            outcome.warning().is_some()
        };
        assert_eq!([warns(0.009, 2, false), warns(0.011, 2, false)], [false, true]);
        assert_eq!([warns(0.011, 1, false), warns(0.011, 1, true)], [false, true]);
    }
}
