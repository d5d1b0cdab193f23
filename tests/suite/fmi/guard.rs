//! What becomes of a panic on its way to C? The guard that every exported function goes through is run on a toy model
//! that panics in a step: fatal status, a log line, nothing on stderr, and the handle can still be given back. Without
//! a guard the host would die.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{ffi::c_void, process::Command, ptr::null_mut};

use ancf14::{
    ffi::{
        component::{Component, Host},
        guard::{free, free_state, guard, hand_out_state, load_state},
        types::fmi2Status,
    },
    fmi::{error::Error, instance::Instance, lifecycle},
};

use super::{
    host::Lines,
    toy::{FORCE, GAIN, POSITION, Toy, Trap, toy},
};

/// A toy behind a C handle, given back at the end of the test.
struct Handle(*mut c_void);

impl Handle {
    fn new(lines: &Lines, trap: Trap) -> Self {
        let mut model = toy();
        model.trap = trap;
        Self(Component::new(model, Host::new(c"toy 1", &lines.callbacks()), false).into_handle())
    }

    /// What the exported functions do.
    fn call(&self, call: lifecycle::Call, body: impl FnOnce(&mut Instance<Toy>) -> Result<(), Error>) -> fmi2Status {
        // SAFETY: the handle is of a toy, or NULL, and in use here only.
        unsafe { guard::<Toy>(self.0, call, body) }
    }

    fn initialize(&self) {
        let both = |instance: &mut Instance<Toy>| {
            instance.enter_initialization_mode()?;
            instance.exit_initialization_mode()
        };
        assert_eq!(self.call(lifecycle::Call::EnterInitializationMode, both), fmi2Status::fmi2OK);
    }

    fn step(&self, time: f64) -> fmi2Status {
        self.call(lifecycle::Call::DoStep, |instance| instance.do_step(time, 0.5))
    }

    fn position(&self) -> f64 {
        let mut value = [f64::NAN];
        let status = self.call(lifecycle::Call::GetReal, |instance| instance.get_real(&[POSITION], &mut value));
        assert_eq!(status, fmi2Status::fmi2OK);
        value[0]
    }
}

impl Drop for Handle {
    fn drop(&mut self) {
        // SAFETY: the handle is of a toy, or NULL, and not used again.
        unsafe { free::<Toy>(self.0) }
    }
}

/// Fatal once and for all, with the panic's words in the log; the handle is given back like any other.
#[test]
fn a_panic_becomes_fatal() {
    let lines = Lines::default();
    let toy = Handle::new(&lines, Trap::PanicBeyond(0.7));
    toy.initialize();
    assert_eq!(toy.step(0.0), fmi2Status::fmi2OK);
    assert_eq!(lines.take(), Vec::<String>::new());
    assert_eq!(toy.step(0.5), fmi2Status::fmi2Fatal);
    let told = lines.take();
    assert_eq!(told.len(), 1);
    assert!(told[0].starts_with("toy 1 fmi2Fatal logStatusFatal fmi2DoStep: internal fault"), "{told:?}");
    assert!(told[0].contains("the toy broke at 1 s"), "{told:?}");
    assert_eq!(toy.step(0.5), fmi2Status::fmi2Fatal);
    assert!(
        lines.take()[0]
            .contains("fmi2DoStep after an internal fault at t = 0.5 s: not allowed now; only fmi2FreeInstance")
    );
    assert_eq!(toy.call(lifecycle::Call::Reset, Instance::reset), fmi2Status::fmi2Fatal);
}

/// In a library whose hook was set by `fmi2Instantiate`, a panic prints nothing and its place is in the log line.
/// A process of its own, because the hook belongs to a process here, and to the library in an FMU.
#[test]
fn a_panic_prints_nothing() {
    let run = |silenced: &str| {
        let mut child = Command::new(std::env::current_exe().unwrap());
        child.args(["--exact", "fmi::guard::child_that_panics", "--nocapture", "--test-threads=1"]);
        child.env("ANCF14_TEST_SILENCED", silenced).output().unwrap()
    };
    let loud = String::from_utf8(run("no").stderr).unwrap();
    assert!(loud.contains("the toy broke"), "the child does panic: {loud}");
    let silent = run("yes");
    assert_eq!(String::from_utf8(silent.stderr).unwrap(), "");
    let told = String::from_utf8(silent.stdout).unwrap();
    assert!(told.contains("the toy broke at 1 s (crates/testing/src/toy.rs:"), "{told}");
}

