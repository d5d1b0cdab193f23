//! Does a host that hears of internal steps see the motion, and may it end a communication step there? Whether it
//! listens or not must not change a bit; values between are those that shorter communication steps have; and after an
//! early return everything is that of the shorter step: states, derivatives, the continuation. Inputs that are set
//! between act on the rest of the step.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use std::cell::{Cell, RefCell};

use ancf14::{
    ffi::{fmi3::*, fmi3_values::*},
    fmi::variable::Causality,
};

use super::super::ffi::MODEL;
use super::host::{ERROR, HELD, OK, Place, Told, Unit, Wishes};

const LISTENS: Wishes = Wishes { updates: true, early_return: true, logging: true };

/// A cable whose solver chooses its steps, a static analysis, and generalized-alpha.
const PACED: &str = include_str!("../../../../models/cantilever.toml");
const STATIC: &str = include_str!("../../../../models/princeton_beam.toml");

/// The arm with internal steps that the solver chooses.
fn paced() -> String {
    MODEL.replace("step = 1e-3", "accuracy = 1e-4")
}

fn alpha() -> String {
    MODEL.replace("step = 1e-3", "step = 1e-3\nintegrator = \"generalized_alpha\"")
}

/// Reads everything that can be read, and goes on.
fn reads(unit: &Unit<'_>, _: Told) -> bool {
    unit.bits();
    rates(unit);
    false
}

/// Derivatives by time of all outputs.
fn rates(unit: &Unit<'_>) -> Vec<f64> {
    let (references, count) = unit.place.of(Causality::Output);
    let (orders, mut values) = (vec![1; references.len()], vec![f64::NAN; count]);
    // SAFETY: the unit is live; the arrays have the lengths that are passed.
    let status = unsafe {
        fmi3GetOutputDerivatives(
            unit.c,
            references.as_ptr(),
            references.len(),
            orders.as_ptr(),
            values.as_mut_ptr(),
            count,
        )
    };
    assert_eq!(status, OK, "{:?}", unit.lines());
    values
}

/// The bits at communication points are the same whether the host listens, reads, or neither.
#[test]
fn listening_changes_nothing() {
    for (text, step) in [(HELD, 7.5e-3), (MODEL, 5e-3), (PACED, 0.02), (STATIC, 0.3), (&alpha(), 5e-3)] {
        let place = Place::new(text);
        let (deaf, listener, reader) = (Unit::new(&place), Unit::with(&place, LISTENS), Unit::with(&place, LISTENS));
        [&deaf, &listener, &reader].into_iter().for_each(Unit::initialize);
        let given = (text == HELD).then(|| ["hand.position", "push.force"].map(|name| place.reference(name)));
        for k in 0..3 {
            let time = step * f64::from(k);
            if let Some(given) = given {
                let values = [1e-4 * f64::from(k), 0.0, 2e-4, 0.1, f64::from(k), 0.0];
                for unit in [&deaf, &listener, &reader] {
                    assert_eq!(unit.set(&given, &values), OK);
                }
            }
            deaf.whole_step(time, step);
            listener.whole_step(time, step);
            let answer = reader.step_with(time, step, reads);
            assert_eq!((answer.status, answer.early), (OK, false), "{:?}", reader.lines());
            let expected = deaf.bits();
            assert_eq!(listener.bits(), expected, "step {k}");
            assert_eq!(reader.bits(), expected, "step {k}");
        }
        assert!(deaf.told().is_empty());
        assert_eq!(listener.told(), reader.told());
    }
}

/// The host hears of every internal step, the last one included; values there are those of a unit with such
/// communication steps.
#[test]
fn every_internal_step_is_told() {
    let place = Place::new(MODEL);
    let (unit, fine) = (Unit::with(&place, LISTENS), Unit::new(&place));
    [&unit, &fine].into_iter().for_each(Unit::initialize);
    let seen = RefCell::new(Vec::new());
    let answer = unit.step_with(0.0, 5e-3, |unit, _| {
        seen.borrow_mut().push(unit.bits());
        false
    });
    assert_eq!((answer.status, answer.time), (OK, 5e-3));
    let told = unit.told();
    assert_eq!(told.len(), 5);
    for (k, told) in told.into_iter().enumerate() {
        let end = 1e-3 * (k + 1) as f64;
        let can_return = k < 4;
        let expected = Told { time: end, set_requested: can_return, get_allowed: true, finished: true, can_return };
        assert_eq!(told, expected);
        fine.whole_step(1e-3 * k as f64, 1e-3);
        assert_eq!(seen.borrow()[k], fine.bits(), "internal step {k}");
    }
}

