//! `run --inputs FILE.csv`: inputs of the model as a host would set them, from a table with a column `time` and one for
//! each input.
//!
//! Between two rows an input changes linearly; before the first row and after the last one it is held. Two rows at one
//! time are a jump. Communication steps end at the rows, so that what acts in a step is a straight line.

use super::Stop;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{Failure, Model, Value};
use ancf14::model::file;
use ancf14::model::names::suggestion;
use ancf14::model::simulation::Simulation;
use ancf14::model::text::csv::{Cell, Csv, Mistake};
use ancf14::model::text::diagnostic::{Diagnostic, Diagnostics, Place, Source};
use std::ops::Range;
use std::path::Path;

/// The name of the first column.
const TIME: &str = "time";

/// The inputs of a run.
#[derive(Debug)]
pub struct Inputs {
    /// The value reference of each column.
    references: Vec<usize>,
    /// The times of the rows, ascending; twice where the inputs jump, s.
    times: Vec<f64>,
    /// The values, row by row.
    values: Vec<f64>,
}

impl Inputs {
    /// Reads a file of inputs of `simulation`.
    pub fn read(path: &Path, simulation: &mut Simulation) -> Result<Self, Stop> {
        let text = file::text(path).map_err(|reason| Stop::Bad(format!("error: {reason}")))?;
        Self::of(&text, simulation).map_err(|Mistake { message, label, help, range }| {
            let source = Source::new(&path.display().to_string(), &text, &[]);
            let mistake = Diagnostic::new(&source, Place::file(range), &message, &label, help);
            Stop::Mistaken(Diagnostics(vec![mistake]))
        })
    }

    fn of(text: &str, simulation: &mut Simulation) -> Result<Self, Mistake> {
        let csv = Csv::read(text)?;
        let first = &csv.header[0];
        if first.name() != TIME {
            let message = format!("the first column is `{}`", first.text);
            let help = "the first line names the columns, as in: time,tip.force[3]";
            return Err(mistake(&message, "`time` was expected", help, &first.range));
        }
        let references = references(&csv.header, simulation)?;
        let mut inputs = Self { references, times: Vec::new(), values: Vec::new() };
        for row in csv.rows() {
            let (time, place) = &row[0];
            inputs.add_time(*time, place)?;
            for ((value, place), reference) in row[1..].iter().zip(&inputs.references) {
                // The model knows what is allowed.
                if let Err(Failure { message, .. }) = simulation.set_value(*reference, Value::Real(*value)) {
                    return Err(mistake(&message, "", "", place));
                }
                inputs.values.push(*value);
            }
        }
        match inputs.times.is_empty() {
            true => {
                Err(mistake("the table has no rows", "", "a row has a time and a value for each input", &first.range))
            }
            false => Ok(inputs),
        }
    }

    fn add_time(&mut self, time: f64, place: &Range<usize>) -> Result<(), Mistake> {
        let count = self.times.len();
        if let Some(before) = self.times.last().filter(|before| **before > time) {
            let label = format!("{time} comes after {before}");
            return Err(mistake("the times do not ascend", &label, "", place));
        }
        if count > 1 && self.times[count - 2] == time {
            let message = format!("three rows are at t = {time} s");
            return Err(mistake(&message, "two rows at one time are a jump", "leave out the one in the middle", place));
        }
        self.times.push(time);
        Ok(())
    }

    /// Sets the inputs to where they are at `time`, s, and how fast they change behind it.
    pub fn start(&self, simulation: &mut Simulation, time: f64) -> Result<(), Failure> {
        let next = self.times.iter().copied().find(|row| *row > time).unwrap_or(f64::INFINITY);
        self.aim(simulation, time, next)
    }

    /// Advances to `end`, s.
    pub fn advance(&self, simulation: &mut Simulation, end: f64) -> Result<(), Failure> {
        loop {
            let begin = simulation.time();
            let margin = simulation.shortest_step();
            let first = self.times.partition_point(|time| *time <= begin + margin);
            let row = self.times.get(first).copied().filter(|time| *time < end - margin);
            self.aim(simulation, begin, row.unwrap_or(end))?;
            simulation.advance(row.unwrap_or(end))?;
            if row.is_none() {
                return Ok(());
            }
        }
    }

    /// Sets the inputs for a step from `begin` to `end`, s.
    fn aim(&self, simulation: &mut Simulation, begin: f64, end: f64) -> Result<(), Failure> {
        // Of a jump the later row at the beginning, the earlier one at the end.
        let before = self.times.partition_point(|time| *time <= begin);
        let after = self.times.partition_point(|time| *time < end);
        for (column, reference) in self.references.iter().enumerate() {
            let (from, to) = (self.between(before, column, begin), self.between(after, column, end));
            let slope = (to - from) / (end - begin);
            simulation.set_value(*reference, Value::Real(from))?;
            simulation.set_input_derivative(*reference, if slope.is_finite() { slope } else { 0.0 });
        }
        Ok(())
    }

    /// The value of a column at `time`, s, on the line between row `next` and the one before it.
    fn between(&self, next: usize, column: usize, time: f64) -> f64 {
        let value = |row: usize| self.values[row * self.references.len() + column];
        let last = self.times.len() - 1;
        match next {
            0 => value(0),
            next if next > last => value(last),
            next => {
                let (from, to) = (self.times[next - 1], self.times[next]);
                let share = (time - from) / (to - from);
                value(next - 1) * (1.0 - share) + value(next) * share
            }
        }
    }
}

fn mistake(message: &str, label: &str, help: &'static str, range: &Range<usize>) -> Mistake {
    Mistake { message: message.to_owned(), label: label.to_owned(), help, range: range.clone() }
}

/// The value references of the columns behind the first one.
fn references(header: &[Cell<'_>], simulation: &Simulation) -> Result<Vec<usize>, Mistake> {
    let known: Vec<(usize, &str)> = simulation
        .variables()
        .iter()
        .enumerate()
        .filter(|(_, row)| row.causality == Causality::Input)
        .map(|(reference, row)| (reference, row.name.as_str()))
        .collect();
    let mut references = Vec::new();
    for cell in &header[1..] {
        let find = |name: &str| known.iter().find(|(_, known)| *known == name).map(|(reference, _)| *reference);
        let Some(reference) = find(cell.text).or_else(|| find(cell.name())) else {
            let names = || known.iter().map(|(_, name)| *name);
            let near = suggestion(cell.text, names());
            let label = match near.is_empty() {
                true if known.is_empty() => String::from("the model has none: see input = true"),
                true => format!("its inputs: {}", names().collect::<Vec<_>>().join(", ")),
                false => near,
            };
            let message = format!("the model has no input `{}`", cell.text);
            return Err(mistake(&message, &label, "`ancf14 check` lists the inputs", &cell.range));
        };
        if references.contains(&reference) {
            return Err(mistake(
                &format!("the column `{}` is there twice", cell.text),
                "the second one",
                "",
                &cell.range,
            ));
        }
        references.push(reference);
    }
    match references.is_empty() {
        true => Err(mistake("the table has no inputs", "columns behind this one were expected", "", &header[0].range)),
        false => Ok(references),
    }
}
