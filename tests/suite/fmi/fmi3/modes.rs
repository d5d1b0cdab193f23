//! Which call of FMI 3.0 is legal in which mode? The standard's lists (sections 2.3 and 4.2.1) are written down here a
//! second time, and every function of a built unit is called in every mode that a host can bring it to. A refused call
//! says so and changes nothing.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{
    cell::RefCell,
    ptr::{null, null_mut},
};

use ancf14::{
    ffi::{fmi3::*, fmi3_other_types::*, fmi3_types::*, fmi3_values::*},
    fmi::{
        lifecycle::{
            Call, Mode, Standard,
            fmi3::{TABLE, name},
        },
        variable::Causality,
    },
};

use super::super::ffi::MODEL;
use super::absent;
use super::host::{ERROR, OK, Place, Unit, Wishes};

const MODES: [Mode; 6] =
    [Mode::Instantiated, Mode::Initialization, Mode::Step, Mode::Terminated, Mode::Error, Mode::Update];

const READS: [Call; 13] = [
    Call::GetFloat32,
    Call::GetReal,
    Call::GetInt8,
    Call::GetUInt8,
    Call::GetInt16,
    Call::GetUInt16,
    Call::GetInteger,
    Call::GetUInt32,
    Call::GetInt64,
    Call::GetUInt64,
    Call::GetBoolean,
    Call::GetString,
    Call::GetBinary,
];
const WRITES: [Call; 13] = [
    Call::SetFloat32,
    Call::SetReal,
    Call::SetInt8,
    Call::SetUInt8,
    Call::SetInt16,
    Call::SetUInt16,
    Call::SetInteger,
    Call::SetUInt32,
    Call::SetInt64,
    Call::SetUInt64,
    Call::SetBoolean,
    Call::SetString,
    Call::SetBinary,
];
const STATES: [Call; 6] = [
    Call::GetFMUstate,
    Call::SetFMUstate,
    Call::FreeFMUstate,
    Call::SerializedFMUstateSize,
    Call::SerializeFMUstate,
    Call::DeSerializeFMUstate,
];

/// What the standard allows in a mode, and what is tolerated beyond it. A failed step terminates an instance by the
/// standard; here it may also be revived.
fn allowed(mode: Mode) -> (Vec<Call>, Vec<Call>) {
    use Call::*;
    let dependencies = [GetNumberOfVariableDependencies, GetVariableDependencies];
    let settable = [&[SetDebugLogging, Reset, FreeInstance][..], &STATES].concat();
    let derivatives = [GetDirectionalDerivative, GetAdjointDerivative];
    let (legal, tolerated) = match mode {
        // The experiment is set up by fmi3EnterInitializationMode itself.
        Mode::Instantiated => (
            [&settable, &READS[..], &WRITES, &dependencies, &[EnterInitializationMode, SetupExperiment]].concat(),
            vec![],
        ),
        Mode::Initialization => (
            [&settable, &READS[..], &WRITES, &dependencies, &derivatives, &[ExitInitializationMode]].concat(),
            vec![GetRealOutputDerivatives],
        ),
        Mode::Step => (
            [
                &settable,
                &READS[..],
                &WRITES,
                &dependencies,
                &derivatives,
                &[GetRealOutputDerivatives, DoStep, Terminate],
            ]
            .concat(),
            vec![],
        ),
        Mode::Terminated | Mode::Error => {
            ([&settable, &READS[..], &dependencies, &derivatives, &[GetRealOutputDerivatives]].concat(), vec![])
        }
        Mode::Update => ([&READS[..], &WRITES, &dependencies, &[GetRealOutputDerivatives]].concat(), vec![]),
        Mode::Fatal => (vec![], vec![FreeInstance, FreeFMUstate]),
        Mode::Event | Mode::ContinuousTime => (vec![], vec![]), // of Model Exchange
    };
    (legal, tolerated)
}

