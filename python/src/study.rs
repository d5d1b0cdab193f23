//! Points of a study, one after the other on one thread: the model is read once, and a run gathers only what the study
//! keeps.

use crate::refusal::place;
use crate::run::{bytes, on_a_thread};
use ancf14::error::decimal;
use ancf14::model::notes;
use ancf14::model::refinement::leaves_mesh;
use ancf14::{Error, Kind, Reach, Simulation, VariableId};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A point: why it failed; warnings; the times of its rows, s; the values of the wanted columns, row by row.
type Point = (Option<String>, Vec<String>, Py<PyBytes>, Py<PyBytes>);

/// A point before Python sees it.
#[derive(Default)]
struct Done {
    error: Option<String>,
    warnings: Vec<String>,
    times: Vec<f64>,
    values: Vec<f64>,
}

/// The changes of a model file, by key.
type Overrides = Vec<(String, String)>;

/// Runs the `points`, each the model with these changes, and gathers the `columns`: their names, and of each vector and
/// table among them how many numbers it has. Warnings of errors are about the results `judged`.
#[pyfunction]
pub fn study(
    py: Python<'_>,
    source: (String, String, Option<PathBuf>, bool),
    points: Vec<Overrides>,
    columns: (Vec<String>, Vec<(String, usize)>),
    judged: Vec<String>,
) -> PyResult<Vec<Point>> {
    let (wanted, shapes) = columns;
    let is_over = Arc::new(AtomicBool::new(false));
    let own_over = Arc::clone(&is_over);
    let work = move || {
        let mut bench = Bench { source, wanted, shapes, judged, kept: None };
        let points = points.iter().take_while(|_| !own_over.load(Ordering::Relaxed));
        points.map(|changes| bench.run_safely(changes, &own_over)).collect::<Vec<Done>>()
    };
    let done = on_a_thread(py, work, &is_over)?;
    let point =
        |Done { error, warnings, times, values }: Done| (error, warnings, bytes(py, &times), bytes(py, &values));
    Ok(done.into_iter().map(point).collect())
}

/// Where points run.
struct Bench {
    /// Name, text and folder of the model file, and whether it may name files elsewhere.
    source: (String, String, Option<PathBuf>, bool),
    wanted: Vec<String>,
    shapes: Vec<(String, usize)>,
    judged: Vec<String>,
    /// That of the point before.
    kept: Option<Kept>,
}

/// A simulation that points share.
struct Kept {
    simulation: Simulation,
    /// The changes that it was loaded with.
    loaded: Overrides,
    /// The notes about its file.
    notes: Vec<String>,
}

impl Bench {
    /// Runs a point. A fault in it leaves the others alone.
    fn run_safely(&mut self, changes: &Overrides, is_over: &AtomicBool) -> Done {
        let outcome = catch_unwind(AssertUnwindSafe(|| self.run(changes, is_over)));
        outcome.unwrap_or_else(|_| {
            self.kept = None;
            Done {
                error: Some(String::from("internal fault, please report it: this run has panicked")),
                ..Done::default()
            }
        })
    }

    /// Runs a point.
    fn run(&mut self, changes: &Overrides, is_over: &AtomicBool) -> Done {
        let mut done = Done::default();
        let kept = self.kept.take().and_then(|kept| kept.with(changes));
        let is_kept = kept.is_some();
        let mut own = match kept.map_or_else(|| self.load(changes), Ok) {
            Ok(own) => own,
            Err(error) => return Done { error: Some(error), ..done },
        };
        let simulation = &mut own.simulation;
        done.warnings.clone_from(&own.notes);
        let outcome = gather(simulation, &self.wanted, is_over, &mut done);
        done.warnings.extend(simulation.take_warnings());
        match outcome {
            Ok(()) => self.kept = Some(own),
            // Messages quote the changes that the model was loaded with.
            Err(_) if is_kept => return self.run(changes, is_over),
            Err(error) => {
                let located = place(simulation, &error).map(|(message, _)| message);
                done.error = Some(located.unwrap_or_else(|| error.to_string()));
            }
        }
        done
    }

