//! What does the library answer where it offers nothing? An error that says why, in any mode, and NULL instead of an
//! instance; it touches no argument, so that NULL does no harm. Types that no variable has are errors as soon as a
//! variable is asked for.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::{
    collections::BTreeSet,
    ffi::{CStr, c_void},
    fs,
    path::Path,
    ptr::{null, null_mut},
};

use ancf14::{
    ffi::{
        fmi2, fmi3::*, fmi3_absent::*, fmi3_exchange::*, fmi3_other_types::*, fmi3_types::*, fmi3_values::*,
        types::fmi2Status,
    },
    fmi::lifecycle::{Call, Standard},
};

use super::super::ffi::MODEL;
use super::host::{ERROR, OK, Place, Unit};

/// The functions that are never legal, called with nothing.
pub fn refused(c: *mut c_void) -> Vec<(Call, fmi3Status)> {
    let none = null::<u32>();
    // SAFETY: the handle is live, NULL, or of another kind, which the library finds out; the arguments are not touched.
    unsafe {
        vec![
            (Call::GetClock, fmi3GetClock(c, none, 0, null_mut())),
            (Call::SetClock, fmi3SetClock(c, none, 0, null())),
            (Call::EnterConfigurationMode, fmi3EnterConfigurationMode(c)),
            (Call::ExitConfigurationMode, fmi3ExitConfigurationMode(c)),
            (Call::EnterEventMode, fmi3EnterEventMode(c)),
            (Call::EnterStepMode, fmi3EnterStepMode(c)),
            (Call::EvaluateDiscreteStates, fmi3EvaluateDiscreteStates(c)),
            (
                Call::UpdateDiscreteStates,
                fmi3UpdateDiscreteStates(c, null_mut(), null_mut(), null_mut(), null_mut(), null_mut(), null_mut()),
            ),
            (Call::GetIntervalDecimal, fmi3GetIntervalDecimal(c, none, 0, null_mut(), null_mut())),
            (Call::GetIntervalFraction, fmi3GetIntervalFraction(c, none, 0, null_mut(), null_mut(), null_mut())),
            (Call::GetShiftDecimal, fmi3GetShiftDecimal(c, none, 0, null_mut())),
            (Call::GetShiftFraction, fmi3GetShiftFraction(c, none, 0, null_mut(), null_mut())),
            (Call::SetIntervalDecimal, fmi3SetIntervalDecimal(c, none, 0, null())),
            (Call::SetIntervalFraction, fmi3SetIntervalFraction(c, none, 0, null(), null())),
            (Call::SetShiftDecimal, fmi3SetShiftDecimal(c, none, 0, null())),
            (Call::SetShiftFraction, fmi3SetShiftFraction(c, none, 0, null(), null())),
            (Call::EnterContinuousTimeMode, fmi3EnterContinuousTimeMode(c)),
            (Call::CompletedIntegratorStep, fmi3CompletedIntegratorStep(c, 0, null_mut(), null_mut())),
            (Call::SetTime, fmi3SetTime(c, 0.0)),
            (Call::SetContinuousStates, fmi3SetContinuousStates(c, null(), 0)),
            (Call::GetContinuousStateDerivatives, fmi3GetContinuousStateDerivatives(c, null_mut(), 0)),
            (Call::GetEventIndicators, fmi3GetEventIndicators(c, null_mut(), 0)),
            (Call::GetContinuousStates, fmi3GetContinuousStates(c, null_mut(), 0)),
            (Call::GetNominalsOfContinuousStates, fmi3GetNominalsOfContinuousStates(c, null_mut(), 0)),
            (Call::GetNumberOfEventIndicators, fmi3GetNumberOfEventIndicators(c, null_mut())),
            (Call::GetNumberOfContinuousStates, fmi3GetNumberOfContinuousStates(c, null_mut())),
            (Call::ActivateModelPartition, fmi3ActivateModelPartition(c, 0, 0.0)),
        ]
    }
}

#[test]
fn never_legal_calls_say_why() {
    let place = Place::new(MODEL);
    let unit = Unit::new(&place);
    for initialized in [false, true] {
        if initialized {
            unit.initialize();
        }
        unit.lines();
        let answers = refused(unit.c);
        let lines = unit.lines();
        assert_eq!(answers.len(), lines.len());
        for ((call, status), line) in answers.into_iter().zip(&lines) {
            assert_eq!(status, ERROR, "{call:?}");
            let name = Standard::Fmi3.name(call);
            assert!(
                line.starts_with(&format!("fmi3Error logStatusError {name} ")) && line.contains("not offered: "),
                "{line}"
            );
        }
    }
    assert!(refused(null_mut()).iter().all(|(_, status)| *status == ERROR));
    unit.whole_step(0.0, 1e-3);
}

