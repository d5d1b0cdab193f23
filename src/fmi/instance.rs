//! One instance of a unit: every FMI call as a safe function over a [`Model`].
//!
//! Each function first asks the calling table ([`super::lifecycle`]), then checks its arguments, and only then touches
//! the model: a call that fails leaves the instance as it was. The one exception is a step that the model itself cannot
//! do; after it only an earlier FMU state or a reset goes on. Log lines are collected in order and fetched by
//! [`Instance::take_entries`]. Reading, writing and stepping allocate nothing here.

mod dependencies;
mod derivatives;
mod exchange;
mod fmi3;
pub mod serialized;
mod state;
mod values;

pub use fmi3::Progress;
pub use state::FmuState;

use serde::{Deserialize, Serialize};

use super::{
    Failure, LogCategory, Model, Status, Value, arrays,
    error::Error,
    lifecycle::{self, Call, Kind, Mode, Standard},
    log::{Entry, Switch},
};

/// How far the host's time may be from ours, relative to the larger of the times and the step: a host that sums up a
/// million steps in doubles is off by 1e-10.
const TIME_TOLERANCE: f64 = 1e-9;

/// One instance of the unit.
pub struct Instance<M: Model> {
    model: M,
    standard: Standard,
    kind: Kind,
    control: Control,
    /// The logging switch of the instantiation, which a reset goes back to.
    first_logging: Switch,
    entries: Vec<Entry>,
    /// What the running call returns where it succeeds; see [`Self::take_status`].
    status: Status,
    /// Values to go back to when a later one of the same call is refused; empty between two calls.
    undo: Vec<(usize, Value)>,
    /// FMI 3.0: the arrays of the variables.
    arrays: Arrays,
}

/// How the variables of FMI 3.0 lie in the table; scratch memory for their elements.
#[derive(Debug, Default)]
struct Arrays {
    /// Elements of the variable with each reference; 0: it is another element of an array. Empty in FMI 2.0.
    lengths: Vec<u32>,
    /// The reference of the independent variable.
    time: u32,
    /// Memory for the rows of all elements that a call is about.
    rows: Vec<Vec<u32>>,
    /// The results are those of the time of Intermediate Update Mode.
    looked: bool,
    /// Where the communication step under way ends, s; none: it has arrived.
    end: Option<f64>,
    /// The host set inputs in Intermediate Update Mode, so that the rest of the communication step begins anew.
    split: bool,
}

/// What changes between two calls, apart from the model.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Control {
    mode: Mode,
    /// Start time, s.
    start: f64,
    /// Stop time where defined, s.
    stop: Option<f64>,
    /// The model's initial state belongs to the values as set in Initialization Mode.
    solved: bool,
    /// A value was read before initialization, and the host was warned.
    warned_early: bool,
    logging: Switch,
}

impl Control {
    fn new(start: f64, logging: Switch) -> Self {
        Self { mode: Mode::Instantiated, start, stop: None, solved: false, warned_early: false, logging }
    }
}

/// What `fmi2Get...Status` asks for (FMI 2.0, section 4.2.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatusKind {
    /// `fmi2DoStepStatus`, the result of an asynchronous step.
    DoStep,
    /// `fmi2PendingStatus`, a text on a step that is still computed.
    Pending,
    /// `fmi2LastSuccessfulTime`, the time reached, s.
    LastSuccessfulTime,
    /// `fmi2Terminated`, whether the unit wants to end.
    Terminated,
}

impl<M: Model> Instance<M> {
    /// A new instance of a model just loaded (`fmi2Instantiate`, section 2.1.5).
    pub fn new(model: M, logging_on: bool) -> Self {
        Self::of(Standard::Fmi2, model, logging_on)
    }

