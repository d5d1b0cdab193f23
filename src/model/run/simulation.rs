//! A mechanism that runs: an [`fmi::Model`](crate::fmi::Model), and what `ancf14 run` drives too.

mod amplitude;
mod at_instant;
pub mod campbell;
mod companion;
mod conclusion;
pub mod critical;
mod derivatives;
mod first_state;
mod given;
mod guid;
mod guided;
mod kept;
pub mod linear;
mod loading;
mod look;
mod mesh_error;
mod plan;
pub mod pole_check;
pub mod reduced;
mod repeat;
mod runner;
mod saved;
mod solver;
mod start;
mod start_derivatives;
pub mod steady;
mod stepping;

pub use companion::{Beside, Companion, Halt, Lost, Placement, Row};
pub use first_state::{FirstState, ReadState};
pub use kept::{Beginning, Kept};
pub use saved::Snapshot;

use self::derivatives::{Derived, LastStep};
use self::guid::guid;
use self::mesh_error::Peak;
use self::runner::Runner;
use self::start::NoStart;
use self::stepping::UnderWay;
use super::accuracy::{Accuracy, Columns, Inexact, Looker};
use super::between::Between;
use super::levels::{OtherMesh, Override};
use super::ranges::Ranges;
use super::scale::Measures;
use super::watch::Watch;
use crate::error::Error;
use crate::fmi::variable::{Variability, Variable};
use crate::fmi::{About, Failure, LogCategory, Model, Value};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::builder;
use crate::model::file::document::Document;
use crate::model::file::entries::frame::FrameSpec;
use crate::model::file::entries::simulation::{Analysis, COARSEST_ACCURACY, FINEST_ACCURACY, IntegratorSpec};
use crate::model::text::diagnostic::Diagnostics;
use crate::model::variables::inputs::Inputs;
use crate::model::variables::{Moment, Source, Table};
use std::sync::Arc;

/// The parameter that a host's tolerance stands for.
const ACCURACY: &str = "simulation.accuracy";

/// A model file, its system and its state.
#[derive(Debug)]
pub struct Simulation {
    about: About,
    table: Arc<Table>,
    document: Arc<Document>,
    runner: Runner,
    results: Vec<f64>,
    /// Looks at the results between rows; none: nobody asks for them.
    between: Option<Box<Between>>,
    /// For results, where the solver has no spare memory for them.
    frames: FrameCache,
    warnings: Vec<String>,
    watch: Watch,
    columns: Arc<Columns>,
    accuracy: Accuracy,
    looker: Looker,
    /// The overrides that the file was read with.
    overrides: Vec<Override>,
    /// The equilibrium of the most strain energy so far.
    peak: Option<Peak>,
    /// Where the run that tells the mesh error of motions takes place, and what halts it; none: it is not asked for.
    placement: Option<(Placement, Halt)>,
    /// That run, with its mesh.
    companion: Option<(Box<dyn Beside>, OtherMesh)>,
    /// The state that the file begins with; none: it begins as drawn, or at an equilibrium.
    first_state: Option<Arc<FirstState>>,
    /// How far results are off because of the mesh, a family each, as found at the end; empty: not known.
    mesh_errors: Vec<Inexact>,
    /// See [`Self::mesh_distances`].
    mesh_distances: Option<(f64, Vec<Inexact>)>,
    /// The families of results whose errors are warned of; none: all.
    judged: Option<Vec<String>>,
    /// It is compared with another run, which tells its errors better than the estimates of one run.
    is_compared: bool,
    /// The mesh error of a run with this mesh, and its warning: a repetition with finer steps has the same.
    mesh_known: (Vec<Inexact>, Option<String>),
    /// The run with half the elements that finds the equilibria.
    guide: Option<Box<Self>>,
    /// It is such a run: what it is watched for, the finer one tells.
    leads: bool,
    inputs: Inputs,
    last: LastStep,
    /// A communication step that is taken part by part.
    under_way: Option<UnderWay>,
    derived: Derived,
    warned_of_quaternion: bool,
    /// The variables that cannot begin otherwise, as the log has been told.
    told_fixed: Vec<usize>,
}

