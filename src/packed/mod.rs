//! The model of an unpacked FMU, whatever its kind: a mechanism, or a linear system.
//!
//! The resources tell which: a linear system has a file of its own. The functions of FMI stand on this type.

use crate::fmi::continuous::Continuous;
use crate::fmi::location::{LINEAR_FILE, MODEL_FILE};
use crate::fmi::variable::Variable;
use crate::fmi::{About, Failure, Model, Value};
use crate::linear;
use crate::model::simulation::{self, Simulation};
use std::path::Path;

/// A model of either kind.
#[derive(Debug)]
pub enum Packed {
    /// A mechanism.
    Mechanism(Box<Simulation>),
    /// A linear system.
    Linear(Box<linear::Unit>),
}

/// The state of a model of either kind between two calls.
#[derive(Clone, Debug)]
pub enum Snapshot {
    /// The state of a mechanism.
    Mechanism(Box<simulation::Snapshot>),
    /// The state of a linear system.
    Linear(Box<linear::State>),
}

impl Packed {
    /// The name of the file in the resources that a model is read from, where `has` tells which files are there.
    pub fn file(has: impl Fn(&str) -> bool) -> &'static str {
        if has(LINEAR_FILE) { LINEAR_FILE } else { MODEL_FILE }
    }

    /// Reads the model from a file of the `resources`: its path and its text.
    ///
    /// # Errors
    /// Everything that is wrong with the file.
    pub fn load(resources: &Path, path: &Path, text: &str) -> Result<Self, Failure> {
        let name = path.display().to_string();
        match path.ends_with(LINEAR_FILE) {
            true => Self::linear(&name, text),
            false => Self::mechanism(resources, &name, text),
        }
    }

    // Not inlined: each has the stack of its own kind only.

    #[inline(never)]
    fn mechanism(resources: &Path, name: &str, text: &str) -> Result<Self, Failure> {
        Ok(Self::Mechanism(Box::new(Simulation::load_packed(resources, name, text)?)))
    }

    /// Reads a linear system.
    ///
    /// # Errors
    /// The file is wrong.
    #[inline(never)]
    pub fn linear(name: &str, text: &str) -> Result<Self, Failure> {
        Ok(Self::Linear(Box::new(linear::Unit::load(name, text)?)))
    }
}

/// Asks a model of either kind.
macro_rules! ask {
    ($packed:expr, $model:ident => $answer:expr) => {
        match $packed {
            Packed::Mechanism($model) => $answer,
            Packed::Linear($model) => $answer,
        }
    };
}

impl Model for Packed {
    type Snapshot = Snapshot;

    fn about(&self) -> &About {
        ask!(self, model => model.about())
    }

    fn variables(&self) -> &[Variable] {
        ask!(self, model => model.variables())
    }

    fn value(&self, reference: usize) -> Value {
        ask!(self, model => model.value(reference))
    }

    fn set_value(&mut self, reference: usize, value: Value) -> Result<(), Failure> {
        ask!(self, model => model.set_value(reference, value))
    }

    fn set_tolerance(&mut self, tolerance: f64) -> Option<f64> {
        ask!(self, model => model.set_tolerance(tolerance))
    }

    fn set_input_derivative(&mut self, reference: usize, derivative: f64) {
        ask!(self, model => model.set_input_derivative(reference, derivative));
    }

    fn check(&self) -> Result<(), Failure> {
        ask!(self, model => model.check())
    }

    fn initialize(&mut self, start: f64) -> Result<(), Failure> {
        ask!(self, model => model.initialize(start))
    }

    fn time(&self) -> f64 {
        ask!(self, model => model.time())
    }

    fn shortest_step(&self) -> f64 {
        ask!(self, model => model.shortest_step())
    }

    fn accept_step(&self, end: f64) -> Result<(), Failure> {
        ask!(self, model => model.accept_step(end))
    }

    fn advance(&mut self, end: f64) -> Result<(), Failure> {
        ask!(self, model => model.advance(end))
    }

    fn begin_step(&mut self, end: f64) -> Result<(), Failure> {
        ask!(self, model => model.begin_step(end))
    }

    fn take_part(&mut self) -> Result<bool, Failure> {
        ask!(self, model => model.take_part())
    }

    fn look_between(&mut self) -> Result<(), Failure> {
        ask!(self, model => model.look_between())
    }

    fn end_step(&mut self) -> Result<(), Failure> {
        ask!(self, model => model.end_step())
    }

    fn output_derivative(&mut self, reference: usize) -> Result<f64, Failure> {
        ask!(self, model => model.output_derivative(reference))
    }

    fn partial_derivative(&mut self, output: usize, input: usize) -> Result<f64, Failure> {
        ask!(self, model => Model::partial_derivative(&mut **model, output, input))
    }

    fn initial_derivative(&mut self, unknown: usize, known: usize) -> Result<f64, Failure> {
        ask!(self, model => model.initial_derivative(unknown, known))
    }

    fn continuous(&mut self) -> Option<&mut dyn Continuous> {
        ask!(self, model => model.continuous())
    }

    fn conclude(&mut self) {
        ask!(self, model => model.conclude());
    }

    fn take_warnings(&mut self) -> Vec<String> {
        ask!(self, model => model.take_warnings())
    }

    fn reset(&mut self) {
        ask!(self, model => model.reset());
    }

    fn snapshot(&self) -> Snapshot {
        match self {
            Self::Mechanism(model) => Snapshot::Mechanism(Box::new(model.snapshot())),
            Self::Linear(model) => Snapshot::Linear(Box::new(model.snapshot())),
        }
    }

    fn restore(&mut self, snapshot: &Snapshot) {
        match (self, snapshot) {
            (Self::Mechanism(model), Snapshot::Mechanism(snapshot)) => model.restore(snapshot),
            (Self::Linear(model), Snapshot::Linear(snapshot)) => model.restore(snapshot),
            _ => unreachable!("a snapshot goes back to the model with its GUID"),
        }
    }

    fn write(&self, snapshot: &Snapshot, bytes: Vec<u8>) -> Vec<u8> {
        // A host may have the states of one unit written by another one.
        match snapshot {
            Snapshot::Mechanism(snapshot) => snapshot.write(bytes),
            Snapshot::Linear(snapshot) => snapshot.write(bytes),
        }
    }

    fn read(&self, bytes: &[u8]) -> Result<Snapshot, Failure> {
        Ok(match self {
            Self::Mechanism(model) => Snapshot::Mechanism(Box::new(model.read(bytes)?)),
            Self::Linear(model) => Snapshot::Linear(Box::new(model.read(bytes)?)),
        })
    }
}