/// No variable is of these types; to ask for none of them is fine.
#[test]
fn types_that_no_variable_has() {
    let place = Place::new(MODEL);
    let unit = Unit::new(&place);
    let (c, one, r) = (unit.c, place.reference("young"), null::<u32>());
    let words = ["Float32", "Int8", "UInt8", "Int16", "UInt16", "UInt32", "Int64", "UInt64", "Boolean", "String"];
    // SAFETY: the unit is live; arrays of no elements may be NULL, and values are not touched.
    let ask = |r: *const u32, n: usize| unsafe {
        [
            [fmi3GetFloat32(c, r, n, null_mut(), 0), fmi3SetFloat32(c, r, n, null(), 0)],
            [fmi3GetInt8(c, r, n, null_mut(), 0), fmi3SetInt8(c, r, n, null(), 0)],
            [fmi3GetUInt8(c, r, n, null_mut(), 0), fmi3SetUInt8(c, r, n, null(), 0)],
            [fmi3GetInt16(c, r, n, null_mut(), 0), fmi3SetInt16(c, r, n, null(), 0)],
            [fmi3GetUInt16(c, r, n, null_mut(), 0), fmi3SetUInt16(c, r, n, null(), 0)],
            [fmi3GetUInt32(c, r, n, null_mut(), 0), fmi3SetUInt32(c, r, n, null(), 0)],
            [fmi3GetInt64(c, r, n, null_mut(), 0), fmi3SetInt64(c, r, n, null(), 0)],
            [fmi3GetUInt64(c, r, n, null_mut(), 0), fmi3SetUInt64(c, r, n, null(), 0)],
            [fmi3GetBoolean(c, r, n, null_mut(), 0), fmi3SetBoolean(c, r, n, null(), 0)],
            [fmi3GetString(c, r, n, null_mut(), 0), fmi3SetString(c, r, n, null(), 0)],
            [fmi3GetBinary(c, r, n, null_mut(), null_mut(), 0), fmi3SetBinary(c, r, n, null(), null(), 0)],
        ]
    };
    assert_eq!(ask(r, 0), [[OK; 2]; 11]);
    unit.lines();
    assert_eq!(ask(&raw const one, 1), [[ERROR; 2]; 11]);
    let lines = unit.lines();
    for (k, word) in words.iter().enumerate() {
        for line in &lines[2 * k..2 * k + 2] {
            assert!(line.contains(&format!("young (value reference {one}) is of type Float64, not {word}")), "{line}");
        }
    }
}