impl Simulation {
    /// Builds a model file that was read with `overrides`.
    fn of(document: Document, overrides: Vec<Override>) -> Result<Self, Failure> {
        let built = builder::build(&document, 0.0).map_err(|mistakes| mistaken(&mistakes))?;
        let mut table = Table::new(&document);
        table.scale(&built.system);
        let about = About {
            name: document.model.name.clone(),
            identifier: document.model.identifier.clone(),
            description: document.model.description.clone(),
            guid: guid(document.text(), &document.remaining(&overrides), &table),
            start: 0.0,
            stop: document.value(document.simulation.stop),
            credits: document.model.credits.clone(),
            output_step: document.output_step(),
            tolerance: document.asked_accuracy(),
        };
        let document = Arc::new(document);
        let mut simulation = Self {
            about,
            columns: Arc::new(Columns::new(&table, document.simulation.analysis == Analysis::Static)),
            accuracy: Accuracy::default(),
            looker: Looker::default(),
            overrides,
            peak: None,
            placement: None,
            companion: None,
            first_state: None,
            mesh_errors: Vec::new(),
            mesh_distances: None,
            judged: None,
            is_compared: false,
            mesh_known: (Vec::new(), None),
            guide: None,
            leads: false,
            table: Arc::new(table),
            runner: Runner::new(built, &document, 0.0),
            inputs: Inputs::new(&document),
            document,
            results: Vec::new(),
            between: None,
            frames: FrameCache::default(),
            warnings: Vec::new(),
            watch: Watch::default(),
            last: LastStep::default(),
            under_way: None,
            derived: Derived::default(),
            warned_of_quaternion: false,
            told_fixed: Vec::new(),
        };
        simulation.read_results().map_err(|error| failure(&error))?;
        Ok(simulation)
    }

    /// The file that is simulated.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The system.
    pub fn system(&self) -> &System {
        &self.runner.system
    }

    /// The state it has reached.
    pub fn state(&self) -> &State {
        &self.runner.state
    }

    /// Multipliers of the joints' conditions, N or N m, where they are those of the very instant: always of equilibria
    /// and of generalized-alpha, otherwise where an output asks for what follows from them.
    pub fn multipliers(&self) -> Option<&[f64]> {
        let simulation = &self.document.simulation;
        let is_at_instant = simulation.analysis == Analysis::Static
            || matches!(simulation.integrator, IntegratorSpec::GeneralizedAlpha { .. })
            || self.table.needs_response();
        is_at_instant.then_some(&self.runner.response.multipliers)
    }

    /// The ranges over time that outputs ask for, without a row yet.
    pub fn ranges(&self) -> Ranges {
        Ranges::new(&self.document, &self.runner.system, &self.table)
    }

    /// What units amount to in the run so far; energies count where they are not among the results, too.
    pub fn measures(&self) -> Measures {
        let Runner { system, state, start, .. } = &self.runner;
        Measures {
            size: system.size,
            duration: state.time - start,
            energy: self.accuracy.energy(&self.columns),
            gravity: system.gravity.norm(),
            beams: self.watch.beams(),
        }
    }

    /// Sets parameter `index` of the file, and what follows from it; one that is tunable at once in a system that runs.
    fn set_parameter(&mut self, index: usize, value: Value, variability: Variability) -> Result<(), Failure> {
        let before = self.document.parameter_value(index);
        let runs = variability == Variability::Tunable && self.runner.is_initialized();
        let stepped = (runs && self.last.known && !self.runner.stale).then(|| self.document.settings());
        let document = Arc::make_mut(&mut self.document);
        document.set_parameter(index, value).map_err(wrong)?;
        if runs {
            // Nothing later checks what follows from a tunable parameter. Its old value was legal.
            if document.feeds_others(index)
                && let Err(objection) = document.check()
            {
                document.set_parameter(index, before).map_err(wrong)?;
                return Err(wrong(objection));
            }
            if let Some(settings) = stepped {
                self.last.settings = settings;
            }
            self.runner.stale = true;
            // They are of other parameters.
            self.peak = None;
            self.lose_companion("a parameter was set");
            self.derived.forget_rates();
        }
        Ok(())
    }

