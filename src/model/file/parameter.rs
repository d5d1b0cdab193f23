//! The parameters of a model: the rows of the FMI variable table that come from the file.

use super::number::{Number, Numbers, Slot, Written};
use super::unit;
use crate::fmi::Value;
use crate::fmi::variable::{Causality, Variability, Variable};

/// A number that can be changed from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its index in the flat list.
    pub number: Number,
    /// Its row of the variable table.
    pub variable: Variable,
}

impl Parameter {
    /// All parameters, in file order.
    pub(super) fn table(numbers: &Numbers) -> Vec<Self> {
        let mut list: Vec<(usize, Self)> = Vec::new();
        for (place, slot) in numbers.slots.iter().enumerate() {
            // A key given as an expression is no parameter; an entry of [parameters] is a calculated one.
            let named = place < numbers.named;
            let Some(order) = slot.listed.filter(|_| named || matches!(slot.written, Written::Plain(_))) else {
                continue;
            };
            list.push((order, Self { number: Number(place), variable: row(slot, numbers.values[place]) }));
        }
        list.sort_by_key(|(order, _)| *order);
        list.into_iter().map(|(_, parameter)| parameter).collect()
    }

    /// Whether the host gives it while the model runs.
    pub fn is_input(&self) -> bool {
        self.variable.causality == Causality::Input
    }

    /// Whether it follows from others and cannot be set.
    pub fn is_calculated(&self) -> bool {
        self.variable.causality == Causality::CalculatedParameter
    }
}

fn row(slot: &Slot, value: f64) -> Variable {
    let meta = &slot.meta;
    Variable {
        name: meta.name.clone(),
        description: meta.description.clone(),
        causality: match slot.written {
            _ if meta.input => Causality::Input,
            Written::Plain(_) => Causality::Parameter,
            _ => Causality::CalculatedParameter,
        },
        variability: match (meta.input, meta.tunable) {
            (true, _) => Variability::Continuous,
            (false, true) => Variability::Tunable,
            (false, false) => Variability::Fixed,
        },
        start: typed(slot, value),
        // FMI's limits belong to the range: one that does not is left out, and the refusal says it.
        min: meta.range.lower.filter(|limit| limit.included).map(|limit| limit.value),
        max: meta.range.upper.filter(|limit| limit.included).map(|limit| limit.value),
        quantity: unit::quantity(&meta.unit),
        nominal: None,
        display_unit: meta.display.clone(),
        found_from: None,
        derivative_of: None,
        follows_from: Vec::new(),
    }
}

pub(super) fn typed(slot: &Slot, value: f64) -> Value {
    // The range of counts is within i32.
    if slot.meta.integer { Value::Integer(value as i32) } else { Value::Real(value) }
}
