//! States that runs leave in files, and begin with: a motion in stages.

use super::{Stop, complain, failed};
use ancf14::fmi::Model;
use ancf14::model::notes;
use ancf14::model::simulation::{Kept, Simulation};
use std::fs;
use std::path::Path;

/// The state of another run as messages call it.
pub const STATE: &str = "the state that the run begins with";

/// Reads the state that `simulation` is to begin with.
pub fn read(path: &Path, simulation: &Simulation) -> Result<Kept, Stop> {
    let name = path.display();
    let bytes = fs::read(path).map_err(|reason| Stop::Bad(format!("error: cannot read {name}: {reason}")))?;
    let kept = Kept::read(&bytes).map_err(|problem| {
        Stop::Bad(format!(
            "error: {name} is not a state that `ancf14 run --save-state` of this version has written: {problem}"
        ))
    })?;
    simulation.fits(&kept).map_err(|problem| Stop::Bad(format!("error: {name}: {problem}")))?;
    Ok(kept)
}

/// Begins with a state, with the warnings about it and about the file.
pub fn start(simulation: &mut Simulation, kept: &Kept) -> Result<(), Stop> {
    let notes = notes::notes(simulation.document());
    let begun = simulation.begin_from(kept);
    for warning in notes.into_iter().chain(simulation.take_warnings()) {
        complain(&format!("warning: {warning}"));
    }
    begun.map_err(|failure| failed(simulation, &failure))
}
