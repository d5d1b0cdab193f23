//! What becomes of handles that are none: freed already, of something else, or another pointer? Each is refused with an
//! error, and the unit goes on. Without a list of live handles these calls free or read whatever is at the address.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::ffi::{
    fmi2::*,
    types::{fmi2False, fmi2Status::*},
};
use ancf14::fmi::lifecycle::Call;
use std::{ffi::c_void, ptr::null_mut};

use super::{
    ffi::MODEL,
    unit::{Place, Unit},
};

#[test]
fn regression_states_that_are_none() {
    let place = Place::new(MODEL);
    let unit = Unit::new(&place);
    assert_eq!(unit.call(Call::EnterInitializationMode), fmi2OK);
    assert_eq!(unit.call(Call::ExitInitializationMode), fmi2OK);
    let (mut saved, mut number) = (null_mut(), [0_u64; 64]);
    assert_eq!(unit.save(&mut saved), fmi2OK);
    let mut freed = saved;
    let mut copy = saved;
    assert_eq!(unit.forget(&mut freed), fmi2OK);
    for none in [copy, unit.c, number.as_mut_ptr().cast()] {
        assert_eq!(unit.restore(none), fmi2Error);
        let mut place = none;
        assert_eq!(unit.save(&mut place), fmi2Error);
        assert_eq!(unit.forget(&mut place), fmi2Error);
        assert_eq!(place, none, "it is left alone");
        let mut size = 0;
        // SAFETY: the instance is live, the size can be written to; what the state is, is the question.
        assert_eq!(unsafe { fmi2SerializedFMUstateSize(unit.c, none, &raw mut size) }, fmi2Error);
    }
    assert_eq!(unit.forget(&mut copy), fmi2Error);
    assert!(unit.lines.take().iter().all(|line| line.contains("no live state of this library")));
    // A host that passes the state where its address is wanted: whatever its first bytes are, it lives on.
    saved = null_mut();
    assert_eq!(unit.save(&mut saved), fmi2OK);
    // SAFETY: the instance and the state are live; the state is long enough to hold a pointer.
    unsafe { fmi2FreeFMUstate(unit.c, saved.cast::<*mut c_void>()) };
    assert_eq!(unit.restore(saved), fmi2OK);
    assert_eq!(unit.forget(&mut saved), fmi2OK);
    assert_eq!(unit.do_step(0.0, 1e-3), fmi2OK);
}

#[test]
fn regression_instances_that_are_none() {
    let place = Place::new(MODEL);
    let (unit, other) = (Unit::new(&place), Unit::new(&place));
    let mut saved = null_mut();
    assert_eq!(other.save(&mut saved), fmi2OK);
    let freed = unit.c;
    drop(unit);
    let mut number = [0_u64; 64];
    for none in [freed, saved, number.as_mut_ptr().cast()] {
        // SAFETY: what the handle is, is the question.
        unsafe {
            assert_eq!(fmi2DoStep(none, 0.0, 1e-3, fmi2False), fmi2Error);
            assert_eq!(fmi2Terminate(none), fmi2Error);
            fmi2FreeInstance(none);
        }
    }
    assert_eq!(other.forget(&mut saved), fmi2OK);
    assert_eq!(other.call(Call::EnterInitializationMode), fmi2OK);
}
