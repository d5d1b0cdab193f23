//! A model that runs: the one [`fmi::Model`](crate::fmi::Model) of this library, and what `ancf14 run` drives too.

use super::build::{self, Built};
use super::document::Document;
use super::entries::simulation::{Analysis, Initial, Integrator as Choice};
use super::slopes::Slopes;
use super::variables::{Moment, Source, Table};
use super::watch::Watch;
use crate::error::Error;
use crate::fmi::variable::Variable;
use crate::fmi::{About, Failure, LogCategory, Model, Value};
use crate::mechanics::sensor::Snapshot as Frames;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::solve::generalized_alpha::GeneralizedAlpha;
use crate::solve::midpoint::{AxialRule, Midpoint};
use crate::solve::response::{Responder, Response};
use crate::solve::start;
use crate::solve::statics::Statics;
use crate::solve::stepping::grid_step;
use std::sync::Arc;

/// How near to a point of the grid of internal steps a communication point must be to be that point, in steps.
const ON_GRID: f64 = 1e-9;
/// Most internal steps in one call: beyond, times a step apart are hardly different numbers, and nobody waits for the end.
const MOST_STEPS: f64 = 1e9;
/// Round-off that a communication step may have before it takes one internal step more, in steps.
const STEP_ROUNDING: f64 = 1e-6;

/// A model file, its machine and its state.
#[derive(Debug)]
pub struct Simulation {
    about: About,
    table: Arc<Table>,
    document: Arc<Document>,
    machine: Machine,
    results: Vec<f64>,
    frames: Frames,
    warnings: Vec<String>,
    watch: Watch,
    slopes: Slopes,
}

/// The machine as built, the state it has reached, and the means to go on.
#[derive(Debug)]
struct Machine {
    system: Arc<System>,
    state: State,
    /// The state before the running call, to go back to when it fails.
    backup: State,
    /// Start of the grid of internal steps, s.
    start: f64,
    /// Internal step, s.
    step: f64,
    /// The initialization that the machine is from; none yet: no solver. Shared with the snapshots taken since, of which a
    /// solver is scratch memory only.
    initialization: Arc<()>,
    solver: Solver,
    /// Computes accelerations and multipliers, where results ask for them.
    responder: Option<Box<Responder>>,
    response: Response,
}

/// What takes a step.
#[derive(Debug)]
enum Solver {
    /// Not initialized yet.
    None,
    Midpoint(Box<Midpoint>),
    GeneralizedAlpha(Box<GeneralizedAlpha>),
    Statics(Box<Statics>),
}

/// What changes between two calls of a host.
#[derive(Clone, Debug)]
pub struct Snapshot {
    document: Arc<Document>,
    system: Arc<System>,
    state: State,
    start: f64,
    step: f64,
    initialization: Arc<()>,
    initialized: bool,
    watch: Watch,
    slopes: Slopes,
    results: Vec<f64>,
}

impl Simulation {
    /// Reads and builds a model file; `overrides` are keys and values of `--set`, `file_name` is for messages.
    ///
    /// # Errors
    /// Everything that is wrong with the file, each with its place.
    pub fn load(file_name: &str, text: &str, overrides: &[(String, String)]) -> Result<Self, Failure> {
        let wrong = |message: String| Failure { message, category: LogCategory::StatusError };
        let document = Document::parse(file_name, text, overrides).map_err(|mistakes| wrong(mistakes.to_string()))?;
        let built = build::build(&document, 0.0).map_err(|mistakes| wrong(mistakes.to_string()))?;
        let table = Table::new(&document);
        let about = About {
            name: document.model.name.clone(),
            identifier: document.model.identifier.clone(),
            description: document.model.description.clone(),
            guid: guid(text, overrides, &table),
            stop: document.value(document.simulation.stop),
            output_step: document.value(document.simulation.output_step),
        };
        let mut simulation = Self {
            about,
            table: Arc::new(table),
            machine: Machine::new(built, &document, 0.0),
            document: Arc::new(document),
            results: Vec::new(),
            frames: Frames::default(),
            warnings: Vec::new(),
            watch: Watch::default(),
            slopes: Slopes::default(),
        };
        simulation.measure().map_err(|error| failure(&error))?;
        Ok(simulation)
    }

    /// The file that is simulated.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The machine.
    pub fn system(&self) -> &System {
        &self.machine.system
    }

    /// The state it has reached.
    pub fn state(&self) -> &State {
        &self.machine.state
    }