/// Each wrong argument of the instantiation gives NULL and one line that names it.
#[test]
fn instantiation_is_refused_with_a_reason() {
    let place = Place::new(MODEL);
    let (token, here) = (place.token(), place.resources());
    let lines = std::cell::RefCell::new(Vec::<String>::new());
    unsafe extern "C" fn log(environment: *mut c_void, status: fmi3Status, category: fmi3String, message: fmi3String) {
        // SAFETY: the environment is the list below; the texts end with a zero byte.
        let (list, [category, message]) = unsafe {
            let texts = [category, message].map(|text| CStr::from_ptr(text).to_str().unwrap());
            (&*environment.cast::<std::cell::RefCell<Vec<String>>>(), texts)
        };
        list.borrow_mut().push(format!("{status:?} {category} {message}"));
    }
    let environment = std::ptr::from_ref(&lines).cast_mut().cast::<c_void>();
    let make = |name: *const _, token: *const _, resources: *const _, event: u8, required: &[u32]| {
        // SAFETY: everything lives during the call.
        let c = unsafe {
            let (list, count) = (required.as_ptr(), required.len());
            fmi3InstantiateCoSimulation(
                name,
                token,
                resources,
                0,
                1,
                event,
                0,
                list,
                count,
                environment,
                Some(log),
                None,
            )
        };
        drop(std::panic::take_hook());
        c
    };
    let (name, token, here) = (c"one".as_ptr(), token.as_ptr(), here.as_ptr());
    let [force, position, gravity] = ["tip.force", "P.position", "gravity"].map(|name| place.reference(name));
    for (made, reason) in [
        (make(null(), token, here, 0, &[]), "instance name is NULL or blank"),
        (make(c" ".as_ptr(), token, here, 0, &[]), "instance name is NULL or blank"),
        (make(name, null(), here, 0, &[]), "`instantiationToken` is NULL"),
        (make(name, c"{wrong}".as_ptr(), here, 0, &[]), "`{wrong}` is not that of the model file"),
        (make(name, token, c"/nowhere/".as_ptr(), 0, &[]), "/nowhere/model.toml: No such file"),
        (make(name, token, here, 1, &[]), "no Event Mode"),
    ] {
        assert!(made.is_null(), "{reason}");
        let line = lines.borrow_mut().remove(0);
        assert!(
            line.contains(reason) && line.starts_with("fmi3Error logStatusError fmi3InstantiateCoSimulation: "),
            "{line}"
        );
    }
    assert!(lines.borrow().is_empty());
    let fine = make(name, token, here, 0, &[position, force]);
    assert!(!fine.is_null());
    assert!(lines.borrow().is_empty());
    // Variables that no update offers are a warning each: a host may require them without ever asking.
    let warned = make(name, token, here, 0, &[position, gravity, position + 1, 9999]);
    assert!(!warned.is_null());
    let told = lines.take();
    assert_eq!(told.len(), 3, "{told:?}");
    for (line, reason) in
        told.iter().zip(["`gravity[1]` cannot be accessed", "is an element, P.position[2]", "reference 9999"])
    {
        assert!(line.starts_with("fmi3Warning logStatusWarning ") && line.contains(reason), "{line}");
    }
    // SAFETY: the handle is live and not used again; NULL is fine.
    unsafe {
        fmi3FreeInstance(fine);
        fmi3FreeInstance(warned);
        fmi3FreeInstance(null_mut());
        assert!(fmi3InstantiateModelExchange(name, token, here, 0, 0, environment, Some(log)).is_null());
        assert!(
            fmi3InstantiateScheduledExecution(name, token, here, 0, 0, environment, Some(log), None, None, None)
                .is_null()
        );
        assert!(fmi3InstantiateModelExchange(name, token, here, 0, 0, null_mut(), None).is_null());
    }
    let told = lines.take();
    assert_eq!(told.len(), 2, "{told:?}");
    assert!(told[0].contains("for co-simulation only; call fmi3InstantiateCoSimulation"), "{told:?}");
    assert!(told[1].contains("this unit has no scheduled execution"), "{told:?}");
}

/// A handle of one version is an error in the functions of the other, and stays usable.
#[test]
fn handles_of_the_other_version() {
    let place = Place::new(MODEL);
    let unit = Unit::new(&place);
    unit.initialize();
    unit.lines();
    // SAFETY: the handle is live.
    assert_eq!(unsafe { fmi2::fmi2DoStep(unit.c, 0.0, 1e-3, 0) }, fmi2Status::fmi2Error);
    assert!(unit.lines()[0].contains("fmi2DoStep in step mode at t = 0 s: this instance was not made by this version"));
    unit.whole_step(0.0, 1e-3);
    let other = super::super::unit::Place::new(MODEL);
    let other = super::super::unit::Unit::new(&other);
    // SAFETY: the handle is live; no values are asked for.
    assert_eq!(unsafe { fmi3GetFloat64(other.c, null(), 0, null_mut(), 0) }, ERROR);
    assert!(super::super::unit::is_fine(other.setup(0.0)));
}

/// Hosts look up all names of the standard's header, and find them with its types: the list of exported names is that
/// of the sources.
#[test]
fn every_function_of_the_standard_is_there() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/ffi");
    let mut names = BTreeSet::new();
    for file in ["fmi3.rs", "fmi3_values.rs", "fmi3_other_types.rs", "fmi3_exchange.rs", "fmi3_absent.rs"] {
        let text = fs::read_to_string(folder.join(file)).unwrap();
        names.extend(text.split("extern \"C\" fn ").skip(1).map(|rest| rest.split('(').next().unwrap().to_owned()));
    }
    let header = include_str!("../../../../c-examples/fmi3/fmi3FunctionTypes.h");
    let standard: BTreeSet<String> = header
        .split(|c: char| !c.is_ascii_alphanumeric())
        .filter_map(|word| Some(word.strip_suffix("TYPE")?.to_owned()))
        .filter(|word| word.starts_with("fmi3"))
        .collect();
    assert_eq!(names, standard);
}
