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
    package::write(output, simulation.about(), simulation.variables(), text, &library).map_err(failed)?;
    say(&format!("{} packed, with {}", output.display(), library.display()));
    Ok(())
}

/// Writes the C header of the model.
pub fn header(simulation: &Simulation, output: &Path) -> Result<(), Stop> {
    let about = simulation.about();
    let text = header::text(about, simulation.variables(), &about.identifier).map_err(failed)?;
    write(output, &text)?;
    say(&format!("{} written", output.display()));
    Ok(())
}

fn failed(reason: Error) -> Stop {
    Stop::Failed(format!("error: {reason}"))
}
