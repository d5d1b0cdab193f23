//! Model Exchange asks a model for `x' = f(x, u)` and `y = g(x, u)`; the host integrates the states `x`.
//!
//! States and their derivatives are rows of the variable table, read and set as all others.

use super::Failure;

/// The inputs of an evaluation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Inputs {
    /// Those that are set: results are those of this instant.
    Set,
    /// Those that the last step ended with; outputs stay.
    Last,
}

/// A model whose states a host may integrate.
pub trait Continuous {
    /// Goes to a time, s.
    fn set_time(&mut self, time: f64);

    /// Makes derivatives, and with [`Inputs::Set`] outputs too, those of the states. Costs nothing where nothing has
    /// changed.
    ///
    /// # Errors
    /// A result is too large for a number; all stay as they were.
    fn evaluate(&mut self, inputs: Inputs) -> Result<(), Failure>;
}