/// Run by [`a_panic_prints_nothing`] in a process of its own; here it shows that the panic becomes fmi2Fatal.
#[test]
#[allow(clippy::print_stdout, reason = "read by the parent process")]
fn child_that_panics() {
    if std::env::var("ANCF14_TEST_SILENCED").is_ok_and(|word| word == "yes") {
        ancf14::ffi::silence_panics();
    }
    let lines = Lines::default();
    let toy = Handle::new(&lines, Trap::PanicBeyond(0.7));
    toy.initialize();
    assert_eq!(toy.step(0.0), fmi2Status::fmi2OK);
    assert_eq!(toy.step(0.5), fmi2Status::fmi2Fatal);
    println!("{:?}", lines.take());
}

/// Errors carry call and mode; a failed step is an error and not fatal.
#[test]
fn errors_name_call_and_mode() {
    let lines = Lines::default();
    let toy = Handle::new(&lines, Trap::FailBeyond(0.7));
    assert_eq!(toy.step(0.0), fmi2Status::fmi2Error);
    assert!(
        lines.take()[0]
            .contains("toy 1 fmi2Error logStatusError fmi2DoStep while instantiated at t = 0 s: not allowed now")
    );
    toy.initialize();
    assert_eq!(toy.step(0.0), fmi2Status::fmi2OK);
    assert_eq!(toy.step(0.5), fmi2Status::fmi2Error);
    assert!(
        lines.take()[0].contains("fmi2Error logNonlinearSystems fmi2DoStep in step mode at t = 0.5 s: no equilibrium")
    );
}

/// A host that asks for something odd gets a warning as status, once.
#[test]
fn odd_requests_are_a_status() {
    let lines = Lines::default();
    let toy = Handle::new(&lines, Trap::None);
    let read = || toy.call(lifecycle::Call::GetReal, |instance| instance.get_real(&[POSITION], &mut [0.0]));
    assert_eq!(read(), fmi2Status::fmi2Warning);
    assert_eq!(read(), fmi2Status::fmi2OK);
    assert_eq!(lines.take().len(), 1);
}

/// Many hosts end a run at any status but fmi2OK: what the model warns of is logged, and the call succeeds.
#[test]
fn regression_warnings_of_the_model_are_no_status() {
    let lines = Lines::default();
    let toy = Handle::new(&lines, Trap::None);
    let still = |i: &mut Instance<Toy>| {
        i.set_real(&[GAIN], &[0.0])?;
        i.enter_initialization_mode()?;
        i.exit_initialization_mode()
    };
    assert_eq!(toy.call(lifecycle::Call::ExitInitializationMode, still), fmi2Status::fmi2OK);
    assert_eq!(lines.take(), ["toy 1 fmi2Warning logStatusWarning a gain of 0 moves nothing"]);
}

/// A state is made, made again in the same place, set, freed, and freed again.
#[test]
fn states_by_handle() {
    let lines = Lines::default();
    let toy = Handle::new(&lines, Trap::None);
    toy.initialize();
    let mut state: *mut c_void = null_mut();
    let place = &raw mut state;
    // SAFETY: `place` holds NULL or a state of a toy.
    let store = || toy.call(lifecycle::Call::GetFMUstate, |i| unsafe { hand_out_state(place, || i.state()) });
    toy.call(lifecycle::Call::SetReal, |i| i.set_real(&[FORCE], &[1.0]));
    assert_eq!(store(), fmi2Status::fmi2OK);
    let first = state;
    assert!(!first.is_null());
    toy.step(0.0);
    assert_eq!(toy.position(), 2.5);
    assert_eq!(store(), fmi2Status::fmi2OK);
    assert_eq!(state, first, "the memory is used again");
    toy.step(0.5);
    assert_eq!(toy.position(), 3.5);
    // SAFETY: as above.
    let load = |state| toy.call(lifecycle::Call::SetFMUstate, |i| unsafe { load_state(i, state) });
    assert_eq!(load(state), fmi2Status::fmi2OK);
    assert_eq!(toy.position(), 2.5);
    for _ in 0..2 {
        // SAFETY: as above.
        let freed = toy.call(lifecycle::Call::FreeFMUstate, |i| unsafe { free_state(i, place) });
        assert_eq!((freed, state), (fmi2Status::fmi2OK, null_mut()));
    }
    assert_eq!(load(null_mut()), fmi2Status::fmi2Error);
    assert!(lines.take()[0].contains("`FMUstate` is NULL"));
}

/// NULL is no instance, and no reason to crash.
#[test]
fn null_handles() {
    assert_eq!(Handle(null_mut()).step(0.0), fmi2Status::fmi2Error);
}
