//! Does a built unit keep the calling table, function by function, in every mode that a host can bring it to? What is
//! legal works; what is not is refused with an error that names call and mode, and the unit goes on with the very bits
//! of one that was not called so. (The mode after an internal fault is reached in `guard.rs`, on a toy that can panic.)
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::{
    ffi::{fmi2::*, types::fmi2Status},
    fmi::lifecycle::{Call, Mode, TABLE},
};
use std::ptr::{null, null_mut};

use super::{
    ffi::MODEL,
    lifecycle::allowed,
    unit::{Place, Saved, Unit, is_fine},
};

/// A force that no step can take.
const BLOW: f64 = 1e20;

/// A new unit in a mode, as a host brings it there; with the state before what failed.
fn in_mode(place: &Place, mode: Mode) -> (Unit<'_>, Saved) {
    let unit = Unit::new(place);
    let mut saved = null_mut();
    if mode == Mode::Instantiated {
        return (unit, saved);
    }
    assert!(is_fine(unit.call(Call::EnterInitializationMode)));
    if mode == Mode::Initialization {
        return (unit, saved);
    }
    assert!(is_fine(unit.call(Call::ExitInitializationMode)));
    assert!(is_fine(unit.do_step(0.0, 1e-3)));
    match mode {
        Mode::Terminated => assert!(is_fine(unit.call(Call::Terminate))),
        Mode::Error => {
            assert!(is_fine(unit.save(&mut saved)));
            assert!(is_fine(unit.set_real(&[place.reference("tip.force[3]")], &[BLOW])));
            assert_eq!(unit.do_step(1e-3, 1e-3), fmi2Status::fmi2Error);
        }
        _ => (),
    }
    unit.lines.take();
    (unit, saved)
}

/// What comes of a unit that goes on from a mode as hosts do.
fn going_on(unit: &Unit, mode: Mode, mut saved: Saved) -> Vec<u64> {
    let mut bits = unit.bits();
    let mut go_on = |call| {
        assert!(is_fine(unit.call(call)), "{:?}", unit.lines.take());
        bits.extend(unit.bits());
    };
    match mode {
        Mode::Instantiated => {
            [Call::EnterInitializationMode, Call::ExitInitializationMode, Call::DoStep].into_iter().for_each(go_on);
        }
        Mode::Initialization => [Call::ExitInitializationMode, Call::DoStep].into_iter().for_each(go_on),
        Mode::Step => [Call::DoStep, Call::Terminate].into_iter().for_each(go_on),
        Mode::Error => {
            assert!(is_fine(unit.restore(saved)));
            go_on(Call::DoStep);
            assert!(is_fine(unit.forget(&mut saved)));
        }
        Mode::Terminated | Mode::Fatal | Mode::Update | Mode::Event | Mode::ContinuousTime => (),
    }
    bits
}

#[test]
fn every_function_in_every_mode() {
    let place = Place::new(MODEL);
    for mode in [Mode::Instantiated, Mode::Initialization, Mode::Step, Mode::Terminated, Mode::Error] {
        let (unit, saved) = in_mode(&place, mode);
        let expected = going_on(&unit, mode, saved);
        let (legal, tolerated) = allowed(mode);
        for (call, _) in TABLE {
            let (unit, mut saved) = in_mode(&place, mode);
            if call == Call::FreeInstance {
                unit.forget(&mut saved);
                continue; // the unit's end; it is legal in all modes
            }
            let status = unit.call(call);
            let lines = unit.lines.take();
            let refused = lines.iter().any(|line| line.contains("not allowed now"));
            if legal.contains(&call) || tolerated.contains(&call) {
                // Some have no answer here, and say so.
                let unanswered = status == fmi2Status::fmi2Discard;
                assert!(!refused && (is_fine(status) || unanswered), "{call} {mode}: {status:?} {lines:?}");
                unit.forget(&mut saved);
            } else {
                assert_eq!(status, fmi2Status::fmi2Error, "{call} {mode}");
                let [line] = &lines[..] else { panic!("{call} {mode}: {lines:?}") };
                assert!(line.contains(&format!("{call} {mode} at t = ")) && refused, "{line}");
                assert_eq!(going_on(&unit, mode, saved), expected, "{call} {mode}");
            }
        }
    }
}

/// Where a mode forbids to ask for a status, the mode is the mistake, whatever kind of status is asked for.
#[test]
fn regression_the_table_comes_before_the_kind_of_a_status() {
    let place = Place::new(MODEL);
    let unit = Unit::new(&place);
    let (c, mut real, mut integer, mut status, mut text) = (unit.c, 0.0, 0, fmi2Status::fmi2OK, null());
    for kind in [-1, 4, i32::MAX] {
        // SAFETY: the unit is live, and every value can be written to.
        let answers = unsafe {
            [
                fmi2GetStatus(c, kind, &raw mut status),
                fmi2GetRealStatus(c, kind, &raw mut real),
                fmi2GetIntegerStatus(c, kind, &raw mut integer),
                fmi2GetBooleanStatus(c, kind, &raw mut integer),
                fmi2GetStringStatus(c, kind, &raw mut text),
            ]
        };
        assert_eq!(answers, [fmi2Status::fmi2Error; 5], "{kind}");
    }
}