/// The values and the continuation after an early return are those of a host that stepped there by itself.
#[test]
fn an_early_return_is_a_shorter_step() {
    let place = Place::new(MODEL);
    let (unit, fine) = (Unit::with(&place, LISTENS), Unit::new(&place));
    for unit in [&unit, &fine] {
        assert_eq!(unit.set(&[place.reference("tip.force")], &[0.0, 0.0, 5.0]), OK);
        unit.initialize();
    }
    let answer = unit.step_with(0.0, 1e-2, |_, told| told.time > 3.5e-3);
    assert_eq!((answer.status, answer.early, answer.time), (OK, true, 4e-3), "{:?}", unit.lines());
    fine.whole_step(0.0, 4e-3);
    assert_eq!(unit.bits(), fine.bits());
    assert_eq!(rates(&unit), rates(&fine));
    for (time, step) in [(4e-3, 6e-3), (1e-2, 1e-2)] {
        unit.whole_step(time, step);
        fine.whole_step(time, step);
        assert_eq!(unit.bits(), fine.bits(), "after t = {time} s");
    }
}

/// A host that did not allow early returns, or asks at the very end, gets the whole step.
#[test]
fn early_returns_are_only_where_they_can_be() {
    let place = Place::new(MODEL);
    let unit = Unit::with(&place, Wishes { early_return: false, ..LISTENS });
    unit.initialize();
    let answer = unit.step_with(0.0, 3e-3, |_, _| true);
    assert_eq!((answer.status, answer.early, answer.time), (OK, false, 3e-3));
    assert!(unit.told().iter().all(|told| !told.can_return));
    let last = Unit::with(&place, LISTENS);
    last.initialize();
    let answer = last.step_with(0.0, 3e-3, |_, told| !told.can_return);
    assert_eq!((answer.status, answer.early, answer.time), (OK, false, 3e-3));
}

/// What a host moves was on its way to the end of the step: the derivatives of the shorter step are those of that way,
/// as differences of repeated steps show. The step goes back by an FMU state, and returns early at the same time again.
#[test]
fn derivatives_after_an_early_return() {
    let place = Place::new(HELD);
    let unit = Unit::with(&place, LISTENS);
    unit.initialize();
    let known = place.reference("hand.rotation");
    unit.whole_step(0.0, 1e-2);
    let before = unit.save();
    let (_, count) = place.of(Causality::Output);
    let values = |turn: f64| -> Vec<f64> {
        unit.restore(before);
        assert_eq!(unit.set(&[known], &[0.0, turn, 0.0]), OK);
        let answer = unit.step_with(1e-2, 1e-2, |_, told| told.time > 1.55e-2);
        assert_eq!((answer.status, answer.early), (OK, true), "{:?}", unit.lines());
        assert!((answer.time - 1.6e-2).abs() < 1e-12, "{}", answer.time);
        unit.bits().into_iter().map(f64::from_bits).collect()
    };
    let reach = 1e-4;
    let [left, right] = [values(0.01 - reach), values(0.01 + reach)];
    values(0.01);
    let derivative = unit.directional(&[known], &[0.0, 1.0, 0.0]);
    assert_eq!(derivative.len(), count);
    let largest = derivative.iter().fold(0.0, |largest, value| f64::max(largest, value.abs()));
    for (place, derivative) in derivative.iter().enumerate() {
        let difference = (right[place] - left[place]) / (2.0 * reach);
        // Differences of second order with steps of 1e-4 rad leave out about 1e-8 of the derivative; Newton's tolerance
        // of 1e-12 over the steps adds 1e-8 rad/rad, which stiff axial forces multiply.
        let tolerance = 1e-6 * derivative.abs() + 1e-8 * largest;
        assert!((derivative - difference).abs() <= tolerance, "output {place}: {derivative} and {difference}");
    }
    assert!(largest > 0.1, "the tip moves with the hand: {largest}");
    unit.forget(before);
}

