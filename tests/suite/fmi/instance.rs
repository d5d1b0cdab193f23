//! Does an instance do what its host asked, all of it or nothing? On the toy model, whose state is one number, so that
//! every expectation can be worked out by hand.

use ancf14::fmi::{
    LogCategory, Status,
    error::Error,
    instance::{FmuState, Instance, StatusKind},
    lifecycle::Mode,
    log::Entry,
};

use crate::support::allocations::count;

use super::toy::{
    AREA, CELLS, COUNT, FORCE, GAIN, IMPOSSIBLE_LENGTH, LENGTH, POSITION, Plain, REFUSED_FORCE, SHORTEST_STEP, TIME,
    Toy, Trap, UNFIT_LENGTH, toy,
};

fn fresh() -> Instance<Toy> {
    Instance::new(toy(), false)
}

fn initialized() -> Instance<Toy> {
    with_trap(Trap::None)
}

fn with_trap(trap: Trap) -> Instance<Toy> {
    let mut model = toy();
    model.trap = trap;
    let mut instance = Instance::new(model, false);
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    instance
}

fn real(instance: &mut Instance<Toy>, reference: u32) -> f64 {
    let mut value = [f64::NAN];
    instance.get_real(&[reference], &mut value).unwrap();
    value[0]
}

fn integer(instance: &mut Instance<Toy>, reference: u32) -> i32 {
    let mut value = [0];
    instance.get_integer(&[reference], &mut value).unwrap();
    value[0]
}

// --- values

/// A bad reference, type or value anywhere in a call leaves every value as it was, also where the model itself refuses
/// the last of several values.
#[test]
fn set_is_all_or_nothing() {
    for (references, values) in [
        (vec![GAIN, 99], vec![3.0, 1.0]),
        (vec![GAIN, CELLS], vec![3.0, 1.0]),
        (vec![GAIN, POSITION], vec![3.0, 1.0]),
        (vec![GAIN, AREA], vec![3.0, 1.0]),
        (vec![GAIN, TIME], vec![3.0, 1.0]),
        (vec![GAIN, FORCE], vec![3.0, f64::NAN]),
        (vec![GAIN, FORCE], vec![3.0, f64::INFINITY]),
        (vec![LENGTH, GAIN], vec![3.0, 10.1]),
        (vec![LENGTH, GAIN], vec![3.0, -0.1]),
        (vec![GAIN, LENGTH, GAIN, FORCE], vec![3.0, 4.0, 5.0, REFUSED_FORCE]),
        (vec![GAIN, LENGTH], vec![3.0]),
    ] {
        let mut instance = fresh();
        assert!(instance.set_real(&references, &values).is_err(), "{references:?} {values:?}");
        assert_eq!(
            [real(&mut instance, GAIN), real(&mut instance, LENGTH), real(&mut instance, FORCE)],
            [2.0, 1.5, 0.0]
        );
    }
    let mut instance = fresh();
    assert!(instance.set_integer(&[CELLS, CELLS], &[7, 101]).is_err());
    assert_eq!(integer(&mut instance, CELLS), 4);
    instance.set_integer(&[CELLS], &[100]).unwrap();
    assert_eq!(integer(&mut instance, CELLS), 100);
}

/// A get that fails leaves the host's array as it was.
#[test]
fn get_is_all_or_nothing() {
    let mut values = [-1.0, -2.0];
    let mut instance = initialized();
    for wrong in [COUNT, 99] {
        assert!(instance.get_real(&[POSITION, wrong], &mut values).is_err());
        assert_eq!(values, [-1.0, -2.0]);
    }
}

/// The message names the variable and what would have been right.
#[test]
fn refusals_name_variable_and_bounds() {
    let mut instance = initialized();
    let said = |outcome: Result<(), Error>| outcome.unwrap_err().to_string();
    let text = said(instance.set_real(&[GAIN], &[11.0]));
    assert_eq!(text, "variable gain cannot be 11 m/(N.s); it must be between 0 and 10");
    assert!(said(instance.set_real(&[LENGTH], &[1.0])).contains("parameter body.length is fixed"));
    assert!(said(instance.set_real(&[POSITION], &[1.0])).contains("tip.position[1] is a result"));
    assert!(said(instance.set_real(&[FORCE], &[f64::NAN])).contains("tip.force[1] cannot be NaN"));
    assert!(
        said(instance.set_integer(&[GAIN], &[1])).contains("gain (value reference 0) is of type Real, not Integer")
    );
    assert!(said(instance.get_boolean(&[COUNT])).contains("of type Integer, not Boolean"));
    assert!(said(instance.get_string(&[8])).contains("8 variables"));
}