    /// Warns, once, of a quaternion of 0 for the end of a step from `begin` to `end`, s.
    fn warn_of_quaternions(&mut self, span: [f64; 2]) {
        if self.warned_of_quaternion {
            return;
        }
        let mut undirected = builder::undirected(&self.document, |number| self.inputs.line(number), span);
        if let Some((FrameSpec { name, .. }, _)) = undirected.next() {
            self.warnings.push(format!(
                "the quaternion of frame {name} is 0, which is no orientation: the frame keeps the one it has; set \
                 {name}.quaternion[1] to 1 for no rotation, or take input = \"rotation\" for the frame, whose inputs may all be 0"
            ));
            self.warned_of_quaternion = true;
        }
    }

    /// Begins a run with `runner`, which has found the state at its start; the one before stays where its results are
    /// not finite.
    fn begin_with(&mut self, runner: Runner) -> Result<(), Failure> {
        let before = std::mem::replace(&mut self.runner, runner);
        self.frames = FrameCache::default();
        self.between.iter_mut().for_each(|between| **between = Between::default());
        self.forget_step();
        self.watch = Watch::new(&self.document);
        if self.is_compared && self.mesh_known.0.is_empty() {
            self.watch.trust_mesh();
        }
        self.accuracy = Accuracy::default();
        self.forget_mesh_errors();
        self.measure().inspect_err(|_| self.runner = before)
    }

    /// There is no last step any more that derivatives could be of, and none under way.
    fn forget_step(&mut self) {
        self.under_way = None;
        self.last.known = false;
        self.last.settings.clear();
        self.derived = Derived::default();
    }

    /// Reads all results off the state that the system has reached, and looks whether they are odd.
    fn measure(&mut self) -> Result<(), Failure> {
        self.read_results().map_err(|error| failure(&error))?;
        self.note_results();
        if let Some(number) = self.results.iter().position(|result| !result.is_finite()) {
            return Err(wrong(self.not_finite(number)));
        }
        let Runner { system, state, solver, .. } = &mut self.runner;
        let frames = solver.spare().map_or(&mut self.frames, |spare| spare.frames);
        let odd = self.watch.look(system, state, &self.table, &self.results, frames);
        self.warnings.extend(odd.into_iter().filter(|_| !self.leads));
        self.accuracy.include(&self.columns, &self.results);
        self.keep_peak();
        if self.accuracy.is_due(self.runner.state.statistics.steps) {
            self.look();
            self.ease();
        }
        self.correct();
        Ok(())
    }

    /// Reads all results off the state that the system has reached, as users get them.
    fn tell_results(&mut self) -> Result<(), Error> {
        self.read_results()?;
        self.correct();
        Ok(())
    }

    /// What is wrong with result `number`.
    fn not_finite(&self, number: usize) -> String {
        let name = self.table.result_name(number);
        let (value, time) = (self.results[number], self.runner.state.time);
        format!(
            "{name} is {value} at t = {time} s: a parameter or an input is far too large or too small for this mechanism; set \
             a reasonable value"
        )
    }

