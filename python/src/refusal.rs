//! Errors as Python sees them: an exception with a kind, a message and a line, which the package turns into its own
//! classes.

use ancf14::{Error, Simulation};
use pyo3::create_exception;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;

create_exception!(
    _native,
    Refusal,
    PyException,
    "Arguments: the kind of the error, its message, and the line of the model file or None."
);

/// An error with its kind: `model` and `run` are raised as such, all others as a mistake of the caller.
pub fn refusal(error: &Error) -> PyErr {
    let line = if let Error::Mistakes { line, .. } = error { *line } else { None };
    let kind = match error {
        Error::Unreadable { .. } | Error::Mistakes { .. } | Error::TooManyRows { .. } => "model",
        Error::UnknownVariable { .. } => "name",
        Error::Failed { .. } | Error::Fault { .. } => "run",
        _ => "call",
    };
    Refusal::new_err((kind, error.to_string(), line))
}

/// The message with the line of the part of the model that the error names, and the number of that line.
pub fn place(simulation: &Simulation, error: &Error) -> Option<(String, usize)> {
    let Error::Failed { reason } = error else { return None };
    let mistake = simulation.model().document().locate(reason)?;
    Some((mistake.to_string(), mistake.line()?))
}

/// The exception of an error whose place is known.
pub fn raised(error: &Error, place: Option<(String, usize)>) -> PyErr {
    match place {
        Some((message, line)) => Refusal::new_err(("run", message, Some(line))),
        None => refusal(error),
    }
}

/// The exception of an error, with the line of the part of the model that it names.
pub fn located(simulation: &Simulation, error: &Error) -> PyErr {
    raised(error, place(simulation, error))
}
