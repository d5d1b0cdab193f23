//! Model Exchange: which call is legal in which mode? The standards' tables (FMI 2.0.1 and later, section 3.2.3; FMI 3.0,
//! section 3.2.1) are written down here a second time. A refused call says so and changes nothing.
#![allow(unsafe_code, reason = "tests of the C ABI")]

use super::exchange_host::{INPUT, OUTPUTS, Place, STATE, Unit};
use super::{U0, oscillator};
use crate::fmi::unit;
use crate::random::Random;
use ancf14::ffi::{fmi2_exchange::*, types::fmi2Status};
use ancf14::fmi::lifecycle::{Call, Kind, Mode, Standard};
use std::ptr::null_mut;

const MODES: [Mode; 5] =
    [Mode::Instantiated, Mode::Initialization, Mode::Event, Mode::ContinuousTime, Mode::Terminated];

const CALLS: [Call; 20] = [
    Call::EnterInitializationMode,
    Call::ExitInitializationMode,
    Call::Terminate,
    Call::Reset,
    Call::EnterEventMode,
    Call::UpdateDiscreteStates,
    Call::EnterContinuousTimeMode,
    Call::CompletedIntegratorStep,
    Call::SetTime,
    Call::SetContinuousStates,
    Call::GetContinuousStateDerivatives,
    Call::GetEventIndicators,
    Call::GetContinuousStates,
    Call::GetNominalsOfContinuousStates,
    Call::GetReal,
    Call::SetReal,
    Call::GetDirectionalDerivative,
    Call::DoStep,
    Call::GetNumberOfContinuousStates,
    Call::GetNumberOfEventIndicators,
];

/// What the standards allow in a mode, each of them or one of them, and to set the time in Event Mode.
fn is_allowed(call: Call, mode: Mode) -> bool {
    use Mode::*;
    let modes: &[Mode] = match call {
        Call::EnterInitializationMode => &[Instantiated],
        Call::ExitInitializationMode => &[Initialization],
        Call::Terminate | Call::EnterEventMode | Call::SetTime => &[Event, ContinuousTime],
        Call::UpdateDiscreteStates | Call::EnterContinuousTimeMode => &[Event],
        Call::CompletedIntegratorStep | Call::SetContinuousStates => &[ContinuousTime],
        Call::SetReal => &[Instantiated, Initialization, Event, ContinuousTime],
        Call::DoStep => &[],
        Call::GetContinuousStateDerivatives
        | Call::GetEventIndicators
        | Call::GetContinuousStates
        | Call::GetDirectionalDerivative => &[Initialization, Event, ContinuousTime, Terminated],
        _ => &MODES,
    };
    modes.contains(&mode)
}

/// The calls that a version of the standard has.
fn calls(standard: Standard) -> &'static [Call] {
    if standard == Standard::Fmi2 { &CALLS[..18] } else { &CALLS }
}

#[test]
fn every_call_in_every_mode() {
    let place = Place::new(&oscillator().text());
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        for mode in MODES {
            for call in calls(standard) {
                let unit = Unit::in_mode(&place, standard, mode);
                let before = unit.bytes();
                let (done, lines) = (unit.call(*call), unit.lines());
                let said = format!("{} {mode}: {lines:?}", standard.name(*call));
                assert_eq!(done, is_allowed(*call, mode), "{said}");
                if !done {
                    assert_eq!(unit.bytes(), before, "{said}");
                    let named = format!("{} {mode} at t = ", standard.name(*call));
                    let reason = if *call == Call::DoStep {
                        "not offered: it belongs to co-simulation"
                    } else {
                        "not allowed now; "
                    };
                    assert!(lines.len() == 1 && lines[0].contains(&named) && lines[0].contains(reason), "{said}");
                }
            }
        }
    }
}

/// An illegal call says which way is open.
#[test]
fn illegal_calls_say_what_to_do() {
    let place = Place::new(&oscillator().text());
    let said = |standard, mode, call| {
        let unit = Unit::in_mode(&place, standard, mode);
        assert!(!unit.call(call));
        unit.lines().remove(0)
    };
    let (two, three) = (Standard::Fmi2, Standard::Fmi3);
    assert!(said(two, Mode::Event, Call::SetContinuousStates).contains("call fmi2EnterContinuousTimeMode first"));
    assert!(
        said(two, Mode::ContinuousTime, Call::UpdateDiscreteStates).contains("fmi2NewDiscreteStates in Continuous")
    );
    assert!(said(three, Mode::ContinuousTime, Call::UpdateDiscreteStates).contains("call fmi3EnterEventMode first"));
    assert!(said(two, Mode::Instantiated, Call::GetContinuousStateDerivatives).contains("fmi2GetDerivatives while"));
    assert!(said(three, Mode::Event, Call::ExitInitializationMode).contains("fmi3Reset starts over"));
}

