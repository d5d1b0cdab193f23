//! Model Exchange (FMI 2.0, section 3.2; FMI 3.0, section 3.2): the host integrates the states. The unit has no events:
//! neither its states nor their nominal values ever jump.

use super::Instance;
use crate::fmi::{
    Model,
    continuous::Inputs,
    error::Error,
    lifecycle::{Call, Kind, Mode, Standard},
};

impl<M: Model> Instance<M> {
    /// A new instance for Model Exchange.
    ///
    /// # Errors
    /// The model has no states that a host may integrate.
    pub fn for_model_exchange(standard: Standard, model: M, logging_on: bool) -> Result<Self, Error> {
        let mut instance = Self::of(standard, model, logging_on);
        if instance.model.continuous().is_none() {
            let remedy = match standard {
                Standard::Fmi2 => "pass fmi2CoSimulation as fmuType",
                Standard::Fmi3 => "call fmi3InstantiateCoSimulation",
            };
            return Err(Error::Instantiate(format!("this unit is for co-simulation only; {remedy}")));
        }
        instance.kind = Kind::ModelExchange;
        Ok(instance)
    }

    /// The rows of the states, each with that of its derivative.
    fn states(&self) -> impl Iterator<Item = (usize, usize)> {
        let rows = self.model.variables().iter().enumerate();
        rows.filter_map(|(row, variable)| variable.derivative_of.map(|state| (state, row)))
    }

    /// Number of continuous states.
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn count_states(&self) -> Result<usize, Error> {
        self.check(Call::GetNumberOfContinuousStates)?;
        Ok(self.states().count())
    }

    /// Number of event indicators: there are none.
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn count_indicators(&self) -> Result<usize, Error> {
        self.check(Call::GetNumberOfEventIndicators)?;
        Ok(0)
    }

    /// Whether a host that asks for `given` event indicators knows that there are none.
    ///
    /// # Errors
    /// The mode does not allow it, or some are asked for.
    pub fn event_indicators(&self, given: usize) -> Result<(), Error> {
        self.check(Call::GetEventIndicators)?;
        counted(0, given)
    }

    /// Enters Event Mode, where inputs may jump.
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn enter_event_mode(&mut self) -> Result<(), Error> {
        self.enter(Call::EnterEventMode, Mode::Event)
    }

    /// Enters Continuous-Time Mode.
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn enter_continuous_time_mode(&mut self) -> Result<(), Error> {
        self.enter(Call::EnterContinuousTimeMode, Mode::ContinuousTime)
    }

    fn enter(&mut self, call: Call, mode: Mode) -> Result<(), Error> {
        self.check(call)?;
        self.control.mode = mode;
        self.event(|| format!("{mode}"));
        Ok(())
    }

    /// Sets the time, s. A solver may look beyond the stop time.
    ///
    /// # Errors
    /// The mode does not allow it, or the time is not finite.
    pub fn set_time(&mut self, time: f64) -> Result<(), Error> {
        self.check(Call::SetTime)?;
        if !time.is_finite() {
            return Err(Error::NotFinite { name: String::from("time"), value: time });
        }
        if let Some(model) = self.model.continuous() {
            model.set_time(time);
        }
        Ok(())
    }

    /// Sets the states: all of them, or none if one is refused.
    ///
    /// # Errors
    /// The mode does not allow it, they are not as many as there are, or one is not finite.
    pub fn set_continuous_states(&mut self, states: &[f64]) -> Result<(), Error> {
        self.check(Call::SetContinuousStates)?;
        let mut rows = self.arrays.rows.pop().unwrap_or_default();
        rows.clear();
        rows.extend(self.states().map(|(state, _)| state as u32));
        let outcome = counted(rows.len(), states.len()).and_then(|()| self.set_real(&rows, states));
        self.arrays.rows.push(rows);
        outcome
    }

    /// Reads the states.
    ///
    /// # Errors
    /// The mode does not allow it, or they are not as many as there are.
    pub fn get_continuous_states(&mut self, states: &mut [f64]) -> Result<(), Error> {
        self.read(Call::GetContinuousStates, states, |(state, _)| state)
    }

    /// Reads the derivatives of the states by time, 1/s of their units.
    ///
    /// # Errors
    /// The mode does not allow it, they are not as many as there are, or one is too large for a number.
    pub fn get_derivatives(&mut self, derivatives: &mut [f64]) -> Result<(), Error> {
        self.read(Call::GetContinuousStateDerivatives, derivatives, |(_, derivative)| derivative)
    }

    fn read(&mut self, call: Call, values: &mut [f64], row: impl Fn((usize, usize)) -> usize) -> Result<(), Error> {
        self.check(call)?;
        counted(self.states().count(), values.len())?;
        if call == Call::GetContinuousStateDerivatives {
            if self.mode() == Mode::Initialization {
                self.solve_initial_state()?;
            }
            self.settle(true)?;
        }
        for (value, pair) in values.iter_mut().zip(self.states()) {
            *value = self.model.value(row(pair)).number();
        }
        Ok(())
    }

    /// Reads the orders of magnitude of the states.
    ///
    /// # Errors
    /// The mode does not allow it, or they are not as many as there are.
    pub fn get_nominals(&self, nominals: &mut [f64]) -> Result<(), Error> {
        self.check(Call::GetNominalsOfContinuousStates)?;
        counted(self.states().count(), nominals.len())?;
        for (nominal, (state, _)) in nominals.iter_mut().zip(self.states()) {
            *nominal = self.model.variables()[state].nominal.unwrap_or(1.0);
        }
        Ok(())
    }

    /// Makes results those of this instant: in Model Exchange outputs and derivatives of the states, else, where
    /// `rates` are wanted, derivatives at the end of the last step.
    pub(super) fn settle(&mut self, rates: bool) -> Result<(), Error> {
        let inputs = match (self.kind, self.mode()) {
            (Kind::ModelExchange, Mode::Event | Mode::ContinuousTime | Mode::Terminated) => Inputs::Set,
            (_, Mode::Initialization | Mode::Step | Mode::Terminated | Mode::Error) if rates => Inputs::Last,
            _ => return Ok(()),
        };
        match self.model.continuous() {
            Some(model) => model.evaluate(inputs)?,
            None => return Ok(()),
        }
        self.pass_on_warnings();
        Ok(())
    }

    /// Whether the derivatives that can be asked for now are those of an instant.
    pub(super) fn is_at_instant(&self) -> bool {
        self.mode() == Mode::Initialization || self.kind == Kind::ModelExchange
    }

    /// Whether an instance of this kind can go back to a state in this mode.
    ///
    /// # Errors
    /// The state is of an instance of the other kind.
    pub(super) fn fits(&self, mode: Mode) -> Result<(), Error> {
        let kind = match mode {
            Mode::Event | Mode::ContinuousTime => Kind::ModelExchange,
            Mode::Step | Mode::Error | Mode::Update => Kind::CoSimulation,
            Mode::Instantiated | Mode::Initialization | Mode::Terminated | Mode::Fatal => self.kind,
        };
        match kind == self.kind {
            true => Ok(()),
            false => Err(Error::OtherKind { theirs: kind, own: self.kind }),
        }
    }
}

/// Whether a host passes as many values as there are.
fn counted(needed: usize, given: usize) -> Result<(), Error> {
    if needed == given { Ok(()) } else { Err(Error::StatesDiffer { needed, given }) }
}
