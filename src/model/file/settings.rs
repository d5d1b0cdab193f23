//! The values of the parameters of a document, and their change.

use super::document::Document;
use super::entries::section::SectionSpec;
use super::number::{Number, Written};
use super::parameter::{Parameter, typed};
use crate::fmi::Value;

impl Document {
    /// The parameters in file order: an FMI host sees them so.
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The value of parameter `index` of [`Self::parameters`].
    pub fn parameter_value(&self, index: usize) -> Value {
        let Number(place) = self.parameters[index].number;
        typed(&self.numbers.slots[place], self.numbers.values[place])
    }

    /// Sets parameter `index` and what follows from it. Numbers that follow are checked by [`Self::check`], once all
    /// are set: a host sets them one after another.
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
        let together = self.parts.objections(&self.numbers, self.value(self.simulation.stop));
        match self.numbers.objections().into_iter().chain(together).next() {
            Some((number, objection)) => {
                Err(format!("`{}` {objection}, this is {}", self.name(number), self.value(number)))
            }
            None => Ok(()),
        }
    }

    /// The first damping ratio that asks for negative damping, in words: a host may have set it so.
    pub fn negative_damping(&self) -> Option<String> {
        let of_materials = self.materials.iter().map(|material| material.damping);
        let of_sections = self.sections.iter().filter_map(SectionSpec::damping);
        let objection =
            of_materials.chain(of_sections).find_map(|damping| damping.objection(|number| self.value(number)));
        objection
            .map(|(number, objection)| format!("`{}` {objection}, this is {}", self.name(number), self.value(number)))
    }

    /// The first stop whose lower limit is not below its upper one, in words: a host may have set them so.
    pub fn crossed_limits(&self) -> Option<String> {
        self.stops.iter().find_map(|stop| {
            let [lower, upper] = [self.value(stop.lower?), self.value(stop.upper?)];
            (lower >= upper).then(|| {
                let name = &stop.name;
                format!("the lower limit of stop {name}, {lower}, is not below its upper limit, {upper}: set `{name}.lower` or `{name}.upper`")
            })
        })
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