/// Fixed parameters end with the initialization; tunable ones and inputs do not.
#[test]
fn what_can_be_set_when() {
    let mut instance = fresh();
    for set_up in [Mode::Instantiated, Mode::Initialization] {
        assert_eq!(instance.mode(), set_up);
        instance.set_real(&[GAIN, LENGTH, FORCE], &[3.0, 2.0, 1.0]).unwrap();
        instance.set_integer(&[CELLS], &[5]).unwrap();
        if set_up == Mode::Instantiated {
            instance.enter_initialization_mode().unwrap();
        }
    }
    instance.exit_initialization_mode().unwrap();
    instance.set_real(&[GAIN, FORCE], &[4.0, 2.0]).unwrap();
    assert!(instance.set_real(&[LENGTH], &[2.5]).is_err());
    assert!(instance.set_integer(&[CELLS], &[6]).is_err());
    assert_eq!(real(&mut instance, POSITION), 2.0);
}

/// Reading results before initialization gives start values and one warning; reading parameters gives none.
#[test]
fn early_reads_warn_once() {
    let mut instance = fresh();
    assert_eq!(real(&mut instance, GAIN), 2.0);
    assert_eq!(instance.take_entries(), []);
    assert_eq!(real(&mut instance, POSITION), 0.0);
    let entries = instance.take_entries();
    assert!(matches!(&entries[..], [Entry { status: Status::Warning, category: LogCategory::StatusWarning, .. }]));
    assert_eq!(real(&mut instance, POSITION), 0.0);
    assert_eq!(instance.take_entries(), []);
}

// --- initialization

/// In Initialization Mode a read solves the initial state of what is set, once until something is set again.
#[test]
fn reads_in_initialization_mode_solve_and_remember() {
    let mut instance = fresh();
    instance.enter_initialization_mode().unwrap();
    assert_eq!(real(&mut instance, GAIN), 2.0);
    assert_eq!(instance.model().initializations, 0);
    assert_eq!((real(&mut instance, POSITION), real(&mut instance, AREA)), (1.5, 2.25));
    assert_eq!(instance.model().initializations, 1);
    instance.set_real(&[LENGTH], &[3.0]).unwrap();
    assert_eq!((real(&mut instance, POSITION), real(&mut instance, AREA)), (3.0, 9.0));
    instance.exit_initialization_mode().unwrap();
    assert_eq!(instance.model().initializations, 2);
}

/// Parameters that fit their ranges but make no model are refused at the latest when the initialization begins, and may
/// be mended then.
#[test]
fn parameters_are_checked_before_the_initialization() {
    let mut instance = fresh();
    instance.set_real(&[LENGTH], &[UNFIT_LENGTH]).unwrap();
    let error = instance.enter_initialization_mode().unwrap_err();
    assert_eq!((error.status(), error.to_string().as_str()), (Status::Error, "that length fits nothing"));
    assert_eq!(instance.mode(), Mode::Instantiated);
    instance.set_real(&[LENGTH], &[1.0]).unwrap();
    instance.enter_initialization_mode().unwrap();
}

/// Without an initial state the instance stays in Initialization Mode, where another value may be tried.
#[test]
fn a_failed_initialization_can_be_repaired() {
    let mut instance = fresh();
    instance.enter_initialization_mode().unwrap();
    instance.set_real(&[LENGTH], &[IMPOSSIBLE_LENGTH]).unwrap();
    let error = instance.exit_initialization_mode().unwrap_err();
    assert_eq!((error.status(), error.category()), (Status::Error, LogCategory::NonlinearSystems));
    assert_eq!(instance.mode(), Mode::Initialization);
    instance.set_real(&[LENGTH], &[1.0]).unwrap();
    instance.exit_initialization_mode().unwrap();
}

/// Warnings of the model reach the log in the call that caused them, whose status they leave alone.
#[test]
fn model_warnings_are_passed_on() {
    let mut instance = fresh();
    instance.set_real(&[GAIN], &[0.0]).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    let entries = instance.take_entries();
    assert_eq!(entries.len(), 1);
    assert_eq!(entries[0].message, "a gain of 0 moves nothing");
    assert_eq!((entries[0].status, entries[0].category), (Status::Warning, LogCategory::StatusWarning));
    assert_eq!(instance.take_status(), Status::Ok);
}

