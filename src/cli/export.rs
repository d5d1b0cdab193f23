//! `pack` and `header`: what leaves for other programs.

use super::{Stop, say, write};
use ancf14::fmi::{Model, error::Error, header, package};
use ancf14::model::simulation::Simulation;
use std::path::Path;

/// Packs the model as an FMU.
pub fn pack(simulation: &Simulation, text: &str, output: &Path, library: Option<&Path>) -> Result<(), Stop> {
    let executable = std::env::current_exe()
        .map_err(|reason| Stop::Failed(format!("error: this program cannot find itself: {reason}")))?;
    // No library at the place that was given is a wrong argument; a failed write is not.
    let library =
        package::find_library(library, &executable).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let shown = library.display().to_string();
    let libraries = [(package::Platform::NATIVE, library)];
    package::write(output, simulation.about(), simulation.variables(), text, &libraries).map_err(failed)?;
    say(&format!("{} packed, with {shown}", output.display()));
    Ok(())
}

/// Writes the C header of the model; `prefix` begins its names, by default the model's identifier.
pub fn header(simulation: &Simulation, output: &Path, prefix: Option<&str>) -> Result<(), Stop> {
    let about = simulation.about();
    let prefix = prefix.unwrap_or(&about.identifier);
    let text = header::text(about, simulation.variables(), prefix).map_err(failed)?;
    write(output, &text)?;
    say(&format!("{} written", output.display()));
    Ok(())
}

fn failed(reason: Error) -> Stop {
    Stop::Failed(format!("error: {reason}"))
}