/// The rows have a column per mode, and only the stated tolerances are marked.
#[test]
fn rows_and_marks_of_the_table() {
    let columns = [
        Mode::Instantiated,
        Mode::Initialization,
        Mode::Step,
        Mode::Terminated,
        Mode::Error,
        Mode::Fatal,
        Mode::Update,
    ];
    for (call, row) in TABLE {
        assert_eq!(row.len(), columns.len(), "{}", name(call));
        for (column, mode) in columns.into_iter().enumerate() {
            assert_eq!(mode as usize, column);
            let (legal, tolerated) = allowed(mode);
            let expected = match (legal.contains(&call), tolerated.contains(&call)) {
                (true, _) => b'x',
                (_, true) => b'~',
                _ => b'.',
            };
            assert_eq!(row.as_bytes()[column], expected, "{} {mode}", name(call));
        }
    }
}

/// A function with arguments that are in order: values of nothing, a state of its own.
pub fn call(unit: &Unit<'_>, call: Call) -> fmi3Status {
    let (c, r) = (unit.c, null::<u32>());
    let (mut saved, mut size, tip) = (null_mut(), 0, unit.place.of(Causality::Output).0[0]);
    let (mut flags, mut time) = ([0_u8; 3], 0.0);
    // SAFETY: the unit is live; arrays without elements may be NULL.
    unsafe {
        match call {
            Call::SetDebugLogging => fmi3SetDebugLogging(c, 1, 0, null()),
            Call::EnterInitializationMode | Call::SetupExperiment => {
                fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0)
            }
            Call::ExitInitializationMode => fmi3ExitInitializationMode(c),
            Call::Terminate => fmi3Terminate(c),
            Call::Reset => fmi3Reset(c),
            Call::GetFloat32 => fmi3GetFloat32(c, r, 0, null_mut(), 0),
            Call::GetReal => fmi3GetFloat64(c, r, 0, null_mut(), 0),
            Call::GetInt8 => fmi3GetInt8(c, r, 0, null_mut(), 0),
            Call::GetUInt8 => fmi3GetUInt8(c, r, 0, null_mut(), 0),
            Call::GetInt16 => fmi3GetInt16(c, r, 0, null_mut(), 0),
            Call::GetUInt16 => fmi3GetUInt16(c, r, 0, null_mut(), 0),
            Call::GetInteger => fmi3GetInt32(c, r, 0, null_mut(), 0),
            Call::GetUInt32 => fmi3GetUInt32(c, r, 0, null_mut(), 0),
            Call::GetInt64 => fmi3GetInt64(c, r, 0, null_mut(), 0),
            Call::GetUInt64 => fmi3GetUInt64(c, r, 0, null_mut(), 0),
            Call::GetBoolean => fmi3GetBoolean(c, r, 0, null_mut(), 0),
            Call::GetString => fmi3GetString(c, r, 0, null_mut(), 0),
            Call::GetBinary => fmi3GetBinary(c, r, 0, null_mut(), null_mut(), 0),
            Call::SetFloat32 => fmi3SetFloat32(c, r, 0, null(), 0),
            Call::SetReal => fmi3SetFloat64(c, r, 0, null(), 0),
            Call::SetInt8 => fmi3SetInt8(c, r, 0, null(), 0),
            Call::SetUInt8 => fmi3SetUInt8(c, r, 0, null(), 0),
            Call::SetInt16 => fmi3SetInt16(c, r, 0, null(), 0),
            Call::SetUInt16 => fmi3SetUInt16(c, r, 0, null(), 0),
            Call::SetInteger => fmi3SetInt32(c, r, 0, null(), 0),
            Call::SetUInt32 => fmi3SetUInt32(c, r, 0, null(), 0),
            Call::SetInt64 => fmi3SetInt64(c, r, 0, null(), 0),
            Call::SetUInt64 => fmi3SetUInt64(c, r, 0, null(), 0),
            Call::SetBoolean => fmi3SetBoolean(c, r, 0, null(), 0),
            Call::SetString => fmi3SetString(c, r, 0, null(), 0),
            Call::SetBinary => fmi3SetBinary(c, r, 0, null(), null(), 0),
            Call::GetFMUstate | Call::SetFMUstate | Call::FreeFMUstate => {
                let mut status = fmi3GetFMUState(c, &raw mut saved);
                if call == Call::SetFMUstate {
                    status = fmi3SetFMUState(c, saved);
                }
                let freed = fmi3FreeFMUState(c, &raw mut saved);
                if call == Call::FreeFMUstate { freed } else { status }
            }
            Call::SerializedFMUstateSize | Call::SerializeFMUstate | Call::DeSerializeFMUstate => {
                fmi3GetFMUState(c, &raw mut saved);
                let mut status = fmi3SerializedFMUStateSize(c, saved, &raw mut size);
                let mut bytes = vec![0_u8; size];
                if call != Call::SerializedFMUstateSize {
                    status = fmi3SerializeFMUState(c, saved, bytes.as_mut_ptr(), size);
                }
                if call == Call::DeSerializeFMUstate {
                    status = fmi3DeserializeFMUState(c, bytes.as_ptr(), size, &raw mut saved);
                }
                fmi3FreeFMUState(c, &raw mut saved);
                status
            }
            Call::GetDirectionalDerivative => fmi3GetDirectionalDerivative(c, r, 0, r, 0, null(), 0, null_mut(), 0),
            Call::GetAdjointDerivative => fmi3GetAdjointDerivative(c, r, 0, r, 0, null(), 0, null_mut(), 0),
            Call::GetRealOutputDerivatives => fmi3GetOutputDerivatives(c, r, 0, null(), null_mut(), 0),
            Call::GetNumberOfVariableDependencies => fmi3GetNumberOfVariableDependencies(c, tip, &raw mut size),
            Call::GetVariableDependencies => {
                fmi3GetNumberOfVariableDependencies(c, tip, &raw mut size);
                let (mut own, mut other, mut kinds) = (vec![0; size], vec![0; size], vec![0; size]);
                let mut references = vec![0; size];
                let (own, other, kinds) = (own.as_mut_ptr(), other.as_mut_ptr(), kinds.as_mut_ptr());
                fmi3GetVariableDependencies(c, tip, own, references.as_mut_ptr(), other, kinds, size)
            }
            Call::DoStep => {
                let [event, end, early] = &mut flags;
                // The time that is reached, where there is a step already: the host of these tests knows it.
                fmi3DoStep(c, 1e-3, 1e-3, 0, event, end, early, &raw mut time)
            }
            other => panic!("{} is never legal", name(other)),
        }
    }
}