/// Times must be numbers and in order; the start time is where the simulation begins.
#[test]
fn experiment_times() {
    let mut instance = fresh();
    assert!(matches!(instance.setup_experiment(None, f64::NAN, None), Err(Error::StartTime { .. })));
    assert!(matches!(instance.setup_experiment(None, 1.0, Some(0.5)), Err(Error::StopTime { .. })));
    assert!(matches!(instance.setup_experiment(None, 1.0, Some(f64::NAN)), Err(Error::StopTime { .. })));
    instance.setup_experiment(Some(1e-4), -5.0, Some(5.0)).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    assert_eq!(instance.time(), -5.0);
    instance.do_step(-5.0, 0.5).unwrap();
    assert_eq!(instance.time(), -4.5);
}

// --- steps

/// `x += gain * force * h`, with the force as last set.
#[test]
fn steps_advance_the_model() {
    let mut instance = initialized();
    instance.set_real(&[FORCE], &[3.0]).unwrap();
    assert_eq!(real(&mut instance, POSITION), 1.5); // a set without a step changes no result
    instance.do_step(0.0, 0.5).unwrap();
    assert_eq!((real(&mut instance, POSITION), real(&mut instance, TIME)), (4.5, 0.5));
    assert_eq!(integer(&mut instance, COUNT), 1);
}

/// The host's time may differ from ours by its round-off, 1e-9 relative, and by no more.
#[test]
fn the_host_s_time_is_checked() {
    for (time, accepted) in
        [(0.5, true), (0.5 + 1e-11, true), (0.5 - 1e-11, true), (0.5 + 1e-8, false), (0.0, false), (f64::NAN, false)]
    {
        let mut instance = initialized();
        instance.do_step(0.0, 0.5).unwrap();
        let outcome = instance.do_step(time, 0.25);
        assert_eq!(outcome.is_ok(), accepted, "{time}: {outcome:?}");
        assert_eq!(instance.mode(), Mode::Step);
        assert_eq!(integer(&mut instance, COUNT), if accepted { 2 } else { 1 });
    }
}

/// Infinite times went on to the model: any difference is small beside them. Refused, they leave the instance as it
/// was.
#[test]
fn regression_infinite_times_are_refused() {
    for time in [f64::INFINITY, f64::NEG_INFINITY] {
        let mut instance = initialized();
        assert!(matches!(instance.do_step(time, 0.5), Err(Error::WrongTime { .. })), "{time}");
        instance.do_step(0.0, 0.5).unwrap();
    }
}

/// A derivative extrapolates its input over the next step, and only that one.
#[test]
fn input_derivatives_are_for_one_step() {
    let mut instance = initialized();
    instance.set_real(&[FORCE], &[3.0]).unwrap();
    instance.set_real_input_derivatives(&[FORCE], &[1], &[4.0]).unwrap();
    instance.do_step(0.0, 0.5).unwrap();
    assert_eq!(real(&mut instance, POSITION), 1.5 + 2.0 * (3.0 + 0.5 * 4.0 * 0.5) * 0.5);
    instance.do_step(0.5, 0.5).unwrap();
    assert_eq!(real(&mut instance, POSITION), 1.5 + 2.0 * (3.0 + 0.5 * 4.0 * 0.5) * 0.5 + 2.0 * 3.0 * 0.5);

    for (reference, order, value) in
        [(GAIN, 1, 0.0), (POSITION, 1, 0.0), (FORCE, 2, 0.0), (FORCE, 0, 0.0), (FORCE, 1, f64::NAN)]
    {
        let refused = instance.set_real_input_derivatives(&[FORCE, reference], &[1, order], &[9.0, value]);
        assert!(refused.is_err(), "{reference} {order} {value}");
    }
    // All of a call or nothing: the first of each pair was not taken either.
    let before = real(&mut instance, POSITION);
    instance.do_step(1.0, 0.5).unwrap();
    assert_eq!(real(&mut instance, POSITION), before + 2.0 * 3.0 * 0.5);
}

/// A step that does not advance is refused and harmless.
#[test]
fn steps_must_be_positive_and_finite() {
    for step in [0.0, -0.1, -1e-15, f64::NAN, f64::INFINITY] {
        let mut instance = initialized();
        instance.do_step(0.0, 0.5).unwrap();
        assert!(matches!(instance.do_step(0.5, step), Err(Error::StepSize { .. })), "{step}");
        instance.do_step(0.5, 0.5).unwrap();
    }
}