    /// Reads all results off the state that the machine has reached.
    fn measure(&mut self) -> Result<(), Error> {
        let machine = &mut self.machine;
        machine.respond()?;
        let moment = Moment { system: &machine.system, state: &machine.state, response: &machine.response };
        self.table.measure(&moment, &mut self.frames, &mut self.results);
        let energies = self.table.energies(&self.results);
        let odd = self.watch.look(&machine.system, &machine.state, energies, &mut self.frames);
        self.warnings.extend(odd);
        Ok(())
    }
}

impl Model for Simulation {
    type Snapshot = Snapshot;

    fn about(&self) -> &About {
        &self.about
    }

    fn variables(&self) -> &[Variable] {
        &self.table.variables
    }

    fn value(&self, reference: usize) -> Value {
        match self.table.sources[reference] {
            Source::Parameter(index) => self.document.parameter_value(index),
            Source::Result(number) => match self.table.variables[reference].start {
                Value::Real(_) => Value::Real(self.results[number]),
                // A count that outgrows FMI's Integer stays at the largest one.
                Value::Integer(_) => Value::Integer(self.results[number] as i32),
            },
        }
    }

    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure> {
        let wrong = |message| Failure { message, category: LogCategory::StatusError };
        let Source::Parameter(index) = self.table.sources[reference] else {
            let name = &self.table.variables[reference].name;
            return Err(wrong(format!("`{name}` is a result and cannot be set")));
        };
        let before = self.document.parameter_value(index);
        let document = Arc::make_mut(&mut self.document);
        document.set_parameter(index, value).map_err(wrong)?;
        if self.machine.is_initialized() {
            // Nothing later checks what follows from a tunable parameter. Its old value was legal.
            if let Err(objection) = document.check() {
                document.set_parameter(index, before).map_err(wrong)?;
                return Err(wrong(objection));
            }
            build::retune(&self.document, Arc::make_mut(&mut self.machine.system));
        }
        Ok(())
    }

    fn set_input_derivative(&mut self, reference: usize, derivative: f64) {
        if let Source::Parameter(index) = self.table.sources[reference] {
            self.slopes.set(self.document.parameters()[index].number, derivative);
        }
    }

    fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        let wrong = |message| Failure { message, category: LogCategory::StatusError };
        self.document.check().map_err(wrong)?;
        let built = build::build(&self.document, start).map_err(|mistakes| wrong(mistakes.to_string()))?;
        let mut machine = Machine::new(built, &self.document, start);
        let document = &self.document;
        build::aim(document, |number| document.value(number), start, &mut machine.state.targets).map_err(wrong)?;
        let warnings = machine.find_initial_state(document, self.table.needs_response());
        self.warnings.extend(warnings.map_err(|error| failure(&error))?);
        let before = std::mem::replace(&mut self.machine, machine);
        self.watch = Watch::new(&self.document);
        if let Err(error) = self.measure() {
            self.machine = before;
            return Err(failure(&error));
        }
        Ok(())
    }

    fn time(&self) -> f64 {
        self.machine.state.time
    }

    fn advance(&mut self, end: f64) -> Result<(), Failure> {
        let wrong = |message| Failure { message, category: LogCategory::StatusError };
        let (machine, document) = (&mut self.machine, &self.document);
        machine.keep();
        let begin = machine.state.time;
        let at_end = |number| document.value(number) + self.slopes.of(number) * (end - begin);
        build::aim(document, at_end, end, &mut machine.state.targets).map_err(wrong)?;
        if self.slopes.change_loads() {
            build::extrapolate(document, |number| self.slopes.of(number), begin, Arc::make_mut(&mut machine.system));
        }
        let outcome = machine.advance(end).and_then(|()| self.measure()).map_err(|error| {
            self.machine.go_back();
            failure(&error)
        });
        if let Solver::Statics(statics) = &mut self.machine.solver {
            self.warnings.extend(statics.take_remarks());
        }
        self.slopes.end_step();
        outcome
    }

    fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    fn reset(&mut self) {
        Arc::make_mut(&mut self.document).reset();
        // The file was built with these very numbers when it was loaded.
        if let Ok(built) = build::build(&self.document, 0.0) {
            self.machine = Machine::new(built, &self.document, 0.0);
        }
        self.warnings.clear();
        self.slopes = Slopes::default();
        // Nothing is solved for before the initialization, so that nothing can fail.
        let _ = self.measure();
    }

    fn snapshot(&self) -> Snapshot {
        let machine = &self.machine;
        Snapshot {
            document: Arc::clone(&self.document),
            system: Arc::clone(&machine.system),
            state: machine.state.clone(),
            start: machine.start,
            step: machine.step,
            initialization: Arc::clone(&machine.initialization),
            initialized: machine.is_initialized(),
            watch: self.watch,
            slopes: self.slopes.clone(),
            results: self.results.clone(),
        }
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        let machine = &mut self.machine;
        self.document = Arc::clone(&snapshot.document);
        machine.system = Arc::clone(&snapshot.system);
        machine.state.clone_from(&snapshot.state);
        (machine.start, machine.step) = (snapshot.start, snapshot.step);
        self.results.clone_from(&snapshot.results);
        self.watch = snapshot.watch;
        self.slopes.clone_from(&snapshot.slopes);
        // The solver has the shape and the tolerance of its initialization, which may be another one, or another instance's.
        if !Arc::ptr_eq(&machine.initialization, &snapshot.initialization) {
            machine.initialization = Arc::clone(&snapshot.initialization);
            machine.solver = match snapshot.initialized {
                false => Solver::None,
                // It could be set up for this very system before; if memory is short, the next step says that there is none.
                true => Solver::new(&self.document, &machine.system).unwrap_or(Solver::None),
            };
            // The response is of the state, and only results ask for it: a snapshot has them.
            machine.responder = match snapshot.initialized && self.table.needs_response() {
                false => None,
                true => Responder::new(&machine.system).ok().map(Box::new),
            };
        }
    }
}