/// Brings a new unit to a mode as a host does, and calls `body` there, in Intermediate Update Mode from within a step.
fn in_mode<R>(place: &Place, mode: Mode, body: impl FnOnce(&Unit<'_>) -> R) -> (R, Vec<u64>) {
    let unit = Unit::with(place, Wishes { updates: true, early_return: true, logging: true });
    let begin = |unit: &Unit<'_>| {
        unit.initialize();
        unit.whole_step(0.0, 1e-3);
    };
    match mode {
        Mode::Instantiated => (),
        // SAFETY: the unit is live.
        Mode::Initialization => assert_eq!(unsafe { fmi3EnterInitializationMode(unit.c, 0, 0.0, 0.0, 0, 0.0) }, OK),
        Mode::Step | Mode::Update => begin(&unit),
        Mode::Terminated => {
            begin(&unit);
            // SAFETY: as above.
            assert_eq!(unsafe { fmi3Terminate(unit.c) }, OK);
        }
        Mode::Error => {
            begin(&unit);
            assert_eq!(unit.set(&[place.reference("tip.force")], &[0.0, 0.0, 1e20]), OK);
            assert_eq!(unit.step(1e-3, 1e-3).status, ERROR);
        }
        Mode::Fatal | Mode::Event | Mode::ContinuousTime => panic!("no call brings a unit there"),
    }
    unit.lines();
    let result = RefCell::new(None);
    let body = RefCell::new(Some(body));
    let once = |unit: &Unit<'_>| {
        if let Some(body) = body.take() {
            *result.borrow_mut() = Some(body(unit));
        }
        false
    };
    if mode == Mode::Update {
        let answer = unit.step_with(1e-3, 3e-3, |unit, _| once(unit));
        assert_eq!((answer.status, answer.time), (OK, 4e-3), "{:?}", unit.lines());
    } else {
        once(&unit);
    }
    let bits = going_on(&unit, mode);
    (result.take().unwrap(), bits)
}

/// The bits that a unit has, and those after it goes on as hosts do.
fn going_on(unit: &Unit<'_>, mode: Mode) -> Vec<u64> {
    let mut bits = unit.bits();
    let go_on: &[Call] = match mode {
        Mode::Instantiated => &[Call::EnterInitializationMode, Call::ExitInitializationMode],
        Mode::Initialization => &[Call::ExitInitializationMode],
        Mode::Step => &[Call::DoStep, Call::Terminate],
        _ => &[],
    };
    for next in go_on {
        assert_eq!(call(unit, *next), OK, "{:?}", unit.lines());
        bits.extend(unit.bits());
    }
    bits
}

