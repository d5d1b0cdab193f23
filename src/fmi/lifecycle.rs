//! The modes of a unit, and which call is legal in which mode: the table of FMI 2.0 for co-simulation (section 4.2.4)
//! is here, that of FMI 3.0 in [`fmi3`], and that of both for Model Exchange in [`exchange`].
//!
//! Steps are synchronous and never discarded, so the modes stepInProgress, stepFailed and stepCanceled of FMI 2.0 do
//! not occur.

pub mod exchange;
pub mod fmi3;

use serde::{Deserialize, Serialize};
use std::fmt;

/// A version of the standard. An instance belongs to one of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standard {
    /// FMI 2.0.
    Fmi2,
    /// FMI 3.0.
    Fmi3,
}

impl Standard {
    /// The name of a function.
    pub fn name(self, call: Call) -> String {
        match self {
            Self::Fmi2 => call.to_string(),
            Self::Fmi3 => fmi3::name(call),
        }
    }
}

/// The purpose of an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Co-simulation: the unit takes the steps.
    CoSimulation,
    /// Model Exchange: the host integrates the states.
    ModelExchange,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::CoSimulation => "co-simulation",
            Self::ModelExchange => "Model Exchange",
        })
    }
}

/// Where an instance stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Mode {
    /// State after instantiation or a reset.
    Instantiated,
    /// Initialization Mode.
    Initialization,
    /// Ready for a step: stepComplete of FMI 2.0, Step Mode of FMI 3.0.
    Step,
    /// State after termination.
    Terminated,
    /// State after a step that failed.
    Error,
    /// State after an internal fault.
    Fatal,
    /// Intermediate Update Mode of FMI 3.0: between two internal steps of a communication step.
    Update,
    /// Event Mode of Model Exchange.
    Event,
    /// Continuous-Time Mode of Model Exchange.
    ContinuousTime,
}

impl Mode {
    /// All modes of FMI 2.0 for co-simulation, in the order of the table's columns.
    pub const ALL: [Self; 6] =
        [Self::Instantiated, Self::Initialization, Self::Step, Self::Terminated, Self::Error, Self::Fatal];
}

impl fmt::Display for Mode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Instantiated => "while instantiated",
            Self::Initialization => "in Initialization Mode",
            Self::Step => "in step mode",
            Self::Terminated => "after termination",
            Self::Error => "after a failed step",
            Self::Fatal => "after an internal fault",
            Self::Update => "in Intermediate Update Mode",
            Self::Event => "in Event Mode",
            Self::ContinuousTime => "in Continuous-Time Mode",
        })
    }
}

/// The functions that take an instance: those of FMI 2.0, under their names there, then those that only FMI 3.0 has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are the standard's, without the prefix `fmi2` or `fmi3`")]
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
    GetFloat32,
    GetInt8,
    GetUInt8,
    GetInt16,
    GetUInt16,
    GetUInt32,
    GetInt64,
    GetUInt64,
    GetBinary,
    GetClock,
    SetFloat32,
    SetInt8,
    SetUInt8,
    SetInt16,
    SetUInt16,
    SetUInt32,
    SetInt64,
    SetUInt64,
    SetBinary,
    SetClock,
    GetAdjointDerivative,
    GetNumberOfVariableDependencies,
    GetVariableDependencies,
    EnterConfigurationMode,
    ExitConfigurationMode,
    EnterEventMode,
    EnterStepMode,
    EvaluateDiscreteStates,
    UpdateDiscreteStates,
    GetIntervalDecimal,
    GetIntervalFraction,
    GetShiftDecimal,
    GetShiftFraction,
    SetIntervalDecimal,
    SetIntervalFraction,
    SetShiftDecimal,
    SetShiftFraction,
    EnterContinuousTimeMode,
    CompletedIntegratorStep,
    SetTime,
    SetContinuousStates,
    GetContinuousStateDerivatives,
    GetEventIndicators,
    GetContinuousStates,
    GetNominalsOfContinuousStates,
    GetNumberOfEventIndicators,
    GetNumberOfContinuousStates,
    ActivateModelPartition,
}