/// A host that adds up its time ends with a step of round-off, forwards from a time a little before or after ours: it
/// is done at once, and its derivatives are used up.
#[test]
fn regression_a_last_step_of_round_off() {
    for (time, step) in
        [(3.0, 1e-17), (3.0, 1e-12), (3.0 - 2e-14, 2e-14), (3.0 - 2e-14, 1e-14), (3.0 + 2e-14, 1e-13), (3.0, 1e-300)]
    {
        let mut instance = fresh();
        instance.setup_experiment(None, 0.0, Some(3.0)).unwrap();
        instance.enter_initialization_mode().unwrap();
        instance.exit_initialization_mode().unwrap();
        instance.set_real(&[FORCE], &[3.0]).unwrap();
        instance.do_step(0.0, 3.0).unwrap();
        let position = real(&mut instance, POSITION);
        instance.set_real_input_derivatives(&[FORCE], &[1], &[4.0]).unwrap();
        let before = instance.state().unwrap();
        instance.do_step(time, step).unwrap_or_else(|error| panic!("{time} {step}: {error}"));
        assert_eq!((instance.time(), real(&mut instance, POSITION)), (3.0, position));
        assert_ne!(instance.model().plain(), before_model(&before, &mut instance), "the derivative is used up");
    }
}

/// The model of a state.
fn before_model(state: &FmuState<Toy>, instance: &mut Instance<Toy>) -> Plain {
    let now = instance.state().unwrap();
    instance.set_state(state).unwrap();
    let plain = instance.model().plain();
    instance.set_state(&now).unwrap();
    plain
}

/// Steps that are too short for the model add up: many of them go as far as one.
#[test]
fn short_steps_are_not_lost() {
    let mut instance = initialized();
    instance.set_real(&[FORCE], &[3.0]).unwrap();
    let step = 1e-12;
    let mut time = 0.0;
    for _ in 0..100_000 {
        instance.do_step(time, step).unwrap();
        assert!((instance.time() - time - step).abs() < SHORTEST_STEP);
        time += step;
    }
    assert!((real(&mut instance, POSITION) - 1.5 - 2.0 * 3.0 * time).abs() <= 6.0 * SHORTEST_STEP);
}

/// What the model refuses before it begins a step is harmless.
#[test]
fn steps_that_are_not_begun_do_no_harm() {
    let mut instance = initialized();
    assert_eq!(instance.do_step(0.0, 2e6).unwrap_err().to_string(), "that is too far");
    assert_eq!(instance.mode(), Mode::Step);
    instance.do_step(0.0, 0.5).unwrap();
}

/// The stop time is the end if it was defined; round-off beyond it is none.
#[test]
fn the_stop_time_is_kept() {
    let mut instance = fresh();
    instance.setup_experiment(None, 0.0, Some(1.0)).unwrap();
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    assert_eq!(instance.do_step(0.0, 1.1), Err(Error::BeyondStop { end: 1.1, stop: 1.0 }));
    instance.do_step(0.0, 1.0 + 1e-12).unwrap();
    assert!(matches!(instance.do_step(1.0, 0.1), Err(Error::BeyondStop { .. })));
}

/// A step the model cannot do is an error, never discarded; then reads work, steps do not, and a reset or an earlier
/// state revives.
#[test]
fn a_failed_step_and_two_ways_back() {
    let mut instance = with_trap(Trap::FailBeyond(1.0));
    instance.do_step(0.0, 1.0).unwrap();
    let good = instance.state().unwrap();
    let error = instance.do_step(1.0, 0.5).unwrap_err();
    assert_eq!((error.status(), error.category()), (Status::Error, LogCategory::NonlinearSystems));
    assert_eq!(instance.mode(), Mode::Error);
    assert_eq!(instance.real_status(StatusKind::LastSuccessfulTime), Ok(1.0));
    assert_eq!(real(&mut instance, TIME), 1.0);
    assert!(matches!(instance.do_step(1.0, 0.5), Err(Error::Illegal(_))));
    instance.set_state(&good).unwrap();
    assert_eq!((instance.mode(), instance.time()), (Mode::Step, 1.0));
    assert!(instance.do_step(1.0, 0.5).is_err());
    instance.reset().unwrap();
    assert_eq!((instance.mode(), instance.time(), real(&mut instance, GAIN)), (Mode::Instantiated, 0.0, 2.0));
}

/// What a host does a million times costs no memory: set, step, get.
#[test]
fn set_step_get_allocate_nothing() {
    let mut instance = initialized();
    instance.set_real(&[GAIN, FORCE], &[1.0, 0.0]).unwrap(); // the list for undoing is made once
    let mut position = [0.0];
    let allocations = count(|| {
        for k in 0..10 {
            instance.set_real(&[GAIN, FORCE], &[1.0, f64::from(k)]).unwrap();
            instance.do_step(0.5 * f64::from(k), 0.5).unwrap();
            instance.get_real(&[POSITION], &mut position).unwrap();
            assert!(instance.take_entries().is_empty());
        }
    });
    assert_eq!((allocations, position[0]), (0, 1.5 + 0.5 * 45.0));
}

