//! What a verification has found: a row a column, and what to change.

use super::estimate::{Estimate, Parts, Trust};
use super::remedy::{Demand, Setting, cheapest};
use super::scale;
use super::{Column, State, Verification};
use crate::fmi::Model;
use crate::model::file::document::Document;
use crate::model::run::levels::{self, Level};
use crate::model::run::scale::Measures;
use crate::model::run::simulation::Simulation;
use crate::model::variables::is_of_account;

/// The error of a column.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Name of the column.
    pub name: String,
    /// Unit label; empty: dimensionless.
    pub unit: String,
    /// What it is compared with, in its unit; 0: it is zero by symmetry.
    pub scale: f64,
    /// Its error.
    pub estimate: Estimate,
    /// Whether it is one of the file's own outputs: energies and momenta are there anyway.
    pub is_asked_for: bool,
    /// What would reach the wanted accuracy; none: no setting that could be named. Empty: it is reached.
    pub remedy: Option<Vec<String>>,
}

impl Row {
    /// The error over the scale.
    pub fn relative(&self) -> f64 {
        if self.estimate.trust == Trust::RoundOff { 0.0 } else { self.estimate.error() / self.scale }
    }
}

/// All that was found.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The accuracy wanted, relative.
    pub wanted: f64,
    /// A row a column, in the order of the results.
    pub rows: Vec<Row>,
    /// What would bring all columns that count to the wanted accuracy, but for those that have no remedy of their own;
    /// none: no setting that could be named. Empty: nothing is to be done.
    pub remedy: Option<Vec<String>>,
    /// Runs that failed, with the reason: those that estimates need.
    pub failures: Vec<(Level, String)>,
}

impl Report {
    /// A part of an error that the run `level` tells; none where it failed before it told anything.
    pub fn part(&self, level: Level, value: f64) -> Option<f64> {
        let is_untold = value == 0.0 && self.failures.iter().any(|(failed, _)| *failed == level);
        (!is_untold).then_some(value)
    }

    /// The columns that count: those asked for, or all where the file has no outputs.
    pub fn counted(&self) -> impl Iterator<Item = &Row> {
        let any = self.rows.iter().any(|row| row.is_asked_for);
        self.rows.iter().filter(move |row| row.is_asked_for || !any)
    }
}

impl Verification {
    /// What the rows so far have told of `simulation`, the first run; `wanted` is the accuracy, relative.
    pub fn report(&self, simulation: &Simulation, wanted: f64) -> Report {
        let document = simulation.document();
        let columns = self.columns.iter().map(|column| (column.name.as_str(), column.unit.as_str(), &column.tally));
        let columns: Vec<_> = columns.collect();
        let own = simulation.measures();
        let measures = Measures {
            duration: simulation.about().stop,
            energy: scale::energy(&columns).unwrap_or(own.energy),
            ..own
        };
        let scales = scale::scales(&columns, &measures);
        let mut demands = Vec::new();
        let mut rows = Vec::new();
        for (Column { name, unit, tally, .. }, scale) in self.columns.iter().zip(scales) {
            let estimate = Estimate::of(name, tally, scale);
            let is_real = estimate.trust != Trust::RoundOff;
            let demand = Demand { parts: Parts::of(name, tally, scale), allowed: wanted * scale };
            let demand = (is_real && estimate.error() > demand.allowed).then_some(demand);
            let is_always_there = matches!(name.split('.').next(), Some("energy" | "momentum"));
            let is_asked_for = !is_always_there && !is_of_account(name);
            rows.push(Row {
                name: name.clone(),
                unit: unit.clone(),
                scale,
                estimate,
                is_asked_for,
                remedy: settings(document, demand.as_slice()),
            });
            demands.push(demand);
        }
        let any = rows.iter().any(|row| row.is_asked_for);
        let demands = rows.iter().zip(demands).filter(|(row, _)| row.remedy.is_some() && (row.is_asked_for || !any));
        let demands: Vec<Demand> = demands.filter_map(|(_, demand)| demand).collect();
        let failures = self.runs.iter().filter_map(|run| match &run.state {
            State::Failed(reason) if !run.level.is_coarse() => Some((run.level, reason.clone())),
            State::Failed(_) | State::Going { .. } => None,
        });
        Report { wanted, rows, remedy: settings(document, &demands), failures: failures.collect() }
    }
}

/// The keys and values that meet all demands.
fn settings(document: &Document, demands: &[Demand]) -> Option<Vec<String>> {
    let Setting { steps, elements, quadratic } = cheapest(demands)?;
    let mut list = Vec::new();
    if steps > 1 {
        let steps = levels::steps(document, 1.0 / f64::from(steps)).into_iter();
        list.extend(steps.map(|(key, value)| format!("{key} = {value}")));
    }
    if elements > 1 {
        let count = |beam| levels::elements(document, beam) * elements as usize;
        list.extend(document.beams.iter().map(|beam| format!("{}.elements = {}", beam.name, count(beam))));
    }
    if quadratic {
        let beams = document.beams.iter().filter(|beam| levels::has_linear_twist(beam));
        list.extend(beams.map(|beam| format!("{}.twist = \"quadratic\"", beam.name)));
    }
    Some(list)
}
