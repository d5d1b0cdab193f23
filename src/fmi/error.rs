//! What can go wrong on the FMI side. One sentence each: what happened, with numbers, and a way out.
//!
//! Which call it was and in which mode is put in front by whoever reports the error (the guard in `ffi`).

use super::{
    Failure, LogCategory, Status,
    lifecycle::{Illegal, Kind, Mode},
};

/// Why a call or a header failed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Error {
    /// The calling table forbids the call in this mode.
    #[error(transparent)]
    Illegal(#[from] Illegal),
    /// A required pointer is NULL.
    #[error("the argument `{argument}` is NULL; pass a valid address")]
    Null {
        /// The standard's name of the argument.
        argument: &'static str,
    },
    /// A text from the host is not UTF-8.
    #[error("the argument `{argument}` is not UTF-8 text")]
    NotUtf8 {
        /// The standard's name of the argument.
        argument: &'static str,
    },
    /// An array has more bytes than a process can address.
    #[error("the argument `{argument}` is said to have {count} elements, more than fit into memory")]
    TooLong {
        /// The standard's name of the argument.
        argument: &'static str,
        /// Its length as passed.
        count: usize,
    },
    /// No variable has this value reference.
    #[error(
        "there is no variable with value reference {reference}: this unit has {count} variables, numbered from 0; \
         take the references from its modelDescription.xml"
    )]
    UnknownReference {
        /// The reference asked for.
        reference: u32,
        /// Number of variables.
        count: usize,
    },
    /// The variable exists but is of another type.
    #[error(
        "variable {name} (value reference {reference}) is of type {actual}, not {asked}; use the functions for {actual}"
    )]
    WrongType {
        /// Its name.
        name: String,
        /// Its value reference.
        reference: u32,
        /// The type it has.
        actual: &'static str,
        /// The type the call is for.
        asked: &'static str,
    },
    /// Derivatives are set for inputs only, and taken by inputs only.
    #[error("`{name}` is no input; derivatives are set for inputs, and taken by inputs")]
    NoInput {
        /// Its name.
        name: String,
    },
    /// Inputs are taken to be linear in time.
    #[error(
        "the derivative of order {order} of `{name}` cannot be set: inputs are extrapolated by their first derivative; pass order 1"
    )]
    InputOrder {
        /// Name of the input.
        name: String,
        /// The order asked for.
        order: i32,
    },
    /// Only outputs have derivatives that can be read.
    #[error("`{name}` is no output; derivatives are read of outputs only")]
    NoOutput {
        /// Its name.
        name: String,
    },
    /// The unknown is not calculated in Initialization Mode.
    #[error(
        "`{name}` is not calculated; here derivatives are those of outputs, of calculated parameters and of rates of \
         states"
    )]
    NotCalculated {
        /// Its name.
        name: String,
    },
    /// The known cannot be set in Initialization Mode.
    #[error("`{name}` cannot be set; here derivatives are taken with respect to inputs, parameters and states")]
    NotGiven {
        /// Its name.
        name: String,
    },
    /// A directional derivative exceeds the range of a double.
    #[error("the change of `{name}` for these seeds is {value}: it exceeds the range of a double; pass seeds near 1")]
    SeedTooLarge {
        /// Name of the unknown.
        name: String,
        /// The sum of the products.
        value: f64,
    },
    /// Second derivatives of outputs are not known.
    #[error(
        "the derivative of order {order} of `{name}` cannot be read: maxOutputDerivativeOrder is 1; read the velocity and its derivative"
    )]
    OutputOrder {
        /// Name of the output.
        name: String,
        /// The order asked for.
        order: i32,
    },
    /// As many values as references are needed.
    #[error("{references} value references but {values} values; pass as many values as references")]
    LengthsDiffer {
        /// Number of references.
        references: usize,
        /// Number of values.
        values: usize,
    },
    /// As many values as elements are needed.
    #[error(
        "the variables have {needed} values, all elements of arrays counted, but {given} are passed; pass {needed} values"
    )]
    ValuesDiffer {
        /// Number of elements.
        needed: usize,
        /// Number of values.
        given: usize,
    },
    /// As many places as dependencies are needed.
    #[error("there are {needed} dependencies, but places for {given}; ask for their number first")]
    DependenciesDiffer {
        /// Number of dependencies.
        needed: usize,
        /// Number of places.
        given: usize,
    },
    /// An element of an array has no value reference of its own in FMI 3.0.
    #[error(
        "value reference {reference} is an element, {name}; pass the reference of the whole array, which is that of its first element"
    )]
    Element {
        /// Its name in FMI 2.0.
        name: String,
        /// The reference asked for.
        reference: u32,
    },
    /// A variable that can be neither read nor set during an intermediate update.
    #[error(
        "`{name}` cannot be accessed during intermediate updates; use continuous inputs and outputs only, which have intermediateUpdate = true"
    )]
    NotBetween {
        /// Its name.
        name: String,
    },
    /// The instance belongs to the other version of the standard.
    #[error("this instance was not made by this version of the standard; call the functions of FMI {own} with it")]
    OtherStandard {
        /// The version that made it.
        own: &'static str,
    },
    /// The variable cannot be set at all.
    #[error("variable {name} is a result and cannot be set; parameters and inputs can")]
    Result {
        /// Its name.
        name: String,
    },
    /// A state was set where nobody integrates it.
    #[error(
        "state {name} can be set before the end of the initialization, and in Continuous-Time Mode of Model Exchange; \
         set it there, or go back to an FMU state"
    )]
    State {
        /// Its name.
        name: String,
    },
    /// As many values as states, or as event indicators, are needed.
    #[error(
        "the call is for {given} states or event indicators, and this unit has {needed}; take the number from \
         modelDescription.xml"
    )]
    StatesDiffer {
        /// How many there are.
        needed: usize,
        /// How many are passed.
        given: usize,
    },
    /// A fixed parameter was set too late.
    #[error(
        "parameter {name} is fixed and can be set before the end of the initialization only; \
         tunable parameters and inputs can be set between two steps"
    )]
    Fixed {
        /// Its name.
        name: String,
    },
    /// NaN or an infinity was to be set.
    #[error("variable {name} cannot be {value}; set a finite number")]
    NotFinite {
        /// Its name.
        name: String,
        /// The number.
        value: f64,
    },
    /// The value is outside `min` and `max`.
    #[error("variable {name} cannot be {value}{unit}; it must be {bounds}")]
    OutOfRange {
        /// Its name.
        name: String,
        /// The number.
        value: f64,
        /// Its unit with a space in front, or empty.
        unit: String,
        /// The allowed range in words.
        bounds: String,
    },
    /// The start time is not a number.
    #[error("the start time {start} s is not finite")]
    StartTime {
        /// As passed, s.
        start: f64,
    },
    /// The stop time lies before the start time.
    #[error("the stop time {stop} s must be finite and not before the start time {start} s")]
    StopTime {
        /// As passed, s.
        start: f64,
        /// As passed, s.
        stop: f64,
    },
    /// The communication step is not positive, or not finite.
    #[error(
        "the communication step {step} s at {time} s is not positive and finite; pass a finite step greater than zero"
    )]
    StepSize {
        /// As passed, s.
        step: f64,
        /// The own time, s.
        time: f64,
    },
    /// The host's time is not ours.
    #[error(
        "the communication point {given} s is not the time this unit has reached, {own} s; go on from there, \
         or go back to an earlier FMU state"
    )]
    WrongTime {
        /// As passed, s.
        given: f64,
        /// The own time, s.
        own: f64,
    },
    /// The step would pass the stop time.
    #[error(
        "the step to {end} s passes the stop time {stop} s that the host defined; end there, or define no stop time"
    )]
    BeyondStop {
        /// End of the step, s.
        end: f64,
        /// The defined stop time, s.
        stop: f64,
    },
    /// A status that a unit without asynchronous steps does not have.
    #[error("this status does not exist here: {reason}")]
    NoSuchStatus {
        /// Why.
        reason: &'static str,
    },
    /// A handle that is no FMU state, or none any more.
    #[error(
        "the argument `FMUstate` is no live state of this library: it was freed, or is another pointer; pass one that \
         this library has handed out, or NULL for a new one"
    )]
    UnknownState,
    /// An FMU state of another model.
    #[error("the FMU state belongs to the model {theirs}, this instance to {own}; use states of this instance only")]
    ForeignState {
        /// GUID in the state.
        theirs: String,
        /// GUID of this model.
        own: String,
    },
    /// An FMU state of the other kind of instances.
    #[error(
        "the FMU state is of an instance for {theirs}, and this instance is for {own}; use states of instances of its \
         kind"
    )]
    OtherKind {
        /// The kind that the state belongs to.
        theirs: Kind,
        /// The kind of this instance.
        own: Kind,
    },
    /// Bytes that are no serialized state.
    #[error(
        "the bytes are not a serialized FMU state of this library: {problem}; pass those that a state was serialized to, all of them"
    )]
    Serialized {
        /// What is wrong with them.
        problem: String,
    },
    /// The host's memory is not as large as the serialized state.
    #[error(
        "the serialized state has {needed} bytes, the host offers {given}; ask for the serialized size of this very state"
    )]
    SerializedSize {
        /// Bytes of the state.
        needed: usize,
        /// Bytes of the host's memory.
        given: usize,
    },
    /// The model failed.
    #[error("{}", .0.message)]
    Model(Failure),
    /// A panic was caught.
    #[error("internal fault, please report it: {message}; this instance is unusable now and can only be freed")]
    Fault {
        /// What the panic said, and where.
        message: String,
    },
    /// The instantiation was called with something it cannot use.
    #[error("{0}")]
    Instantiate(String),
    /// The model identifier is not a C identifier.
    #[error(
        "the model identifier `{0}` is not a C identifier; it must be letters, digits and `_`, not begin with a digit, \
         and be no keyword"
    )]
    Identifier(String),
}

impl Error {
    /// What the call returns for it.
    pub fn status(&self) -> Status {
        match self {
            Self::NoSuchStatus { .. } => Status::Discard,
            Self::Fault { .. } | Self::Illegal(Illegal { mode: Mode::Fatal, .. }) => Status::Fatal,
            _ => Status::Error,
        }
    }

    /// The log category it goes to.
    pub fn category(&self) -> LogCategory {
        match (self, self.status()) {
            (Self::Model(failure), _) => failure.category,
            (_, Status::Discard) => LogCategory::StatusDiscard,
            (_, Status::Fatal) => LogCategory::StatusFatal,
            _ => LogCategory::StatusError,
        }
    }
}

impl From<Failure> for Error {
    fn from(failure: Failure) -> Self {
        Self::Model(failure)
    }
}
