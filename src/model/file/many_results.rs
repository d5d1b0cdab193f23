//! Outputs with more results than a table can have: `stations` along many beams.

use super::entries::output::{OutputSpec, Target};
use crate::model::text::diagnostic::Report;

/// Most results of a model. Each is a variable with its name and meaning, 1 kB, and a column of the table.
const MOST_RESULTS: usize = 200_000;

/// Reports the output with which there are too many.
pub(super) fn report(outputs: &[OutputSpec], report: &mut Report<'_>) {
    let mut count = 0;
    for output in outputs {
        let places = if let Target::On { stations, .. } = output.target { stations } else { 1 };
        count += places * output.quantities.iter().map(|quantity| quantity.row().components).sum::<usize>();
        if count > MOST_RESULTS {
            let message = format!("the outputs up to [output.{}] have {count} results", output.name);
            let label = format!("the limit is {MOST_RESULTS}");
            report.error(output.place, &message, &label, "take fewer `stations`, or fewer quantities along beams");
            return;
        }
    }
}
