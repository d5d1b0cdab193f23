//! The modes of a co-simulation unit and the one table of which call is legal in which mode (FMI 2.0, section 4.2.4).
//!
//! Steps are synchronous and never discarded, so the standard's modes stepInProgress, stepFailed and stepCanceled do
//! not occur.

use serde::{Deserialize, Serialize};
use std::fmt;

/// Where an instance stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// After `fmi2Instantiate` or `fmi2Reset`.
    Instantiated,
    /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
    Initialization,
    /// Ready for `fmi2DoStep`: the standard's stepComplete.
    Step,
    /// After `fmi2Terminate`.
    Terminated,
    /// After a step that failed.
    Error,
    /// After an internal fault.
    Fatal,
}

impl Mode {
    /// All modes, in the order of the table's columns.
    pub const ALL: [Self; 6] =
        [Self::Instantiated, Self::Initialization, Self::Step, Self::Terminated, Self::Error, Self::Fatal];
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Instantiated => "while instantiated",
            Self::Initialization => "in Initialization Mode",
            Self::Step => "in step mode",
            Self::Terminated => "after fmi2Terminate",
            Self::Error => "after a failed step",
            Self::Fatal => "after an internal fault",
        })
    }
}

/// The functions that take an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are the standard's, without the prefix `fmi2`")]
pub enum Call {
    SetDebugLogging,
    FreeInstance,
    SetupExperiment,
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    GetReal,
    GetInteger,
    GetBoolean,
    GetString,
    SetReal,
    SetInteger,
    SetBoolean,
    SetString,
    GetFMUstate,
    SetFMUstate,
    FreeFMUstate,
    SerializedFMUstateSize,
    SerializeFMUstate,
    DeSerializeFMUstate,
    GetDirectionalDerivative,
    SetRealInputDerivatives,
    GetRealOutputDerivatives,
    DoStep,
    CancelStep,
    GetStatus,
    GetRealStatus,
    GetIntegerStatus,
    GetBooleanStatus,
    GetStringStatus,
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "fmi2{self:?}")
    }
}

/// One row per call, in the order of [`Call`], one column per mode, in the order of [`Mode`]: `x` legal, `.` an error,
/// `~` legal here though the standard forbids it.
///
/// - Values may be read before initialization (with one warning): many hosts do.
/// - Output derivatives of the initial state may be read in Initialization Mode, like the outputs themselves.
/// - `fmi2GetStatus` tells the last time reached also after a failed step.
/// - Memory can be given back after an internal fault.
pub const TABLE: [(Call, &str); 31] = [
    //                          Instantiated, Initialization, Step, Terminated, Error, Fatal
    (Call::SetDebugLogging, "xxxxx."),
    (Call::FreeInstance, "xxxxx~"),
    (Call::SetupExperiment, "x....."),
    (Call::EnterInitializationMode, "x....."),
    (Call::ExitInitializationMode, ".x...."),
    (Call::Terminate, "..x..."),
    (Call::Reset, "xxxxx."),
    (Call::GetReal, "~xxxx."),
    (Call::GetInteger, "~xxxx."),
    (Call::GetBoolean, "~xxxx."),
    (Call::GetString, "~xxxx."),
    (Call::SetReal, "xxx..."),
    (Call::SetInteger, "xxx..."),
    (Call::SetBoolean, "xxx..."),
    (Call::SetString, "xxx..."),
    (Call::GetFMUstate, "xxxxx."),
    (Call::SetFMUstate, "xxxxx."),
    (Call::FreeFMUstate, "xxxxx~"),
    (Call::SerializedFMUstateSize, "xxxxx."),
    (Call::SerializeFMUstate, "xxxxx."),
    (Call::DeSerializeFMUstate, "xxxxx."),
    (Call::GetDirectionalDerivative, ".xxxx."),
    (Call::SetRealInputDerivatives, "xxx..."),
    (Call::GetRealOutputDerivatives, ".~xxx."),
    (Call::DoStep, "..x..."),
    (Call::CancelStep, "......"),
    (Call::GetStatus, "..xx~."),
    (Call::GetRealStatus, "..xx~."),
    (Call::GetIntegerStatus, "..xx~."),
    (Call::GetBooleanStatus, "..xx~."),
    (Call::GetStringStatus, "..xx~."),
];

/// A call that the table forbids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("not allowed now; {}", way_out(*.call, *.mode))]
pub struct Illegal {
    /// The call.
    pub call: Call,
    /// The mode it came in.
    pub mode: Mode,
}

/// The check that every call starts with.
///
/// # Errors
/// The table has a dot there.
pub fn check(call: Call, mode: Mode) -> Result<(), Illegal> {
    let (_, row) = TABLE[call as usize];
    match row.as_bytes()[mode as usize] {
        b'.' => Err(Illegal { call, mode }),
        _ => Ok(()),
    }
}

/// What a host can do after an illegal call.
pub fn way_out(call: Call, mode: Mode) -> &'static str {
    match (call, mode) {
        (_, Mode::Fatal) => "only fmi2FreeInstance is left",
        (Call::CancelStep, _) => "fmi2DoStep returns when its step is done, so there is never a step to cancel",
        (_, Mode::Error) => "only fmi2SetFMUstate with an earlier state, or fmi2Reset, revives the instance",
        (_, Mode::Terminated) => "fmi2Reset starts over",
        (Call::ExitInitializationMode, Mode::Instantiated) => "call fmi2EnterInitializationMode first",
        (_, Mode::Instantiated) => "call fmi2EnterInitializationMode and fmi2ExitInitializationMode first",
        (Call::SetupExperiment, _) => "it comes before fmi2EnterInitializationMode; fmi2Reset starts over",
        (Call::EnterInitializationMode, _) => "it comes once, right after instantiation; fmi2Reset starts over",
        (_, Mode::Initialization) => "call fmi2ExitInitializationMode first",
        (_, Mode::Step) => "the initialization is done; fmi2Reset starts over",
    }
}