/// Instances for co-simulation refuse all that Model Exchange adds, those of a mechanism too, and go on.
#[test]
fn instances_for_co_simulation_refuse_it() {
    let added = &CALLS[4..14];
    let place = Place::new(&oscillator().text());
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        let unit = Unit::new(&place, standard, Kind::CoSimulation);
        for _ in 0..2 {
            for call in added {
                let before = unit.bytes();
                assert!(!unit.call(*call) && unit.bytes() == before, "{call:?}");
                let lines = unit.lines();
                assert!(lines.len() == 1 && lines[0].contains("not offered: it belongs to "), "{lines:?}");
            }
            unit.call(Call::EnterInitializationMode);
            unit.lines();
        }
        assert!(unit.call(Call::ExitInitializationMode) && unit.call(Call::DoStep), "{:?}", unit.lines());
    }
    let place = unit::Place::new(crate::fmi::ffi::MODEL);
    let unit = unit::Unit::new(&place);
    let c = unit.c;
    // SAFETY: the unit is live; what is refused touches no argument.
    let statuses = unsafe {
        [
            fmi2EnterEventMode(c),
            fmi2NewDiscreteStates(c, null_mut()),
            fmi2EnterContinuousTimeMode(c),
            fmi2CompletedIntegratorStep(c, 1, null_mut(), null_mut()),
            fmi2SetTime(c, 1.0),
            fmi2SetContinuousStates(c, null_mut(), 0),
            fmi2GetDerivatives(c, null_mut(), 0),
            fmi2GetEventIndicators(c, null_mut(), 0),
            fmi2GetContinuousStates(c, null_mut(), 0),
            fmi2GetNominalsOfContinuousStates(c, null_mut(), 0),
            fmi2GetDerivatives(null_mut(), null_mut(), 0),
        ]
    };
    assert_eq!(statuses, [fmi2Status::fmi2Error; 11]);
    let lines = unit.lines.take();
    assert!(lines.len() == 10 && lines.iter().all(|line| line.contains("not offered: it belongs to ")), "{lines:?}");
}

/// A state goes back to an instance of its kind only.
#[test]
fn states_of_the_other_kind_are_refused() {
    let place = Place::new(&oscillator().text());
    for standard in [Standard::Fmi2, Standard::Fmi3] {
        let exchange = Unit::in_mode(&place, standard, Mode::ContinuousTime);
        assert!(exchange.set_states(&[0.25, 0.5]));
        let bytes = exchange.bytes();
        let other = Unit::new(&place, standard, Kind::CoSimulation);
        let fresh = other.bytes();
        assert!(!other.go_to(&bytes));
        let said = "of an instance for Model Exchange, and this instance is for co-simulation";
        assert!(other.lines().iter().any(|line| line.contains(said)));
        assert!(other.call(Call::EnterInitializationMode) && other.call(Call::ExitInitializationMode));
        assert!(!exchange.go_to(&other.bytes()) && exchange.bytes() == bytes, "a state of Step Mode");
        let again = Unit::new(&place, standard, Kind::ModelExchange);
        assert!(again.go_to(&fresh) && again.go_to(&bytes), "{:?}", again.lines());
        assert_eq!((again.states(), again.derivatives()), ([0.25, 0.5], exchange.derivatives()));
    }
}

/// A number, now and then one that hardly anybody means.
fn number(random: &mut Random) -> f64 {
    const ODD: [f64; 6] = [-0.0, 5e-324, 1e308, f64::MAX, f64::NAN, f64::NEG_INFINITY];
    if random.below(8) == 0 { ODD[random.below(ODD.len())] } else { random.signed() }
}

/// Makes a random call with random arguments; whether it succeeds.
fn play(unit: &Unit, random: &mut Random, call: Call) -> bool {
    let mut values = [f64::NAN; 3];
    match call {
        Call::SetTime => unit.set_time(number(random)),
        Call::SetContinuousStates => unit.set_states(&[number(random), number(random)]),
        Call::SetReal if random.below(2) == 0 => unit.set(&STATE, &[number(random), number(random)]),
        Call::SetReal => unit.set(&[INPUT], &[U0 + number(random)]),
        Call::GetReal => {
            let done = unit.get(&OUTPUTS, &mut values);
            assert!(values.iter().all(|value| value.is_finite() == done), "{values:?}");
            done
        }
        Call::GetContinuousStateDerivatives => {
            let rates = unit.derivatives();
            assert!(rates.is_none_or(|rates| rates.iter().all(|rate| rate.is_finite())), "{rates:?}");
            rates.is_some()
        }
        other => unit.call(other),
    }
}

/// Random calls: one that is refused changes nothing and says why, and no value is infinite.
#[test]
fn random_calls_are_answered_as_the_table_says() {
    let place = Place::new(&oscillator().text());
    for seed in 0..60 {
        let standard = if seed % 2 == 0 { Standard::Fmi2 } else { Standard::Fmi3 };
        let (unit, mut random) = (Unit::new(&place, standard, Kind::ModelExchange), Random(seed));
        let mut mode = Mode::Instantiated;
        for _ in 0..150 {
            let list = calls(standard);
            let call = list[random.below(list.len())];
            // It would end nearly every sequence at once.
            if matches!(call, Call::Terminate | Call::Reset) && random.below(4) > 0 {
                continue;
            }
            let before = unit.bytes();
            unit.lines();
            let (done, lines) = (play(&unit, &mut random, call), unit.lines());
            let said = format!("seed {seed}, {} {mode}: {lines:?}", standard.name(call));
            assert!(!done || is_allowed(call, mode), "{said}");
            if !done {
                assert!(unit.bytes() == before && !lines.is_empty(), "{said}");
                continue;
            }
            mode = match call {
                Call::EnterInitializationMode => Mode::Initialization,
                Call::ExitInitializationMode | Call::EnterEventMode => Mode::Event,
                Call::EnterContinuousTimeMode => Mode::ContinuousTime,
                Call::Terminate => Mode::Terminated,
                Call::Reset => Mode::Instantiated,
                _ => mode,
            };
        }
    }
}
