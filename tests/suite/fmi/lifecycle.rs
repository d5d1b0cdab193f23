//! Which call is legal in which mode? The standard's table (FMI 2.0.4, section 4.2.4) is written down here a second
//! time, mode by mode, and every function of a real instance is called in every mode. A wrong table would let a host
//! step a unit that was never initialized, or refuse a correct host.

use ancf14::fmi::{
    error::Error,
    instance::{Instance, StatusKind},
    lifecycle::{Call, Illegal, Kind, Mode, Standard, TABLE},
};

use super::toy::{Toy, Trap, toy};

/// What the standard allows in a mode, and what is tolerated beyond it.
pub fn allowed(mode: Mode) -> (Vec<Call>, Vec<Call>) {
    use Call::*;
    let reads = [GetReal, GetInteger, GetBoolean, GetString];
    let writes = [SetReal, SetInteger, SetBoolean, SetString];
    let states =
        [GetFMUstate, SetFMUstate, FreeFMUstate, SerializedFMUstateSize, SerializeFMUstate, DeSerializeFMUstate];
    let statuses = [GetStatus, GetRealStatus, GetIntegerStatus, GetBooleanStatus, GetStringStatus];
    let anywhere = [&[SetDebugLogging, FreeInstance, Reset], &states[..]].concat();
    match mode {
        Mode::Instantiated => (
            [&anywhere, &writes[..], &[SetupExperiment, EnterInitializationMode, SetRealInputDerivatives]].concat(),
            reads.to_vec(),
        ),
        Mode::Initialization => (
            [
                &anywhere,
                &reads[..],
                &writes,
                &[ExitInitializationMode, GetDirectionalDerivative, SetRealInputDerivatives],
            ]
            .concat(),
            vec![GetRealOutputDerivatives],
        ),
        Mode::Step => (
            [
                &anywhere,
                &reads[..],
                &writes,
                &statuses,
                &[DoStep, Terminate, GetDirectionalDerivative, SetRealInputDerivatives, GetRealOutputDerivatives],
            ]
            .concat(),
            vec![],
        ),
        Mode::Terminated => {
            ([&anywhere, &reads[..], &statuses, &[GetDirectionalDerivative, GetRealOutputDerivatives]].concat(), vec![])
        }
        Mode::Error => {
            ([&anywhere, &reads[..], &[GetDirectionalDerivative, GetRealOutputDerivatives]].concat(), statuses.to_vec())
        }
        Mode::Fatal => (vec![], vec![FreeInstance, FreeFMUstate]),
        // FMI 3.0 and Model Exchange have these.
        Mode::Update | Mode::Event | Mode::ContinuousTime => (vec![], vec![]),
    }
}

/// A fresh instance brought into a mode the way a host does it.
fn in_mode(mode: Mode) -> Instance<Toy> {
    let mut model = toy();
    model.trap = Trap::FailBeyond(1.0);
    let mut instance = Instance::new(model, false);
    if mode == Mode::Instantiated {
        return instance;
    }
    instance.enter_initialization_mode().unwrap();
    if mode == Mode::Initialization {
        return instance;
    }
    instance.exit_initialization_mode().unwrap();
    match mode {
        Mode::Terminated => instance.terminate().unwrap(),
        Mode::Error => assert!(matches!(instance.do_step(0.0, 5.0), Err(Error::Model(_)))),
        Mode::Fatal => instance.give_up(),
        _ => (),
    }
    instance
}