impl Machine {
    fn new(built: Built, document: &Document, start: f64) -> Self {
        let Built { system, state } = built;
        Self {
            system: Arc::new(system),
            backup: state.clone(),
            state,
            start,
            step: document.value(document.simulation.step),
            initialization: Arc::new(()),
            solver: Solver::None,
            responder: None,
            response: Response::default(),
        }
    }

    fn is_initialized(&self) -> bool {
        !matches!(self.solver, Solver::None)
    }

    /// Sets up the solver and finds the state at the start; returns what the user should know of it.
    fn find_initial_state(&mut self, document: &Document, responds: bool) -> Result<Vec<String>, Error> {
        start::check_assembled(&self.system, &self.state)?;
        self.solver = Solver::new(document, &self.system)?;
        if responds {
            self.responder = Some(Box::new(Responder::new(&self.system)?));
        }
        let simulation = &document.simulation;
        let moving = self.state.velocity.iter().any(|value| *value != 0.0);
        let mut warnings = Vec::new();
        if simulation.analysis == Analysis::Dynamic {
            match simulation.initial {
                Initial::AsDrawn => start::check_drives(&self.system, &self.state)?,
                Initial::Equilibrium => {
                    let tolerance = document.value(simulation.tolerance);
                    warnings.extend(start::find_equilibrium(&self.system, &mut self.state, tolerance)?);
                    if moving {
                        let why = "the motion begins at an equilibrium";
                        warnings.push(format!("the given initial velocities are not used: {why}"));
                    }
                }
            }
        }
        let changed = match &mut self.solver {
            Solver::None => 0.0,
            Solver::Midpoint(midpoint) => start::set_motion(&self.system, midpoint, &mut self.state)?,
            Solver::GeneralizedAlpha(alpha) => {
                warnings.extend(alpha.objection(&self.system));
                start::set_motion(&self.system, alpha, &mut self.state)?
            }
            Solver::Statics(statics) => {
                self.state.velocity.fill(0.0);
                statics.find(&self.system, &mut self.state, self.start)?;
                warnings.extend(statics.take_remarks());
                if moving {
                    warnings.push(String::from("the initial velocities are not used: the analysis is static"));
                }
                if self.system.is_damped() {
                    warnings.push(String::from("dampers are not used: the analysis is static"));
                }
                0.0
            }
        };
        if changed > 0.0 {
            warnings.push(format!(
                "the given initial velocities do not fit the joints: they were changed to the nearest that do, a change of \
                 {:.3} % of their kinetic energy",
                100.0 * changed
            ));
        }
        Ok(warnings)
    }

    /// Computes the response of the state that is reached, if results ask for it.
    fn respond(&mut self) -> Result<(), Error> {
        match (&mut self.responder, &self.solver) {
            (Some(responder), Solver::Midpoint(_)) => {
                return responder.respond(&self.system, &self.state, &mut self.response);
            }
            // It computes accelerations and multipliers at the ends of steps.
            (Some(_), Solver::GeneralizedAlpha(_)) => self.response.set_from(&self.state),
            _ => self.response.set_at_rest(&self.state),
        }
        Ok(())
    }

