//! `check`: a model is without mistakes if it can be loaded and brought to its initial state; its variables as an
//! aligned table.

use super::picture::Target;
use super::{Stop, complain, progress, say, start, voice};
use ancf14::fmi::Model;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::model::derived::{Derived, derived_numbers};
use ancf14::model::drawing::Drawing;
use ancf14::model::simulation::Simulation;
use ancf14::model::step_length;
use ancf14_report::numbers::shortest;
use serde_json::{Value, json};

/// Columns of the table.
const TITLES: [&str; 7] = ["ref", "name", "causality", "variability", "start", "unit", "description"];

/// Draws the mechanism if asked to, looks for all that `run` refuses at its start, and lists the variables.
pub fn check(mut simulation: Simulation, name: &str, picture: Option<Target<'_>>) -> Result<(), Stop> {
    // A picture helps to find the mistake in a mechanism that cannot start.
    let about = simulation.about();
    let drawn = picture.map(|picture| picture.draw(&Drawing::new(simulation.document()), &about.name)).transpose()?;
    progress::last_row(&simulation)?;
    start(&mut simulation)?;
    if let Some(note) = step_length::long_step(&simulation) {
        complain(&format!("warning: {note}"));
    }
    if voice::is_json() {
        voice::deliver(document(&simulation));
        return Ok(());
    }
    say(&aligned(&rows(&simulation)))?;
    for Derived { key, value, unit } in derived_numbers(&simulation) {
        say(&format!("{key} = {} {unit}, which the file leaves to the program", shortest(value)))?;
    }
    let count =
        |wanted: Causality| simulation.variables().iter().filter(|variable| variable.causality == wanted).count();
    say(&format!(
        "{name}: no mistakes; {} parameters, {} inputs, {} outputs",
        count(Causality::Parameter) + count(Causality::CalculatedParameter),
        count(Causality::Input),
        count(Causality::Output)
    ))?;
    drawn.map_or(Ok(()), |drawn| say(&drawn))
}

/// Prints the text of a model without copies and includes. Overrides that are not in it would be lost.
pub fn resolved(text: &str, remaining: &[(String, String)]) -> Result<(), Stop> {
    match remaining.first() {
        None => voice::print(text.trim_end()),
        Some((key, _)) => Err(Stop::Bad(format!(
            "error: --resolved prints what the file says, so that --set {key} would be lost; leave it out here, and give it when you run \
             the printed file"
        ))),
    }
}

/// The model and its variables for programs: numbers that are not finite are null.
fn document(simulation: &Simulation) -> Value {
    let about = simulation.about();
    let variable = |(reference, variable): (usize, &Variable)| {
        let has_start = !matches!(variable.causality, Causality::Output | Causality::Independent);
        let start = match variable.start {
            ancf14::fmi::Value::Real(value) => json!(value),
            ancf14::fmi::Value::Integer(value) => json!(value),
        };
        json!({
            "reference": reference,
            "name": variable.name,
            "causality": causality(variable.causality),
            "variability": variable.variability.word(),
            "start": if has_start { start } else { Value::Null },
            "unit": variable.quantity.unit,
            "description": variable.description,
        })
    };
    json!({
        "model": about.name,
        "description": about.description,
        "stop": about.stop,
        "output_step": about.output_step,
        "derived": derived_numbers(simulation)
            .into_iter()
            .map(|Derived { key, value, unit }| json!({ "key": key, "value": value, "unit": unit }))
            .collect::<Vec<_>>(),
        "variables": simulation.variables().iter().enumerate().map(variable).collect::<Vec<_>>(),
    })
}

fn rows(simulation: &Simulation) -> Vec<[String; 7]> {
    let mut rows = vec![TITLES.map(str::to_owned)];
    for (reference, variable) in simulation.variables().iter().enumerate() {
        let has_start = !matches!(variable.causality, Causality::Output | Causality::Independent);
        let start = match (has_start, variable.start) {
            (false, _) => String::new(),
            (true, ancf14::fmi::Value::Real(value)) => shortest(value),
            (true, ancf14::fmi::Value::Integer(value)) => format!("{value}"),
        };
        rows.push([
            reference.to_string(),
            variable.name.clone(),
            causality(variable.causality).to_owned(),
            variable.variability.word().to_owned(),
            start,
            variable.quantity.unit.clone(),
            variable.description.clone(),
        ]);
    }
    rows
}

fn causality(causality: Causality) -> &'static str {
    match causality {
        Causality::Parameter => "parameter",
        Causality::CalculatedParameter => "calculated",
        Causality::Input => "input",
        Causality::Output => "output",
        Causality::Local => "local",
        Causality::Independent => "independent",
    }
}

/// Columns as wide as their widest cell.
pub fn aligned<const N: usize>(rows: &[[String; N]]) -> String {
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: [usize; N] = std::array::from_fn(width);
    let mut text = String::new();
    for row in rows {
        let cells: Vec<_> = row.iter().zip(widths).map(|(cell, width)| format!("{cell:<width$}")).collect();
        text.push_str(cells.join("  ").trim_end());
        text.push('\n');
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every cell of a column begins at the same place.
    #[test]
    fn columns_are_aligned() {
        let row = |name: &str, unit: &str| ["0", name, "output", "fixed", "1", unit, "text"].map(str::to_owned);
        let text = aligned(&[row("a", "kg/m3"), row("longer.name[1]", "m")]);
        let starts: Vec<_> = text.lines().map(|line| line.find("text")).collect();
        assert!(starts.len() == 2 && starts[0].is_some() && starts[0] == starts[1], "{text}");
    }
}
