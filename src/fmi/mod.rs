//! The FMI half, 2.0 and 3.0, for co-simulation and Model Exchange: variables, calling tables, instance, C header. No
//! mechanics.
//!
//! [`Model`] is the whole of what this half asks of the other one. What a host calls goes to an
//! [`instance::Instance`]. A packed unit is made from [`About`] and the variable table, by the package of
//! `crates/pack`.

pub mod arrays;
pub mod continuous;
pub mod error;
pub mod header;
pub mod identifier;
pub mod instance;
pub mod lifecycle;
pub mod location;
pub mod log;
pub mod unit;
pub mod variable;

use continuous::Continuous;
use variable::Variable;

/// What a call reports, in the order of severity of `fmi2Status`. A step is never pending.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Status {
    /// All well.
    Ok,
    /// The host asked for something odd, a log line tells what; the call succeeded.
    Warning,
    /// The question has no answer here; nothing changed.
    Discard,
    /// The call failed.
    Error,
    /// The instance is unusable.
    Fatal,
}

/// A number as FMI types it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A `Real`.
    Real(f64),
    /// An `Integer`.
    Integer(i32),
}

impl Value {
    /// The value as a double; exact for both types.
    pub fn number(self) -> f64 {
        match self {
            Self::Real(number) => number,
            Self::Integer(number) => f64::from(number),
        }
    }
}

/// What the description says of a model as a whole.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// `modelName`: free text.
    pub name: String,
    /// `modelIdentifier`: a C identifier, also the file name of the library.
    pub identifier: String,
    /// One sentence on the model; may be empty.
    pub description: String,
    /// Who made it, when, and under which terms.
    pub credits: Credits,
    /// Hash of the model and of what matters in the XML, with braces: `{8c4e810f-...}`.
    pub guid: String,
    /// Default start time, s: 0, or that of the state that the model begins with.
    pub start: f64,
    /// Default stop time, s.
    pub stop: f64,
    /// Default communication step, s.
    pub output_step: f64,
    /// Relative tolerance of the computation, for `DefaultExperiment`.
    pub tolerance: f64,
}

/// Texts of the description that only its reader understands; each may be missing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Credits {
    /// Who made the model.
    pub author: Option<String>,
    /// Its version.
    pub version: Option<String>,
    /// The terms of its use.
    pub license: Option<String>,
    /// Whose it is.
    pub copyright: Option<String>,
    /// When it was made: `2026-03-31T12:00:00Z`.
    pub date: Option<String>,
}

/// Why the model could not do what it was asked: one sentence with numbers, and the log category it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// What happened, where, with which numbers, and what to try.
    pub message: String,
    /// One of the standard's log categories.
    pub category: LogCategory,
    /// The line of the first mistake in the text of the model, from 1; none: it is not about a line.
    pub line: Option<usize>,
}

/// The log categories of FMI 2.0 (section 2.2.4) that are used here.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LogCategory {
    /// Calls and their parameters.
    Events,
    /// The linear system has no solution.
    SingularLinearSystems,
    /// Newton did not converge.
    NonlinearSystems,
    /// Something is odd but the call succeeded.
    StatusWarning,
    /// A call was discarded.
    StatusDiscard,
    /// A call failed; the instance goes on.
    StatusError,
    /// The instance is unusable.
    StatusFatal,
}

/// What the FMI half asks of a model. A failed call leaves the model as it was.
pub trait Model: Sized {
    /// A plain copy of everything that changes between two calls: what an FMU state keeps of the model.
    type Snapshot: Clone;

    /// Names, guid and default experiment.
    fn about(&self) -> &About;

    /// The variable table: a variable's value reference is its place in this slice.
    fn variables(&self) -> &[Variable];

    /// The value of variable `reference` (a legal place in the table): after `initialize` as of the last accepted time,
    /// before it the start value.
    fn value(&self, reference: usize) -> Value;

    /// Sets variable `reference`, whose causality and variability the caller has checked; the type and range are
    /// checked here.
    ///
    /// # Errors
    /// The value is out of range, of the wrong type, or not finite; the model is as it was.
    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure>;

    /// Sets the relative accuracy that a host asks for (a positive number), before [`Self::initialize`]; returns the
    /// one that the model takes, the nearest that it knows. None: it has no use for one.
    fn set_tolerance(&mut self, tolerance: f64) -> Option<f64>;

    /// Sets the derivative by time of input `reference` (a finite number) for the next `advance` only.
    fn set_input_derivative(&mut self, reference: usize, derivative: f64);

