//! What becomes of a panic in the middle of a step, between two updates? The instance is unusable and says so; nothing
//! crosses to C. Run on a toy model that panics beyond a time, in parts of a quarter of a second.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{cell::RefCell, ffi::CStr, ffi::c_void, marker::PhantomData};

use ancf14::{
    ffi::{
        component::{Component, Host},
        fmi3_types::{Callbacks, fmi3Status, fmi3String},
        guard::{free, run},
    },
    fmi::{
        Status,
        error::Error,
        instance::Instance,
        lifecycle::{Call, Mode, Standard},
    },
};

use super::super::toy::{FORCE, GAIN, POSITION, Toy, Trap, toy};

unsafe extern "C" fn log(environment: *mut c_void, status: fmi3Status, category: fmi3String, message: fmi3String) {
    // SAFETY: the environment is the list of lines of the test; the texts end with a zero byte.
    let (lines, [category, message]) = unsafe {
        let texts = [category, message].map(|text| CStr::from_ptr(text).to_str().unwrap());
        (&*environment.cast::<RefCell<Vec<String>>>(), texts)
    };
    lines.borrow_mut().push(format!("{status:?} {category} {message}"));
}

/// A toy behind a C handle of FMI 3.0, given back at the end of the test.
struct Handle<'a>(*mut c_void, PhantomData<&'a RefCell<Vec<String>>>);

impl<'a> Handle<'a> {
    fn new(lines: &'a RefCell<Vec<String>>, trap: Trap) -> Self {
        let mut model = toy();
        model.trap = trap;
        let host = Host::Fmi3(Callbacks {
            environment: std::ptr::from_ref(lines).cast_mut().cast(),
            log_message: Some(log),
            intermediate_update: None,
            early_return_allowed: true,
        });
        let handle = Self(Component::new(model, host, false).into_handle(), PhantomData);
        let start = |instance: &mut Instance<Toy>| {
            instance.enter_initialization_mode_for(None, 0.0, None)?;
            instance.exit_initialization_mode()
        };
        assert_eq!(handle.call(Call::EnterInitializationMode, start), Status::Ok);
        handle
    }

    fn call(&self, call: Call, body: impl FnOnce(&mut Instance<Toy>) -> Result<(), Error>) -> Status {
        // SAFETY: the handle is of a toy, and in use here only.
        unsafe { run::<Toy>(Standard::Fmi3, self.0, call, body) }
    }

    /// A part of the step; the time that it reached, s, and whether that is the end.
    fn part(&self) -> (Status, Option<(f64, bool)>) {
        let mut reached = None;
        let status = self.call(Call::DoStep, |instance| {
            let progress = instance.take_part()?;
            reached = Some((progress.time, progress.arrived));
            Ok(())
        });
        (status, reached)
    }
}

impl Drop for Handle<'_> {
    fn drop(&mut self) {
        // SAFETY: the handle is of a toy and not used again.
        unsafe { free::<Toy>(self.0) }
    }
}

#[test]
fn a_panic_between_updates_becomes_fatal() {
    let lines = RefCell::default();
    let toy = Handle::new(&lines, Trap::PanicBeyond(0.3));
    assert_eq!(toy.call(Call::DoStep, |instance| instance.begin_step(0.0, 1.0)), Status::Ok);
    assert_eq!(toy.part(), (Status::Ok, Some((0.25, false))));
    assert_eq!(toy.call(Call::DoStep, Instance::go_on), Status::Ok);
    assert_eq!(toy.part(), (Status::Fatal, None));
    let told = lines.take();
    assert!(told.len() == 1 && told[0].starts_with("fmi3Fatal logStatusFatal fmi3DoStep: internal fault"), "{told:?}");
    assert!(told[0].contains("the toy broke at 0.5 s"), "{told:?}");
    // Whatever the host's loop does next is refused.
    assert_eq!(toy.call(Call::DoStep, Instance::go_on), Status::Fatal);
    assert_eq!(toy.call(Call::DoStep, Instance::return_early), Status::Fatal);
    assert_eq!(toy.part(), (Status::Fatal, None));
    assert!(lines.take().iter().all(|line| line.contains("only fmi3FreeInstance is left")));
}

/// A panic while the host reads in its callback: the step does not go on as if nothing had happened.
#[test]
fn a_panic_in_a_callback_ends_the_step() {
    let lines = RefCell::default();
    let toy = Handle::new(&lines, Trap::None);
    assert_eq!(toy.call(Call::DoStep, |instance| instance.begin_step(0.0, 1.0)), Status::Ok);
    assert_eq!(toy.part(), (Status::Ok, Some((0.25, false))));
    assert_eq!(toy.call(Call::GetReal, |_| panic!("in the callback")), Status::Fatal);
    assert_eq!(toy.call(Call::DoStep, Instance::go_on), Status::Fatal);
}

/// A failed part brings the toy into the mode that only a state or a reset leaves; the parts before it count as the
/// model says.
#[test]
fn a_failed_part_stops_the_step() {
    let lines = RefCell::default();
    let toy = Handle::new(&lines, Trap::FailBeyond(0.3));
    assert_eq!(toy.call(Call::DoStep, |instance| instance.begin_step(0.0, 1.0)), Status::Ok);
    assert_eq!(toy.part().0, Status::Ok);
    assert_eq!(toy.call(Call::DoStep, Instance::go_on), Status::Ok);
    assert_eq!(toy.part(), (Status::Error, None));
    let mode = |instance: &mut Instance<Toy>| {
        assert_eq!(instance.mode(), Mode::Error);
        Ok(())
    };
    assert_eq!(toy.call(Call::GetReal, mode), Status::Ok);
    assert!(lines.take()[0].contains("fmi3DoStep in step mode at t = 0.25 s: no equilibrium"));
}

/// Parts end where the step ends; the sum of them is the step at once, which the toy can take to the bit: quarters are
/// exact.
#[test]
fn parts_add_up() {
    let lines = RefCell::default();
    let (parts, whole) = (Handle::new(&lines, Trap::None), Handle::new(&lines, Trap::None));
    for toy in [&parts, &whole] {
        assert_eq!(toy.call(Call::SetReal, |instance| instance.set_float64(&[GAIN, FORCE], &[3.0, 1.0])), Status::Ok);
    }
    assert_eq!(whole.call(Call::DoStep, |instance| instance.do_step(0.0, 0.625)), Status::Ok);
    assert_eq!(parts.call(Call::DoStep, |instance| instance.begin_step(0.0, 0.625)), Status::Ok);
    for expected in [(0.25, false), (0.5, false), (0.625, true)] {
        assert_eq!(parts.part(), (Status::Ok, Some(expected)));
        assert_eq!(parts.call(Call::DoStep, Instance::go_on), Status::Ok);
    }
    let position = |toy: &Handle<'_>| {
        let mut value = [f64::NAN];
        assert_eq!(toy.call(Call::GetReal, |instance| instance.get_float64(&[POSITION], &mut value)), Status::Ok);
        value[0]
    };
    assert_eq!(position(&parts), position(&whole));
    assert_eq!(position(&whole), 1.5 + 3.0 * 0.625); // length and way
}
