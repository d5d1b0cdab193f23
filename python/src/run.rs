//! A whole run, on a thread of its own: the calling thread waits without the GIL, and looks for signals in between.
//!
//! A row of results that takes long does not delay Ctrl-C: the calling thread takes the rows so far and leaves; the
//! other thread ends after its row.

use crate::refusal::{Refusal, place, raised, refusal};
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::model::ranges::{Range, Ranges};
use ancf14::model::refinement::{Outcome as RefinementOutcome, Refinement, is_repeated};
use ancf14::model::rows;
use ancf14::model::simulation::Halt;
use ancf14::{Error, Kind, Simulation, VariableId};
use ancf14_view::Film;
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// How often the calling thread looks for signals: no person notices the delay.
const LOOK: Duration = Duration::from_millis(50);
/// How long a row may take to notice an interruption.
const GRACE: Duration = Duration::from_millis(100);
/// The stack of the thread, bytes: that of a main thread on Linux.
const STACK: usize = 8 << 20;

/// What a run leaves: times, s; the values of all outputs, row by row (doubles in the order of bytes of the machine);
/// warnings; the exception that ended it; the page; the ranges along beams; what repetitions have found.
pub type Outcome =
    (Py<PyBytes>, Py<PyBytes>, Vec<String>, Option<Py<PyAny>>, Option<String>, Vec<FoundRange>, Option<FoundSettings>);

/// What repetitions have found: overrides for a run like the last one; the runs in a line; the warning where the
/// accuracy is not reached; the text of the file without copies and includes with these numbers, or the reason why there
/// is none.
type FoundSettings = (Vec<(String, String)>, String, Option<String>, Option<String>, String);

/// A range along a beam: its name, unit and meaning, how many components it has, the arc lengths of its stations, m,
/// and of each component at each station minimum, time, maximum, time, mean.
type FoundRange = (String, String, String, usize, Vec<f64>, Vec<f64>);

/// What there is so far.
#[derive(Default)]
struct Rows {
    times: Vec<f64>,
    values: Vec<f64>,
    warnings: Vec<String>,
    ranges: Ranges,
}

impl Rows {
    /// Takes the rows of a later run; the warnings about the start stay those of the first one.
    fn take(&mut self, later: Mutex<Self>) {
        let later = later.into_inner().unwrap_or_else(PoisonError::into_inner);
        (self.times, self.values, self.ranges) = (later.times, later.values, later.ranges);
    }
}

/// How the other thread ended: with the page and what it found, or with an error and the line it names.
type End = (Result<(), (Error, Option<(String, usize)>)>, Option<String>, Option<FoundSettings>);