    /// Whether the parameters as set make a model: that each is within its range is known since it was set, not what
    /// follows from them.
    ///
    /// # Errors
    /// They do not.
    fn check(&self) -> Result<(), Failure>;

    /// Builds the model from the parameters as set and finds its initial state at `start`, s. May be called again.
    ///
    /// # Errors
    /// The parameters do not make a model, or no initial state exists.
    fn initialize(&mut self, start: f64) -> Result<(), Failure>;

    /// The time that the model has reached, s.
    fn time(&self) -> f64;

    /// The shortest step that the model takes, s. An end that is nearer to the own time is left to the next step:
    /// nothing moves, and the own time stays.
    fn shortest_step(&self) -> f64;

    /// Whether a step to `end`, s, can be tried: what is refused here has no consequences.
    ///
    /// # Errors
    /// It would be too many internal steps, or an input has a value that means nothing.
    fn accept_step(&self, end: f64) -> Result<(), Failure>;

    /// Advances from the own time to `end`, s; the model's own grid decides the internal steps. An end that is not
    /// beyond the own time by
    /// [`Self::shortest_step`] or more moves nothing. Either way the derivatives of the inputs are used up.
    ///
    /// # Errors
    /// A step that does not converge even at the smallest internal step; the model is as it was before the call.
    fn advance(&mut self, end: f64) -> Result<(), Failure>;

    /// Begins the step to `end`, s, that [`Self::advance`] takes at once, to be taken part by part with the same
    /// results: [`Self::take_part`] until it says that the end is reached, or [`Self::end_step`] before.
    ///
    /// # Errors
    /// As [`Self::advance`].
    fn begin_step(&mut self, end: f64) -> Result<(), Failure>;

    /// Takes the next internal step; returns whether the end is reached.
    ///
    /// # Errors
    /// As [`Self::advance`]: the model is as it was before [`Self::begin_step`], and the step is over.
    fn take_part(&mut self) -> Result<bool, Failure>;

    /// Makes the values those of the own time, in the middle of a step.
    ///
    /// # Errors
    /// The results of this state cannot be computed.
    fn look_between(&mut self) -> Result<(), Failure>;

    /// Ends the step at the own time, before its end.
    ///
    /// # Errors
    /// As [`Self::take_part`].
    fn end_step(&mut self) -> Result<(), Failure>;

    /// The derivative by time of output `reference`, a Real, 1/s of its unit; from [`Self::initialize`] on.
    ///
    /// # Errors
    /// It is no output.
    fn output_derivative(&mut self, reference: usize) -> Result<f64, Failure>;

    /// The derivative of output `output`, a Real, at the end of the last step by input `input` of that step; 0 where
    /// there is no such step.
    ///
    /// # Errors
    /// The step cannot be differentiated.
    fn partial_derivative(&mut self, output: usize, input: usize) -> Result<f64, Failure>;

    /// The derivative of the initial value of `unknown`, a Real that is calculated, by the value of `known`, a Real
    /// that can be set; in Model Exchange that of its value at any instant; 0, with a warning, where `known` cannot
    /// begin at another value. The initial state is found already.
    ///
    /// # Errors
    /// The initial state with another value of `known` cannot be found.
    fn initial_derivative(&mut self, unknown: usize, known: usize) -> Result<f64, Failure>;

    /// The model as Model Exchange needs it; none: it is for co-simulation only.
    fn continuous(&mut self) -> Option<&mut dyn Continuous> {
        None
    }

    /// The run has ended: [`Self::take_warnings`] then has what should be known of it as a whole.
    fn conclude(&mut self);

    /// Warnings since the last call of this function, oldest first.
    fn take_warnings(&mut self) -> Vec<String>;

    /// Back to just loaded: start values everywhere.
    fn reset(&mut self);

    /// Copies what changes between two calls.
    fn snapshot(&self) -> Self::Snapshot;

    /// Goes back to a snapshot of this model.
    fn restore(&mut self, snapshot: &Self::Snapshot);

    /// Writes a snapshot of this model behind `bytes`, such that [`Self::read`] of the same model in any process reads
    /// it.
    fn write(&self, snapshot: &Self::Snapshot, bytes: Vec<u8>) -> Vec<u8>;

    /// The snapshot that [`Self::write`] wrote. Any bytes may come; those that were written are undamaged, and of a
    /// model with this guid.
    ///
    /// # Errors
    /// They are not a snapshot of this model.
    fn read(&self, bytes: &[u8]) -> Result<Self::Snapshot, Failure>;
}
