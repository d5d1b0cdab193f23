//! The library's own functions for programs in C and C++: load a model file, set, advance, read. `docs/programming.md`
//! shows them at work.
//!
//! Every function keeps the rules that stand at the head of `include/ancf14.h`, which are its readers' "Safety": texts
//! end with a zero byte, places can be written to, a simulation is used by one thread at a time.
#![allow(
    clippy::missing_safety_doc,
    reason = "the rules stand once, at the head of the header that C programmers read"
)]

use std::{
    ffi::{c_char, c_int},
    ptr::{null, null_mut},
};

use super::{
    fault,
    front_handle::{Front, Mistake, NO_HANDLE, ask, guard, place, write},
    front_types::*,
    guard::{self as pointers, caught, text},
    live,
};
use crate::model::file::Reach;
use crate::simulation::{Error, SavedState, Simulation};

/// The version of the library: "0.1.0".
#[unsafe(no_mangle)]
pub extern "C" fn ancf14_version() -> *const c_char {
    const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "\0");
    VERSION.as_ptr().cast()
}

/// Loads the model file at `path`. `overrides` is NULL, or changes numbers and words of the file as --set of the
/// command line does, one KEY=VALUE a line: "arm.elements=16\narm.strain=small".
///
/// Returns NULL where the file cannot be read or is wrong; `error` then has the reason, all mistakes of the file with
/// their lines, cut to `size` bytes, a zero byte included. `error` may be NULL; 4096 bytes are enough for most files.
/// Free the simulation with ancf14_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_load_file(
    path: *const c_char,
    overrides: *const c_char,
    error: *mut c_char,
    size: usize,
) -> *mut ancf14_simulation {
    // SAFETY: the rules at the head of the header.
    unsafe { load_file(path, Reach::Inside, overrides, error, size) }
}

/// Loads the model file at `path`, which you trust: it may include files and read tables from outside of its folder,
/// where ancf14_load_file returns an error. All else is as there.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_load_trusted_file(
    path: *const c_char,
    overrides: *const c_char,
    error: *mut c_char,
    size: usize,
) -> *mut ancf14_simulation {
    // SAFETY: the rules at the head of the header.
    unsafe { load_file(path, Reach::Anywhere, overrides, error, size) }
}

/// Loads a model from memory: `model` is the text of a model file, `name` what messages call it. All else is as in
/// ancf14_load_file.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_load_text(
    name: *const c_char,
    model: *const c_char,
    overrides: *const c_char,
    error: *mut c_char,
    size: usize,
) -> *mut ancf14_simulation {
    // SAFETY: the rules at the head of the header.
    unsafe {
        load(overrides, error, size, |overrides| {
            Ok(Simulation::from_text_with(text(name, "name")?, text(model, "model")?, overrides)?)
        })
    }
}

/// Frees a simulation; NULL is fine. The texts that belong to it are gone, its saved states are not.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_free(simulation: *mut ancf14_simulation) {
    // SAFETY: all handles of this list are of this type, and the rules at the head of the header.
    let _ = caught(|| drop(unsafe { live::SIMULATIONS.take_back::<Front>(simulation.cast()) }));
}

/// The reason why the last failed call with this simulation failed: a sentence with numbers that says what to do. It is
/// empty if no call has failed, and never NULL. It is valid until the next call that fails.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_last_error(simulation: *mut ancf14_simulation) -> *const c_char {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, NO_HANDLE.as_ptr(), |front| Ok(front.error.as_ptr())) }
}

/// The oldest warning that was not fetched yet, or NULL if there is none. A warning is a sentence about results that
/// should not be trusted, or about a model that is legal but probably not what was meant. It is valid until the next
/// call of this function.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_next_warning(simulation: *mut ancf14_simulation) -> *const c_char {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, null(), |front| Ok(front.next_warning().unwrap_or(null()))) }
}

/// The number of variables, which are numbered from 0; -1 if the handle is not a live simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_variable_count(simulation: *mut ancf14_simulation) -> c_int {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, -1, |front| Ok(number(front.texts.len()))) }
}

/// The number of the variable called `name`, for instance `tip.displacement[3]`; -1: there is none, and
/// ancf14_last_error suggests the nearest name. The numbers of a model file do not change.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_find(simulation: *mut ancf14_simulation, name: *const c_char) -> c_int {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, -1, |front| Ok(number(front.simulation.find(text(name, "name")?)?.index()))) }
}

