//! Reading and writing variables (FMI 2.0, section 2.1.7): all of a call, or nothing.

use super::Instance;
use crate::fmi::{
    Model, Value,
    error::Error,
    lifecycle::{Call, Mode, Standard},
    variable::{Causality, Variability, Variable, type_word},
};

/// A number type of FMI that variables here can have.
pub(super) trait Number: Copy {
    /// FMI's name of the type.
    const NAME: &'static str;

    fn from_value(value: Value) -> Option<Self>;

    fn into_value(self) -> Value;

    /// The time, s; none: it is not of this type.
    fn from_time(time: f64) -> Option<Self>;
}

impl Number for f64 {
    const NAME: &'static str = "Real";

    fn from_value(value: Value) -> Option<Self> {
        match value {
            Value::Real(number) => Some(number),
            Value::Integer(_) => None,
        }
    }

    fn into_value(self) -> Value {
        Value::Real(self)
    }

    fn from_time(time: f64) -> Option<Self> {
        Some(time)
    }
}

impl Number for i32 {
    const NAME: &'static str = "Integer";

    fn from_value(value: Value) -> Option<Self> {
        match value {
            Value::Integer(number) => Some(number),
            Value::Real(_) => None,
        }
    }

    fn into_value(self) -> Value {
        Value::Integer(self)
    }

    fn from_time(_time: f64) -> Option<Self> {
        None
    }
}

