//! Reads a model and finds its initial state, with the messages of both.

use super::voice::complain;
use super::{Stop, is_piped, name};
use ancf14::fmi::{Failure, Model};
use ancf14::model::document::Document;
use ancf14::model::file::{Folder, Reach};
use ancf14::model::simulation::Simulation;
use ancf14::model::{builder, file, missed_damping, notes};
use std::io;
use std::path::Path;
use std::sync::OnceLock;

/// Reads a model file; gives its text too, without copies and includes.
pub fn load(path: &Path, overrides: &[(String, String)], reach: Reach) -> Result<(Simulation, String), Stop> {
    let name = name(path);
    let read = if is_piped(path) { piped(&name) } else { file::text(path) };
    let text = read.map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    // The parts of a model from a pipe are those of the current folder.
    let folder = path.parent().map(|path| Folder::new(path, reach));
    let simulation = Simulation::load_in(folder, &name, &text, overrides).map_err(|Failure { message, .. }| {
        let mistakes = Document::parse_in(folder, &name, &text, overrides)
            .and_then(|document| builder::build(&document, 0.0).map(drop))
            .err();
        mistakes.map_or(Stop::Bad(message), Stop::Mistaken)
    })?;
    let text = simulation.document().text().to_owned();
    Ok((simulation, text))
}

/// The text of the standard input. Some commands load their model twice, and a pipe is read once only.
fn piped(name: &str) -> Result<String, String> {
    static TEXT: OnceLock<String> = OnceLock::new();
    if let Some(text) = TEXT.get() {
        return Ok(text.clone());
    }
    let text = file::piped(name, io::stdin())?;
    Ok(TEXT.get_or_init(|| text).clone())
}

/// Finds the initial state, with the warnings about it and about the file.
pub fn start(simulation: &mut Simulation) -> Result<(), Stop> {
    let notes = notes::notes(simulation.document());
    let start = simulation.about().start;
    let initialized = simulation.initialize(start);
    let missed = initialized.as_ref().ok().and_then(|()| missed_damping::missed_ratio(simulation));
    for warning in notes.into_iter().chain(missed).chain(simulation.take_warnings()) {
        complain(&format!("warning: {warning}"));
    }
    initialized.map_err(|failure| failed(simulation, &failure))
}

/// The message about a simulation that failed, with the line of the part that it names.
pub fn failed(simulation: &Simulation, failure: &Failure) -> Stop {
    let Failure { message, .. } = failure;
    let located = simulation.document().locate(message);
    Stop::Failed(located.map_or_else(|| format!("error: {message}"), |mistake| mistake.to_string()))
}
