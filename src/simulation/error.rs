//! What can go wrong for a program that uses [`Simulation`](super::Simulation).

use std::fmt;

use crate::error::decimal;
use crate::fmi::{self, lifecycle::Mode};

/// Why a call of a [`Simulation`](super::Simulation) failed. Each message is a sentence with numbers and a way out.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The model file cannot be read.
    #[error("{reason}")]
    Unreadable {
        /// The file, and why it cannot be read.
        reason: String,
    },
    /// The text is not a model.
    #[error("{mistakes}")]
    Mistakes {
        /// All mistakes, each with its line underlined; text of several lines.
        mistakes: String,
        /// The line of the first mistake, from 1; none: the mistakes are in overrides.
        line: Option<usize>,
    },
    /// No variable has this name.
    #[error(
        "there is no variable `{name}`; {hint}`ancf14 check` lists all of them. Words, such as arm.strain, are not variables: \
         they are set by an override when the model is loaded"
    )]
    UnknownVariable {
        /// The name asked for.
        name: String,
        /// The nearest known name as a question, or empty.
        hint: String,
    },
    /// No variable has this number.
    #[error("there is no variable {index}: the model has {count} variables, numbered from 0")]
    UnknownIndex {
        /// The number asked for.
        index: usize,
        /// Number of variables.
        count: usize,
    },
    /// The value of a variable cannot be set, or not to this value, or not now.
    #[error("{reason}")]
    Refused {
        /// The variable, the value, and what is possible.
        reason: String,
    },
    /// The simulation has to be initialized first.
    #[error("the simulation is not initialized: there are no results yet, and it cannot advance; initialize it first")]
    NotInitialized,
    /// The simulation has been initialized already.
    #[error("the simulation is initialized already; reset it to start over")]
    Initialized,
    /// The run is finished.
    #[error("the run is finished at t = {t} s; reset the simulation to start over, or restore a saved state", t = decimal(*.time))]
    Finished {
        /// The time reached, s.
        time: f64,
    },
    /// An earlier step failed.
    #[error(
        "an earlier step failed, and the simulation stays at t = {t} s; restore a saved state, or reset the simulation to start over",
        t = decimal(*.time)
    )]
    Stopped {
        /// The time reached, s.
        time: f64,
    },
    /// A time to advance to lies in the past, or is not finite.
    #[error("the simulation cannot advance from t = {from} s to t = {to} s; pass a finite time that is not before the one reached", from = decimal(*.from))]
    Time {
        /// The time reached, s.
        from: f64,
        /// The time asked for, s.
        to: f64,
    },
    /// A saved state belongs to another model.
    #[error("the saved state belongs to another model, or to other overrides; restore states of the same model only")]
    ForeignState,
    /// The model has no initial state, or a step cannot be computed.
    #[error("{reason}")]
    Failed {
        /// What happened, where, and what to try.
        reason: String,
    },
    /// The run would have more rows of results than anybody can use.
    #[error(
        "the run would have {rows:.1e} rows of results, at most {:.0e} are possible; give a larger simulation.output_step",
        crate::model::rows::MOST
    )]
    TooManyRows {
        /// How many.
        rows: f64,
    },
    /// A defect of this library.
    #[error("internal fault, please report it: {message}; this simulation is unusable now and can only be freed")]
    Fault {
        /// What the panic said, and where.
        message: String,
    },
}

/// The sentence too: a `main` that returns an error prints it in this way, and mistakes of a file are text of several
/// lines.
impl fmt::Debug for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl Error {
    /// As the instance behind a simulation says it, which has reached `time`, s.
    pub(super) fn of(error: fmi::error::Error, time: f64) -> Self {
        use fmi::error::Error as Told;
        match error {
            Told::Illegal(illegal) => match illegal.mode {
                Mode::Instantiated | Mode::Initialization => Self::NotInitialized,
                Mode::Step | Mode::Update | Mode::Event | Mode::ContinuousTime => Self::Initialized,
                Mode::Terminated => Self::Finished { time },
                Mode::Error => Self::Stopped { time },
                Mode::Fatal => Self::Fault { message: String::from("an earlier call failed") },
            },
            Told::ForeignState { .. } => Self::ForeignState,
            Told::Model(failure) => Self::Failed { reason: failure.message },
            Told::Fault { message } => Self::Fault { message },
            Told::Fixed { name } => Self::Refused {
                reason: format!(
                    "parameter {name} is fixed: it can be set before the simulation is initialized only; reset the simulation first, \
                     or use a tunable parameter or an input, which can be set between two steps"
                ),
            },
            other => Self::Refused { reason: other.to_string() },
        }
    }

    /// As [`Self::of`] of a value that was to be set: whatever the model objects to is the value.
    pub(super) fn of_value(error: fmi::error::Error, time: f64) -> Self {
        match Self::of(error, time) {
            Self::Failed { reason } => Self::Refused { reason },
            other => other,
        }
    }
}
