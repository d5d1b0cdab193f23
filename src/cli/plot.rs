//! Plots of results: one SVG per quantity of an output, its components as lines, and one of the energies.

use super::chart::{Chart, Line, Stroke};
use super::results::Results;
use std::error::Error;
use std::path::Path;

/// The lines of one plot.
#[derive(Debug, PartialEq)]
struct Group {
    /// `tip.displacement`, `energy`.
    name: String,
    unit: String,
    /// Places of the columns.
    columns: Vec<usize>,
}

/// Draws all plots into `directory`; gives their number.
pub fn plots(results: &Results, directory: &Path) -> Result<usize, Box<dyn Error>> {
    if results.rows.len() < 2 {
        return Ok(0);
    }
    let groups = groups(results.columns.iter().map(|column| (column.name.as_str(), column.unit.as_str())));
    for group in &groups {
        draw(results, group, &directory.join(format!("{}.svg", group.name)))?;
    }
    Ok(groups.len())
}

/// Components belong together, and so do the energies; momenta and counts are in the table only.
fn groups<'a>(columns: impl Iterator<Item = (&'a str, &'a str)>) -> Vec<Group> {
    let mut groups: Vec<Group> = Vec::new();
    for (place, (name, unit)) in columns.enumerate() {
        let quantity = name.split('[').next().unwrap_or(name);
        let name = match quantity.split_once('.') {
            Some(("momentum" | "statistics", _)) => continue,
            Some(("energy", _)) => "energy",
            _ => quantity,
        };
        match groups.iter_mut().find(|group| group.name == name) {
            Some(group) => group.columns.push(place),
            None => groups.push(Group { name: name.to_owned(), unit: unit.to_owned(), columns: vec![place] }),
        }
    }
    groups
}

fn draw(results: &Results, group: &Group, path: &Path) -> Result<(), Box<dyn Error>> {
    let unit = if group.unit.is_empty() { "1" } else { &group.unit };
    let quantity = group.name.rsplit('.').next().unwrap_or(&group.name).replace('_', " ");
    let line = |(colour, column): (usize, &usize)| {
        let name = &results.columns[*column].name;
        let label = name
            .strip_prefix(&group.name)
            .filter(|rest| rest.starts_with('.'))
            .map_or_else(|| name.split_once('.').map_or(name.as_str(), |(_, rest)| rest), |rest| &rest[1..]);
        let points = results.times.iter().zip(&results.rows).map(|(time, row)| (*time, row[*column])).collect();
        Line { name: label.to_owned(), stroke: Stroke::Solid, colour, points }
    };
    let chart = Chart {
        title: group.name.clone(),
        axes: [String::from("time (s)"), format!("{quantity} ({unit})")],
        shape: false,
        lines: group.columns.iter().enumerate().map(line).collect(),
    };
    chart.draw(path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn components_and_energies_belong_together() {
        let columns = [
            ("tip.position[1]", "m"),
            ("tip.position[2]", "m"),
            ("tip.twist", "rad"),
            ("energy.kinetic", "J"),
            ("energy.total", "J"),
            ("momentum.linear[1]", "N.s"),
            ("statistics.steps", ""),
        ];
        let groups = groups(columns.into_iter());
        let found: Vec<_> = groups.iter().map(|group| (group.name.as_str(), group.columns.as_slice())).collect();
        assert_eq!(found, [("tip.position", &[0, 1][..]), ("tip.twist", &[2]), ("energy", &[3, 4])]);
    }
}
