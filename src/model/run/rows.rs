//! The rows of a table of results: one every `simulation.output_step`, and one at the end.

use crate::fmi::About;

/// An output step may miss the end by its round-off without making a row of its own, in output steps.
const ROUNDING: f64 = 1e-9;
/// Most rows of a run: more would fill a disk with some 30 GB.
pub const MOST: f64 = 1e8;

/// Number of the last row; row 0 is the start. None: there would be more than [`MOST`].
pub fn last(about: &About) -> Option<u64> {
    let is_possible = about.stop / about.output_step <= MOST;
    is_possible.then(|| (rows_until(about.stop, about.output_step) - passed(about, about.start)).max(1))
}

/// The time of a row, s: after the start, multiples of the output step.
pub fn time(about: &About, row: u64, last: u64) -> f64 {
    match row {
        _ if row == last => about.stop,
        0 => about.start,
        _ => (passed(about, about.start) + row) as f64 * about.output_step,
    }
}

/// Number of the last row up to `time`, s, of a run from 0.
fn passed(about: &About, time: f64) -> u64 {
    (time / about.output_step + ROUNDING).floor().max(0.0) as u64
}

/// Number of the first row after `begin`, s, where a run begins there instead of at 0; `last` is that of the last row.
/// None: nothing is left to run.
pub fn first_after(about: &About, begin: f64, last: u64) -> Option<u64> {
    let margin = ROUNDING * about.output_step;
    (begin + margin < about.stop).then(|| (passed(about, begin) + 1).min(last))
}

fn rows_until(stop: f64, step: f64) -> u64 {
    ((stop / step - ROUNDING).ceil() as u64).max(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A run that begins where another has ended writes the rows that this one has not: also where the division is not
    /// exact, or the end is between two rows.
    #[test]
    fn rows_go_on_after_a_beginning() {
        let about = |stop: f64, output_step: f64| About { stop, output_step, ..About::default() };
        assert_eq!(first_after(&about(0.6, 0.1), 0.3, 6), Some(4));
        assert_eq!(first_after(&about(0.6, 0.1), 0.1 + 0.2, 6), Some(4));
        assert_eq!(first_after(&about(1.0, 0.3), 0.95, 4), Some(4));
        assert_eq!(first_after(&about(1.0, 0.3), 0.7, 4), Some(3));
        assert_eq!(first_after(&about(0.3, 0.1), 0.3, 3), None);
    }

    /// A model that begins with a state has its row 0 there, and the rows after it at multiples of the output step.
    #[test]
    fn rows_of_a_model_that_begins_with_a_state() {
        let times = |start: f64, stop: f64| {
            let about = About { start, stop, output_step: 0.1, ..About::default() };
            let last = last(&about).unwrap();
            (0..=last).map(|row| time(&about, row, last)).collect::<Vec<f64>>()
        };
        assert_eq!(times(0.0, 0.3), [0.0, 0.1, 0.2, 0.3]);
        assert_eq!(times(0.1 + 0.2, 0.6), [0.1 + 0.2, 0.4, 0.5, 0.6]);
        assert_eq!(times(0.25, 0.45), [0.25, 3.0 * 0.1, 0.4, 0.45]);
        assert_eq!(times(0.25, 0.26), [0.25, 0.26]);
    }

    /// The last row is at the end, no row twice, also where the division is not exact.
    #[test]
    fn rows_end_at_the_stop() {
        assert_eq!(rows_until(0.5, 1e-3), 500);
        assert_eq!(rows_until(0.3, 0.1), 3);
        assert_eq!(rows_until(1.0, 0.3), 4);
        assert_eq!(rows_until(0.1, 1.0), 1);
        assert_eq!(rows_until(10.0, 1e-4), 100_000);
    }
}
