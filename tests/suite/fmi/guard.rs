//! What becomes of a panic on its way to C? The guard that every exported function goes through is run on a toy model
//! that panics in a step: fatal status, a log line, nothing on stderr, and the handle can still be given back. Without a
//! guard the host would die.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{ffi::c_void, process::Command, ptr::null_mut};

use ancf14::{
    ffi::{
        component::{Component, Host},
        guard::{free, free_state, guard, load_state, store_state},
        types::fmi2Status,
    },
    fmi::lifecycle::Call,
};

use super::{
    host::Lines,
    toy::{FORCE, POSITION, Toy, Trap, toy},
};

fn handle(lines: &Lines, trap: Trap) -> *mut c_void {
    let mut model = toy();
    model.trap = trap;
    Component::new(model, Host::new(c"toy 1", &lines.callbacks()), false).into_handle()
}

/// SAFETY of all uses below: the handle comes from `handle` and is freed at the end of the test.
fn start(handle: *mut c_void) {
    let status = unsafe {
        guard::<Toy>(handle, Call::EnterInitializationMode, |instance| {
            instance.enter_initialization_mode()?;
            instance.exit_initialization_mode()
        })
    };
    assert_eq!(status, fmi2Status::fmi2OK);
}

fn step(handle: *mut c_void, time: f64) -> fmi2Status {
    unsafe { guard::<Toy>(handle, Call::DoStep, |instance| instance.do_step(time, 0.5)) }
}

/// Named so that the child process below can run this test alone.
#[test]
fn a_panic_becomes_fatal() {
    let lines = Lines::default();
    let toy = handle(&lines, Trap::PanicBeyond(0.7));
    start(toy);
    assert_eq!(step(toy, 0.0), fmi2Status::fmi2OK);
    assert_eq!(lines.take(), Vec::<String>::new());
    assert_eq!(step(toy, 0.5), fmi2Status::fmi2Fatal);
    let told = lines.take();
    assert_eq!(told.len(), 1);
    assert!(told[0].starts_with("toy 1 fmi2Fatal logStatusFatal fmi2DoStep: internal fault"), "{told:?}");
    assert!(told[0].contains("the toy broke at 1 s"), "{told:?}");
    assert_eq!(step(toy, 0.5), fmi2Status::fmi2Fatal);
    assert!(lines.take()[0].contains("fmi2DoStep after an internal fault: not allowed now; only fmi2FreeInstance"));
    let reset = unsafe { guard::<Toy>(toy, Call::Reset, |instance| instance.reset()) };
    assert_eq!(reset, fmi2Status::fmi2Fatal);
    unsafe { free::<Toy>(toy) };
}

/// In a library whose hook was set by `fmi2Instantiate`, a panic prints nothing and its place is in the log line.
/// A process of its own, because the hook belongs to a process here, and to the library in an FMU.
#[test]
fn a_panic_prints_nothing() {
    let run = |silenced: &str| {
        let mut child = Command::new(std::env::current_exe().unwrap());
        child.args(["--exact", "fmi::guard::child_that_panics", "--ignored", "--nocapture", "--test-threads=1"]);
        child.env("ANCF14_TEST_SILENCED", silenced).output().unwrap()
    };
    let loud = String::from_utf8(run("no").stderr).unwrap();
    assert!(loud.contains("the toy broke"), "the child does panic: {loud}");
    let silent = run("yes");
    assert_eq!(String::from_utf8(silent.stderr).unwrap(), "");
    let told = String::from_utf8(silent.stdout).unwrap();
    assert!(told.contains("the toy broke at 1 s (tests/suite/fmi/toy.rs:"), "{told}");
}

#[test]
#[ignore = "run by a_panic_prints_nothing in a process of its own"]
fn child_that_panics() {
    let lines = Lines::default();
    if std::env::var("ANCF14_TEST_SILENCED").is_ok_and(|word| word == "yes") {
        ancf14::ffi::silence_panics();
    }
    let toy = handle(&lines, Trap::PanicBeyond(0.7));
    start(toy);
    assert_eq!(step(toy, 0.0), fmi2Status::fmi2OK);
    assert_eq!(step(toy, 0.5), fmi2Status::fmi2Fatal);
    println!("{:?}", lines.take());
    unsafe { free::<Toy>(toy) };
}

/// Errors carry call and mode; a failed step is an error and not fatal.
#[test]
fn errors_name_call_and_mode() {
    let lines = Lines::default();
    let toy = handle(&lines, Trap::FailBeyond(0.7));
    assert_eq!(step(toy, 0.0), fmi2Status::fmi2Error);
    assert!(lines.take()[0].contains("toy 1 fmi2Error logStatusError fmi2DoStep while instantiated: not allowed now"));
    start(toy);
    assert_eq!(step(toy, 0.0), fmi2Status::fmi2OK);
    assert_eq!(step(toy, 0.5), fmi2Status::fmi2Error);
    assert!(lines.take()[0].contains("fmi2Error logNonlinearSystems fmi2DoStep between steps: no equilibrium"));
    unsafe { free::<Toy>(toy) };
}

/// A warning of the instance is the status of the call.
#[test]
fn warnings_are_a_status() {
    let lines = Lines::default();
    let toy = handle(&lines, Trap::None);
    let read = || unsafe { guard::<Toy>(toy, Call::GetReal, |instance| instance.get_real(&[POSITION], &mut [0.0])) };
    assert_eq!(read(), fmi2Status::fmi2Warning);
    assert_eq!(read(), fmi2Status::fmi2OK);
    assert_eq!(lines.take().len(), 1);
    unsafe { free::<Toy>(toy) };
}

/// A state is made, made again in the same place, set, freed, and freed again.
#[test]
fn states_by_handle() {
    let lines = Lines::default();
    let toy = handle(&lines, Trap::None);
    start(toy);
    let mut state = null_mut();
    let position = || {
        let mut value = [0.0];
        let status = unsafe { guard::<Toy>(toy, Call::GetReal, |i| i.get_real(&[POSITION], &mut value)) };
        assert_eq!(status, fmi2Status::fmi2OK);
        value[0]
    };
    unsafe { guard::<Toy>(toy, Call::SetReal, |i| i.set_real(&[FORCE], &[1.0])) };
    unsafe { guard::<Toy>(toy, Call::GetFMUstate, |i| store_state(i, &raw mut state)) };
    let first = state;
    assert!(!first.is_null());
    step(toy, 0.0);
    assert_eq!(position(), 2.5);
    unsafe { guard::<Toy>(toy, Call::GetFMUstate, |i| store_state(i, &raw mut state)) };
    assert_eq!(state, first, "the memory is used again");
    step(toy, 0.5);
    unsafe { guard::<Toy>(toy, Call::SetFMUstate, |i| load_state(i, state)) };
    assert_eq!(position(), 2.5);
    for _ in 0..2 {
        let freed = unsafe { guard::<Toy>(toy, Call::FreeFMUstate, |i| free_state(i, &raw mut state)) };
        assert_eq!((freed, state), (fmi2Status::fmi2OK, null_mut()));
    }
    let none = unsafe { guard::<Toy>(toy, Call::SetFMUstate, |i| load_state(i, null_mut())) };
    assert_eq!(none, fmi2Status::fmi2Error);
    assert!(lines.take()[0].contains("`FMUstate` is NULL"));
    unsafe { free::<Toy>(toy) };
}

/// NULL is no instance, and no reason to crash.
#[test]
fn null_handles() {
    assert_eq!(step(null_mut(), 0.0), fmi2Status::fmi2Error);
    unsafe { free::<Toy>(null_mut()) };
}
