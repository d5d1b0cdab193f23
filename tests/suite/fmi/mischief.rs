//! Wrong calls of all kinds: each must be an error.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use ancf14::{
    ffi::{fmi2::*, fmi2_values::*, types::*},
    fmi::lifecycle::{Call, Mode, TABLE},
};
use std::ptr::{null, null_mut};

use super::{
    lifecycle::allowed,
    unit::{Place, Unit},
};
use crate::random::Random;

/// Makes three wrong calls.
pub fn play(unit: &Unit, place: &Place, mode: Mode, random: &mut Random) {
    for _ in 0..3 {
        let trick = random.below(TRICKS);
        let status = wrong_call(trick, unit, place, mode, random);
        assert_eq!(status, fmi2Status::fmi2Error, "trick {trick} {mode}: {:?}", unit.lines.take());
    }
}

const TRICKS: usize = 28;

/// No number of a step or a value.
fn no_number(random: &mut Random) -> f64 {
    [f64::NAN, f64::INFINITY, f64::NEG_INFINITY][random.below(3)]
}

fn wrong_call(trick: usize, unit: &Unit, place: &Place, mode: Mode, random: &mut Random) -> fmi2Status {
    let c = unit.c;
    let (input, output) = (place.reference("push.force[1]"), place.reference("tip.position[1]"));
    let (count, density) = (place.reference("arm.elements"), place.reference("steel.density"));
    let nowhere = 4_000_000_000;
    let time = if mode == Mode::Step { unit.time() } else { 0.0 };
    let (mut value, mut flag, text, order) = (7.0, 0, null(), 0);
    let no_input = [output, nowhere][random.below(2)];
    let (seed, no_seed) = (1.0, no_number(random));
    // SAFETY: wrong arguments are the question; arrays that are not NULL have an element, and so many that no array can
    // have them are counted, not read.
    unsafe {
        match trick {
            0 => unit.get_real(&[output, nowhere], &mut [0.0, 0.0]),
            1 => unit.get_real(&[count], &mut [0.0]),
            2 => fmi2GetReal(c, null(), 1, &raw mut value),
            3 => fmi2GetReal(c, &raw const output, 1, null_mut()),
            4 => fmi2GetReal(c, &raw const output, usize::MAX, &raw mut value),
            5 => unit.set_real(&[input], &[no_number(random)]),
            6 => unit.set_real(&[input, input], &[3.0, no_number(random)]),
            7 => unit.set_real(&[input, output], &[3.0, 1.0]),
            8 => unit.set_real(&[input, density], &[3.0, -1.0]),
            9 => fmi2SetReal(c, &raw const input, usize::MAX / 2, &raw const value),
            10 => unit.set_integer(density, 3),
            11 => fmi2GetBoolean(c, &raw const input, 1, &raw mut flag),
            12 => fmi2SetString(c, &raw const input, 1, &raw const text),
            13 => unit.set_slope(input, 2, 1.0),
            14 => unit.set_slope(input, 1, no_number(random)),
            15 => unit.set_slope(output, 1, 1.0),
            16 => unit.do_step(time + 0.5, 1e-3),
            17 => unit.do_step(time, [0.0, -1e-3, f64::NAN, f64::INFINITY][random.below(4)]),
            18 => unit.do_step(no_number(random), 1e-3),
            19 => unit.restore(null_mut()),
            20 => fmi2GetFMUstate(c, null_mut()),
            21 => damaged_bytes(unit, random),
            22 => wrong_room(unit),
            23 => unit.simple(Call::CancelStep),
            24 => fmi2GetRealOutputDerivatives(c, &raw const output, 1, &raw const order, &raw mut value),
            25 => fmi2GetDirectionalDerivative(
                c,
                &raw const output,
                1,
                &raw const no_input,
                1,
                &raw const seed,
                &raw mut value,
            ),
            26 => fmi2GetDirectionalDerivative(
                c,
                &raw const output,
                1,
                &raw const input,
                1,
                &raw const no_seed,
                &raw mut value,
            ),
            _ => in_the_wrong_mode(unit, mode, random),
        }
    }
}