// --- states

/// Continuing from a state repeats the same bits, whatever was done in between; mode, times, inputs and logging come
/// back with it.
#[test]
fn states_restore_everything() {
    let mut instance = initialized();
    instance.set_real(&[FORCE], &[0.3]).unwrap();
    instance.set_debug_logging(true, &["logEvents"]).unwrap();
    instance.do_step(0.0, 0.1).unwrap();
    let state = instance.state().unwrap();
    let go_on = |instance: &mut Instance<Toy>| {
        instance.do_step(0.1, 0.7).unwrap();
        (real(instance, POSITION), real(instance, TIME), integer(instance, COUNT))
    };
    let first = go_on(&mut instance);
    instance.set_real(&[FORCE, GAIN], &[9.0, 7.0]).unwrap();
    instance.set_debug_logging(false, &[]).unwrap();
    instance.terminate().unwrap();
    instance.set_state(&state).unwrap();
    instance.take_entries();
    assert_eq!(go_on(&mut instance), first);
    assert_eq!(instance.take_entries().len(), 1, "debug messages are on again");
    instance.reset().unwrap();
    instance.set_state(&state).unwrap();
    assert_eq!(go_on(&mut instance), first);
}

/// A state taken in Initialization Mode knows whether the initial state was solved.
#[test]
fn states_of_the_initialization() {
    let mut instance = fresh();
    instance.setup_experiment(None, 3.0, None).unwrap();
    instance.enter_initialization_mode().unwrap();
    assert_eq!(real(&mut instance, POSITION), 1.5);
    let state = instance.state().unwrap();
    instance.set_real(&[LENGTH], &[4.0]).unwrap();
    instance.exit_initialization_mode().unwrap();
    instance.set_state(&state).unwrap();
    assert_eq!((instance.mode(), instance.time()), (Mode::Initialization, 3.0));
    assert_eq!(real(&mut instance, POSITION), 1.5);
}

// --- logging and status

/// Debug messages come when switched on; one names the tolerance of the host, which this model does not use.
#[test]
fn debug_messages() {
    let mut instance = fresh();
    instance.setup_experiment(Some(1e-4), 0.0, None).unwrap();
    assert_eq!(instance.take_entries(), []);
    instance.set_debug_logging(true, &[]).unwrap();
    instance.setup_experiment(Some(1e-4), 0.0, None).unwrap();
    let messages: Vec<String> = instance.take_entries().into_iter().map(|entry| entry.message).collect();
    assert_eq!(messages.len(), 2);
    assert!(messages[1].contains("does not use the host's tolerance 0.0001"), "{messages:?}");
    instance.set_debug_logging(true, &["logStatusError", "nonsense"]).unwrap();
    let entries = instance.take_entries();
    assert!(entries.len() == 1 && entries[0].message.contains("`nonsense`"));
    instance.enter_initialization_mode().unwrap();
    assert_eq!(instance.take_entries(), []);
}

/// A reset goes back to the logging of the instantiation.
#[test]
fn reset_restores_logging() {
    let mut instance = Instance::new(toy(), true);
    instance.set_debug_logging(false, &[]).unwrap();
    instance.reset().unwrap();
    instance.take_entries();
    instance.enter_initialization_mode().unwrap();
    assert_eq!(instance.take_entries().len(), 1);
}

/// A unit with synchronous steps knows the time it reached and that it goes on; everything else is discarded.
#[test]
fn statuses_of_a_synchronous_unit() {
    let mut instance = initialized();
    instance.do_step(0.0, 0.25).unwrap();
    assert_eq!(instance.real_status(StatusKind::LastSuccessfulTime), Ok(0.25));
    assert_eq!(instance.boolean_status(StatusKind::Terminated), Ok(false));
    for kind in [StatusKind::DoStep, StatusKind::Pending, StatusKind::Terminated] {
        assert_eq!(instance.real_status(kind).unwrap_err().status(), Status::Discard);
    }
    let error = instance.other_status(ancf14::fmi::lifecycle::Call::GetStatus, StatusKind::DoStep).unwrap_err();
    assert_eq!((error.status(), error.category()), (Status::Discard, LogCategory::StatusDiscard));
    assert_eq!(instance.cancel_step().unwrap_err().status(), Status::Error);
}