impl Call {
    /// Whether it belongs to Model Exchange alone.
    fn is_of_model_exchange(self) -> bool {
        use Call::*;
        matches!(
            self,
            EnterContinuousTimeMode
                | CompletedIntegratorStep
                | SetTime
                | SetContinuousStates
                | GetContinuousStateDerivatives
                | GetEventIndicators
                | GetContinuousStates
                | GetNominalsOfContinuousStates
                | GetNumberOfEventIndicators
                | GetNumberOfContinuousStates
        )
    }
}

impl fmt::Display for Call {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UpdateDiscreteStates => f.write_str("fmi2NewDiscreteStates"),
            Self::GetContinuousStateDerivatives => f.write_str("fmi2GetDerivatives"),
            other => write!(f, "fmi2{other:?}"),
        }
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
#[error("{}", self.reason())]
pub struct Illegal {
    /// The standard whose function it is.
    pub standard: Standard,
    /// The kind of the instance.
    pub kind: Kind,
    /// The call.
    pub call: Call,
    /// The mode it came in.
    pub mode: Mode,
}

/// The check that every call starts with.
///
/// # Errors
/// The table has a dot there, or the standard has no such mode.
pub fn check(standard: Standard, kind: Kind, call: Call, mode: Mode) -> Result<(), Illegal> {
    let mark = match (kind, standard) {
        (Kind::ModelExchange, _) => exchange::mark(call, mode),
        (Kind::CoSimulation, Standard::Fmi2) => TABLE.get(call as usize).and_then(|(_, row)| column(row, mode)),
        (Kind::CoSimulation, Standard::Fmi3) => column(fmi3::row(call), mode),
    };
    match mark {
        None | Some(b'.') => Err(Illegal { standard, kind, call, mode }),
        Some(_) => Ok(()),
    }
}

/// The mark of a mode in a row.
fn column(row: &str, mode: Mode) -> Option<u8> {
    row.as_bytes().get(mode as usize).copied()
}

impl Illegal {
    fn reason(self) -> String {
        match self.never().filter(|_| self.mode != Mode::Fatal) {
            Some(reason) => format!("not offered: {reason}"),
            None => format!("not allowed now; {}", self.way_out()),
        }
    }

    /// Why no mode of such an instance allows the call; none: some mode does.
    fn never(self) -> Option<&'static str> {
        match (self.kind, self.standard) {
            (Kind::ModelExchange, _) => exchange::never(self.call),
            (Kind::CoSimulation, Standard::Fmi2) if (self.call as usize) < TABLE.len() => None,
            (Kind::CoSimulation, _) => fmi3::never(self.call),
        }
    }

    /// What a host can do after an illegal call.
    fn way_out(self) -> String {
        let Self { standard, call, mode, .. } = self;
        let name = |call| standard.name(call);
        let (enter, exit) = (Call::EnterInitializationMode, Call::ExitInitializationMode);
        match (call, mode) {
            (_, Mode::Fatal) => format!("only {} is left", name(Call::FreeInstance)),
            (Call::CancelStep, _) => {
                format!("{} returns when its step is done, so there is never a step to cancel", name(Call::DoStep))
            }
            (_, Mode::Error) => format!(
                "only {} with an earlier state, or {}, revives the instance",
                name(Call::SetFMUstate),
                name(Call::Reset)
            ),
            (_, Mode::Terminated) => format!("{} starts over", name(Call::Reset)),
            (_, Mode::Update) => format!(
                "during an intermediate update outputs and their derivatives can be read, and inputs set; {} goes on when the callback returns",
                name(Call::DoStep)
            ),
            (Call::ExitInitializationMode, Mode::Instantiated) => format!("call {} first", name(enter)),
            (_, Mode::Instantiated) => format!("call {} and {} first", name(enter), name(exit)),
            (Call::SetupExperiment, _) => format!("it comes before {}; {} starts over", name(enter), name(Call::Reset)),
            (Call::EnterInitializationMode, _) => {
                format!("it comes once, right after instantiation; {} starts over", name(Call::Reset))
            }
            (_, Mode::Initialization) => format!("call {} first", name(exit)),
            (_, Mode::Step) | (Call::ExitInitializationMode, _) => {
                format!("the initialization is done; {} starts over", name(Call::Reset))
            }
            (_, Mode::Event) => format!("call {} first", name(Call::EnterContinuousTimeMode)),
            (_, Mode::ContinuousTime) => format!("call {} first", name(Call::EnterEventMode)),
        }
    }
}