    /// A new instance of a model just loaded, for co-simulation by hosts of a version of the standard.
    pub fn of(standard: Standard, model: M, logging_on: bool) -> Self {
        let logging = Switch::new(logging_on);
        let variables = model.variables();
        let arrays = match standard {
            Standard::Fmi2 => Arrays::default(),
            Standard::Fmi3 => Arrays {
                lengths: arrays::lengths(variables),
                time: arrays::time_reference(variables) as u32,
                ..Arrays::default()
            },
        };
        let control = Control::new(model.about().start, logging);
        let mut instance = Self {
            model,
            standard,
            kind: Kind::CoSimulation,
            control,
            first_logging: logging,
            entries: Vec::new(),
            status: Status::Ok,
            undo: Vec::new(),
            arrays,
        };
        instance.pass_on_warnings();
        instance
    }

    /// The version of the standard that its host speaks.
    pub fn standard(&self) -> Standard {
        self.standard
    }

    /// Whether the host wants log lines of this category.
    pub fn wants(&self, category: LogCategory) -> bool {
        self.control.logging.wants(category)
    }

    /// The model behind it.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// The model behind it, for what no host of an FMU can ask for.
    pub(crate) fn model_mut(&mut self) -> &mut M {
        &mut self.model
    }

    /// The mode it is in.
    pub fn mode(&self) -> Mode {
        self.control.mode
    }

    /// The time reached; before initialization the start time, s.
    pub fn time(&self) -> f64 {
        match self.control.mode {
            Mode::Instantiated | Mode::Initialization => self.control.start,
            _ => self.model.time(),
        }
    }

    /// The log lines since the last call of this function, oldest first. Allocates nothing where there are none.
    pub fn take_entries(&mut self) -> Vec<Entry> {
        std::mem::take(&mut self.entries)
    }

    /// What a call that succeeded returns: a warning only where the host asked for something odd. What the model warns
    /// of goes to the log alone, since many hosts end a run at any status but `fmi2OK`.
    pub fn take_status(&mut self) -> Status {
        std::mem::replace(&mut self.status, Status::Ok)
    }

    /// Makes the instance unusable, after a caught panic.
    pub fn give_up(&mut self) {
        self.control.mode = Mode::Fatal;
    }

    /// Whether `call` is legal now (section 4.2.4).
    ///
    /// # Errors
    /// It is not.
    pub fn check(&self, call: Call) -> Result<(), Error> {
        Ok(lifecycle::check(self.standard, self.kind, call, self.control.mode)?)
    }

    /// Switches debug messages; no category named means all (section 2.1.5). Unknown names are warned of and left out.
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn set_debug_logging(&mut self, on: bool, categories: &[&str]) -> Result<(), Error> {
        self.check(Call::SetDebugLogging)?;
        let logging = &mut self.control.logging;
        let unknown = match self.standard {
            Standard::Fmi2 => logging.select(on, categories),
            Standard::Fmi3 => logging.turn(on, categories),
        };
        for unknown in unknown {
            self.object(format!("there is no log category `{unknown}`; the known ones stand in modelDescription.xml"));
        }
        Ok(())
    }

    /// Start and stop time, s (section 2.1.6). The host's tolerance is not used: accuracy is the model's.
    ///
    /// # Errors
    /// The mode does not allow it, or the times are not finite or not in order.
    pub fn setup_experiment(&mut self, tolerance: Option<f64>, start: f64, stop: Option<f64>) -> Result<(), Error> {
        self.check(Call::SetupExperiment)?;
        if !start.is_finite() {
            return Err(Error::StartTime { start });
        }
        if let Some(stop) = stop
            && !(stop.is_finite() && stop >= start)
        {
            return Err(Error::StopTime { start, stop });
        }
        self.control.start = start;
        self.control.stop = stop;
        self.event(|| match stop {
            Some(stop) => format!("experiment from t = {start} s to t = {stop} s"),
            None => format!("experiment from t = {start} s, no stop time"),
        });
        if let Some(tolerance) = tolerance {
            let is_possible = tolerance > 0.0 && tolerance.is_finite();
            let accuracy = if is_possible { self.model.set_tolerance(tolerance) } else { None };
            self.event(|| match accuracy {
                Some(accuracy) => {
                    format!("the host's tolerance {tolerance} sets the accuracy of the motion to {accuracy}")
                }
                None => format!("the model does not use the host's tolerance {tolerance}"),
            });
        }
        Ok(())
    }