/// The name of a variable; NULL: there is none with this number. It is valid as long as the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_variable_name(simulation: *mut ancf14_simulation, variable: c_int) -> *const c_char {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, null(), |front| Ok(front.texts_of(variable)?[0].as_ptr())) }
}

/// The SI unit of a variable, "N.m" or "rad/s"; empty: it has none; NULL: there is no such variable. It is valid as
/// long as the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_variable_unit(simulation: *mut ancf14_simulation, variable: c_int) -> *const c_char {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, null(), |front| Ok(front.texts_of(variable)?[1].as_ptr())) }
}

/// What a variable means, with axes and sign; NULL: there is no such variable. It is valid as long as the simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_variable_description(
    simulation: *mut ancf14_simulation,
    variable: c_int,
) -> *const c_char {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, null(), |front| Ok(front.texts_of(variable)?[2].as_ptr())) }
}

/// What a variable is; ANCF14_NO_VARIABLE: there is none with this number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_variable_kind(simulation: *mut ancf14_simulation, variable: c_int) -> ancf14_kind {
    // SAFETY: the rules at the head of the header.
    unsafe {
        ask(simulation, ancf14_kind::ANCF14_NO_VARIABLE, |front| {
            Ok(front.simulation.variable(place(variable))?.kind.into())
        })
    }
}

/// Reads a variable: the number of a parameter at any time, a result after ancf14_initialize.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_get(
    simulation: *mut ancf14_simulation,
    variable: c_int,
    value: *mut f64,
) -> ancf14_status {
    // SAFETY: the rules at the head of the header.
    unsafe {
        guard(simulation, |front| {
            let target = pointers::place(value, "value")?;
            let id = front.simulation.variable(place(variable))?.id;
            *target = front.simulation.value_of(id)?;
            Ok(())
        })
    }
}

/// Sets a variable: a parameter before ancf14_initialize, a tunable parameter or an input at any time. An input keeps
/// its value until it is set again. A value that is refused leaves the old one.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_set(simulation: *mut ancf14_simulation, variable: c_int, value: f64) -> ancf14_status {
    // SAFETY: the rules at the head of the header.
    unsafe {
        guard(simulation, |front| {
            let id = front.simulation.variable(place(variable))?.id;
            Ok(front.simulation.set_value_of(id, value)?)
        })
    }
}

/// Builds the mechanism from the parameters as set, and finds its initial state, at t = 0 or at the time of the state
/// that the model begins with. After a failure other parameters can be tried.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_initialize(simulation: *mut ancf14_simulation) -> ancf14_status {
    // SAFETY: the rules at the head of the header.
    unsafe { guard(simulation, |front| Ok(front.simulation.initialize()?)) }
}

/// Advances to `time`, s, in the internal steps of the model file. Times that are multiples of its simulation.step give
/// the bits of `ancf14 run`; compute them as k * step, not as a running sum.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_advance(simulation: *mut ancf14_simulation, time: f64) -> ancf14_status {
    // SAFETY: the rules at the head of the header.
    unsafe { guard(simulation, |front| Ok(front.simulation.advance(time)?)) }
}

/// Ends the run, so that ancf14_next_warning has those on the run as a whole: how far results are off because of the
/// length of the steps. Values can still be read.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_finish(simulation: *mut ancf14_simulation) -> ancf14_status {
    // SAFETY: the rules at the head of the header.
    unsafe { guard(simulation, |front| Ok(front.simulation.finish()?)) }
}

/// Goes back to the model as it was loaded, parameters and inputs included: for the next run of a study.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_reset(simulation: *mut ancf14_simulation) -> ancf14_status {
    // SAFETY: the rules at the head of the header.
    unsafe { guard(simulation, |front| Ok(front.simulation.reset()?)) }
}

/// The time reached, s; NaN if the handle is not a live simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_time(simulation: *mut ancf14_simulation) -> f64 {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, f64::NAN, |front| Ok(front.simulation.time())) }
}

/// The time at which a run ends by the model file, s; NaN if the handle is not a live simulation. Nothing keeps a
/// program from advancing further.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_stop_time(simulation: *mut ancf14_simulation) -> f64 {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, f64::NAN, |front| Ok(front.simulation.stop_time())) }
}

