//! The C types of FMI 3.0, under the standard's names.
#![allow(non_camel_case_types, non_snake_case, non_upper_case_globals, reason = "the standard's names")]

use std::ffi::{c_char, c_void};

use crate::fmi::Status;

/// An instance, made by `fmi3InstantiateCoSimulation`.
pub type fmi3Instance = *mut c_void;
/// What the host wants to be handed back with every callback.
pub type fmi3InstanceEnvironment = *mut c_void;
/// A copy of an instance, made by `fmi3GetFMUState`.
pub type fmi3FMUState = *mut c_void;
/// Names a variable.
pub type fmi3ValueReference = u32;
/// A float.
pub type fmi3Float32 = f32;
/// A double.
pub type fmi3Float64 = f64;
/// A signed integer of 8 bits.
pub type fmi3Int8 = i8;
/// An unsigned integer of 8 bits.
pub type fmi3UInt8 = u8;
/// A signed integer of 16 bits.
pub type fmi3Int16 = i16;
/// An unsigned integer of 16 bits.
pub type fmi3UInt16 = u16;
/// A signed integer of 32 bits.
pub type fmi3Int32 = i32;
/// An unsigned integer of 32 bits.
pub type fmi3UInt32 = u32;
/// A signed integer of 64 bits.
pub type fmi3Int64 = i64;
/// An unsigned integer of 64 bits.
pub type fmi3UInt64 = u64;
/// C's `bool`, read as a byte: a host that passes another byte than 0 and 1 means true.
pub type fmi3Boolean = u8;
/// A byte of text.
pub type fmi3Char = c_char;
/// Text in UTF-8 that ends with a zero byte.
pub type fmi3String = *const fmi3Char;
/// A byte.
pub type fmi3Byte = u8;
/// Bytes of a Binary variable.
pub type fmi3Binary = *const fmi3Byte;
/// The state of a clock.
pub type fmi3Clock = u8;
/// `fmi3DependencyKind` and `fmi3IntervalQualifier`, which C stores as an int.
pub type fmi3Enumeration = i32;

/// True.
pub const fmi3True: fmi3Boolean = 1;
/// False.
pub const fmi3False: fmi3Boolean = 0;

/// The kind of a dependency of which no more is known.
pub const fmi3Dependent: fmi3Enumeration = 5;

/// What a call reports.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum fmi3Status {
    /// All well.
    fmi3OK,
    /// Something is odd, see the log.
    fmi3Warning,
    /// The question has no answer here.
    fmi3Discard,
    /// The call failed, see the log.
    fmi3Error,
    /// The instance is unusable.
    fmi3Fatal,
}

impl From<Status> for fmi3Status {
    fn from(status: Status) -> Self {
        match status {
            Status::Ok => Self::fmi3OK,
            Status::Warning => Self::fmi3Warning,
            Status::Discard => Self::fmi3Discard,
            Status::Error => Self::fmi3Error,
            Status::Fatal => Self::fmi3Fatal,
        }
    }
}

/// Takes a log line: environment, status, category, text.
pub type fmi3LogMessageCallback = Option<
    unsafe extern "C" fn(
        instanceEnvironment: fmi3InstanceEnvironment,
        status: fmi3Status,
        category: fmi3String,
        message: fmi3String,
    ),
>;

/// Hears of a finished internal step, and may ask for the end of the communication step.
pub type fmi3IntermediateUpdateCallback = Option<
    unsafe extern "C" fn(
        instanceEnvironment: fmi3InstanceEnvironment,
        intermediateUpdateTime: fmi3Float64,
        intermediateVariableSetRequested: fmi3Boolean,
        intermediateVariableGetAllowed: fmi3Boolean,
        intermediateStepFinished: fmi3Boolean,
        canReturnEarly: fmi3Boolean,
        earlyReturnRequested: *mut fmi3Boolean,
        earlyReturnTime: *mut fmi3Float64,
    ),
>;
/// Not used by this library.
pub type fmi3ClockUpdateCallback = Option<unsafe extern "C" fn(instanceEnvironment: fmi3InstanceEnvironment)>;
/// Not used by this library.
pub type fmi3LockPreemptionCallback = Option<unsafe extern "C" fn()>;
/// Not used by this library.
pub type fmi3UnlockPreemptionCallback = Option<unsafe extern "C" fn()>;

/// What the host offers to an instance; the functions may be NULL.
#[derive(Clone, Copy, Debug)]
pub struct Callbacks {
    /// Handed back with every callback.
    pub environment: fmi3InstanceEnvironment,
    /// Takes log lines.
    pub log_message: fmi3LogMessageCallback,
    /// Hears of internal steps.
    pub intermediate_update: fmi3IntermediateUpdateCallback,
    /// Whether it may end a communication step.
    pub early_return_allowed: bool,
}
