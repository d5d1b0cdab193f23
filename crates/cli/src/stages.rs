//! States that runs leave in files, and begin with: a motion in stages.

use super::{Stop, complain, failed, output, say};
use ancf14::fmi::Model;
use ancf14::model::notes;
use ancf14::model::simulation::{Beginning, Kept, Simulation};
use std::fs;
use std::path::{Path, PathBuf};

/// The state of another run as messages call it.
pub const STATE: &str = "the state that the run begins with";

/// Reads the state that `simulation` is to begin with, and says whether it continues the run that left it.
pub fn read(path: &Path, simulation: &Simulation) -> Result<Beginning, Stop> {
    let name = path.display();
    let bytes = fs::read(path).map_err(|reason| Stop::Bad(format!("error: cannot read {name}: {reason}")))?;
    let kept = Kept::read(&bytes).map_err(|problem| {
        Stop::Bad(format!("error: {name} is not a state written by `ancf14 run --save-state`: {problem}"))
    })?;
    let beginning = simulation.fit(kept).map_err(|problem| Stop::Bad(format!("error: {name}: {problem}")))?;
    match beginning.continues() {
        true => say(&format!("continues the run that left {name}")),
        false => say(&format!("begins with the state of {name}: the model file or its overrides differ")),
    }?;
    Ok(beginning)
}

/// The file of the state that the model file names, where `simulation` is to begin with one; says so. It cannot be
/// verified then.
pub fn named(simulation: &Simulation, model: &Path, is_verified: bool) -> Result<Option<PathBuf>, Stop> {
    let Some(state) = simulation.first_state() else { return Ok(None) };
    let path = model.parent().unwrap_or(Path::new("")).join(&state.name);
    if is_verified {
        let reason =
            "error: a run that begins with a state cannot be verified: the model file has simulation.from_state";
        return Err(Stop::Bad(format!("{reason}; leave out --verify")));
    }
    say(&format!("begins with the state of {}, as the model file says", path.display()))?;
    Ok(Some(path))
}

/// The message about two states to begin with.
pub fn named_twice(given: &Path, named: &Path) -> Stop {
    let (given, named) = (given.display(), named.display());
    Stop::Bad(format!(
        "error: --from-state names {given}, and simulation.from_state of the model file names {named}: a run begins with one state. Leave out one of the two"
    ))
}

/// Begins with a state, with the warnings about it and about the file.
pub fn start(simulation: &mut Simulation, beginning: &Beginning) -> Result<(), Stop> {
    let notes = notes::notes(simulation.document());
    let begun = simulation.begin_from(beginning);
    for warning in notes.into_iter().chain(simulation.take_warnings()) {
        complain(&format!("warning: {warning}"));
    }
    begun.map_err(|failure| failed(simulation, &failure))
}

/// Writes the state that `simulation` has reached.
pub fn save(path: &Path, simulation: &Simulation) -> Result<(), Stop> {
    let bytes = simulation.keep().map_err(|failure| failed(simulation, &failure))?;
    output::write(path, &bytes)
}
