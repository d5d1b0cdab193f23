//! `[parameters]`: named numbers, for expressions and for the user of the FMU.

use crate::fmi::unit::{display_factor, natural};
use crate::model::expression::Variable;
use crate::model::expression::function::Formula;
use crate::model::file::number::{Meta, Number, Slot, Written};
use crate::model::file::range::{Limit, Range};
use crate::model::file::reader::Context;
use crate::model::file::unit::coherent_instead;
use crate::model::text::names::suggestion;
use crate::model::text::tree::{Entry, Item, Node};

/// The keys of a parameter that is given as a table.
const KEYS: [&str; 6] = ["value", "unit", "display", "min", "max", "description"];

/// Puts the entries into the list of numbers, and gives back their values: all names must be in the list before the
/// first expression is read.
pub(in crate::model) fn names<'e>(context: &mut Context<'_>, entries: &'e [Entry]) -> Vec<(Number, &'e Item)> {
    let mut values = Vec::new();
    for entry in entries {
        let number = context.numbers.push(Slot {
            meta: Meta {
                name: entry.key.clone(),
                description: format!("Parameter {} of the model", entry.key),
                unit: String::new(),
                display: None,
                range: Range::ALL,
                integer: false,
                tunable: false,
                input: false,
                variable: Variable::None,
            },
            place: entry.item.place,
            listed: Some(entry.key_place.start),
            written: Written::Broken,
        });
        match &entry.item.node {
            Node::Table(inner) => {
                let value = table(context, number, entry, inner);
                values.extend(value.map(|value| (number, value)));
            }
            _ => values.push((number, &entry.item)),
        }
    }
    context.numbers.named = context.numbers.slots.len();
    values
}

/// Reads the values of the entries.
pub(in crate::model) fn read(context: &mut Context<'_>, values: Vec<(Number, &Item)>) {
    for (number, item) in values {
        let written = written(context, number, item);
        let slot = &mut context.numbers.slots[number.0];
        slot.place = item.place;
        slot.written = written;
    }
}

fn written(context: &mut Context<'_>, number: Number, item: &Item) -> Written {
    match &item.node {
        Node::Integer(value) => Written::Plain(*value as f64),
        Node::Float(value) => Written::Plain(*value),
        Node::Text(text) => match context.program(text, item.place, Variable::None) {
            Some(program) => Written::Formula(Formula::single(program)),
            None => Written::Broken,
        },
        _ => {
            let name = context.numbers.slots[number.0].meta.name.clone();
            context.wrong_type(&name, item, "a number, an expression in quotes, or a table with `value`");
            Written::Broken
        }
    }
}

/// `{ value = 1e-4, unit = "m", min = 0.0 }`; gives the value back.
fn table<'e>(context: &mut Context<'_>, number: Number, entry: &Entry, inner: &'e [Entry]) -> Option<&'e Item> {
    let mut value = None;
    let mut meta = context.numbers.slots[number.0].meta.clone();
    for part in inner {
        match part.key.as_str() {
            "value" => value = Some(&part.item),
            "unit" => meta.unit = text(context, part).unwrap_or_default(),
            "display" => meta.display = text(context, part),
            "description" => {
                if let Some(text) = text(context, part).filter(|text| !text.trim().is_empty()) {
                    meta.description = text;
                }
            }
            "min" => meta.range.lower = limit(context, part),
            "max" => meta.range.upper = limit(context, part),
            unknown => {
                let message = format!("unknown key `{unknown}` in the parameter `{}`", entry.key);
                let help = format!("known here: {}", KEYS.join(", "));
                context.report.error(part.key_place, &message, &suggestion(unknown, KEYS), &help);
            }
        }
    }
    if value.is_none() {
        let message = format!("the parameter `{}` needs the key `value`", entry.key);
        context.report.error(entry.key_place, &message, "missing here", "");
    }
    if let (Some(lower), Some(upper)) = (meta.range.lower, meta.range.upper)
        && lower.value > upper.value
    {
        let place = inner.iter().find(|part| part.key == "min").map_or(entry.key_place, |part| part.item.place);
        let message = format!("min of `{}` is greater than its max", entry.key);
        context.report.error(place, &message, &format!("{} > {}", lower.value, upper.value), "");
    }
    let at = |key: &str| inner.iter().find(|part| part.key == key).map_or(entry.key_place, |part| part.item.place);
    if let Some(coherent) = coherent_instead(&meta.unit) {
        let help = format!("write unit = \"{coherent}\", display = \"{}\" and the number in {coherent}", meta.unit);
        let message = format!("the unit {} would need a conversion", meta.unit);
        context.report.error(at("unit"), &message, "a label only", &help);
    } else if let Some(display) = &meta.display
        && display_factor(&meta.unit, display).is_none()
    {
        let help = format!("units like {}", natural(&meta.unit).join(", "));
        let help = if natural(&meta.unit).is_empty() { "" } else { &help };
        let label = format!("a unit for `{}` was expected", meta.unit);
        context.report.error(at("display"), &format!("`{}` cannot be shown in {display}", entry.key), &label, help);
    }
    context.numbers.slots[number.0].meta = meta;
    value
}

fn text(context: &mut Context<'_>, part: &Entry) -> Option<String> {
    match &part.item.node {
        Node::Text(text) => Some(text.clone()),
        _ => {
            context.wrong_type(&part.key, &part.item, "a string");
            None
        }
    }
}

/// A bound: a number, or an expression without parameters.
fn limit(context: &mut Context<'_>, part: &Entry) -> Option<Limit> {
    let value = match &part.item.node {
        Node::Integer(value) => *value as f64,
        Node::Float(value) => *value,
        Node::Text(text) => {
            let program = context.program(text, part.item.place, Variable::None)?;
            if program.parameters().next().is_some() {
                let message = format!("`{}` uses a parameter", part.key);
                context.report.error(part.item.place, &message, "a bound must stand by itself", "");
                return None;
            }
            program.value(0.0, |_| f64::NAN)
        }
        _ => {
            context.wrong_type(&part.key, &part.item, "a number");
            return None;
        }
    };
    if !value.is_finite() {
        context.report.error(part.item.place, &format!("`{}` is not finite", part.key), "a number was expected", "");
        return None;
    }
    Some(Limit { value, included: true })
}