/// Inputs that are set after some of the internal steps: bits are those of a host that returns early there, sets them
/// and steps on, also where the solver chooses its steps and where a host moves a frame. Those that are set at the very
/// end act on the next step.
#[test]
fn inputs_between_act_on_the_rest() {
    for (text, length) in [(HELD, 1e-2), (MODEL, 5e-3), (&alpha(), 5e-3), (&paced(), 5e-3)] {
        let place = Place::new(text);
        let (unit, other) = (Unit::with(&place, LISTENS), Unit::with(&place, LISTENS));
        [&unit, &other].into_iter().for_each(Unit::initialize);
        let (inputs, count) = place.of(Causality::Input);
        let values =
            |call: i32| -> Vec<f64> { (0..count).map(|k| 1e-3 * f64::from(call) * (1.0 + k as f64)).collect() };
        let mut times = [0.0; 2];
        for k in 0..2 {
            let end = length * f64::from(k + 1);
            let (calls, returns) = (Cell::new(10 * k), Cell::new(10 * k));
            let answer = unit.step_with(times[0], end - times[0], |unit, _| {
                calls.set(calls.get() + 1);
                if calls.get() % 2 == 1 {
                    assert_eq!(unit.set(&inputs, &values(calls.get())), OK, "{:?}", unit.lines());
                }
                false
            });
            assert_eq!((answer.status, answer.early), (OK, false), "{:?}", unit.lines());
            while times[1] < end - 1e-12 {
                let answer = other.step_with(times[1], end - times[1], |_, _| {
                    returns.set(returns.get() + 1);
                    returns.get() % 2 == 1
                });
                assert_eq!(answer.status, OK, "{:?}", other.lines());
                times[1] = answer.time;
                if returns.get() % 2 == 1 {
                    assert_eq!(other.set(&inputs, &values(returns.get())), OK);
                }
            }
            times[0] = answer.time;
            assert!(calls.get() > 10 * k + 2, "there are several internal steps: {}", calls.get());
            assert_eq!(calls, returns);
            assert_eq!(unit.bits(), other.bits());
            assert_eq!(rates(&unit), rates(&other));
        }
    }
}

/// Without the value, or with one that is refused, the step goes on as if nothing had been tried.
#[test]
fn refused_inputs_between_change_nothing() {
    let place = Place::new(HELD);
    let (unit, alone) = (Unit::with(&place, LISTENS), Unit::new(&place));
    [&unit, &alone].into_iter().for_each(Unit::initialize);
    let push = place.reference("push.force");
    let answer = unit.step_with(0.0, 1e-2, |unit, _| {
        assert_eq!(unit.set(&[], &[]), OK);
        assert_eq!(unit.set(&[push], &[0.0, f64::NAN, 0.0]), ERROR);
        assert_eq!(unit.set(&[push], &[0.0, 1.0]), ERROR);
        assert_eq!(unit.set(&[place.reference("tip.position")], &[0.0; 3]), ERROR);
        false
    });
    assert_eq!((answer.status, answer.time), (OK, 1e-2));
    alone.whole_step(0.0, 1e-2);
    assert_eq!(unit.bits(), alone.bits());
}

/// The derivatives are those of the part of the step that the last inputs acted on; a host is told where a step failed
/// after inputs were set.
#[test]
fn derivatives_and_failures_after_inputs_between() {
    let place = Place::new(MODEL);
    let (unit, other) = (Unit::with(&place, LISTENS), Unit::new(&place));
    [&unit, &other].into_iter().for_each(Unit::initialize);
    let force = place.reference("tip.force");
    let at = |told: Told, time: f64| (told.time - time).abs() < 1e-9;
    let answer = unit.step_with(0.0, 5e-3, |unit, told| {
        if at(told, 2e-3) {
            assert_eq!(unit.set(&[force], &[0.0, 0.0, 3.0]), OK);
        }
        false
    });
    assert_eq!(answer.status, OK);
    other.whole_step(0.0, 2e-3);
    assert_eq!(other.set(&[force], &[0.0, 0.0, 3.0]), OK);
    other.whole_step(2e-3, 3e-3);
    let seed = [0.2, -0.3, 1.0];
    assert_eq!(unit.directional(&[force], &seed), other.directional(&[force], &seed));
    let answer = unit.step_with(5e-3, 5e-3, |unit, told| {
        if at(told, 7e-3) {
            assert_eq!(unit.set(&[force], &[0.0, 0.0, 1e20]), OK);
        }
        false
    });
    assert_eq!((answer.status, answer.early), (ERROR, false));
    assert!((answer.time - 7e-3).abs() < 1e-12, "{}", answer.time);
    assert_eq!(unit.step(answer.time, 1e-3).status, ERROR);
}

