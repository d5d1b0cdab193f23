//! Which call of FMI 3.0 for co-simulation is legal in which mode (sections 2.3 and 4.2.1).
//!
//! The unit has neither events nor clocks nor structural parameters, so the modes Event, Configuration and
//! Reconfiguration do not occur. The standard terminates an instance whose call returned an error; here only a failed
//! step does, and an instance goes on after any other refused call.

use super::Call;

/// One row per call, one column per mode, in the order of [`super::Mode`]: `x` legal, `.` an error, `~` legal here
/// though the standard forbids it. A call that is not listed is never legal; [`never`] says why.
///
/// - Output derivatives of the initial state may be read in Initialization Mode, like the outputs themselves.
/// - Memory can be given back after an internal fault.
pub const TABLE: [(Call, &str); 45] = [
    //                          Instantiated, Initialization, Step, Terminated, Error, Fatal, Update
    (Call::SetDebugLogging, "xxxxx.."),
    (Call::FreeInstance, "xxxxx~."),
    // Part of `fmi3EnterInitializationMode`.
    (Call::SetupExperiment, "x......"),
    (Call::EnterInitializationMode, "x......"),
    (Call::ExitInitializationMode, ".x....."),
    (Call::Terminate, "..x...."),
    (Call::Reset, "xxxxx.."),
    (Call::GetFloat32, "xxxxx.x"),
    (Call::GetReal, "xxxxx.x"),
    (Call::GetInt8, "xxxxx.x"),
    (Call::GetUInt8, "xxxxx.x"),
    (Call::GetInt16, "xxxxx.x"),
    (Call::GetUInt16, "xxxxx.x"),
    (Call::GetInteger, "xxxxx.x"),
    (Call::GetUInt32, "xxxxx.x"),
    (Call::GetInt64, "xxxxx.x"),
    (Call::GetUInt64, "xxxxx.x"),
    (Call::GetBoolean, "xxxxx.x"),
    (Call::GetString, "xxxxx.x"),
    (Call::GetBinary, "xxxxx.x"),
    (Call::SetFloat32, "xxx...x"),
    (Call::SetReal, "xxx...x"),
    (Call::SetInt8, "xxx...x"),
    (Call::SetUInt8, "xxx...x"),
    (Call::SetInt16, "xxx...x"),
    (Call::SetUInt16, "xxx...x"),
    (Call::SetInteger, "xxx...x"),
    (Call::SetUInt32, "xxx...x"),
    (Call::SetInt64, "xxx...x"),
    (Call::SetUInt64, "xxx...x"),
    (Call::SetBoolean, "xxx...x"),
    (Call::SetString, "xxx...x"),
    (Call::SetBinary, "xxx...x"),
    (Call::GetFMUstate, "xxxxx.."),
    (Call::SetFMUstate, "xxxxx.."),
    (Call::FreeFMUstate, "xxxxx~."),
    (Call::SerializedFMUstateSize, "xxxxx.."),
    (Call::SerializeFMUstate, "xxxxx.."),
    (Call::DeSerializeFMUstate, "xxxxx.."),
    (Call::GetDirectionalDerivative, ".xxxx.."),
    (Call::GetAdjointDerivative, ".xxxx.."),
    (Call::GetNumberOfVariableDependencies, "xxxxx.x"),
    (Call::GetVariableDependencies, "xxxxx.x"),
    (Call::GetRealOutputDerivatives, ".~xxx.x"),
    (Call::DoStep, "..x...."),
];

/// The row of a call; empty where it is never legal.
pub(super) fn row(call: Call) -> &'static str {
    TABLE.iter().find(|(listed, _)| *listed == call).map_or("", |(_, row)| row)
}

/// The name of a function of FMI 3.0.
pub fn name(call: Call) -> String {
    match call {
        Call::SetupExperiment => String::from("fmi3EnterInitializationMode"),
        Call::GetReal => String::from("fmi3GetFloat64"),
        Call::SetReal => String::from("fmi3SetFloat64"),
        Call::GetInteger => String::from("fmi3GetInt32"),
        Call::SetInteger => String::from("fmi3SetInt32"),
        Call::GetFMUstate => String::from("fmi3GetFMUState"),
        Call::SetFMUstate => String::from("fmi3SetFMUState"),
        Call::FreeFMUstate => String::from("fmi3FreeFMUState"),
        Call::SerializedFMUstateSize => String::from("fmi3SerializedFMUStateSize"),
        Call::SerializeFMUstate => String::from("fmi3SerializeFMUState"),
        Call::DeSerializeFMUstate => String::from("fmi3DeserializeFMUState"),
        Call::GetRealOutputDerivatives => String::from("fmi3GetOutputDerivatives"),
        other => format!("fmi3{other:?}"),
    }
}

/// Why a call is not legal in any mode; none: it is in some.
pub(super) fn never(call: Call) -> Option<&'static str> {
    use Call::*;
    match call {
        EnterConfigurationMode | ExitConfigurationMode => Some("this unit has no structural parameters"),
        EnterEventMode | EnterStepMode | EvaluateDiscreteStates | UpdateDiscreteStates => {
            Some("it belongs to Event Mode, which this unit does not have in co-simulation")
        }
        GetClock | SetClock | GetIntervalDecimal | GetIntervalFraction | GetShiftDecimal | GetShiftFraction
        | SetIntervalDecimal | SetIntervalFraction | SetShiftDecimal | SetShiftFraction => {
            Some("this unit has no clocks")
        }
        own if own.is_of_model_exchange() => {
            Some("it belongs to Model Exchange, and this instance is for co-simulation")
        }
        ActivateModelPartition => Some("it belongs to scheduled execution, which this unit does not have"),
        _ => None,
    }
}