    /// Enters Initialization Mode (section 2.1.6).
    ///
    /// # Errors
    /// The mode does not allow it, or the parameters as set do not make a model: the instance stays as it is, for
    /// others to be set.
    pub fn enter_initialization_mode(&mut self) -> Result<(), Error> {
        self.check(Call::EnterInitializationMode)?;
        self.model.check()?;
        self.control.mode = Mode::Initialization;
        self.control.solved = false;
        self.event(|| "Initialization Mode".to_owned());
        Ok(())
    }

    /// Finds the initial state, if no read has already, and leaves Initialization Mode: every output is valid then
    /// (section 2.1.6).
    ///
    /// # Errors
    /// The mode does not allow it, or the model has no initial state; the instance stays in Initialization Mode, where
    /// other values may be tried.
    pub fn exit_initialization_mode(&mut self) -> Result<(), Error> {
        self.check(Call::ExitInitializationMode)?;
        self.solve_initial_state()?;
        self.control.mode = match self.kind {
            Kind::CoSimulation => Mode::Step,
            Kind::ModelExchange => Mode::Event,
        };
        let start = self.control.start;
        self.event(|| format!("initialized at t = {start} s"));
        Ok(())
    }

    /// Ends the simulation; values can still be read (section 2.1.6).
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn terminate(&mut self) -> Result<(), Error> {
        self.check(Call::Terminate)?;
        self.control.mode = Mode::Terminated;
        self.model.conclude();
        self.pass_on_warnings();
        self.event(|| "terminated".to_owned());
        Ok(())
    }

    /// Back to just instantiated (section 2.1.6).
    ///
    /// # Errors
    /// The mode does not allow it.
    pub fn reset(&mut self) -> Result<(), Error> {
        self.check(Call::Reset)?;
        self.model.reset();
        self.control = Control::new(self.model.about().start, self.first_logging);
        self.event(|| "reset".to_owned());
        Ok(())
    }

    /// Advances from `time` by `step`, s (section 4.2.2). Never discarded: the model halves its own steps. The last
    /// step of a host that adds up its time may be round-off; such a step is done at once.
    ///
    /// # Errors
    /// The mode does not allow it, or the numbers do not fit (nothing happened); or the model fails on the way: then
    /// only an earlier FMU state or a reset goes on.
    pub fn do_step(&mut self, time: f64, step: f64) -> Result<(), Error> {
        self.check(Call::DoStep)?;
        let end = self.end_of_step(time, step)?;
        self.advance(end)
    }

    /// Checks whether a step to `end`, s, can be tried; a refusal changes nothing.
    fn accept_step(&mut self, end: f64) -> Result<(), Error> {
        self.check(Call::DoStep)?;
        self.model.accept_step(end)?;
        let time = self.model.time();
        self.event(|| format!("step from t = {time} s to t = {end} s"));
        Ok(())
    }

    /// Passes the model's warnings on; after a failed step the instance is stopped.
    fn after_step<T>(&mut self, outcome: Result<T, Failure>) -> Result<T, Error> {
        self.pass_on_warnings();
        outcome.map_err(|failure| {
            self.control.mode = Mode::Error;
            Error::Model(failure)
        })
    }

    /// Advances to `end`, s, an instant that is not before the own time.
    ///
    /// # Errors
    /// As [`Self::do_step`].
    pub fn advance(&mut self, end: f64) -> Result<(), Error> {
        self.accept_step(end)?;
        let outcome = self.model.advance(end);
        self.after_step(outcome)
    }

