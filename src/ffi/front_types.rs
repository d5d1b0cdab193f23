//! The C types of the library's own functions ([`super::front`]).
#![allow(non_camel_case_types, reason = "names as C programmers write them")]

use crate::simulation::{Error, Kind};

/// A model that is loaded and runs, made by ancf14_load_file or ancf14_load_text.
#[derive(Debug)]
pub struct ancf14_simulation {
    _opaque: (),
}

/// A copy of a simulation to go back to, made by ancf14_save.
#[derive(Debug)]
pub struct ancf14_state {
    _opaque: (),
}

/// What a call reports. ancf14_last_error has the sentence that belongs to it.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ancf14_status {
    /// The call succeeded.
    ANCF14_OK,
    /// The simulation, or the state, is NULL, was freed, or is another pointer; or the state belongs to another model.
    /// Nothing was touched.
    ANCF14_BAD_HANDLE,
    /// Another argument is NULL where an address is needed, or is not UTF-8 text.
    ANCF14_BAD_ARGUMENT,
    /// The model has no variable with this number or name.
    ANCF14_UNKNOWN_VARIABLE,
    /// The value is out of range, the variable cannot be set now, or the time lies in the past. Nothing was changed.
    ANCF14_REFUSED,
    /// The call comes too early, too late, or after a failed step.
    ANCF14_WRONG_ORDER,
    /// The mechanism has no initial state, or a step cannot be computed: ancf14_restore or ancf14_reset goes on.
    ANCF14_FAILED,
    /// A defect of the library. The simulation is unusable, and can only be freed.
    ANCF14_FAULT,
}

/// What a variable is, and so when it can be set.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ancf14_kind {
    /// There is no such variable.
    ANCF14_NO_VARIABLE,
    /// A number of the model file; it can be set before ancf14_initialize.
    ANCF14_PARAMETER,
    /// A number of the model file that can be set between two steps too.
    ANCF14_TUNABLE,
    /// A number of the model file that follows from others; it cannot be set.
    ANCF14_CALCULATED,
    /// A number that the program gives; it can be set at any time, and acts from the next step on.
    ANCF14_INPUT,
    /// A result; it can be read after ancf14_initialize.
    ANCF14_OUTPUT,
}

impl From<&Error> for ancf14_status {
    fn from(error: &Error) -> Self {
        match error {
            Error::UnknownVariable { .. } | Error::UnknownIndex { .. } => Self::ANCF14_UNKNOWN_VARIABLE,
            Error::Refused { .. } | Error::Time { .. } => Self::ANCF14_REFUSED,
            Error::NotInitialized | Error::Initialized | Error::Finished { .. } | Error::Stopped { .. } => {
                Self::ANCF14_WRONG_ORDER
            }
            Error::ForeignState => Self::ANCF14_BAD_HANDLE,
            Error::Unreadable { .. } | Error::Mistakes { .. } | Error::Failed { .. } | Error::TooManyRows { .. } => {
                Self::ANCF14_FAILED
            }
            Error::Fault { .. } => Self::ANCF14_FAULT,
        }
    }
}

impl From<Kind> for ancf14_kind {
    fn from(kind: Kind) -> Self {
        match kind {
            Kind::Parameter => Self::ANCF14_PARAMETER,
            Kind::Tunable => Self::ANCF14_TUNABLE,
            Kind::Calculated => Self::ANCF14_CALCULATED,
            Kind::Input => Self::ANCF14_INPUT,
            Kind::Output => Self::ANCF14_OUTPUT,
        }
    }
}