/// Calls a function with arguments that are in order.
fn call(instance: &mut Instance<Toy>, call: Call) -> Result<(), Error> {
    let time = instance.time();
    let kind = StatusKind::DoStep;
    match call {
        Call::SetDebugLogging => instance.set_debug_logging(true, &[]),
        Call::SetupExperiment => instance.setup_experiment(None, 0.0, None),
        Call::EnterInitializationMode => instance.enter_initialization_mode(),
        Call::ExitInitializationMode => instance.exit_initialization_mode(),
        Call::Terminate => instance.terminate(),
        Call::Reset => instance.reset(),
        Call::GetReal => instance.get_real(&[], &mut []),
        Call::GetInteger => instance.get_integer(&[], &mut []),
        Call::GetBoolean => instance.get_boolean(&[]),
        Call::GetString => instance.get_string(&[]),
        Call::SetReal => instance.set_real(&[], &[]),
        Call::SetInteger => instance.set_integer(&[], &[]),
        Call::SetBoolean => instance.set_boolean(&[]),
        Call::SetString => instance.set_string(&[]),
        Call::GetFMUstate => instance.state().map(drop),
        Call::SetFMUstate => {
            let state = Instance::new(toy(), false).state()?;
            instance.set_state(&state)
        }
        Call::DoStep => instance.do_step(time, 0.1),
        Call::CancelStep => instance.cancel_step(),
        Call::GetRealStatus => instance.real_status(kind).map(drop),
        Call::GetBooleanStatus => instance.boolean_status(kind).map(drop),
        Call::GetStatus | Call::GetIntegerStatus | Call::GetStringStatus => instance.other_status(call, kind),
        Call::SerializedFMUstateSize | Call::SerializeFMUstate => {
            let state = Instance::new(toy(), false).state()?;
            instance.serialize(call, &state).map(drop)
        }
        Call::DeSerializeFMUstate => {
            let other = Instance::new(toy(), false);
            let bytes = other.serialize(Call::SerializeFMUstate, &other.state()?)?;
            instance.deserialize(&bytes).map(drop)
        }
        Call::GetDirectionalDerivative => instance.directional_derivative(&[], &[], &[], &mut []),
        Call::SetRealInputDerivatives => instance.set_real_input_derivatives(&[], &[], &[]),
        Call::GetRealOutputDerivatives => instance.get_real_output_derivatives(&[], &[], &mut []),
        Call::FreeInstance | Call::FreeFMUstate => instance.check(call),
        other => panic!("{other:?} is not a function of FMI 2.0"),
    }
}

/// Every function in every mode is refused exactly where the standard and the stated tolerances forbid it, and a
/// refused call leaves the mode as it was.
#[test]
fn every_call_in_every_mode() {
    for mode in Mode::ALL {
        let (legal, tolerated) = allowed(mode);
        for (function, _) in TABLE {
            let mut instance = in_mode(mode);
            assert_eq!(instance.mode(), mode);
            let refused = call(&mut instance, function)
                == Err(Error::Illegal(Illegal {
                    standard: Standard::Fmi2,
                    kind: Kind::CoSimulation,
                    call: function,
                    mode,
                }));
            assert_eq!(!refused, legal.contains(&function) || tolerated.contains(&function), "{function} {mode}");
            if refused {
                assert_eq!(instance.mode(), mode, "{function} {mode}");
            }
        }
    }
}

/// The rows stand in the order of the calls, each with a column per mode, and only the stated tolerances are marked.
#[test]
fn rows_and_marks_of_the_table() {
    for (place, (function, row)) in TABLE.iter().enumerate() {
        assert_eq!(*function as usize, place);
        assert_eq!(row.len(), Mode::ALL.len(), "{function}");
        for (mode, mark) in Mode::ALL.into_iter().zip(row.chars()) {
            let (legal, tolerated) = allowed(mode);
            let expected = match (legal.contains(function), tolerated.contains(function)) {
                (true, _) => 'x',
                (_, true) => '~',
                _ => '.',
            };
            assert_eq!(mark, expected, "{function} {mode}");
        }
    }
}

/// The calls that change the mode lead where the standard says.
#[test]
fn modes_follow_the_calls() {
    for (from, function, to) in [
        (Mode::Instantiated, Call::EnterInitializationMode, Mode::Initialization),
        (Mode::Initialization, Call::ExitInitializationMode, Mode::Step),
        (Mode::Step, Call::DoStep, Mode::Step),
        (Mode::Step, Call::Terminate, Mode::Terminated),
        (Mode::Terminated, Call::Reset, Mode::Instantiated),
        (Mode::Error, Call::Reset, Mode::Instantiated),
        (Mode::Error, Call::SetFMUstate, Mode::Instantiated),
    ] {
        let mut instance = in_mode(from);
        call(&mut instance, function).unwrap();
        assert_eq!(instance.mode(), to, "{function} {from}");
    }
}

/// An illegal call says which way is open.
#[test]
fn illegal_calls_say_what_to_do() {
    let text = |mode, function| call(&mut in_mode(mode), function).unwrap_err().to_string();
    assert!(text(Mode::Instantiated, Call::DoStep).contains("call fmi2EnterInitializationMode"));
    assert!(text(Mode::Initialization, Call::DoStep).contains("call fmi2ExitInitializationMode"));
    assert!(text(Mode::Step, Call::SetupExperiment).contains("fmi2Reset"));
    assert!(text(Mode::Error, Call::DoStep).contains("fmi2SetFMUstate"));
    assert!(text(Mode::Fatal, Call::Reset).contains("fmi2FreeInstance"));
}