    /// Loads the model with these changes.
    fn load(&self, changes: &Overrides) -> Result<Kept, String> {
        let loaded = self.read(changes).map_err(|error| error.to_string())?;
        let names: Vec<&str> = loaded.simulation.variables().map(|variable| variable.name).collect();
        for (base, count) in &self.shapes {
            let is_own = |name: &&&str| name.strip_prefix(base.as_str()).is_some_and(|rest| rest.starts_with('['));
            let own = names.iter().filter(is_own).count();
            if own != *count {
                return Err(format!(
                    "`{base}` has {own} numbers here and {count} in the model; a study needs one shape in all runs"
                ));
            }
        }
        Ok(loaded)
    }

    fn read(&self, changes: &Overrides) -> Result<Kept, Error> {
        let (name, text, folder, allow_outside) = &self.source;
        let pairs: Vec<(&str, &str)> = changes.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
        let reach = if *allow_outside { Reach::Anywhere } else { Reach::Inside };
        let mut simulation = match folder {
            Some(folder) => Simulation::from_text_in(folder, reach, name, text, &pairs)?,
            None => Simulation::from_text_with(name, text, &pairs)?,
        };
        let judged: Vec<&str> = self.judged.iter().map(String::as_str).collect();
        simulation.judge_only(&judged)?;
        let notes = simulation.take_warnings();
        Ok(Kept { simulation, loaded: changes.clone(), notes })
    }
}

impl Kept {
    /// The same simulation at its start, with other changes; none: it must be loaded anew, as where a change decides
    /// about the mesh or the rows.
    fn with(mut self, changes: &Overrides) -> Option<Self> {
        let Self { simulation, loaded, notes } = &mut self;
        if !loaded.iter().map(|(key, _)| key).eq(changes.iter().map(|(key, _)| key)) {
            return None;
        }
        simulation.reset().ok()?;
        let others: Vec<&(String, String)> =
            changes.iter().zip(&*loaded).filter(|(own, loaded)| own != loaded).map(|(own, _)| own).collect();
        set(simulation, &others)?;
        simulation.take_warnings();
        let document = simulation.model().document();
        let rows = [document.value(document.simulation.stop), document.output_step()];
        // Automatic meshes, and the rows, are those of the file as it was loaded.
        if leaves_mesh(document) || rows != [simulation.stop_time(), simulation.output_step()] {
            return None;
        }
        // Notes quote the changes that the model was loaded with.
        let quotes = |note: &String| others.iter().any(|(key, _)| note.contains(key.as_str()));
        let is_same = notes::notes(simulation.model().document()) == *notes && !notes.iter().any(quotes);
        is_same.then_some(self)
    }
}

/// Sets parameters to numbers; none: one is something else, as a word or the end of the run.
fn set(simulation: &mut Simulation, changes: &[&(String, String)]) -> Option<()> {
    changes.iter().try_for_each(|(key, value)| {
        let id = simulation.find(key).ok()?;
        let kind = simulation.variable(id.index()).ok()?.kind;
        let number = value.parse().ok().filter(|_| matches!(kind, Kind::Parameter | Kind::Tunable))?;
        simulation.set_value_of(id, number).ok()
    })
}

/// Runs to the end, row by row, until it is over.
fn gather(simulation: &mut Simulation, wanted: &[String], is_over: &AtomicBool, done: &mut Done) -> Result<(), Error> {
    let columns = wanted.iter().map(|name| simulation.find(name)).collect::<Result<Vec<VariableId>, _>>()?;
    simulation.run_while(|simulation| {
        done.times.push(decimal(simulation.time()));
        for id in &columns {
            done.values.push(simulation.value_of(*id)?);
        }
        Ok(!is_over.load(Ordering::Relaxed))
    })
}
