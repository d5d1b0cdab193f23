//! All outputs over time, for the charts of the page.

use super::block::{Effort, doubles};
use ancf14::error::decimal;
use ancf14::fmi::Model;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::model::variables::is_of_account;
use ancf14::model::view::Recording;
use serde::Serialize;

/// The outputs so far.
#[derive(Debug)]
pub struct Charts {
    columns: Vec<Column>,
    times: Vec<f64>,
}

#[derive(Debug)]
struct Column {
    reference: usize,
    name: String,
    unit: String,
    values: Vec<f64>,
}

/// What the page has of them.
#[derive(Debug, Serialize)]
pub struct Charted {
    /// Number of instants.
    count: usize,
    times: String,
    columns: Vec<ChartedColumn>,
    /// Columns that belong into one chart.
    groups: Vec<Group>,
}

#[derive(Debug, Serialize)]
struct ChartedColumn {
    name: String,
    unit: String,
    data: String,
}

#[derive(Debug, Serialize)]
struct Group {
    name: String,
    unit: String,
    columns: Vec<usize>,
}

impl Charts {
    /// No instant yet.
    pub fn new(variables: &[Variable]) -> Self {
        let outputs = variables.iter().enumerate().filter(|(_, variable)| variable.causality == Causality::Output);
        let column = |(reference, variable): (usize, &Variable)| Column {
            reference,
            name: variable.name.clone(),
            unit: variable.quantity.unit.clone(),
            values: Vec::new(),
        };
        Self { columns: outputs.map(column).collect(), times: Vec::new() }
    }

    /// Number of columns.
    pub fn width(&self) -> usize {
        self.columns.len()
    }

    /// Number of instants.
    pub fn count(&self) -> usize {
        self.times.len()
    }

    /// Adds the instant that the model has reached.
    pub fn record(&mut self, model: &impl Model) {
        self.times.push(decimal(model.time()));
        for column in &mut self.columns {
            column.values.push(model.value(column.reference).number());
        }
    }

    /// As the page has them: zeros instead of values that are the round-off of what `recording` has seen.
    pub fn charted(&self, recording: &Recording, effort: Effort) -> Charted {
        let mut groups: Vec<Group> = Vec::new();
        for (place, column) in self.columns.iter().enumerate() {
            let name = group(&column.name);
            match groups.iter_mut().find(|group| group.name == name) {
                Some(group) => group.columns.push(place),
                None => groups.push(Group { name, unit: column.unit.clone(), columns: vec![place] }),
            }
        }
        let values: Vec<_> = self.columns.iter().map(|own| (&*own.name, &*own.unit, &*own.values)).collect();
        let data = |values: &[f64], is_zero: bool| match is_zero {
            true => doubles(&vec![0.0; values.len()], effort),
            false => doubles(values, effort),
        };
        let column = |(column, is_zero): (&Column, bool)| ChartedColumn {
            name: column.name.clone(),
            unit: column.unit.clone(),
            data: data(&column.values, is_zero),
        };
        let columns = self.columns.iter().zip(recording.are_zero(&values)).map(column).collect();
        Charted { count: self.times.len(), times: doubles(&self.times, effort), columns, groups }
    }
}

/// The chart that a column belongs into: components of a quantity are together, of a whole beam the stations of one
/// component; so are all energies, and all counts.
fn group(name: &str) -> String {
    let (quantity, index) = name.split_once('[').unwrap_or((name, ""));
    match (quantity.split_once('.'), index.trim_end_matches(']').split_once(',')) {
        (Some((kind @ ("energy" | "statistics"), _)), _) => kind.to_owned(),
        (Some((kind @ "work", _)), _) if is_of_account(quantity) => kind.to_owned(),
        (_, Some((_, component))) => format!("{quantity}.{component}"),
        _ => quantity.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Components of a point are together, of a beam the stations of each component.
    #[test]
    fn columns_that_belong_together_share_a_chart() {
        let groups =
            ["tip.position[1]", "line.position[3,2]", "line.twist[3]", "energy.total", "work.drift", "hinge.angle"]
                .map(group);
        assert_eq!(groups, ["tip.position", "line.position.2", "line.twist", "energy", "work", "hinge.angle"]);
    }
}
