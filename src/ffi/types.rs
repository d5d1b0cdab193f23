//! The C types of FMI 2.0, under the standard's names.
#![allow(non_camel_case_types, non_snake_case, non_upper_case_globals, reason = "the standard's names")]

use std::ffi::{c_char, c_double, c_int, c_uint, c_void};

use crate::fmi::{Status, instance::StatusKind};

/// An instance, made by `fmi2Instantiate`.
pub type fmi2Component = *mut c_void;
/// What the host wants to be handed back with every callback.
pub type fmi2ComponentEnvironment = *mut c_void;
/// A copy of an instance, made by `fmi2GetFMUstate`.
pub type fmi2FMUstate = *mut c_void;
/// Names a variable.
pub type fmi2ValueReference = c_uint;
/// A double.
pub type fmi2Real = c_double;
/// An int.
pub type fmi2Integer = c_int;
/// `fmi2True` or `fmi2False`.
pub type fmi2Boolean = c_int;
/// A byte of text.
pub type fmi2Char = c_char;
/// Text in UTF-8 that ends with a zero byte.
pub type fmi2String = *const fmi2Char;
/// A byte of a serialized FMU state.
pub type fmi2Byte = c_char;
/// `fmi2ModelExchange` or `fmi2CoSimulation`.
pub type fmi2Type = c_int;
/// `fmi2DoStepStatus`, `fmi2PendingStatus`, `fmi2LastSuccessfulTime` or `fmi2Terminated`.
pub type fmi2StatusKind = c_int;

/// True.
pub const fmi2True: fmi2Boolean = 1;
/// False.
pub const fmi2False: fmi2Boolean = 0;
/// The host integrates the states: of a linear system only.
pub const fmi2ModelExchange: fmi2Type = 0;
/// The unit takes the steps.
pub const fmi2CoSimulation: fmi2Type = 1;
/// For `fmi2GetStatus`.
pub const fmi2DoStepStatus: fmi2StatusKind = 0;
/// For `fmi2GetStringStatus`.
pub const fmi2PendingStatus: fmi2StatusKind = 1;
/// For `fmi2GetRealStatus`.
pub const fmi2LastSuccessfulTime: fmi2StatusKind = 2;
/// For `fmi2GetBooleanStatus`.
pub const fmi2Terminated: fmi2StatusKind = 3;

/// What a call reports.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum fmi2Status {
    /// All well.
    fmi2OK,
    /// Something is odd, see the log.
    fmi2Warning,
    /// The question has no answer here.
    fmi2Discard,
    /// The call failed, see the log.
    fmi2Error,
    /// The instance is unusable.
    fmi2Fatal,
    /// Never returned: steps are synchronous.
    fmi2Pending,
}

impl From<Status> for fmi2Status {
    fn from(status: Status) -> Self {
        match status {
            Status::Ok => Self::fmi2OK,
            Status::Warning => Self::fmi2Warning,
            Status::Discard => Self::fmi2Discard,
            Status::Error => Self::fmi2Error,
            Status::Fatal => Self::fmi2Fatal,
        }
    }
}

/// The kind of status a host asks for; none for a number outside the standard.
pub(super) fn status_kind(kind: fmi2StatusKind) -> Option<StatusKind> {
    match kind {
        fmi2DoStepStatus => Some(StatusKind::DoStep),
        fmi2PendingStatus => Some(StatusKind::Pending),
        fmi2LastSuccessfulTime => Some(StatusKind::LastSuccessfulTime),
        fmi2Terminated => Some(StatusKind::Terminated),
        _ => None,
    }
}

/// Takes a log line: environment, instance name, status, category, printf format, and no further arguments.
pub type fmi2CallbackLogger = Option<
    unsafe extern "C" fn(
        componentEnvironment: fmi2ComponentEnvironment,
        instanceName: fmi2String,
        status: fmi2Status,
        category: fmi2String,
        message: fmi2String,
        ...
    ),
>;
/// Not used by this library.
pub type fmi2CallbackAllocateMemory = Option<unsafe extern "C" fn(nobj: usize, size: usize) -> *mut c_void>;
/// Not used by this library.
pub type fmi2CallbackFreeMemory = Option<unsafe extern "C" fn(obj: *mut c_void)>;
/// Not used by this library.
pub type fmi2StepFinished =
    Option<unsafe extern "C" fn(componentEnvironment: fmi2ComponentEnvironment, status: fmi2Status)>;

/// What the host offers to an instance. Only the logger is used; it may be NULL.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct fmi2CallbackFunctions {
    /// Takes log lines.
    pub logger: fmi2CallbackLogger,
    /// Not used.
    pub allocateMemory: fmi2CallbackAllocateMemory,
    /// Not used.
    pub freeMemory: fmi2CallbackFreeMemory,
    /// Not used.
    pub stepFinished: fmi2StepFinished,
    /// Handed back with every callback.
    pub componentEnvironment: fmi2ComponentEnvironment,
}

/// The answer of `fmi2NewDiscreteStates`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct fmi2EventInfo {
    /// Always false.
    pub newDiscreteStatesNeeded: fmi2Boolean,
    /// Always false.
    pub terminateSimulation: fmi2Boolean,
    /// Always false.
    pub nominalsOfContinuousStatesChanged: fmi2Boolean,
    /// Always false.
    pub valuesOfContinuousStatesChanged: fmi2Boolean,
    /// Always false.
    pub nextEventTimeDefined: fmi2Boolean,
    /// Not defined, s.
    pub nextEventTime: fmi2Real,
}