    /// Keeps the state, for [`Self::go_back`].
    fn keep(&mut self) {
        self.backup.clone_from(&self.state);
    }

    /// Goes back to the state that was kept.
    fn go_back(&mut self) {
        self.state.clone_from(&self.backup);
    }

    /// Advances to `end`, on the grid `start + k step` where both ends are on it, else in equal steps.
    fn advance(&mut self, end: f64) -> Result<(), Error> {
        let grid = |number: f64| self.start + number * self.step;
        let nearest = |time: f64| ((time - self.start) / self.step).round();
        let last = nearest(end);
        let on_grid = (end - grid(last)).abs() <= ON_GRID * self.step;
        let end = if on_grid { grid(last) } else { end };
        self.state.targets.end = end;
        let first = nearest(self.state.time);
        let needed = (end - self.state.time) / self.step;
        if needed > MOST_STEPS {
            return Err(Error::TooManySteps { count: needed, step: self.step, from: self.state.time, to: end });
        }
        if on_grid && self.state.time == grid(first) {
            let count = (last - first) as u64;
            for number in 1..=count {
                let next = self.start + (first + number as f64) * self.step;
                self.step_to(next, self.step)?;
            }
            return Ok(());
        }
        let begin = self.state.time;
        let count = ((end - begin) / self.step - STEP_ROUNDING).ceil().max(1.0);
        let step = (end - begin) / count;
        for number in 1..=count as u64 {
            let next = if number as f64 == count { end } else { begin + number as f64 * step };
            self.step_to(next, step)?;
        }
        Ok(())
    }

    fn step_to(&mut self, end: f64, step: f64) -> Result<(), Error> {
        match &mut self.solver {
            Solver::None => Err(Error::NotInitialized),
            Solver::Midpoint(midpoint) => grid_step(midpoint.as_mut(), &self.system, &mut self.state, step, end),
            Solver::GeneralizedAlpha(alpha) => grid_step(alpha.as_mut(), &self.system, &mut self.state, step, end),
            Solver::Statics(statics) => grid_step(statics.as_mut(), &self.system, &mut self.state, step, end),
        }
    }
}

impl Solver {
    fn new(document: &Document, system: &System) -> Result<Self, Error> {
        let simulation = &document.simulation;
        let tolerance = document.value(simulation.tolerance);
        Ok(match (simulation.analysis, simulation.integrator) {
            (Analysis::Static, _) => Self::Statics(Box::new(Statics::new(system, tolerance)?)),
            (Analysis::Dynamic, Choice::Conserving) => {
                Self::Midpoint(Box::new(Midpoint::new(system, AxialRule::Conserving, tolerance)?))
            }
            (Analysis::Dynamic, Choice::Variational) => {
                Self::Midpoint(Box::new(Midpoint::new(system, AxialRule::Variational, tolerance)?))
            }
            (Analysis::Dynamic, Choice::GeneralizedAlpha { spectral_radius }) => {
                let spectral_radius = document.value(spectral_radius);
                Self::GeneralizedAlpha(Box::new(GeneralizedAlpha::new(system, spectral_radius, tolerance)?))
            }
        })
    }
}

pub(super) fn failure(error: &Error) -> Failure {
    Failure { message: error.to_string(), category: category(error) }
}

fn category(error: &Error) -> LogCategory {
    match error {
        Error::Singular { .. } => LogCategory::SingularLinearSystems,
        Error::NotConverged { .. } => LogCategory::NonlinearSystems,
        Error::StepTooSmall { reason, .. } | Error::RampStuck { reason, .. } => category(reason),
        _ => LogCategory::StatusError,
    }
}

/// A name-based hash of the file, of its overrides and of the variable table: what a host's XML and the model must agree on.
fn guid(text: &str, overrides: &[(String, String)], table: &Table) -> String {
    let mut content = format!("ancf14 {}\n{text}\n", env!("CARGO_PKG_VERSION"));
    for (key, value) in overrides {
        content.push_str(&format!("{key}={value}\n"));
    }
    for variable in &table.variables {
        content.push_str(&format!("{variable:?}\n"));
    }
    format!("{{{}}}", uuid::Uuid::new_v5(&uuid::Uuid::NAMESPACE_URL, content.as_bytes()))
}
