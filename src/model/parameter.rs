//! The parameters of a model: the rows of the FMI variable table that come from the file, and their change.

use super::document::Document;
use super::number::{Number, Numbers, Slot, Written};
use super::unit;
use crate::fmi::Value;
use crate::fmi::variable::{Causality, Variability, Variable};

/// A number that can be changed from outside.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its place in the flat list.
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
        display_unit: meta.display.clone(),
        found_from: None,
    }
}

fn typed(slot: &Slot, value: f64) -> Value {
    // The range of counts is within i32.
    if slot.meta.integer { Value::Integer(value as i32) } else { Value::Real(value) }
}

impl Document {
    /// The parameters in file order: an FMI host sees them so.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The start value that the file gives a number; none: it is no parameter and no input.
    pub fn start(&self, number: Number) -> Option<f64> {
        self.parameters.iter().find(|row| row.number == number).map(|row| row.variable.start.number())
    }

    /// The value of parameter `index` of [`Self::parameters`].
    pub fn parameter_value(&self, index: usize) -> Value {
        let Number(place) = self.parameters[index].number;
        typed(&self.numbers.slots[place], self.numbers.values[place])
    }

    /// Sets parameter `index` and what follows from it. Numbers that follow are checked by [`Self::check`], once all are set:
    /// a host sets them one after another.
    ///
    /// # Errors
    /// The parameter is calculated, the type is wrong or the value is out of range; nothing has changed.
    pub fn set_parameter(&mut self, index: usize, value: Value) -> Result<(), String> {
        let parameter = &self.parameters[index];
        let slot = &self.numbers.slots[parameter.number.0];
        let name = &slot.meta.name;
        if parameter.is_calculated() {
            return Err(format!("`{name}` follows from other parameters and cannot be set"));
        }
        let value = match value {
            Value::Integer(value) if slot.meta.integer => f64::from(value),
            Value::Real(value) if !slot.meta.integer => value,
            Value::Integer(_) => return Err(format!("`{name}` is a Real, not an Integer")),
            Value::Real(_) => return Err(format!("`{name}` is an Integer, not a Real")),
        };
        let number = parameter.number;
        self.accept(number, value)?;
        self.set_start(number, value);
        if self.feeds_others(index) {
            self.numbers.resolve();
        }
        Ok(())
    }

    /// Whether other numbers may follow from parameter `index`: an entry of `[parameters]`.
    pub fn feeds_others(&self, index: usize) -> bool {
        self.parameters[index].number.0 < self.numbers.named
    }

    /// Whether `number` may have this value.
    ///
    /// # Errors
    /// Why not.
    pub fn accept(&self, number: Number, value: f64) -> Result<(), String> {
        let meta = &self.numbers.slots[number.0].meta;
        match meta.objection(value) {
            Some(objection) => Err(format!("`{}` {objection}, this is {value}", meta.name)),
            None => Ok(()),
        }
    }

    /// Sets a number that nothing follows from, as the start value of an input; the caller has checked it.
    pub fn set_start(&mut self, number: Number, value: f64) {
        self.numbers.slots[number.0].written = Written::Plain(value);
        self.numbers.values[number.0] = value;
    }

    /// The values of all that can be set, in their order: what makes this document of the file.
    pub fn settings(&self) -> Vec<f64> {
        self.settable().map(|number| self.value(number)).collect()
    }

    /// This file with other settings; what follows from them is for [`Self::check`].
    ///
    /// # Errors
    /// Their number or a value is not right.
    pub fn with_settings(&self, settings: &[f64]) -> Result<Self, String> {
        let count = self.settable().count();
        if settings.len() != count {
            return Err(format!("there are {} settings, {count} were expected", settings.len()));
        }
        let mut document = self.clone();
        for (number, value) in self.settable().zip(settings) {
            document.accept(number, *value)?;
            document.set_start(number, *value);
        }
        document.numbers.resolve();
        Ok(document)
    }

    /// The numbers that can be set, in the order of the parameters.
    fn settable(&self) -> impl Iterator<Item = Number> + '_ {
        self.parameters.iter().filter(|parameter| !parameter.is_calculated()).map(|parameter| parameter.number)
    }

    /// Whether everything that follows from the parameters is as it must be.
    ///
    /// # Errors
    /// The first number that is not.
    pub fn check(&self) -> Result<(), String> {
        let tubes = self.sections.iter().filter_map(|section| section.objection(&self.numbers));
        match self.numbers.objections().into_iter().chain(tubes).next() {
            Some((number, objection)) => {
                Err(format!("`{}` {objection}, this is {}", self.name(number), self.value(number)))
            }
            None => Ok(()),
        }
    }

    /// Every parameter back to its start value.
    pub fn reset(&mut self) {
        for parameter in self.parameters.iter().filter(|parameter| !parameter.is_calculated()) {
            let start = match parameter.variable.start {
                Value::Real(value) => value,
                Value::Integer(value) => f64::from(value),
            };
            self.numbers.slots[parameter.number.0].written = Written::Plain(start);
        }
        self.numbers.resolve();
    }
}
