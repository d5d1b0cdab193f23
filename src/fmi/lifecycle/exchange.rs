//! Which call is legal in which mode of Model Exchange (FMI 2.0, section 3.2.3; FMI 3.0, sections 2.3 and 3.2). One
//! table serves both versions: a call that one of them forbids in a mode and the other allows is legal in both.
//!
//! The unit has no events of its own: a host enters Event Mode where inputs jump.

use super::{Call, Mode, fmi3};

/// The mark of a mode in the row of a call: `x` legal, `.` an error, `~` legal here though both standards forbid it.
pub(super) fn mark(call: Call, mode: Mode) -> Option<u8> {
    let column = match mode {
        Mode::Instantiated => 0,
        Mode::Initialization => 1,
        Mode::Event => 2,
        Mode::ContinuousTime => 3,
        Mode::Terminated => 4,
        Mode::Fatal => 5,
        Mode::Step | Mode::Error | Mode::Update => return None,
    };
    row(call).as_bytes().get(column).copied()
}

/// The row of a call, a column per mode; empty where it is never legal.
///
/// - FMI 2.0 forbids to set the time in Event Mode; hosts do so at the start.
/// - Memory can be given back after an internal fault.
pub fn row(call: Call) -> &'static str {
    use Call::*;
    match call {
        // Instantiated, Initialization, Event, Continuous-Time, Terminated, Fatal
        FreeInstance | FreeFMUstate => "xxxxx~",
        SetupExperiment | EnterInitializationMode => "x.....",
        ExitInitializationMode => ".x....",
        EnterEventMode | Terminate => "..xx..",
        UpdateDiscreteStates | EnterContinuousTimeMode => "..x...",
        SetTime => "..~x..",
        CompletedIntegratorStep | SetContinuousStates => "...x..",
        SetReal | SetFloat32 => "xxxx..",
        SetInteger | SetBoolean | SetString | SetInt8 | SetUInt8 | SetInt16 | SetUInt16 | SetUInt32 | SetInt64
        | SetUInt64 | SetBinary => "xxx...",
        GetDirectionalDerivative
        | GetAdjointDerivative
        | GetContinuousStateDerivatives
        | GetContinuousStates
        | GetEventIndicators => ".xxxx.",
        other if never(other).is_none() => "xxxxx.",
        _ => "",
    }
}

/// Why a call is not legal in any mode; none: it is in some.
pub(super) fn never(call: Call) -> Option<&'static str> {
    use Call::*;
    match call {
        SetRealInputDerivatives
        | GetRealOutputDerivatives
        | DoStep
        | CancelStep
        | GetStatus
        | GetRealStatus
        | GetIntegerStatus
        | GetBooleanStatus
        | GetStringStatus
        | EnterStepMode => Some("it belongs to co-simulation, and this instance is for Model Exchange"),
        EvaluateDiscreteStates => Some("this unit has no discrete states; providesEvaluateDiscreteStates is false"),
        EnterEventMode | UpdateDiscreteStates => None,
        own if own.is_of_model_exchange() => None,
        other => fmi3::never(other),
    }
}
