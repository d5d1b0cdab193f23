//! The comparison run beside a motion that tells its mesh error: the same model with half the elements, or with twice
//! as many where no beam can do with fewer.
//!
//! With elements `r` times as long, errors of order `p` are `r^p` times as large: the difference of both runs is `|r^p
//! - 1|` times the error of the first one.
//!
//! The library has no threads: the caller says where the comparison run takes place.

use super::Simulation;
use crate::fmi::{Failure, Model};
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::accuracy::{Columns, Differences};
use crate::model::run::levels::{self, OtherMesh, Override};
use crate::solve::step::course::Course;
use std::fmt::Debug;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The comparison run ends early when it has tried so many times the steps of the other one, and so many more.
const MOST_STEPS_TIMES: u64 = 2;
const MOST_STEPS_MORE: u64 = 1000;

/// A run that follows another one row by row: a [`Companion`], here or on another thread.
pub trait Beside: Debug + Send + Sync {
    /// Advances to a row of the other run. Rows come in their order, the start first.
    fn go_on(&mut self, row: Row);

    /// Returns how far both runs are apart.
    ///
    /// # Errors
    /// The comparison run has not reached the end.
    fn finish(self: Box<Self>) -> Result<Differences, Lost>;
}

/// Why a comparison run has not reached the end.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Lost {
    /// Its motion cannot be computed, or takes too many steps.
    Motion(String),
    /// It never ran, or is of another model.
    Start(String),
    /// It was halted: nobody waits for its result.
    Halted,
}

/// Halts a comparison run within its next step, from any thread.
#[derive(Clone, Debug, Default)]
pub struct Halt(Arc<AtomicBool>);

impl Halt {
    /// Halts the run that has this.
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Decides where a companion runs: `|companion| Box::new(companion)` lets it run within each step of the other one.
pub type Placement = fn(Companion) -> Box<dyn Beside>;

/// A row of the run that is compared.
#[derive(Clone, Debug)]
pub struct Row {
    /// Time of the row, s.
    time: f64,
    /// Values and derivatives of the inputs until then.
    inputs: [Vec<f64>; 2],
    results: Vec<f64>,
    /// Steps so far, rejected ones too.
    steps: u64,
}

/// The comparison run.
#[derive(Debug)]
pub struct Companion {
    document: Arc<Document>,
    /// The overrides that `document` was read with, and those of the other mesh.
    overrides: [Vec<Override>; 2],
    columns: Arc<Columns>,
    /// The steps of the other run, where those are given: steps of its own would be off by their own error.
    course: Option<Course>,
    /// None until the first row: building takes time, which another thread may spend.
    simulation: Option<Box<Simulation>>,
    found: Result<Differences, Lost>,
    /// The halt of whoever asked for the run, and that of the placement.
    halts: [Halt; 2],
}

impl Companion {
    /// Creates the comparison run of `simulation`, and returns it with its mesh; none if a beam has no other mesh.
    pub(super) fn new(simulation: &Simulation, halt: Halt) -> Option<(Self, OtherMesh)> {
        let mesh = match simulation.document.simulation.analysis {
            Analysis::Dynamic => OtherMesh::beside(&simulation.document)?,
            Analysis::Static => OtherMesh::finer(&simulation.document)?,
        };
        let companion = Self {
            document: Arc::clone(&simulation.document),
            overrides: [simulation.overrides.clone(), mesh.overrides.clone()],
            columns: Arc::clone(&simulation.columns),
            course: simulation.runner.course.clone(),
            simulation: None,
            found: Ok(Differences::default()),
            halts: [halt, Halt::default()],
        };
        Some((companion, mesh))
    }

    /// What halts this run, for the placement: a run that is dropped needs it no more.
    pub fn halt(&self) -> Halt {
        self.halts[1].clone()
    }

    /// # Errors
    /// The run was halted.
    fn go_on_if_wanted(&self) -> Result<(), Lost> {
        if self.halts.iter().any(Halt::is_set) { Err(Lost::Halted) } else { Ok(()) }
    }

    fn build(&self) -> Result<Simulation, Lost> {
        let [own, changes] = self.overrides.clone();
        let document = levels::changed(&self.document, &own, changes);
        let document =
            document.ok_or_else(|| Lost::Start(String::from("the file makes no model with so few elements")))?;
        let mut simulation = Simulation::of(document, own).map_err(|failure| Lost::Start(failure.message))?;
        simulation.runner.course.clone_from(&self.course);
        Ok(simulation)
    }

    fn compare(&mut self, row: &Row, differences: &mut Differences) -> Result<(), Lost> {
        self.go_on_if_wanted()?;
        let mut simulation = match self.simulation.take() {
            Some(simulation) => simulation,
            None => Box::new(self.build()?),
        };
        let Row { time, inputs: [values, slopes], results, steps } = row;
        if !simulation.inputs.set_parts([values, slopes]) || simulation.results.len() != results.len() {
            return Err(Lost::Start(String::from("its model has other variables")));
        }
        let motion = |failure: Failure| Lost::Motion(failure.message);
        if simulation.runner.is_initialized() {
            simulation.begin(*time).map_err(motion)?;
            while !simulation.part().map_err(motion)? {
                self.go_on_if_wanted()?;
                if simulation.tried_steps() > MOST_STEPS_TIMES * steps + MOST_STEPS_MORE {
                    let reason = format!("it needed more than {MOST_STEPS_TIMES} times the steps by t = {time} s");
                    return Err(Lost::Motion(reason));
                }
            }
        } else {
            simulation.initialize(*time).map_err(motion)?;
        }
        simulation.warnings.clear();
        differences.include(&self.columns, results, &simulation.results);
        self.simulation = Some(simulation);
        Ok(())
    }
}

impl Beside for Companion {
    fn go_on(&mut self, row: Row) {
        if let Ok(mut differences) = self.found.as_mut().map(std::mem::take) {
            self.found = self.compare(&row, &mut differences).map(|()| differences);
        }
    }

    fn finish(self: Box<Self>) -> Result<Differences, Lost> {
        self.found
    }
}

impl Simulation {
    /// Hands the row that is reached over to the companion, if there is one.
    pub(super) fn hand_over(&mut self, inputs: [Vec<f64>; 2]) {
        let (time, steps) = (self.runner.state.time, self.tried_steps());
        if let Some((companion, _)) = &mut self.companion {
            companion.go_on(Row { time, inputs, results: self.results.clone(), steps });
        }
    }

    /// Counts the steps so far, rejected ones too.
    pub(super) fn tried_steps(&self) -> u64 {
        let statistics = &self.runner.state.statistics;
        statistics.steps.saturating_add(statistics.rejected)
    }
}