/// The time between two rows of results by the model file, s; NaN if the handle is not a live simulation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_output_step(simulation: *mut ancf14_simulation) -> f64 {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, f64::NAN, |front| Ok(front.simulation.output_step())) }
}

/// Copies all that changes: parameters, inputs, time and motion; NULL where that is not possible. Free the copy with
/// ancf14_free_state.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_save(simulation: *mut ancf14_simulation) -> *mut ancf14_state {
    // SAFETY: the rules at the head of the header.
    unsafe { ask(simulation, null_mut(), |front| Ok(live::SAVED.hand_out(front.simulation.save()?).cast())) }
}

/// Goes back to a copy, also after a failed step. The copy stays; it may come from another simulation of the same model
/// with the same overrides. What follows has the same bits each time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_restore(simulation: *mut ancf14_simulation, state: *mut ancf14_state) -> ancf14_status {
    // SAFETY: all handles of that list are of this type, and the rules at the head of the header.
    unsafe {
        guard(simulation, |front| {
            let state = live::SAVED.behind::<SavedState>(state.cast()).ok_or_else(no_state)?;
            Ok(front.simulation.restore(state)?)
        })
    }
}

/// Frees a copy; NULL is fine.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn ancf14_free_state(state: *mut ancf14_state) {
    // SAFETY: all handles of this list are of this type, and the rules at the head of the header.
    let _ = caught(|| drop(unsafe { live::SAVED.take_back::<SavedState>(state.cast()) }));
}

fn no_state() -> Mistake {
    let sentence = "this is no live state: the handle is NULL, was freed, or is another pointer; pass one that ancf14_save has returned";
    Mistake::Argument(ancf14_status::ANCF14_BAD_HANDLE, sentence.to_owned())
}

/// A count or a number of a variable for C. No memory holds a model with more.
fn number(count: usize) -> c_int {
    c_int::try_from(count).unwrap_or(c_int::MAX)
}

/// Loads the model file at `path`, which may name files where `reach` says.
///
/// # Safety
/// As [`load`]; `path` is NULL or ends with a zero byte.
unsafe fn load_file(
    path: *const c_char,
    reach: Reach,
    overrides: *const c_char,
    error: *mut c_char,
    size: usize,
) -> *mut ancf14_simulation {
    // SAFETY: the caller's promise.
    unsafe {
        load(overrides, error, size, |overrides| Ok(Simulation::open_reaching(text(path, "path")?, reach, overrides)?))
    }
}

/// Loads a simulation by `open`, given the overrides; NULL, and the reason in `error`.
///
/// # Safety
/// The text is NULL or ends with a zero byte; `error` is NULL or has `size` bytes.
unsafe fn load(
    overrides: *const c_char,
    error: *mut c_char,
    size: usize,
    open: impl FnOnce(&[(&str, &str)]) -> Result<Simulation, Mistake>,
) -> *mut ancf14_simulation {
    fault::silence();
    let loaded = caught(|| {
        // SAFETY: the caller's promise.
        let lines = if overrides.is_null() { "" } else { unsafe { text(overrides, "overrides") }? };
        Ok(Front::new(open(&keys_and_values(lines)?)?))
    });
    let mistake: Mistake = match loaded.unwrap_or_else(|message| Err(Error::Fault { message }.into())) {
        Ok(front) => {
            // SAFETY: the caller's promise.
            unsafe { write("", error, size) };
            return live::SIMULATIONS.hand_out(front).cast();
        }
        Err(mistake) => mistake,
    };
    // SAFETY: the caller's promise.
    unsafe { write(&mistake.sentence(), error, size) };
    null_mut()
}

/// The overrides of a text with one KEY=VALUE a line.
fn keys_and_values(lines: &str) -> Result<Vec<(&str, &str)>, Mistake> {
    let lines = lines.lines().map(str::trim).filter(|line| !line.is_empty());
    let pair = |line: &str| format!("the override `{line}` is not KEY=VALUE, like steel.young=2.1e11");
    lines
        .map(|line| {
            let split = line.split_once('=').map(|(key, value)| (key.trim(), value.trim()));
            split
                .filter(|(key, value)| !key.is_empty() && !value.is_empty())
                .ok_or_else(|| Mistake::Argument(ancf14_status::ANCF14_BAD_ARGUMENT, pair(line)))
        })
        .collect()
}