impl<M: Model> Instance<M> {
    /// Reads Real variables.
    ///
    /// # Errors
    /// The mode does not allow it, a reference or type is wrong, or the initial state cannot be found; `values` is
    /// untouched then.
    pub fn get_real(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Error> {
        self.check(Call::GetReal)?;
        self.get(references, values)
    }

    /// Reads Integer variables.
    ///
    /// # Errors
    /// As [`Self::get_real`].
    pub fn get_integer(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Error> {
        self.check(Call::GetInteger)?;
        self.get(references, values)
    }

    /// Reads Boolean variables, of which there are none.
    ///
    /// # Errors
    /// The mode does not allow it, or any reference is given.
    pub fn get_boolean(&mut self, references: &[u32]) -> Result<(), Error> {
        self.check(Call::GetBoolean)?;
        self.none_of_type(references, "Boolean")
    }

    /// Reads String variables, of which there are none.
    ///
    /// # Errors
    /// The mode does not allow it, or any reference is given.
    pub fn get_string(&mut self, references: &[u32]) -> Result<(), Error> {
        self.check(Call::GetString)?;
        self.none_of_type(references, "String")
    }

    /// Sets Real variables.
    ///
    /// # Errors
    /// The mode does not allow it, or a reference, a type or a value is refused; no value is changed then.
    pub fn set_real(&mut self, references: &[u32], values: &[f64]) -> Result<(), Error> {
        self.check(Call::SetReal)?;
        self.set(references, values)
    }

    /// Sets Integer variables.
    ///
    /// # Errors
    /// As [`Self::set_real`].
    pub fn set_integer(&mut self, references: &[u32], values: &[i32]) -> Result<(), Error> {
        self.check(Call::SetInteger)?;
        self.set(references, values)
    }

    /// Sets Boolean variables, of which there are none.
    ///
    /// # Errors
    /// The mode does not allow it, or any reference is given.
    pub fn set_boolean(&mut self, references: &[u32]) -> Result<(), Error> {
        self.check(Call::SetBoolean)?;
        self.none_of_type(references, "Boolean")
    }

    /// Sets String variables, of which there are none.
    ///
    /// # Errors
    /// The mode does not allow it, or any reference is given.
    pub fn set_string(&mut self, references: &[u32]) -> Result<(), Error> {
        self.check(Call::SetString)?;
        self.none_of_type(references, "String")
    }

    fn get<T: Number>(&mut self, references: &[u32], values: &mut [T]) -> Result<(), Error> {
        self.same_length(references.len(), values.len())?;
        let (mut results_wanted, mut rates_wanted) = (false, false);
        for &reference in references {
            if self.time_at::<T>(reference).is_none() {
                let variable = self.variable::<T>(reference)?;
                rates_wanted |= variable.derivative_of.is_some();
                results_wanted |= is_result(variable);
                if self.mode() == Mode::Update {
                    self.between(reference)?;
                }
            }
        }
        match self.mode() {
            Mode::Instantiated if results_wanted && self.standard == Standard::Fmi2 => self.warn_early(),
            Mode::Initialization if results_wanted => self.solve_initial_state()?,
            Mode::Update if results_wanted => self.look_between()?,
            _ => (),
        }
        if results_wanted {
            self.settle(rates_wanted)?;
        }
        for (value, &reference) in values.iter_mut().zip(references) {
            *value = match self.time_at(reference) {
                Some(time) => time,
                None => {
                    T::from_value(self.model.value(reference as usize)).expect("a variable keeps the type of its start")
                }
            };
        }
        Ok(())
    }

    /// The time, where `reference` is that of the independent variable of FMI 3.0 and the time has this type.
    fn time_at<T: Number>(&self, reference: u32) -> Option<T> {
        let is_time = self.standard == Standard::Fmi3 && reference == self.arrays.time;
        if is_time { T::from_time(self.time()) } else { None }
    }

    fn set<T: Number>(&mut self, references: &[u32], values: &[T]) -> Result<(), Error> {
        self.same_length(references.len(), values.len())?;
        for (&reference, &value) in references.iter().zip(values) {
            let variable = self.variable::<T>(reference)?;
            may_be_set(variable, self.mode())?;
            in_range(variable, value.into_value())?;
        }
        self.assign(references, values)?;
        if references.is_empty() {
            return Ok(());
        }
        if self.is_to_split() {
            // The part of the step that is done had the values before, and keeps them.
            self.take_back();
            self.split()?;
            self.assign(references, values)?;
        }
        self.control.solved = false;
        Ok(())
    }

    /// Hands checked values to the model: all of them, or none if it refuses one.
    fn assign<T: Number>(&mut self, references: &[u32], values: &[T]) -> Result<(), Error> {
        self.undo.clear();
        for (&reference, &value) in references.iter().zip(values) {
            let place = reference as usize;
            let before = self.model.value(place);
            if let Err(failure) = self.model.set_value(place, value.into_value()) {
                self.take_back();
                return Err(failure.into());
            }
            self.undo.push((place, before));
        }
        Ok(())
    }

    /// Undoes the values set so far in this call, the last one first.
    fn take_back(&mut self) {
        while let Some((place, before)) = self.undo.pop() {
            if let Err(failure) = self.model.set_value(place, before) {
                self.warn(format!("a value could not be set back: {}", failure.message));
            }
        }
    }

    fn warn_early(&mut self) {
        if !self.control.warned_early {
            self.control.warned_early = true;
            self.object(
                "results were read before initialization: these are start values; the results of the initial state \
                 are there from fmi2EnterInitializationMode on"
                    .to_owned(),
            );
        }
    }

    /// The row of a reference, if its type is `T`.
    pub(super) fn variable<T: Number>(&self, reference: u32) -> Result<&Variable, Error> {
        let variable = self.row(reference)?;
        match T::from_value(variable.start) {
            Some(_) => Ok(variable),
            None => Err(self.wrong_type(variable, reference, T::NAME)),
        }
    }

    pub(super) fn none_of_type(&self, references: &[u32], asked: &'static str) -> Result<(), Error> {
        match references.first() {
            Some(&reference) => Err(self.wrong_type(self.row(reference)?, reference, asked)),
            None => Ok(()),
        }
    }

    pub(super) fn row(&self, reference: u32) -> Result<&Variable, Error> {
        let variables = self.model.variables();
        variables.get(reference as usize).ok_or(Error::UnknownReference { reference, count: variables.len() })
    }

    fn wrong_type(&self, variable: &Variable, reference: u32, asked: &'static str) -> Error {
        let (actual, asked) = (variable.type_name_in(self.standard), type_word(self.standard, asked));
        Error::WrongType { name: variable.name.clone(), reference, actual, asked }
    }

    pub(super) fn same_length(&self, references: usize, values: usize) -> Result<(), Error> {
        if references == values { Ok(()) } else { Err(Error::LengthsDiffer { references, values }) }
    }
}

/// Whether the value needs the initial state. Calculated parameters follow from others at once.
fn is_result(variable: &Variable) -> bool {
    variable.causality == Causality::Output || variable.derivative_of.is_some()
}

/// Parameters, inputs and states up to the end of the initialization, afterwards inputs and tunable parameters; between
/// internal steps continuous inputs; in Continuous-Time Mode states too.
fn may_be_set(variable: &Variable, mode: Mode) -> Result<(), Error> {
    match (variable.causality, variable.variability) {
        (Causality::Input, Variability::Continuous) => Ok(()),
        (Causality::Input | Causality::Parameter, _) if mode == Mode::Update => {
            Err(Error::NotBetween { name: variable.name.clone() })
        }
        (Causality::Input, _) | (Causality::Parameter, Variability::Tunable) => Ok(()),
        (Causality::Parameter, _) if matches!(mode, Mode::Instantiated | Mode::Initialization) => Ok(()),
        (Causality::Parameter, _) => Err(Error::Fixed { name: variable.name.clone() }),
        (Causality::Local, _) if variable.is_state() => match mode {
            Mode::Instantiated | Mode::Initialization | Mode::ContinuousTime => Ok(()),
            _ => Err(Error::State { name: variable.name.clone() }),
        },
        _ => Err(Error::Result { name: variable.name.clone() }),
    }
}

/// Finite and within `min` and `max`.
fn in_range(variable: &Variable, value: Value) -> Result<(), Error> {
    let number = value.number();
    if !number.is_finite() {
        return Err(Error::NotFinite { name: variable.name.clone(), value: number });
    }
    if variable.min.is_none_or(|min| number >= min) && variable.max.is_none_or(|max| number <= max) {
        return Ok(());
    }
    let unit = match variable.quantity.unit.as_str() {
        "" => String::new(),
        unit => format!(" {unit}"),
    };
    let bounds = match (variable.min, variable.max) {
        (Some(min), Some(max)) => format!("between {min} and {max}"),
        (Some(min), None) => format!("at least {min}"),
        (None, Some(max)) => format!("at most {max}"),
        (None, None) => "any finite number".to_owned(),
    };
    Err(Error::OutOfRange { name: variable.name.clone(), value: number, unit, bounds })
}