    /// End of the step that the host asks for, s; by round-off it may be before the own time.
    fn end_of_step(&self, time: f64, step: f64) -> Result<f64, Error> {
        let own = self.model.time();
        let rounding = TIME_TOLERANCE * own.abs().max(time.abs()).max(step);
        let end = time + step;
        // False for NaN; any difference is small beside an infinite time. The model lags behind by what it has left to
        // the next step.
        let same_time = time.is_finite() && (time - own).abs() <= rounding.max(self.model.shortest_step());
        if !same_time {
            return Err(Error::WrongTime { given: time, own });
        }
        let advances = step > 0.0 && end.is_finite(); // false for NaN
        if !advances {
            return Err(Error::StepSize { step, time });
        }
        match self.control.stop {
            Some(stop) if end > stop + rounding => Err(Error::BeyondStop { end, stop }),
            _ => Ok(end),
        }
    }

    /// There is never a step to cancel (section 4.2.2).
    ///
    /// # Errors
    /// Always: steps are synchronous.
    pub fn cancel_step(&mut self) -> Result<(), Error> {
        self.check(Call::CancelStep)
    }

    /// `fmi2GetRealStatus` (section 4.2.3): the time reached, s.
    ///
    /// # Errors
    /// The mode does not allow it, or another status is asked for.
    pub fn real_status(&self, kind: StatusKind) -> Result<f64, Error> {
        self.check(Call::GetRealStatus)?;
        match kind {
            StatusKind::LastSuccessfulTime => Ok(self.model.time()),
            other => Err(no_such_status(other)),
        }
    }

    /// `fmi2GetBooleanStatus` (section 4.2.3): this unit never wants to end by itself.
    ///
    /// # Errors
    /// The mode does not allow it, or another status is asked for.
    pub fn boolean_status(&self, kind: StatusKind) -> Result<bool, Error> {
        self.check(Call::GetBooleanStatus)?;
        match kind {
            StatusKind::Terminated => Ok(false),
            other => Err(no_such_status(other)),
        }
    }

    /// `fmi2GetStatus`, `fmi2GetIntegerStatus` and `fmi2GetStringStatus` (section 4.2.3): there is none of that type.
    ///
    /// # Errors
    /// Always: the mode does not allow it, or a unit with synchronous steps has no such status.
    pub fn other_status(&self, call: Call, kind: StatusKind) -> Result<(), Error> {
        self.check(call)?;
        Err(no_such_status(kind))
    }

    /// The initial state that belongs to the values as set.
    fn solve_initial_state(&mut self) -> Result<(), Error> {
        if self.control.solved {
            return Ok(());
        }
        let outcome = self.model.initialize(self.control.start);
        self.pass_on_warnings();
        outcome?;
        self.control.solved = true;
        Ok(())
    }

    /// Logs what happened, where the host wants to know.
    fn event(&mut self, message: impl FnOnce() -> String) {
        if self.control.logging.wants(LogCategory::Events) {
            self.entries.push(Entry { status: Status::Ok, category: LogCategory::Events, message: message() });
        }
    }

    /// Warns of something odd that the host asked for, in the log and by the status of the call.
    fn object(&mut self, message: String) {
        self.status = Status::Warning;
        self.warn(message);
    }

    /// Warns in the log.
    fn warn(&mut self, message: String) {
        self.entries.push(Entry { status: Status::Warning, category: LogCategory::StatusWarning, message });
    }

    fn pass_on_warnings(&mut self) {
        for warning in self.model.take_warnings() {
            self.warn(warning);
        }
    }
}

fn no_such_status(kind: StatusKind) -> Error {
    let reason = match kind {
        StatusKind::DoStep | StatusKind::Pending => {
            "fmi2DoStep never returns fmi2Pending; its own result is the status"
        }
        StatusKind::LastSuccessfulTime => "fmi2LastSuccessfulTime is asked for by fmi2GetRealStatus",
        StatusKind::Terminated => "fmi2Terminated is asked for by fmi2GetBooleanStatus",
    };
    Error::NoSuchStatus { reason }
}
