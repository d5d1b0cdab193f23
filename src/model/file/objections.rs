//! Reports the numbers that are not what they must be: out of range, or without a value in a table.

use super::entries::Parts;
use super::number::{Number, Numbers, Written};
use crate::model::text::diagnostic::Report;

/// Reports every number that asks a table for a value it does not have, as far as that is known before a run to `stop`
/// s, and gives them back.
pub(super) fn report_undefined(numbers: &Numbers, stop: f64, report: &mut Report<'_>) -> Vec<Number> {
    let mut list = Vec::new();
    for (number, time, undefined) in numbers.undefined(stop) {
        let slot = &numbers.slots[number.0];
        let at = if numbers.function(number).is_constant() { String::new() } else { format!(" at t = {time} s") };
        let help =
            format!("add rows to the table, or set outside = \"hold\" or \"repeat\" in [function.{}]", undefined.name);
        let message = format!("`{}` has no value{at}", slot.meta.name);
        report.error(slot.place, &message, &undefined.to_string(), &help);
        list.push(number);
    }
    list
}

/// Reports every number that is out of its range in a run to `stop` s, but for those that are reported already.
pub(super) fn report_objections(numbers: &Numbers, parts: &Parts, stop: f64, told: &[Number], report: &mut Report<'_>) {
    let together = parts.objections(numbers, stop);
    let objections = numbers.objections().into_iter().filter(|(number, _)| !told.contains(number));
    for (number, objection) in objections.chain(together) {
        let slot = &numbers.slots[number.0];
        let value = numbers.values[number.0];
        let unit = if slot.meta.unit.is_empty() || !value.is_finite() { "" } else { &format!(" {}", slot.meta.unit) };
        let verb = if matches!(slot.written, Written::Plain(_)) { "this is" } else { "this gives" };
        let label = match &slot.written {
            Written::Formula(formula) if !formula.is_constant() => String::new(),
            _ => format!("{verb} {value}{unit}"),
        };
        report.error(slot.place, &format!("`{}` {objection}", slot.meta.name), &label, "");
    }
}
