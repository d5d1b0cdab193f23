//! What FMI 3.0 adds: arrays, the time as a variable, and communication steps with an update after each internal step.

use super::Instance;
use crate::fmi::{
    Model,
    error::Error,
    lifecycle::{Call, Mode},
    variable::{Causality, Variability},
};

/// Where a communication step is after one of its internal steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// The time reached, s.
    pub time: f64,
    /// Whether it is the end of the communication step.
    pub arrived: bool,
}

impl<M: Model> Instance<M> {
    /// Enters Initialization Mode, with the experiment that FMI 2.0 sets up before (section 2.3.2).
    ///
    /// # Errors
    /// As [`Self::setup_experiment`] and [`Self::enter_initialization_mode`]; the instance stays as it is.
    pub fn enter_initialization_mode_for(
        &mut self,
        tolerance: Option<f64>,
        start: f64,
        stop: Option<f64>,
    ) -> Result<(), Error> {
        self.setup_experiment(tolerance, start, stop)?;
        self.enter_initialization_mode()
    }

    /// Warns of required intermediate variables that can neither be read nor set during an intermediate update.
    /// Others can, required or not.
    pub fn require_between(&mut self, references: &[u32]) {
        for &reference in references {
            if reference == self.arrays.time {
                continue;
            }
            if let Err(error) = self.elements(reference).and_then(|_| self.between(reference)) {
                self.warn(format!("a required intermediate variable is not offered: {error}"));
            }
        }
    }

    /// Whether a variable can be read during an intermediate update: continuous outputs and continuous inputs.
    ///
    /// # Errors
    /// It cannot.
    pub(super) fn between(&self, reference: u32) -> Result<(), Error> {
        let variable = self.row(reference)?;
        let is_between = matches!(variable.causality, Causality::Input | Causality::Output);
        match is_between && variable.variability == Variability::Continuous {
            true => Ok(()),
            false => Err(Error::NotBetween { name: variable.name.clone() }),
        }
    }

