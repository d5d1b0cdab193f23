//! The run beside a motion that tells its mesh error: the same model with half the elements, or with twice as many where no beam can do with fewer.
//!
//! With elements `r` times as long, errors of order `p` are `r^p` times as large: the difference of both runs is `|r^p - 1|` times the error of the first one. A run with half the
//! elements may take steps twice as long as well, where the solver chooses them: the error of these steps is divided likewise.
//!
//! The library has no threads: the caller says where this run takes place.

use super::Simulation;
use crate::fmi::{Failure, Model};
use crate::model::file::document::Document;
use crate::model::run::accuracy::{Columns, Differences};
use crate::model::run::levels::{self, OtherMesh, Override};
use std::fmt::Debug;
use std::sync::Arc;

/// The run is given up when it has tried so many times the steps of the other one, and so many more.
const MOST_STEPS_TIMES: u64 = 2;
const MOST_STEPS_MORE: u64 = 1000;

/// A run that follows another one row by row: a [`Companion`], here or on another thread.
pub trait Beside: Debug + Send + Sync {
    /// Goes on to a row of the other run. Rows come in their order, the start first.
    fn go_on(&mut self, row: Row);

    /// How far both runs are apart.
    ///
    /// # Errors
    /// Why this one has not come to the end.
    fn finish(self: Box<Self>) -> Result<Differences, String>;
}

/// Where a companion runs: `|run| Box::new(run)` is within each step of the other one.
pub type Placement = fn(Companion) -> Box<dyn Beside>;

/// A row of the run that is compared.
#[derive(Clone, Debug)]
pub struct Row {
    /// s.
    time: f64,
    /// Values and derivatives of the inputs until then.
    inputs: [Vec<f64>; 2],
    results: Vec<f64>,
    /// Steps so far, rejected ones too.
    steps: u64,
}

/// The run with the other mesh.
#[derive(Debug)]
pub struct Companion {
    document: Arc<Document>,
    /// The overrides that `document` was read with, and those of the other mesh.
    overrides: [Vec<Override>; 2],
    columns: Arc<Columns>,
    /// None until the first row: building takes time, which may be spent elsewhere.
    simulation: Option<Box<Simulation>>,
    found: Result<Differences, String>,
}

impl Companion {
    /// For `simulation`, with its mesh; none where a beam has no other mesh.
    pub(super) fn new(simulation: &Simulation) -> Option<(Self, OtherMesh)> {
        let mesh = OtherMesh::beside(&simulation.document)?;
        let companion = Self {
            document: Arc::clone(&simulation.document),
            overrides: [simulation.overrides.clone(), mesh.overrides.clone()],
            columns: Arc::clone(&simulation.columns),
            simulation: None,
            found: Ok(Differences::default()),
        };
        Some((companion, mesh))
    }

    fn build(&self) -> Result<Simulation, String> {
        let [own, changes] = self.overrides.clone();
        let document = levels::changed(&self.document, &own, changes).ok_or("its model file cannot be read")?;
        Simulation::of(document, own).map_err(words)
    }

    fn compare(&mut self, row: &Row, differences: &mut Differences) -> Result<(), String> {
        let mut simulation = match self.simulation.take() {
            Some(simulation) => simulation,
            None => Box::new(self.build()?),
        };
        let Row { time, inputs: [values, slopes], results, steps } = row;
        if !simulation.inputs.set_parts([values, slopes]) || simulation.results.len() != results.len() {
            return Err(String::from("its model has other variables"));
        }
        match simulation.runner.is_initialized() {
            true => simulation.advance(*time),
            false => simulation.initialize(*time),
        }
        .map_err(words)?;
        simulation.warnings.clear();
        differences.include(&self.columns, results, &simulation.results);
        if simulation.tried_steps() > MOST_STEPS_TIMES * steps + MOST_STEPS_MORE {
            return Err(format!("it needed more than {MOST_STEPS_TIMES} times the steps by t = {time} s"));
        }
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

    fn finish(self: Box<Self>) -> Result<Differences, String> {
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

    /// Steps so far, rejected ones too.
    fn tried_steps(&self) -> u64 {
        let statistics = &self.runner.state.statistics;
        statistics.steps.saturating_add(statistics.rejected)
    }
}

fn words(failure: Failure) -> String {
    failure.message
}
