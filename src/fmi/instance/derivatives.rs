//! Derivatives: of inputs and outputs by time (FMI 2.0, section 4.2.1), of outputs by inputs (section 2.1.9).

use super::Instance;
use crate::fmi::{
    Model,
    error::Error,
    lifecycle::Call,
    variable::{Causality, Variable},
};

impl<M: Model> Instance<M> {
    /// Sets first derivatives of Real inputs by time, for the next step only (section 4.2.1).
    ///
    /// # Errors
    /// The mode does not allow it, a reference is no input, an order is not 1, or a derivative is not finite; none is changed then.
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

    /// Reads first derivatives of Real outputs by time, 1/s of their units (section 4.2.1).
    ///
    /// # Errors
    /// The mode does not allow it, a reference is no output, an order is not 1; or a derivative is that of the last step, and there is none.
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
            let variable = self.output(reference)?;
            if order != 1 {
                return Err(Error::OutputOrder { name: variable.name.clone(), order });
            }
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

    /// The change of `unknowns`, outputs at the end of the last step, when the inputs `knowns` of that step change by `seeds` (section
    /// 2.1.9).
    ///
    /// # Errors
    /// The mode does not allow it, an unknown is no Real output, a known no Real input; or there is no step to differentiate.
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
        for &unknown in unknowns {
            self.output(unknown)?;
        }
        for (&known, &seed) in knowns.iter().zip(seeds) {
            let variable = self.input(known)?;
            if !seed.is_finite() {
                return Err(Error::NotFinite { name: format!("{} (its seed)", variable.name), value: seed });
            }
        }
        for (change, &unknown) in changes.iter_mut().zip(unknowns) {
            let mut sum = 0.0;
            for (&known, &seed) in knowns.iter().zip(seeds) {
                sum += seed * self.model.partial_derivative(unknown as usize, known as usize)?;
            }
            *change = sum;
        }
        Ok(())
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
