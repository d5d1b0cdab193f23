//! Do values of FMI 3.0 arrive where the description says, arrays element by element? All of a call or nothing, and
//! what is wrong is said.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::ptr::{null, null_mut};

use ancf14::{
    ffi::{fmi3::*, fmi3_values::*},
    fmi::{Model, Value},
};

use super::super::ffi::MODEL;
use super::host::{ERROR, HELD, OK, Place, Unit, Wishes};

/// The same unit, driven by FMI 2.0's instance in Rust, gives the same bits, element by element.
#[test]
fn values_are_those_of_fmi_2() {
    let place = Place::new(HELD);
    let unit = Unit::new(&place);
    let mut other = ancf14::fmi::instance::Instance::new(
        ancf14::model::simulation::Simulation::load("model.toml", HELD, &[]).unwrap(),
        false,
    );
    let first = place.reference("push.force");
    assert_eq!(unit.set(&[first], &[1.0, -2.0, 3.0]), OK);
    other.set_real(&[first, first + 1, first + 2], &[1.0, -2.0, 3.0]).unwrap();
    unit.initialize();
    other.enter_initialization_mode().unwrap();
    other.exit_initialization_mode().unwrap();
    for k in 0..3 {
        unit.whole_step(0.01 * f64::from(k), 0.01);
        other.do_step(0.01 * f64::from(k), 0.01).unwrap();
        let outputs = place.of(ancf14::fmi::variable::Causality::Output);
        let variables = other.model().variables();
        let expected: Vec<u64> = (0..variables.len())
            .filter(|row| variables[*row].causality == ancf14::fmi::variable::Causality::Output)
            .filter_map(|row| match other.model().value(row) {
                Value::Real(value) => Some(value.to_bits()),
                Value::Integer(_) => None,
            })
            .collect();
        assert_eq!(expected.len(), outputs.1);
        assert_eq!(unit.bits(), expected, "step {k}");
    }
    assert_eq!(unit.value::<3>("push.force"), [1.0, -2.0, 3.0]);
}

/// The time is a variable, behind the table; whole numbers are Int32.
#[test]
fn time_and_counts() {
    let place = Place::new(HELD);
    let unit = Unit::new(&place);
    let time = u32::try_from(place.model.variables().len()).unwrap();
    // SAFETY: the unit is live; one start time.
    assert_eq!(unsafe { fmi3EnterInitializationMode(unit.c, 0, 0.0, 0.25, 0, 0.0) }, OK);
    let mut value = [f64::NAN; 4];
    assert_eq!(unit.get(&[time, place.reference("tip.quaternion")][..1], &mut value[..1]), OK);
    assert_eq!(value[0], 0.25);
    // SAFETY: as above.
    assert_eq!(unsafe { fmi3ExitInitializationMode(unit.c) }, OK);
    unit.whole_step(0.25, 0.01);
    let mut both = [f64::NAN; 5];
    assert_eq!(unit.get(&[place.reference("tip.quaternion"), time], &mut both), OK);
    assert!((both[4] - 0.26).abs() < 1e-15, "{both:?}"); // one sum of two doubles
    assert!((both[0].hypot(both[1]).hypot(both[2]).hypot(both[3]) - 1.0).abs() < 1e-12); // a quaternion, to round-off
    assert_eq!(unit.set(&[time], &[1.0]), ERROR);
    let (steps, mut count) = (place.reference("statistics.steps"), 0);
    // SAFETY: one reference, one value.
    assert_eq!(unsafe { fmi3GetInt32(unit.c, &raw const steps, 1, &raw mut count, 1) }, OK);
    assert_eq!(count, 10);
}