    /// Reads all results off the state that the system has reached, as computed.
    fn read_results(&mut self) -> Result<(), Error> {
        let runner = &mut self.runner;
        runner.respond()?;
        let Runner { system, state, response, solver, .. } = runner;
        let frames = solver.spare().map_or(&mut self.frames, |spare| spare.frames);
        self.table.measure(&Moment { system, state, response, fibers: &[] }, frames, &mut self.results);
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
            Source::Input(place) => Value::Real(self.inputs.value(place)),
            Source::Result(number) => match self.table.variables[reference].start {
                Value::Real(_) => Value::Real(self.results[number]),
                // A count that outgrows FMI's Integer stays at the largest one.
                Value::Integer(_) => Value::Integer(self.results[number] as i32),
            },
        }
    }

    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure> {
        let variable = &self.table.variables[reference];
        match (self.table.sources[reference], value) {
            (Source::Result(_), _) => Err(wrong(format!("`{}` is a result and cannot be set", variable.name))),
            (Source::Input(_), Value::Integer(_)) => {
                Err(wrong(format!("`{}` is a Real, not an Integer", variable.name)))
            }
            (Source::Input(place), Value::Real(number)) => {
                if !self.inputs.set(place, number) {
                    self.document.accept(self.inputs.number(place), number).map_err(wrong)?;
                }
                Ok(())
            }
            (Source::Parameter(index), _) => self.set_parameter(index, value, variable.variability),
        }
    }

    fn set_tolerance(&mut self, tolerance: f64) -> Option<f64> {
        let place = self.table.variables.iter().position(|variable| variable.name == ACCURACY)?;
        let accuracy = tolerance.clamp(FINEST_ACCURACY, COARSEST_ACCURACY);
        self.set_value(place, Value::Real(accuracy)).ok().map(|()| accuracy)
    }

    fn set_input_derivative(&mut self, reference: usize, derivative: f64) {
        if let Source::Input(place) = self.table.sources[reference] {
            self.inputs.set_slope(place, derivative);
        }
    }

    fn check(&self) -> Result<(), Failure> {
        self.document.check().map_err(wrong)?;
        builder::check(&self.document).map_err(|mistakes| wrong(mistakes.to_string()))
    }

    fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        self.find_start(start).map_err(NoStart::into_failure)
    }

    fn time(&self) -> f64 {
        self.runner.state.time
    }

    fn shortest_step(&self) -> f64 {
        self.runner.shortest_step()
    }

    fn accept_step(&self, end: f64) -> Result<(), Failure> {
        let begin = self.runner.state.time;
        self.runner.plan(begin, end).map(|_| ()).map_err(|error| failure(&error))
    }

    fn advance(&mut self, end: f64) -> Result<(), Failure> {
        self.advance_at_once(end)
    }

    fn begin_step(&mut self, end: f64) -> Result<(), Failure> {
        self.begin(end)
    }

    fn take_part(&mut self) -> Result<bool, Failure> {
        self.part()
    }

    fn look_between(&mut self) -> Result<(), Failure> {
        self.tell_results().map_err(|error| failure(&error))
    }

    fn end_step(&mut self) -> Result<(), Failure> {
        self.end_early()
    }

    fn conclude(&mut self) {
        self.end_run();
    }

    fn take_warnings(&mut self) -> Vec<String> {
        std::mem::take(&mut self.warnings)
    }

    fn reset(&mut self) {
        Arc::make_mut(&mut self.document).reset();
        // The file was built with these very numbers when it was loaded.
        if let Ok(built) = builder::build(&self.document, 0.0) {
            self.runner = Runner::new(built, &self.document, 0.0);
        }
        self.warnings.clear();
        self.warned_of_quaternion = false;
        self.told_fixed.clear();
        self.inputs = Inputs::new(&self.document);
        self.forget_step();
        self.forget_mesh_errors();
        // Nothing is solved for before the initialization, so that nothing can fail.
        let _ = self.read_results();
    }

    fn output_derivative(&mut self, reference: usize) -> Result<f64, Failure> {
        match self.table.sources[reference] {
            Source::Result(result) => Ok(self.rate(result)),
            _ => Err(wrong(format!("`{}` is no result", self.table.variables[reference].name))),
        }
    }

    fn partial_derivative(&mut self, output: usize, input: usize) -> Result<f64, Failure> {
        match (self.table.sources[output], self.table.sources[input]) {
            (Source::Result(result), Source::Input(place)) => Simulation::partial_derivative(self, result, place),
            _ => Err(wrong(String::from("only results have derivatives, and only by inputs"))),
        }
    }

    fn initial_derivative(&mut self, unknown: usize, known: usize) -> Result<f64, Failure> {
        self.start_derivative(unknown, known)
    }

    fn snapshot(&self) -> Snapshot {
        self.save()
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        self.go_back_to(snapshot);
    }

    fn write(&self, snapshot: &Snapshot, bytes: Vec<u8>) -> Vec<u8> {
        snapshot.write(bytes)
    }

    fn read(&self, bytes: &[u8]) -> Result<Snapshot, Failure> {
        Snapshot::read(&self.document, self.results.len(), bytes).map_err(wrong)
    }
}

fn wrong(message: String) -> Failure {
    Failure { message, category: LogCategory::StatusError, line: None }
}

fn mistaken(mistakes: &Diagnostics) -> Failure {
    Failure { line: mistakes.line(), ..wrong(mistakes.to_string()) }
}

pub(in crate::model) fn failure(error: &Error) -> Failure {
    Failure { message: error.to_string(), category: category(error), line: None }
}

fn category(error: &Error) -> LogCategory {
    match error {
        Error::Singular { .. } => LogCategory::SingularLinearSystems,
        Error::NotConverged { .. } => LogCategory::NonlinearSystems,
        Error::StepTooSmall { reason, .. } | Error::RampStuck { reason, .. } => category(reason),
        _ => LogCategory::StatusError,
    }
}
