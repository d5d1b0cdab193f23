//! Derivatives: of inputs and outputs by time (FMI 2.0, section 4.2.1), of outputs by inputs (section 2.1.9).

use super::Instance;
use crate::fmi::{
    Model,
    error::Error,
    lifecycle::{Call, Mode},
    variable::{Causality, Variable},
};

impl<M: Model> Instance<M> {
    /// Sets first derivatives of Real inputs by time, for the next step only (section 4.2.1).
    ///
    /// # Errors
    /// The mode does not allow it, a reference is no input, an order is not 1, or a derivative is not finite; none is
    /// changed then.
    pub fn set_real_input_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        derivatives: &[f64],
    ) -> Result<(), Error> {
        self.check(Call::SetRealInputDerivatives)?;
        self.same_length(references.len(), derivatives.len())?;
        self.same_length(references.len(), orders.len())?;
        for ((&reference, &order), &derivative) in references.iter().zip(orders).zip(derivatives) {
            let variable = self.input(reference)?;
            if order != 1 {
                return Err(Error::InputOrder { name: variable.name.clone(), order });
            }
            if !derivative.is_finite() {
                return Err(Error::NotFinite { name: variable.name.clone(), value: derivative });
            }
        }
        for (&reference, &derivative) in references.iter().zip(derivatives) {
            self.model.set_input_derivative(reference as usize, derivative);
        }
        Ok(())
    }

    /// Reads first derivatives of Real outputs by time, 1/s of their units (section 4.2.1); in Initialization Mode too,
    /// of the initial state.
    ///
    /// # Errors
    /// The mode does not allow it, a reference is no output, an order is not 1, or the initial state cannot be found.
    pub fn get_real_output_derivatives(
        &mut self,
        references: &[u32],
        orders: &[i32],
        derivatives: &mut [f64],
    ) -> Result<(), Error> {
        self.check(Call::GetRealOutputDerivatives)?;
        self.same_length(references.len(), derivatives.len())?;
        self.same_length(references.len(), orders.len())?;
        for (&reference, &order) in references.iter().zip(orders) {
            self.check_output_order(reference, order)?;
        }
        self.output_derivatives(references, derivatives)
    }

    /// Whether the derivative of this order by time can be read.
    pub(super) fn check_output_order(&self, reference: u32, order: i32) -> Result<(), Error> {
        let variable = self.output(reference)?;
        match order {
            1 => Ok(()),
            _ => Err(Error::OutputOrder { name: variable.name.clone(), order }),
        }
    }

    /// First derivatives by time of outputs.
    pub(super) fn output_derivatives(&mut self, references: &[u32], derivatives: &mut [f64]) -> Result<(), Error> {
        for &reference in references {
            self.output(reference)?;
        }
        match self.mode() {
            Mode::Initialization => self.solve_initial_state()?,
            Mode::Update => self.look_between()?,
            _ => (),
        }
        // All are there, or none is read: the model keeps what it has computed.
        for &reference in references {
            self.model.output_derivative(reference as usize)?;
        }
        for (derivative, &reference) in derivatives.iter_mut().zip(references) {
            *derivative = self.model.output_derivative(reference as usize)?;
        }
        Ok(())
    }

    /// The change of `unknowns` when `knowns` change by `seeds` (section 2.1.9): of outputs at the end of the last step
    /// with the inputs of that step, none before there is a step; in Initialization Mode and in Model Exchange of what
    /// is calculated with the inputs, parameters and states that it follows from.
    ///
    /// # Errors
    /// The mode does not allow it, an unknown or a known is none in this mode, or there is no derivative; none is
    /// written then.
    pub fn directional_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seeds: &[f64],
        changes: &mut [f64],
    ) -> Result<(), Error> {
        self.check(Call::GetDirectionalDerivative)?;
        self.same_length(unknowns.len(), changes.len())?;
        self.same_length(knowns.len(), seeds.len())?;
        self.check_roles(unknowns, knowns)?;
        self.check_seeds(knowns, seeds)?;
        self.start_derivatives()?;
        // All are there, or none is written: the model keeps what it has computed.
        for &unknown in unknowns {
            self.change(unknown, knowns, seeds)?;
        }
        self.pass_on_warnings();
        for (change, &unknown) in changes.iter_mut().zip(unknowns) {
            *change = self.change(unknown, knowns, seeds)?;
        }
        Ok(())
    }

    /// The transposed product (FMI 3.0, section 2.2.11): for each of the `knowns` the sum of the derivatives of the
    /// `unknowns` with respect to it, each times its seed. The model has the derivatives of the step with respect to
    /// all inputs once they have been asked for.
    ///
    /// # Errors
    /// As [`Self::directional_derivative`].
    pub fn adjoint_derivative(
        &mut self,
        unknowns: &[u32],
        knowns: &[u32],
        seeds: &[f64],
        changes: &mut [f64],
    ) -> Result<(), Error> {
        self.check(Call::GetAdjointDerivative)?;
        self.same_length(unknowns.len(), seeds.len())?;
        self.same_length(knowns.len(), changes.len())?;
        self.check_roles(unknowns, knowns)?;
        self.check_seeds(unknowns, seeds)?;
        self.start_derivatives()?;
        for &known in knowns {
            self.adjoint(unknowns, seeds, known)?;
        }
        self.pass_on_warnings();
        for (change, &known) in changes.iter_mut().zip(knowns) {
            *change = self.adjoint(unknowns, seeds, known)?;
        }
        Ok(())
    }

    /// Whether these are unknowns and knowns in this mode.
    fn check_roles(&self, unknowns: &[u32], knowns: &[u32]) -> Result<(), Error> {
        let starts = self.is_at_instant();
        for &unknown in unknowns {
            if starts {
                self.calculated(unknown)?
            } else {
                self.output(unknown)?
            };
        }
        for &known in knowns {
            if starts {
                self.given(known)?
            } else {
                self.input(known)?
            };
        }
        Ok(())
    }

    /// Derivatives in Initialization Mode are those of the initial state.
    fn start_derivatives(&mut self) -> Result<(), Error> {
        match self.mode() {
            Mode::Initialization => self.solve_initial_state(),
            _ => Ok(()),
        }
    }

    fn check_seeds(&self, references: &[u32], seeds: &[f64]) -> Result<(), Error> {
        for (&reference, &seed) in references.iter().zip(seeds) {
            if !seed.is_finite() {
                let name = format!("{} (its seed)", self.row(reference)?.name);
                return Err(Error::NotFinite { name, value: seed });
            }
        }
        Ok(())
    }

    /// The change of one unknown: the sum of its derivatives with respect to the knowns, each times its seed.
    fn change(&mut self, unknown: u32, knowns: &[u32], seeds: &[f64]) -> Result<f64, Error> {
        let mut sum = 0.0;
        for (&known, &seed) in knowns.iter().zip(seeds) {
            sum += seed * self.derivative(unknown, known)?;
        }
        self.finite(sum, unknown)
    }

    /// The adjoint derivative of one known: the sum of the derivatives of the unknowns with respect to it, each times
    /// its seed.
    fn adjoint(&mut self, unknowns: &[u32], seeds: &[f64], known: u32) -> Result<f64, Error> {
        let mut sum = 0.0;
        for (&unknown, &seed) in unknowns.iter().zip(seeds) {
            sum += seed * self.derivative(unknown, known)?;
        }
        self.finite(sum, known)
    }

    /// The derivative of one unknown with respect to one known.
    fn derivative(&mut self, unknown: u32, known: u32) -> Result<f64, Error> {
        let (unknown, known) = (unknown as usize, known as usize);
        Ok(match self.is_at_instant() {
            true => self.model.initial_derivative(unknown, known)?,
            false => self.model.partial_derivative(unknown, known)?,
        })
    }

    fn finite(&self, sum: f64, reference: u32) -> Result<f64, Error> {
        match sum.is_finite() {
            true => Ok(sum),
            false => Err(Error::SeedTooLarge { name: self.variable::<f64>(reference)?.name.clone(), value: sum }),
        }
    }

    /// The row of a Real that the initialization calculates.
    fn calculated(&self, reference: u32) -> Result<&Variable, Error> {
        let variable = self.variable::<f64>(reference)?;
        match variable.causality {
            Causality::Output | Causality::CalculatedParameter => Ok(variable),
            Causality::Local if !variable.is_state() => Ok(variable),
            _ => Err(Error::NotCalculated { name: variable.name.clone() }),
        }
    }

    /// The row of a Real that the initialization begins with.
    fn given(&self, reference: u32) -> Result<&Variable, Error> {
        let variable = self.variable::<f64>(reference)?;
        match variable.causality {
            Causality::Input | Causality::Parameter => Ok(variable),
            Causality::Local if variable.is_state() => Ok(variable),
            _ => Err(Error::NotGiven { name: variable.name.clone() }),
        }
    }

    /// The row of a Real input.
    fn input(&self, reference: u32) -> Result<&Variable, Error> {
        let variable = self.variable::<f64>(reference)?;
        match variable.causality {
            Causality::Input => Ok(variable),
            _ => Err(Error::NoInput { name: variable.name.clone() }),
        }
    }

    /// The row of a Real output.
    fn output(&self, reference: u32) -> Result<&Variable, Error> {
        let variable = self.variable::<f64>(reference)?;
        match variable.causality {
            Causality::Output => Ok(variable),
            _ => Err(Error::NoOutput { name: variable.name.clone() }),
        }
    }
}
