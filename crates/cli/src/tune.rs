//! `tune`: runs a model until its results are accurate, and writes the numbers that it took into a copy of the file.

use super::inputs::Inputs;
use super::loading::failed;
use super::output::{self, Input};
use super::progress::{self, bar};
use super::{INPUTS, MODEL_FILE, Stop, background, complain, is_piped, load, name, say};
use ancf14::fmi::{Failure, Model};
use ancf14::model::file::{self, Folder, Reach};
use ancf14::model::refinement::{Found, Outcome, Refinement};
use ancf14::model::rows;
use ancf14::model::run::accuracy::{Differences, Inexact};
use ancf14::model::simulation::Simulation;
use std::path::{Path, PathBuf};

/// The ending of the file that is written where none is named.
const ENDING: &str = "tuned.toml";
/// A difference from the finest run that readers should know of, as a share of the range of a result.
const TOLD: f64 = 0.002;

/// What the runs of a model have found.
pub struct Search {
    /// The last run that counts, and its rows.
    last: Box<Simulation>,
    rows: Vec<Vec<f64>>,
    /// What its file must say.
    pub found: Found,
    /// The runs in numbers.
    pub outcome: Outcome,
}

/// Repeats `simulation`, with the `inputs` of a table if there is one, until its results are accurate; none: its file
/// leaves nothing to the program.
///
/// # Errors
/// The table has mistakes, or the first run failed.
pub fn search(mut simulation: Simulation, inputs: Option<&Path>, budget: Option<f64>) -> Result<Option<Search>, Stop> {
    let inputs = inputs.map(|path| Inputs::read(path, &mut simulation)).transpose()?;
    let inputs = inputs.as_ref();
    simulation.ask_for_mesh_error(background::start);
    let Some(mut refinement) = Refinement::of(&mut simulation, budget) else { return Ok(None) };
    let mut last = Box::new(simulation);
    let mut first = run(&mut last, inputs, |simulation| refinement.look(simulation));
    let mut next = if first.is_err() { refinement.rescue(&last) } else { None };
    while let Some(mut own) = next.take() {
        match run(&mut own, inputs, |simulation| refinement.look(simulation)) {
            Ok(found) => (last, first) = (own, Ok(found)),
            // The first failure is told.
            Err(_) => next = refinement.rescue(&own),
        }
    }
    let mut rows = first?;
    while let Some(mut next) = refinement.judge(&last) {
        match run(&mut next, inputs, |simulation| refinement.look(simulation)) {
            Ok(found) => (last, rows) = (next, found),
            Err(stop) => refinement.fail(stop.reason()),
        }
    }
    let (found, outcome) = (refinement.found(&last), refinement.outcome(&last));
    Ok(Some(Search { last, rows, found, outcome }))
}

/// Runs to the end, and shows all rows to `look`; returns them.
fn run(
    simulation: &mut Simulation,
    inputs: Option<&Inputs>,
    mut look: impl FnMut(&Simulation),
) -> Result<Vec<Vec<f64>>, Stop> {
    let last = progress::last_row(simulation)?;
    let begin = rows::time(simulation.about(), 0, last);
    if let Some(inputs) = inputs {
        inputs.start(simulation, begin).map_err(|failure| failed(simulation, &failure))?;
    }
    let bar = bar(last);
    let mut found = Vec::new();
    let outcome = (0..=last).try_for_each(|row| {
        let time = rows::time(simulation.about(), row, last);
        let advanced = match inputs {
            _ if row == 0 => simulation.initialize(time),
            Some(inputs) => inputs.advance(simulation, time),
            None => simulation.advance(time),
        };
        advanced.map_err(|failure| failed(simulation, &failure))?;
        look(simulation);
        found.push(simulation.results().to_vec());
        bar.inc(1);
        Ok(())
    });
    bar.finish_and_clear();
    outcome?;
    simulation.conclude();
    // The comparison of the runs tells more.
    simulation.take_warnings();
    Ok(found)
}

/// Writes the numbers that the model file at `path` takes, with the `inputs` of a table if there is one, into a copy of
/// it at `output`, and runs that once.
pub fn tune(
    (path, reach): (&Path, Reach),
    inputs: Option<&Path>,
    output: Option<PathBuf>,
    budget: Option<f64>,
) -> Result<(), Stop> {
    if is_piped(path) {
        return Err(Stop::Bad("error: tune writes a copy of a file: give the file, not a pipe".to_owned()));
    }
    let output = output.unwrap_or_else(|| path.with_extension(ENDING));
    let read: Vec<Input<'_>> = inputs.map(|path| (INPUTS, path)).into_iter().chain([(MODEL_FILE, path)]).collect();
    output::spare(&read, std::slice::from_ref(&output))?;
    output::try_out(&output)?;
    let (simulation, _) = load(path, &[], reach)?;
    let text = file::text(path).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    let Some(search) = search(simulation, inputs, budget)? else {
        let message = "error: tune has nothing to find: the model file gives its steps and its elements, or begins with \
                       a state";
        return Err(Stop::Bad(message.to_owned()));
    };
    say(&search.outcome.line())?;
    search.outcome.warning().iter().for_each(|warning| complain(&format!("warning: {warning}")));
    let written = search.found.written(search.last.document(), &text);
    let written = written.map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
    output::write(&output, written.as_bytes())?;
    let settings = search.found.settings();
    let settings = if settings.is_empty() { "as it was".to_owned() } else { settings.join(", ") };
    say(&format!("{}: {settings}", output.display()))?;
    tell_difference(&search, (&output, inputs), &written, reach)
}

/// Runs the text that was written to `output`, and tells how far it is from the finest run.
fn tell_difference(
    search: &Search,
    (output, inputs): (&Path, Option<&Path>),
    text: &str,
    reach: Reach,
) -> Result<(), Stop> {
    let folder = output.parent().map(|path| Folder::new(path, reach));
    let loaded = Simulation::load_in(folder, &name(output), text, &[]);
    let mut simulation = loaded.map_err(|Failure { message, .. }| Stop::Failed(message))?;
    let inputs = inputs.map(|path| Inputs::read(path, &mut simulation)).transpose()?;
    let (mut differences, mut row) = (Differences::default(), 0);
    run(&mut simulation, inputs.as_ref(), |own| {
        search.rows.get(row).into_iter().for_each(|other| own.compare(other, &mut differences));
        row += 1;
    })?;
    let distances = simulation.distances(&differences, |_, _| 1.0);
    let worst = distances.into_iter().max_by(|a, b| a.error.total_cmp(&b.error));
    match worst {
        Some(worst) if worst.error > TOLD => {
            complain(&format!("warning: {}", words(&worst)));
            Ok(())
        }
        Some(worst) if worst.error > 0.0 => say(&words(&worst)),
        _ => say("results of a run of this file are bit-identical to those of the finest run"),
    }
}

/// How far a run of the file is from the finest run.
fn words(worst: &Inexact) -> String {
    format!(
        "a run of this file differs from the finest run by {} of the range of {}, because its steps or its path differ",
        worst.size(),
        worst.name
    )
}
