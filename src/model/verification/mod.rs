//! How far a run is from what shorter steps and finer meshes would give.
//!
//! The same file runs again on a few [`levels`], row by row beside the rows of the first run, so that nothing is kept
//! but the largest differences of each column ([`tally`]). They make an [`estimate`] of its error, compared with a
//! [`scale`], and a [`remedy`].

pub mod estimate;
pub mod remedy;
mod report;
pub mod scale;
pub mod tally;

pub use report::{Report, Row};

use self::tally::{Sample, Tally};
use super::file::document::Document;
use super::file::quantity::Quantity;
use super::run::levels::{self, Level, Override};
use super::run::scale::compare_turns;
use super::run::simulation::Simulation;
use crate::fmi::variable::{Causality, Variable};
use crate::fmi::{Failure, Model};

/// The runs beside the first one, and what they have told so far.
#[derive(Debug)]
pub struct Verification {
    runs: Vec<Run>,
    columns: Vec<Column>,
    /// Places of the first components of rotation vectors.
    rotations: Vec<usize>,
    /// Nothing has a finer twist: the mesh of the first run is the one with quadratic twist.
    is_quadratic: bool,
}

/// A column of the results that is a physical quantity.
#[derive(Clone, Debug)]
struct Column {
    name: String,
    unit: String,
    /// Place among the columns of the results.
    place: usize,
    tally: Tally,
}

/// A run beside the first one.
#[derive(Debug)]
struct Run {
    level: Level,
    stride: u64,
    state: State,
    /// The row that `values` are of.
    row: Option<u64>,
    values: Vec<f64>,
}

#[derive(Debug)]
enum State {
    Going {
        simulation: Box<Simulation>,
        /// Places of the columns in the variable table.
        references: Vec<usize>,
    },
    Failed(String),
}

impl Verification {
    /// Prepares the runs beside that of `simulation`, which was made of the same file name, text and overrides. Those
    /// that cannot be built are reported as failed.
    pub fn new(simulation: &Simulation, file_name: &str, text: &str, overrides: &[Override]) -> Self {
        let document = simulation.document();
        let run = |level: Level| {
            let overrides = levels::merged(overrides, level.overrides(document)?);
            let state = match Simulation::load(file_name, text, &overrides) {
                Ok(other) => State::Going { references: outputs(other.variables()), simulation: Box::new(other) },
                Err(failure) => State::Failed(reason(&failure)),
            };
            Some(Run { level, stride: level.stride(document), state, row: None, values: Vec::new() })
        };
        let variables = simulation.variables();
        let columns = outputs(variables).into_iter().enumerate().filter_map(|(place, reference)| {
            let variable = &variables[reference];
            let is_count = variable.name.starts_with("statistics.");
            let (name, unit) = (variable.name.clone(), variable.quantity.unit.clone());
            (!is_count).then_some(Column { name, unit, place, tally: Tally::default() })
        });
        let columns: Vec<Column> = columns.collect();
        let is_rotation =
            |column: &&Column| column.name.split(['.', '[']).nth(1) == Some(Quantity::Rotation.row().word);
        Self {
            rotations: columns.iter().filter(is_rotation).step_by(3).map(|column| column.place).collect(),
            runs: Level::ALL.into_iter().filter_map(run).collect(),
            columns,
            is_quadratic: is_quadratic(document),
        }
    }

    /// How many runs there are beside the first one.
    pub fn runs(&self) -> usize {
        self.runs.len()
    }

    /// Compares row `row` of the first run, with all its columns, at `time`, s. Rows come in their order; row 0 is the
    /// start.
    pub fn compare(&mut self, row: u64, time: f64, own: &[f64]) {
        self.runs.iter_mut().for_each(|run| run.go_to(row, time, own, &self.rotations));
        let values = Level::ALL.map(|level| {
            let run = self.runs.iter().find(|run| run.level == level);
            run.filter(|run| run.row == Some(row)).map(|run| run.values.as_slice())
        });
        for Column { place, tally, .. } in &mut self.columns {
            let own = own[*place];
            let [half_step, double_step, quadratic, double_elements, half_elements] =
                values.map(|values| values.map(|values| values[*place]));
            let quadratic = if self.is_quadratic { Some(own) } else { quadratic };
            tally.add(time, Sample { own, half_step, double_step, quadratic, double_elements, half_elements });
        }
    }
}

impl Run {
    /// Advances to a row, unless it has none there or has failed; `own` is that of the first run.
    fn go_to(&mut self, row: u64, time: f64, own: &[f64], rotations: &[usize]) {
        let State::Going { simulation, references } = &mut self.state else { return };
        if !row.is_multiple_of(self.stride) {
            return;
        }
        let outcome = if row == 0 { simulation.initialize(time) } else { simulation.advance(time) };
        // The first run has told them, or will not be followed there.
        simulation.take_warnings();
        match outcome {
            Ok(()) => {
                self.row = Some(row);
                self.values.clear();
                self.values.extend(references.iter().map(|reference| simulation.value(*reference).number()));
                compare_turns(rotations, own, &mut self.values);
            }
            Err(failure) => self.state = State::Failed(reason(&failure)),
        }
    }
}

/// Places of the results in a variable table, in the order of their columns.
fn outputs(variables: &[Variable]) -> Vec<usize> {
    let places = variables.iter().enumerate();
    places.filter(|(_, variable)| variable.causality == Causality::Output).map(|(place, _)| place).collect()
}

/// Whether no beam has a finer twist than it uses.
fn is_quadratic(document: &Document) -> bool {
    !document.beams.iter().any(levels::has_linear_twist)
}

/// The first line of a message: what follows it quotes the file.
fn reason(failure: &Failure) -> String {
    let line = failure.message.lines().next().unwrap_or("");
    line.strip_prefix("error: ").unwrap_or(line).to_owned()
}