#[test]
fn every_function_in_every_mode() {
    let place = Place::new(MODEL);
    for mode in MODES {
        let ((), expected) = in_mode(&place, mode, |_| ());
        let (legal, tolerated) = allowed(mode);
        for (function, _) in TABLE {
            // FreeInstance is the unit's end, legal wherever a host is not inside another call.
            if function == Call::FreeInstance {
                continue;
            }
            let label = name(function);
            if legal.contains(&function) || tolerated.contains(&function) {
                let unit = RefCell::new(None);
                let run = |u: &Unit<'_>| *unit.borrow_mut() = Some((call(u, function), u.lines()));
                legally(&place, mode, run);
                let (status, lines) = unit.take().unwrap();
                let refused = lines.iter().any(|line| line.contains("not allowed now"));
                assert!(status == OK && !refused, "{label} {mode}: {status:?} {lines:?}");
            } else {
                let ((status, lines), bits) = in_mode(&place, mode, |unit| (call(unit, function), unit.lines()));
                assert_eq!(status, ERROR, "{label} {mode}");
                let place = format!("{label} {mode} at t = ");
                let says = |line: &String| line.contains(&place) && line.contains("not allowed now");
                assert!(lines.iter().any(says), "{label} {mode}: {lines:?}");
                assert_eq!(bits, expected, "{label} {mode}");
            }
        }
    }
}

/// Calls `body` in a mode, whatever becomes of the unit.
fn legally(place: &Place, mode: Mode, body: impl Fn(&Unit<'_>)) {
    if mode == Mode::Update {
        in_mode(place, mode, |unit| body(unit));
        return;
    }
    let unit = Unit::with(place, Wishes { updates: true, early_return: true, logging: true });
    // The same way there.
    match mode {
        Mode::Instantiated => (),
        // SAFETY: the unit is live.
        Mode::Initialization => assert_eq!(unsafe { fmi3EnterInitializationMode(unit.c, 0, 0.0, 0.0, 0, 0.0) }, OK),
        _ => {
            unit.initialize();
            unit.whole_step(0.0, 1e-3);
        }
    }
    match mode {
        // SAFETY: as above.
        Mode::Terminated => assert_eq!(unsafe { fmi3Terminate(unit.c) }, OK),
        Mode::Error => {
            assert_eq!(unit.set(&[place.reference("tip.force")], &[0.0, 0.0, 1e20]), OK);
            assert_eq!(unit.step(1e-3, 1e-3).status, ERROR);
        }
        _ => (),
    }
    unit.lines();
    body(&unit);
}

/// Calls that are never legal are refused in every mode, and change nothing.
#[test]
fn what_is_never_legal_changes_nothing() {
    let place = Place::new(MODEL);
    for mode in MODES {
        let ((), expected) = in_mode(&place, mode, |_| ());
        let (answers, bits) = in_mode(&place, mode, |unit| absent::refused(unit.c));
        assert!(answers.iter().all(|(_, status)| *status == ERROR), "{mode}");
        assert_eq!(bits, expected, "{mode}");
    }
}

/// An illegal call says which way is open, by the names of FMI 3.0.
#[test]
fn illegal_calls_say_what_to_do() {
    let place = Place::new(MODEL);
    let said = |mode, function| in_mode(&place, mode, |unit| (call(unit, function), unit.lines())).0.1.pop().unwrap();
    assert!(said(Mode::Instantiated, Call::DoStep).contains("call fmi3EnterInitializationMode and fmi3Exit"));
    assert!(said(Mode::Initialization, Call::DoStep).contains("call fmi3ExitInitializationMode first"));
    assert!(said(Mode::Step, Call::ExitInitializationMode).contains("fmi3Reset starts over"));
    assert!(said(Mode::Error, Call::DoStep).contains("only fmi3SetFMUState with an earlier state, or fmi3Reset"));
    assert!(said(Mode::Update, Call::DoStep).contains("goes on when the callback returns"));
    assert_eq!(Standard::Fmi3.name(Call::DeSerializeFMUstate), "fmi3DeserializeFMUState");
}