/// A saved state as bytes, cut off or with a bit turned.
fn damaged_bytes(unit: &Unit, random: &mut Random) -> fmi2Status {
    let (mut saved, mut read) = (null_mut(), null_mut());
    assert_eq!(unit.save(&mut saved), fmi2Status::fmi2OK);
    let mut bytes = unit.serialize(saved);
    unit.forget(&mut saved);
    let place = random.below(bytes.len());
    match random.below(2) {
        0 => bytes.truncate(place),
        _ => bytes[place] ^= 1 << random.below(8),
    }
    let status = unit.deserialize(&bytes, &mut read);
    assert!(read.is_null(), "nothing is handed out");
    status
}

/// Less room than a saved state needs.
fn wrong_room(unit: &Unit) -> fmi2Status {
    let mut saved = null_mut();
    assert_eq!(unit.save(&mut saved), fmi2Status::fmi2OK);
    let mut bytes = unit.serialize(saved);
    bytes.pop();
    let status = unit.serialize_to(saved, &mut bytes);
    unit.forget(&mut saved);
    status
}

/// A call that the table forbids.
fn in_the_wrong_mode(unit: &Unit, mode: Mode, random: &mut Random) -> fmi2Status {
    let (legal, tolerated) = allowed(mode);
    let forbidden = |call: &Call| !legal.contains(call) && !tolerated.contains(call);
    let calls: Vec<Call> = TABLE.iter().map(|(call, _)| *call).filter(forbidden).collect();
    unit.call(calls[random.below(calls.len())])
}

/// No handle, for every function that takes one: an error, and no crash.
#[test]
fn no_instance() {
    let wrong = fmi2Status::fmi2Error;
    let (mut real, mut integer, mut status, mut text) = (0.0, 0, fmi2Status::fmi2OK, null());
    let (mut saved, mut size) = (null_mut(), 0);
    let (none, nobody) = (null::<u32>(), null_mut());
    // SAFETY: NULL is the question; arrays have no elements.
    let answers = unsafe {
        [
            fmi2SetDebugLogging(nobody, 1, 0, null()),
            fmi2SetupExperiment(nobody, 0, 0.0, 0.0, 0, 0.0),
            fmi2EnterInitializationMode(nobody),
            fmi2ExitInitializationMode(nobody),
            fmi2Terminate(nobody),
            fmi2Reset(nobody),
            fmi2GetReal(nobody, none, 0, null_mut()),
            fmi2GetInteger(nobody, none, 0, null_mut()),
            fmi2GetBoolean(nobody, none, 0, null_mut()),
            fmi2GetString(nobody, none, 0, null_mut()),
            fmi2SetReal(nobody, none, 0, null()),
            fmi2SetInteger(nobody, none, 0, null()),
            fmi2SetBoolean(nobody, none, 0, null()),
            fmi2SetString(nobody, none, 0, null()),
            fmi2GetFMUstate(nobody, &raw mut saved),
            fmi2SetFMUstate(nobody, saved),
            fmi2FreeFMUstate(nobody, &raw mut saved),
            fmi2SerializedFMUstateSize(nobody, saved, &raw mut size),
            fmi2SerializeFMUstate(nobody, saved, null_mut(), 0),
            fmi2DeSerializeFMUstate(nobody, null(), 0, &raw mut saved),
            fmi2GetDirectionalDerivative(nobody, none, 0, none, 0, null(), null_mut()),
            fmi2SetRealInputDerivatives(nobody, none, 0, null(), null()),
            fmi2GetRealOutputDerivatives(nobody, none, 0, null(), null_mut()),
            fmi2DoStep(nobody, 0.0, 1e-3, 1),
            fmi2CancelStep(nobody),
            fmi2GetStatus(nobody, fmi2DoStepStatus, &raw mut status),
            fmi2GetRealStatus(nobody, fmi2LastSuccessfulTime, &raw mut real),
            fmi2GetIntegerStatus(nobody, fmi2DoStepStatus, &raw mut integer),
            fmi2GetBooleanStatus(nobody, fmi2Terminated, &raw mut integer),
            fmi2GetStringStatus(nobody, fmi2PendingStatus, &raw mut text),
        ]
    };
    assert_eq!(answers, [wrong; TABLE.len() - 1], "all but fmi2FreeInstance, which takes NULL and says nothing");
    // SAFETY: NULL is fine.
    unsafe { fmi2FreeInstance(nobody) };
}