    /// Reads Float64 variables, arrays element by element.
    ///
    /// # Errors
    /// As [`Self::get_real`]; or the number of values is not that of the elements.
    pub fn get_float64(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Error> {
        self.check(Call::GetReal)?;
        self.spread(references, values.len(), |instance, rows| instance.get_real(rows, values))
    }

    /// Reads Int32 variables.
    ///
    /// # Errors
    /// As [`Self::get_float64`].
    pub fn get_int32(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Error> {
        self.check(Call::GetInteger)?;
        self.spread(references, values.len(), |instance, rows| instance.get_integer(rows, values))
    }

    /// Sets Float64 variables: all of them, or none if one is refused.
    ///
    /// # Errors
    /// As [`Self::set_real`]; or the number of values is not that of the elements.
    pub fn set_float64(&mut self, references: &[u32], values: &[f64]) -> Result<(), Error> {
        self.check(Call::SetReal)?;
        self.spread(references, values.len(), |instance, rows| instance.set_real(rows, values))
    }

    /// Sets Int32 variables.
    ///
    /// # Errors
    /// As [`Self::set_float64`].
    pub fn set_int32(&mut self, references: &[u32], values: &[i32]) -> Result<(), Error> {
        self.check(Call::SetInteger)?;
        self.spread(references, values.len(), |instance, rows| instance.set_integer(rows, values))
    }

    /// Reads or sets variables of a type that no variable has.
    ///
    /// # Errors
    /// The mode does not allow `call`, or any reference is given.
    pub fn no_variable(&self, call: Call, references: &[u32], asked: &'static str) -> Result<(), Error> {
        self.check(call)?;
        self.none_of_type(references, asked)
    }

    /// The derivatives by time of Float64 outputs, of order 1, arrays element by element.
    ///
    /// # Errors
    /// As [`Self::get_real_output_derivatives`]; or the number of values is not that of the elements.
    pub fn get_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        derivatives: &mut [f64],
    ) -> Result<(), Error> {
        self.check(Call::GetRealOutputDerivatives)?;
        for (&reference, &order) in references.iter().zip(orders) {
            self.check_output_order(reference, order)?;
        }
        self.spread(references, derivatives.len(), |instance, rows| instance.output_derivatives(rows, derivatives))
    }

    /// [`Self::directional_derivative`] with arrays, element by element.
    ///
    /// # Errors
    /// As there; or the number of values is not that of the elements.
    pub fn directional_derivative_of_arrays(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seeds: &[f64],
        changes: &mut [f64],
    ) -> Result<(), Error> {
        self.check(Call::GetDirectionalDerivative)?;
        self.spread(unknowns, changes.len(), |instance, unknowns| {
            instance.spread(knowns, seeds.len(), |instance, knowns| {
                instance.directional_derivative(unknowns, knowns, seeds, changes)
            })
        })
    }

    /// [`Self::adjoint_derivative`] with arrays, element by element.
    ///
    /// # Errors
    /// As there; or the number of values is not that of the elements.
    pub fn adjoint_derivative_of_arrays(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seeds: &[f64],
        changes: &mut [f64],
    ) -> Result<(), Error> {
        self.check(Call::GetAdjointDerivative)?;
        self.spread(unknowns, seeds.len(), |instance, unknowns| {
            instance.spread(knowns, changes.len(), |instance, knowns| {
                instance.adjoint_derivative(unknowns, knowns, seeds, changes)
            })
        })
    }

    /// Begins a communication step that is taken in parts (section 4.2.1): [`Self::take_part`] until it arrives, each
    /// followed by
    /// [`Self::go_on`] or [`Self::return_early`].
    ///
    /// # Errors
    /// As [`Self::do_step`].
    pub fn begin_step(&mut self, time: f64, step: f64) -> Result<(), Error> {
        self.check(Call::DoStep)?;
        let end = self.end_of_step(time, step)?;
        self.depart(end)
    }

    /// Begins a step to `end`, s, that is taken in parts.
    fn depart(&mut self, end: f64) -> Result<(), Error> {
        self.accept_step(end)?;
        let outcome = self.model.begin_step(end);
        self.after_step(outcome)?;
        (self.arrays.end, self.arrays.split) = (Some(end), false);
        Ok(())
    }

    /// Takes an internal step and enters Intermediate Update Mode.
    ///
    /// # Errors
    /// As [`Self::do_step`].
    pub fn take_part(&mut self) -> Result<Progress, Error> {
        self.check(Call::DoStep)?;
        let outcome = self.model.take_part();
        let arrived = self.after_step(outcome)?;
        self.control.mode = Mode::Update;
        self.arrays.looked = arrived;
        if arrived {
            self.arrays.end = None;
        }
        Ok(Progress { time: self.model.time(), arrived })
    }

    /// Leaves Intermediate Update Mode. If inputs were set there, the rest of the communication step begins anew.
    ///
    /// # Errors
    /// The instance has become unusable during the update; or as [`Self::begin_step`], at the time that is reached.
    pub fn go_on(&mut self) -> Result<(), Error> {
        self.leave_update()?;
        match self.arrays.end.filter(|_| self.arrays.split) {
            Some(end) => self.depart(end),
            None => Ok(()),
        }
    }

    /// Leaves Intermediate Update Mode, and ends the communication step where it is.
    ///
    /// # Errors
    /// As [`Self::go_on`] and [`Self::do_step`].
    pub fn return_early(&mut self) -> Result<(), Error> {
        self.leave_update()?;
        let time = self.model.time();
        self.event(|| format!("the host ends the step at t = {time} s"));
        // One that inputs have split is over already.
        let outcome = if self.arrays.split { Ok(()) } else { self.model.end_step() };
        self.after_step(outcome)
    }

    fn leave_update(&mut self) -> Result<(), Error> {
        if self.control.mode == Mode::Update {
            self.control.mode = Mode::Step;
        }
        self.check(Call::DoStep)
    }

    /// Whether inputs that are set now split the communication step: they act on the rest of it only.
    pub(super) fn is_to_split(&self) -> bool {
        self.control.mode == Mode::Update && self.arrays.end.is_some() && !self.arrays.split
    }

    /// Ends the part of the communication step that the inputs so far act on.
    pub(super) fn split(&mut self) -> Result<(), Error> {
        let outcome = self.model.end_step();
        self.after_step(outcome)?;
        (self.arrays.looked, self.arrays.split) = (true, true);
        Ok(())
    }

    /// The results of the time that an intermediate update is at.
    pub(super) fn look_between(&mut self) -> Result<(), Error> {
        if !self.arrays.looked {
            self.model.look_between()?;
            self.arrays.looked = true;
        }
        Ok(())
    }

    /// Calls `body` with the rows of all elements of variables, which must be as many as `values`.
    fn spread<R>(
        &mut self,
        references: &[u32],
        values: usize,
        body: impl FnOnce(&mut Self, &[u32]) -> Result<R, Error>,
    ) -> Result<R, Error> {
        let mut rows = self.arrays.rows.pop().unwrap_or_default();
        rows.clear();
        let outcome = self.add_elements(references, &mut rows).and_then(|()| match rows.len() == values {
            true => body(self, &rows),
            false => Err(Error::ValuesDiffer { needed: rows.len(), given: values }),
        });
        self.arrays.rows.push(rows);
        outcome
    }

    fn add_elements(&self, references: &[u32], rows: &mut Vec<u32>) -> Result<(), Error> {
        for &reference in references {
            rows.extend(reference..reference + self.elements(reference)?);
        }
        Ok(())
    }

    /// Number of elements of a variable.
    pub(super) fn elements(&self, reference: u32) -> Result<u32, Error> {
        match self.arrays.lengths.get(reference as usize) {
            None if reference == self.arrays.time => Ok(1),
            None => self.row(reference).map(|_| 1),
            Some(0) => Err(Error::Element { name: self.row(reference)?.name.clone(), reference }),
            Some(&count) => Ok(count),
        }
    }
}
