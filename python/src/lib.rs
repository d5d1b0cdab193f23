//! The module `ancf14._native`: a simulation as Python sees it, in plain types. The package `ancf14` around it is
//! written in Python.

mod campbell;
mod linear;
mod models;
mod refusal;
mod run;
mod simulation;
mod study;

use ancf14::fmi::location::LIBRARY;
use pyo3::prelude::*;
use std::ffi::OsString;
use std::path::PathBuf;

/// Runs the command line with its arguments, the name of the program first, and returns the exit code. `pack` looks for
/// the library of FMUs next to the file `program`.
#[pyfunction]
fn command(py: Python<'_>, arguments: Vec<OsString>, program: PathBuf) -> u8 {
    py.detach(|| ancf14_cli::main(arguments, Some(&program)))
}

#[pymodule]
fn _native(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("LIBRARY", LIBRARY)?;
    module.add_class::<linear::LinearSystem>()?;
    module.add_class::<campbell::FoundCampbell>()?;
    module.add_class::<simulation::Simulation>()?;
    module.add_function(wrap_pyfunction!(command, module)?)?;
    module.add_function(wrap_pyfunction!(models::table, module)?)?;
    module.add_function(wrap_pyfunction!(study::study, module)?)?;
    module.add("Refusal", module.py().get_type::<refusal::Refusal>())
}