/// Runs a simulation, and repeats it with finer steps and meshes if asked to `refine`, or if nothing is said where the
/// file leaves the elements of a beam to the program; an interruption halts its comparison run.
pub fn run(
    py: Python<'_>,
    (mut simulation, halt): (Simulation, &Halt),
    names: &[String],
    inputs: Vec<f64>,
    (film, last): (bool, Option<u64>),
    (refine, budget): (Option<bool>, Option<f64>),
) -> PyResult<Outcome> {
    let driven: Vec<VariableId> =
        names.iter().map(|name| simulation.find(name)).collect::<Result<_, _>>().map_err(|error| refusal(&error))?;
    let rows = Arc::new(Mutex::new(Rows::default()));
    let is_over = Arc::new(AtomicBool::new(false));
    let (send, mut receive) = channel::<End>();
    let (own_rows, own_over) = (Arc::clone(&rows), Arc::clone(&is_over));
    let work = move || {
        let new_film = |simulation: &Simulation| {
            film.then(|| Film::new(simulation.model(), whole(simulation).min(last.unwrap_or(u64::MAX))))
        };
        let mut film = new_film(&simulation);
        // A page of some rows, and a run that its caller ends, are what they are.
        let is_asked = refine.unwrap_or_else(|| is_repeated(simulation.model().document()));
        let mut refinement = if is_asked && last.is_none() { simulation.refine(budget) } else { None };
        let driven = (&*driven, &*inputs);
        let mut outcome =
            advance(&mut simulation, &own_rows, &own_over, driven, film.as_mut(), last, refinement.as_mut());
        if let (Err(_), Some(refinement)) = (&outcome, refinement.as_mut()) {
            let mut next = simulation.rescued(refinement);
            while let Some(mut own) = next.take().filter(|_| !own_over.load(Ordering::Relaxed)) {
                let (rows, mut own_film) = (Mutex::new(Rows::default()), new_film(&own));
                match advance(&mut own, &rows, &own_over, driven, own_film.as_mut(), last, Some(&mut *refinement)) {
                    Ok(()) => {
                        locked(&own_rows).take(rows);
                        (simulation, film, outcome) = (own, own_film, Ok(()));
                    }
                    // The first failure is told.
                    Err(_) => next = own.rescued(refinement),
                }
            }
        }
        let mut warnings = simulation.take_warnings();
        let mut settings = None;
        if let Some(refinement) = refinement.as_mut().filter(|_| outcome.is_ok()) {
            while !own_over.load(Ordering::Relaxed)
                && let Some(mut next) = simulation.repeated(refinement)
            {
                let (rows, mut next_film) = (Mutex::new(Rows::default()), new_film(&next));
                let parts = (next_film.as_mut(), Some(&mut *refinement));
                match advance(&mut next, &rows, &own_over, driven, parts.0, last, parts.1) {
                    // One that was stopped has fewer rows.
                    Ok(()) if own_over.load(Ordering::Relaxed) => break,
                    Ok(()) => {
                        locked(&own_rows).take(rows);
                        warnings = next.take_warnings();
                        (simulation, film) = (next, next_film);
                    }
                    Err(error) => refinement.fail(error.to_string()),
                }
            }
            let outcome = simulation.outcome(refinement);
            settings = Some(settings_of(&simulation, refinement, &outcome));
            warnings.extend(outcome.warning());
        }
        locked(&own_rows).warnings.extend(warnings);
        let outcome =
            outcome.map_err(|error| (place(&simulation, &error), error)).map_err(|(place, error)| (error, place));
        let page = film.and_then(|film| film.page(None).ok());
        // Nobody waits any more after an interruption.
        let _ = send.send((outcome, page, settings));
    };
    let builder = thread::Builder::new().name("ancf14 run".to_owned()).stack_size(STACK);
    builder.spawn(work).map_err(|reason| PyRuntimeError::new_err(format!("cannot start a thread: {reason}")))?;
    let (error, page, settings) = loop {
        let (ended, back) = wait(py, receive, LOOK);
        receive = back;
        match ended {
            Ok((Ok(()), page, settings)) => break (None, page, settings),
            Ok((Err((error, place)), page, _)) => break (Some(raised(&error, place)), page, None),
            Err(RecvTimeoutError::Disconnected) => {
                let fault = "internal fault, please report it: the thread of the run has panicked";
                break (Some(Refusal::new_err(("run", fault, None::<usize>))), None, None);
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(interruption) = py.check_signals() {
            is_over.store(true, Ordering::Relaxed);
            // The thread of the run may wait for it.
            halt.set();
            let (_, _) = wait(py, receive, GRACE);
            break (Some(interruption), None, None);
        }
    };
    let mut rows = locked(&rows);
    let error = error.map(|error| error.into_value(py).into_any());
    let ranges = found(&rows.ranges);
    Ok((
        bytes(py, &rows.times),
        bytes(py, &rows.values),
        std::mem::take(&mut rows.warnings),
        error,
        page,
        ranges,
        settings,
    ))
}

/// Numbers in the order of bytes of the machine.
pub fn bytes(py: Python<'_>, values: &[f64]) -> Py<PyBytes> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_ne_bytes()).collect();
    PyBytes::new(py, &bytes).unbind()
}

/// Does `work` on a thread of its own while the calling thread waits without the GIL. A signal sets `is_over`, and is
/// raised without waiting for the end of the work.
pub fn on_a_thread<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> T + Send + 'static,
    is_over: &AtomicBool,
) -> PyResult<T> {
    let (send, mut receive) = channel();
    let builder = thread::Builder::new().name("ancf14 run".to_owned()).stack_size(STACK);
    // Nobody waits any more after an interruption.
    let started = builder.spawn(move || drop(send.send(work())));
    started.map_err(|reason| PyRuntimeError::new_err(format!("cannot start a thread: {reason}")))?;
    loop {
        let (ended, back) = wait(py, receive, LOOK);
        receive = back;
        match ended {
            Ok(found) => return Ok(found),
            Err(RecvTimeoutError::Disconnected) => {
                let fault = "internal fault, please report it: the thread of the run has panicked";
                return Err(Refusal::new_err(("run", fault, None::<usize>)));
            }
            Err(RecvTimeoutError::Timeout) => {}
        }
        if let Err(interruption) = py.check_signals() {
            is_over.store(true, Ordering::Relaxed);
            return Err(interruption);
        }
    }
}

/// What the file must say for a run like `simulation`, the last one that counts.
fn settings_of(simulation: &Simulation, refinement: &Refinement, outcome: &RefinementOutcome) -> FoundSettings {
    let found = simulation.found(refinement);
    let (text, reason) = match found.written_flat(simulation.model().document()) {
        Ok(text) => (Some(text), String::new()),
        Err(reason) => (None, reason),
    };
    (found.overrides(), outcome.line(), outcome.shortfall(), text, reason)
}

/// The ranges in plain types.
fn found(ranges: &Ranges) -> Vec<FoundRange> {
    let plain = |range: &Range| {
        let Range { name, unit, meaning, components, stations, .. } = range.clone();
        let values = range.envelopes().flat_map(|own| [own.minimum.as_slice(), &own.maximum, &[own.mean]].concat());
        (name, unit, meaning, components, stations, values.collect())
    };
    ranges.list.iter().map(plain).collect()
}

/// Waits for the end without the GIL; the receiver comes back, since it belongs to one thread at a time.
fn wait<T: Send>(py: Python<'_>, receive: Receiver<T>, time: Duration) -> (Result<T, RecvTimeoutError>, Receiver<T>) {
    py.detach(move || (receive.recv_timeout(time), receive))
}

/// Number of the last row of a whole run.
fn whole(simulation: &Simulation) -> u64 {
    rows::last(simulation.model().about()).unwrap_or(0)
}

/// What [`Simulation::run`] does, row by row, until it is over; sets the inputs before each row.
fn advance(
    simulation: &mut Simulation,
    rows: &Mutex<Rows>,
    is_over: &AtomicBool,
    (driven, inputs): (&[VariableId], &[f64]),
    mut film: Option<&mut Film>,
    last: Option<u64>,
    mut refinement: Option<&mut Refinement>,
) -> Result<(), Error> {
    let outputs: Vec<VariableId> =
        simulation.variables().filter(|variable| variable.kind == Kind::Output).map(|variable| variable.id).collect();
    let set = |simulation: &mut Simulation, row: u64| {
        let at = usize::try_from(row).unwrap_or(usize::MAX).saturating_mul(driven.len());
        let values = inputs.get(at..).unwrap_or_default();
        driven.iter().zip(values).try_for_each(|(id, value)| simulation.set_value_of(*id, *value))
    };
    simulation.look_at_all_steps();
    set(simulation, 0)?;
    let mut row = 0;
    simulation.run_while(|simulation| {
        if let Some(film) = &mut film {
            film.look(row, simulation.model());
        }
        if let Some(refinement) = &mut refinement {
            simulation.look(refinement);
        }
        let mut rows = locked(rows);
        if row == 0 {
            rows.warnings.append(&mut simulation.take_warnings());
            rows.ranges = simulation.model().ranges();
        }
        // The row first: of equal values it is the one that is told.
        rows.ranges.include(decimal(simulation.time()), simulation.model().results());
        rows.ranges.include_between(simulation.model().between_rows());
        rows.times.push(decimal(simulation.time()));
        for id in &outputs {
            rows.values.push(simulation.value_of(*id)?);
        }
        drop(rows);
        simulation.begin_row();
        // The value of this row acts until the next one.
        if row > 0 {
            set(simulation, row)?;
        }
        row += 1;
        Ok(!is_over.load(Ordering::Relaxed) && last.is_none_or(|last| row <= last))
    })
}

/// A poisoned lock has rows that are whole up to the last one.
fn locked(rows: &Mutex<Rows>) -> MutexGuard<'_, Rows> {
    rows.lock().unwrap_or_else(PoisonError::into_inner)
}
