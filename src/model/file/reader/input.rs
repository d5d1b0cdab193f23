//! `input = true`: numbers that the host gives while the model runs. What the file has are their start values.

use super::Context;
use crate::model::file::number::{Number, Written};

/// What becomes of the value of a load during a communication step.
pub const HELD: &str = "held during a communication step";
/// What becomes of the value of a prescribed motion during a communication step.
pub const REACHED: &str = "reached at the end of the communication step, smoothly from the value before";

/// What becomes of a temperature during a communication step.
pub const RAMPED: &str = "reached at the end of the communication step, on a straight line from the value before";

/// What becomes of the value of a switch during a communication step.
pub const SWITCHED: &str = "switched at the start of the communication step";

/// Makes a number an input of the FMU; its name, unit and range stay.
pub(in crate::model) fn make_input(context: &mut Context<'_>, number: Number) {
    make_start(context, number);
    let slot = &mut context.numbers.slots[number.0];
    slot.meta.input = true;
    slot.listed.get_or_insert(usize::MAX);
}

/// Makes sure that a number can be the start value of an input: an expression may stand for it, but neither time nor a
/// parameter may be in it, for an input follows from nothing.
pub(in crate::model) fn make_start(context: &mut Context<'_>, number: Number) {
    let slot = &mut context.numbers.slots[number.0];
    let Written::Formula(formula) = &slot.written else { return };
    if formula.is_constant() && formula.parameters().next().is_none() {
        slot.written = Written::Plain(formula.bound(|_| f64::NAN).value(0.0));
        return;
    }
    let message = format!("`{}` is an input and an expression", slot.meta.name);
    context.report.error(slot.place, &message, "a number was expected: the start value of the input", "");
}