/// As many values as elements, known references, the right type; else nothing is read or set, and the log says why.
#[test]
fn wrong_arguments_change_nothing() {
    let place = Place::new(HELD);
    let unit = Unit::new(&place);
    unit.initialize();
    let (force, tip) = (place.reference("push.force"), place.reference("tip.position"));
    assert_eq!(unit.set(&[force], &[1.0, 2.0, 3.0]), OK);
    let told = |reason: &str| {
        let lines = unit.lines();
        assert!(lines.iter().any(|line| line.contains(reason) && line.starts_with("fmi3Error")), "{reason}: {lines:?}");
    };
    unit.lines();
    assert_eq!(unit.set(&[force], &[4.0]), ERROR);
    told("fmi3SetFloat64 in step mode at t = 0 s: the variables have 3 values");
    assert_eq!(unit.set(&[force], &[4.0; 4]), ERROR);
    told("the variables have 3 values, all elements of arrays counted, but 4 are passed");
    assert_eq!(unit.set(&[force], &[4.0, 5.0, f64::NAN]), ERROR);
    told("push.force[3] cannot be NaN");
    assert_eq!(unit.set(&[force + 1], &[4.0]), ERROR);
    told("is an element, push.force[2]");
    assert_eq!(unit.set(&[force, tip], &[4.0; 6]), ERROR);
    told("tip.position[1] is a result");
    assert_eq!(unit.set(&[9999], &[4.0]), ERROR);
    told("there is no variable with value reference 9999");
    assert_eq!(unit.value::<3>("push.force"), [1.0, 2.0, 3.0]);
    let mut values = [7.0; 3];
    assert_eq!(unit.get(&[tip, 9999], &mut values), ERROR);
    assert_eq!(unit.get(&[place.reference("arm.elements")], &mut values[..1]), ERROR);
    assert_eq!(values, [7.0; 3]);
    let mut count = [7];
    // SAFETY: one reference, one value.
    assert_eq!(unsafe { fmi3GetInt32(unit.c, &raw const tip, 1, count.as_mut_ptr(), 1) }, ERROR);
    unit.lines();
    // SAFETY: NULL is the question; what is not NULL has one element.
    unsafe {
        assert_eq!(fmi3GetFloat64(unit.c, null(), 1, values.as_mut_ptr(), 1), ERROR);
        told("`valueReferences` is NULL");
        assert_eq!(fmi3GetFloat64(unit.c, &raw const tip, 1, null_mut(), 3), ERROR);
        told("`values` is NULL");
        assert_eq!(fmi3GetFloat64(unit.c, null(), 0, null_mut(), 0), OK);
        assert_eq!(fmi3GetFloat64(null_mut(), null(), 0, null_mut(), 0), ERROR);
        assert_eq!(fmi3DoStep(unit.c, 0.0, 1e-3, 0, null_mut(), null_mut(), null_mut(), null_mut()), ERROR);
        told("`eventHandlingNeeded` is NULL");
    }
    unit.whole_step(0.0, 1e-3);
}

/// Start values can be read at once; fixed parameters are set until the end of the initialization, whole arrays too.
#[test]
fn starts_and_parameters() {
    let place = Place::new(HELD);
    let unit = Unit::new(&place);
    assert_eq!(unit.value::<3>("arm.to"), [0.5, 0.0, 0.0]);
    assert_eq!(unit.set(&[place.reference("arm.to")], &[0.4, 0.0, 0.0]), OK);
    unit.initialize();
    assert_eq!(unit.value::<3>("tip.position"), [0.4, 0.0, 0.0]);
    assert_eq!(unit.set(&[place.reference("arm.to")], &[0.5, 0.0, 0.0]), ERROR);
    assert_eq!(unit.set(&[place.reference("gravity")], &[0.0, 0.0, 0.0]), OK); // tunable
    // SAFETY: the unit is live.
    assert_eq!(unsafe { fmi3Reset(unit.c) }, OK);
    assert_eq!(unit.value::<3>("arm.to"), [0.5, 0.0, 0.0]);
}

/// Log categories are switched one by one, and nothing but errors is logged where they are off (FMI 3.0, section
/// 2.3.1).
#[test]
fn log_categories() {
    let place = Place::new(MODEL);
    let unit = Unit::with(&place, Wishes { updates: false, early_return: false, logging: false });
    let switch = |on: u8, names: &[&std::ffi::CStr]| {
        let names: Vec<_> = names.iter().map(|name| name.as_ptr()).collect();
        // SAFETY: the unit is live; the texts end with a zero byte.
        unsafe { fmi3SetDebugLogging(unit.c, on, names.len(), names.as_ptr()) }
    };
    let reset = || {
        // SAFETY: the unit is live.
        assert_eq!(unsafe { fmi3Terminate(unit.c) }, ERROR); // not initialized
        unit.lines()
    };
    assert_eq!(reset().len(), 1);
    assert_eq!(switch(1, &[c"logEvents"]), OK);
    unit.initialize();
    assert!(unit.lines().iter().any(|line| line.starts_with("fmi3OK logEvents initialized")));
    assert_eq!(switch(0, &[c"logEvents"]), OK);
    assert_eq!(switch(1, &[c"logStatusError"]), OK);
    unit.whole_step(0.0, 1e-3);
    assert_eq!(unit.lines(), Vec::<String>::new());
    assert_eq!(switch(1, &[]), OK);
    unit.whole_step(1e-3, 1e-3);
    assert!(unit.lines()[0].starts_with("fmi3OK logEvents step from"));
}