/// The state after an early return, as bytes in another instance: the same derivatives and the same continuation, to
/// the bit.
#[test]
fn states_after_an_early_return() {
    let place = Place::new(HELD);
    let (unit, other) = (Unit::with(&place, LISTENS), Unit::new(&place));
    unit.initialize();
    let known = place.reference("hand.rotation");
    assert_eq!(unit.set(&[known], &[0.0, 0.02, 0.0]), OK);
    let answer = unit.step_with(0.0, 1e-2, |_, told| told.time > 4.5e-3);
    assert!(answer.early && answer.time < 6e-3, "{answer:?}");
    let state = unit.save();
    let bytes = unit.serialize(state);
    let copy = other.deserialize(&bytes);
    other.restore(copy);
    let seeds = [0.3, 1.0, -0.2];
    let bits = |values: Vec<f64>| -> Vec<u64> { values.into_iter().map(f64::to_bits).collect() };
    assert_eq!(bits(unit.directional(&[known], &seeds)), bits(other.directional(&[known], &seeds)));
    assert_eq!(bits(rates(&unit)), bits(rates(&other)));
    for unit in [&unit, &other] {
        unit.whole_step(answer.time, 5e-3);
    }
    assert_eq!(unit.bits(), other.bits());
    unit.restore(state);
    unit.whole_step(answer.time, 5e-3);
    assert_eq!(unit.bits(), other.bits());
    unit.forget(state);
    other.forget(copy);
}

/// A step whose internal step fails goes back to its beginning; an earlier state revives the instance.
#[test]
fn a_failed_step_goes_back() {
    let place = Place::new(MODEL);
    let unit = Unit::with(&place, LISTENS);
    unit.initialize();
    unit.whole_step(0.0, 1e-3);
    let (state, before) = (unit.save(), unit.bits());
    assert_eq!(unit.set(&[place.reference("tip.force")], &[0.0, 0.0, 1e20]), OK);
    let answer = unit.step(1e-3, 1e-2);
    assert_eq!((answer.status, answer.early, answer.time), (ERROR, false, 1e-3));
    assert_eq!(unit.bits(), before);
    assert_eq!(unit.step(1e-3, 1e-2).status, ERROR);
    unit.restore(state);
    unit.whole_step(1e-3, 1e-2);
    unit.forget(state);
}

/// In the callback the instance refuses what would change it, goes on all the same, and survives that the host frees
/// it.
#[test]
fn calls_from_inside_an_update() {
    let place = Place::new(MODEL);
    let (unit, alone) = (Unit::with(&place, LISTENS), Unit::new(&place));
    [&unit, &alone].into_iter().for_each(Unit::initialize);
    let inner = Cell::new(0);
    let answer = unit.step_with(0.0, 3e-3, |unit, told| {
        assert_eq!(unit.step(told.time, 1e-3).status, ERROR);
        assert_eq!(unit.set(&[unit.place.reference("gravity")], &[0.0, 0.0, -1.0]), ERROR);
        assert_eq!(unit.get(&[unit.place.reference("gravity")], &mut [0.0; 3]), ERROR);
        inner.set(inner.get() + 1);
        false
    });
    assert_eq!((answer.status, answer.time, inner.get()), (OK, 3e-3, 3), "{:?}", unit.lines());
    alone.whole_step(0.0, 3e-3);
    assert_eq!(unit.bits(), alone.bits());
    let lines = unit.lines();
    let told = |text: &str| lines.iter().filter(|line| line.contains(text)).count();
    assert_eq!(told("fmi3DoStep in Intermediate Update Mode at t = 0.001 s: not allowed now"), 1);
    assert_eq!(told("fmi3SetFloat64 in Intermediate Update Mode"), 3);
    assert_eq!(told("fmi3GetFloat64 in Intermediate Update Mode"), 3);
    let freed = unit.step_with(3e-3, 3e-3, |unit, _| {
        // SAFETY: the handle is live; it is not used as one afterwards.
        unsafe { fmi3FreeInstance(unit.c) };
        false
    });
    assert_eq!(freed.status, ERROR);
}
