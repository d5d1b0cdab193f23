//! Loads, actuators, drives and frames that switch too often for steps to end there.

use super::Note;
use super::fast_signals::signals;
use crate::model::expression::function::MOST_SWITCHES;
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::number::Number;

/// Names what switches so often that no step ends at its switches.
pub fn many_switches(document: &Document) -> Vec<Note> {
    if document.simulation.analysis != Analysis::Dynamic {
        return Vec::new();
    }
    let [begin, stop] = document.span();
    let note = |number: Number| {
        let function = document.function(number);
        let period = function.shortest_switching([begin, stop])?;
        let count = (stop - begin) / period;
        (count > MOST_SWITCHES).then(|| {
            let text = format!(
                "switches every {period:.1e} s on average, {count:.1e} times up to stop = {stop} s. Steps end at the switches of an expression up to {MOST_SWITCHES:.0e} of them, not here, and pass \
                 over its pulses. Give the mean of the expression over a period, or an earlier stop"
            );
            Note::of(document, number, &text)
        })
    };
    signals(document).into_iter().filter_map(note).collect()
}
