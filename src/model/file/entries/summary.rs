//! `summary` of `[output.NAME]`: stations along a beam that give their range over time, instead of a column each.

use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::schema::Rule;

/// The summaries that there are.
pub(super) const SUMMARIES: [(&str, ()); 1] = [("range", ())];
pub(super) const FROM: Rule = Rule::new("from", "time at which the summary begins", "s").from(0.0);

/// Reads when a summary begins, s; none: there is no summary.
pub(super) fn read(reader: &mut Reader<'_, '_>) -> Option<Number> {
    if !reader.has("summary") {
        reader.refuse(FROM.key, "`from` says when a summary begins", "it needs summary = \"range\"");
        return None;
    }
    reader.word("summary", &SUMMARIES, Some(()));
    let from = reader.number_or(&FROM, 0.0);
    // It changes no variable of an FMU.
    reader.context.numbers.slots[from.0].listed = None;
    Some(from)
}

/// Refuses a summary of something else than stations.
pub(super) fn refuse(reader: &mut Reader<'_, '_>) {
    if reader.has("summary") {
        let message = "`summary` belongs to stations along a beam";
        reader.refuse("summary", message, "it needs on = \"BEAM\" instead of `at` or `of`");
        reader.set_aside(FROM.key);
    }
}

/// Why a summary of a run to `stop` s cannot begin at a time; none: it can.
pub(super) fn objection(from: Number, numbers: &Numbers, stop: f64) -> Option<(Number, String)> {
    let is_late = numbers.value(from) >= stop && stop > 0.0;
    is_late.then(|| (from, format!("must be less than simulation.stop, {stop} s: nothing is left to summarize")))
}
