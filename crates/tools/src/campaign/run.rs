//! One run of a model file: rows of results, warnings, and how it ended. Nothing that happens in it ends the campaign.

use super::machine::{Machine, Setting};
use ancf14::fmi::Model;
use ancf14::fmi::variable::Causality;
use ancf14::model::effort;
use ancf14::model::simulation::Simulation;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A run is given up when it has tried so many times the steps that its setting asks for, and so many more. Halving by
/// ten would be a thousand times.
const MOST_STEPS_TIMES: f64 = 20.0;
const MOST_STEPS_MORE: f64 = 5_000.0;

/// A column of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name: `tip.displacement[1]`.
    pub name: String,
    /// Its unit.
    pub unit: String,
}

/// What a run has left behind.
#[derive(Clone, Debug)]
pub struct Record {
    /// What its rows hold.
    pub columns: Vec<Column>,
    /// Rows, each with its number in the table of the machine: row 0 is the start.
    pub rows: Vec<(usize, Vec<f64>)>,
    /// What it was warned of, in order.
    pub warnings: Vec<String>,
    /// How it ended.
    pub end: End,
    /// Largest extent of the machine, m.
    pub size: f64,
    /// Time from its start to its end, s.
    pub duration: f64,
}

/// How a run ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum End {
    /// At the stop time.
    Complete,
    /// With an error, in words.
    Refused(String),
    /// It would have gone on for ever, or nearly so.
    Endless,
    /// A panic, which is always a defect.
    Panicked(String),
}

impl Record {
    /// Runs `text`, which `machine` gives for `setting`.
    pub fn new(machine: &Machine, setting: Setting, text: &str) -> Self {
        let duration = machine.stop() - machine.start;
        let empty = Self {
            columns: Vec::new(),
            rows: Vec::new(),
            warnings: Vec::new(),
            end: End::Complete,
            size: 0.0,
            duration,
        };
        let mut record = empty.clone();
        let outcome = catch_unwind(AssertUnwindSafe(|| record.fill(machine, setting, text)));
        match outcome {
            Ok(end) => Self { end, ..record },
            Err(payload) => {
                let words = payload.downcast_ref::<String>().map(String::as_str);
                let words = words.or(payload.downcast_ref::<&str>().copied()).unwrap_or("without a message");
                Self { end: End::Panicked(words.to_owned()), ..empty }
            }
        }
    }

    fn fill(&mut self, machine: &Machine, setting: Setting, text: &str) -> End {
        let mut simulation = match Simulation::load("machine.toml", text, &[]) {
            Ok(simulation) => simulation,
            Err(failure) => return End::Refused(failure.message),
        };
        let outputs: Vec<usize> = outputs(&simulation).collect();
        let column = |reference: &usize| {
            let variable = &simulation.variables()[*reference];
            Column { name: variable.name.clone(), unit: variable.quantity.unit.clone() }
        };
        self.columns = outputs.iter().map(column).collect();
        // References are runs with finer meshes themselves.
        if !matches!(setting, Setting::Finer(_)) {
            simulation.ask_for_mesh_error(|companion| Box::new(companion));
        }
        let begun = simulation.initialize(machine.start);
        self.warnings.extend(simulation.take_warnings());
        if let Err(failure) = begun {
            return End::Refused(failure.message);
        }
        self.size = simulation.system().size;
        let end = self.march(machine, setting, &mut simulation, &outputs);
        simulation.conclude();
        self.warnings.extend(simulation.take_warnings());
        let reached = simulation.time() - machine.start;
        let rows = self.rows.len() as u64;
        self.warnings.extend(effort::rejections(simulation.document(), &simulation.state().statistics, reached, rows));
        end
    }

    fn march(&mut self, machine: &Machine, setting: Setting, simulation: &mut Simulation, outputs: &[usize]) -> End {
        let (interval, apart) = (machine.output_step(), setting.rows_apart(machine));
        let last = (self.duration / interval - 1e-9).ceil().max(1.0) as usize;
        let steps = self.duration / setting.step(machine).min(interval);
        let most = MOST_STEPS_MORE + MOST_STEPS_TIMES * steps;
        let row = |simulation: &Simulation| outputs.iter().map(|place| simulation.value(*place).number()).collect();
        self.rows.push((0, row(simulation)));
        for number in (0..last).step_by(apart).skip(1).chain([last]) {
            let time = if number == last { machine.stop() } else { machine.start + number as f64 * interval };
            let advanced = simulation.advance(time);
            self.warnings.extend(simulation.take_warnings());
            if let Err(failure) = advanced {
                return End::Refused(failure.message);
            }
            self.rows.push((number, row(simulation)));
            let statistics = &simulation.state().statistics;
            if (statistics.steps + statistics.rejected) as f64 > most {
                return End::Endless;
            }
        }
        End::Complete
    }

    /// The row of this number in the machine's table.
    pub fn row(&self, number: usize) -> Option<&[f64]> {
        let place = self.rows.binary_search_by_key(&number, |(own, _)| *own).ok()?;
        Some(&self.rows[place].1)
    }
}

/// The results of a model that are Reals.
fn outputs(simulation: &Simulation) -> impl Iterator<Item = usize> {
    let rows = simulation.variables().iter().enumerate();
    rows.filter(|(_, row)| row.causality == Causality::Output && row.type_name() == "Real").map(|(place, _)| place)
}

#[cfg(test)]
impl Record {
    /// A complete run of a machine of 2 m and 1 s, for tests: names and units of its columns, and its rows.
    pub fn sample(columns: &[(&str, &str)], rows: impl IntoIterator<Item = Vec<f64>>) -> Self {
        let column = |(name, unit): &(&str, &str)| Column { name: (*name).to_owned(), unit: (*unit).to_owned() };
        Self {
            columns: columns.iter().map(column).collect(),
            rows: rows.into_iter().enumerate().collect(),
            warnings: Vec::new(),
            end: End::Complete,
            size: 2.0,
            duration: 1.0,
        }
    }
}
