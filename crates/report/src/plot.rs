//! Plots of results: one SVG per quantity of an output, its components as lines over time; of a quantity at the
//! stations of a beam the shape at some instants; and one of the energies.

use crate::chart::{Chart, Layout, Line, Stroke};
use crate::column::Name;
use crate::draw::Projection;
use crate::results::{Column, Results};
use ancf14::model::document::Document;
use ancf14::model::entries::output::Target;
use ancf14::model::variables::is_of_account;
use std::error::Error;

/// The lines of one plot.
#[derive(Clone, Debug, PartialEq)]
pub struct Plot {
    /// `tip.displacement`, `energy`, `shape.displacement.2`.
    name: String,
    unit: String,
    kind: Kind,
    /// Places of the columns; of a beam station by station.
    columns: Vec<usize>,
}

/// What a plot shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Columns over time.
    Time,
    /// Columns over the arc length of a path.
    ArcLength,
    /// The parameter of a path over columns: a bifurcation diagram.
    Path,
    /// One component over the length of a beam, at some instants.
    Length,
    /// The positions of a beam, as the drawing of the mechanism shows them, at some instants.
    Shape,
}

impl Plot {
    /// All plots of these columns. Components belong together, and so do the energies; momenta and counts are in the
    /// table only.
    pub fn all(columns: &[Column], document: &Document) -> Vec<Self> {
        let is_beam = |name: &str| {
            document.outputs.iter().any(|output| output.name == name && matches!(output.target, Target::On { .. }))
        };
        let rows = if document.follows_arc_length() { Kind::ArcLength } else { Kind::Time };
        let mut plots: Vec<Self> = Vec::new();
        for (place, column) in columns.iter().enumerate() {
            let Name { quantity, component, .. } = Name::of(&column.name);
            let (kind, name) = match quantity.split_once('.') {
                Some(("momentum" | "statistics", _)) => continue,
                Some(("energy", _)) => (rows, "energy".to_owned()),
                Some(("path", _)) => (rows, quantity.to_owned()),
                Some(("work", _)) if is_of_account(quantity) => (Kind::Time, "work".to_owned()),
                Some((output, "position")) if is_beam(output) => (Kind::Shape, quantity.to_owned()),
                Some((output, _)) if is_beam(output) => {
                    let part = if component.is_empty() { String::new() } else { format!(".{component}") };
                    (Kind::Length, format!("{quantity}{part}"))
                }
                _ if rows == Kind::ArcLength => (Kind::Path, quantity.to_owned()),
                _ => (rows, quantity.to_owned()),
            };
            match plots.iter_mut().find(|plot| plot.name == name) {
                Some(plot) => plot.columns.push(place),
                None => plots.push(Self { name, unit: column.unit.clone(), kind, columns: vec![place] }),
            }
        }
        plots
    }

    /// The name of its file.
    pub fn file(&self) -> String {
        format!("{}.svg", self.name)
    }

    /// The picture; `remark` stands behind the title.
    ///
    /// # Errors
    /// It cannot be drawn.
    pub fn svg(&self, results: &Results, remark: &str) -> Result<String, Box<dyn Error>> {
        self.chart(results, remark).svg()
    }

    fn chart(&self, results: &Results, remark: &str) -> Chart {
        let value = value_axis(&self.name, &self.unit);
        let axes = match self.kind {
            Kind::Time => [String::from("time (s)"), value],
            Kind::ArcLength => [String::from("arc length"), value],
            Kind::Path => [value, String::from("t, dots: unstable")],
            Kind::Length => [String::from("fraction of the length, from start to end"), value],
            Kind::Shape => ["x, y obliquely (m)", "z, y obliquely (m)"].map(str::to_owned),
        };
        let lines = match self.kind {
            Kind::Time | Kind::ArcLength => self.curves(results),
            Kind::Path => self.branches(results),
            Kind::Length | Kind::Shape => self.snapshots(results),
        };
        let layout = match self.kind {
            Kind::Time | Kind::ArcLength => Layout::Panels,
            Kind::Path | Kind::Length => Layout::Single,
            Kind::Shape => Layout::Shape,
        };
        Chart { title: format!("{}{remark}", self.name), axes, layout, lines }
    }

    /// Whether what it shows is zero but for round-off: its noise is not a curve.
    fn is_zero(&self, results: &Results) -> bool {
        // `shape.velocity.2` is a component of `shape.velocity`.
        let quantity = self.name.trim_end_matches(|letter: char| letter == '.' || letter.is_ascii_digit());
        results.zeros.iter().any(|zero| zero == quantity)
    }

    fn curves(&self, results: &Results) -> Vec<Line> {
        let line = |(color, column): (usize, &usize)| {
            let Column { name, trace, .. } = &results.columns[*column];
            // A component, an energy, or a quantity without components.
            let label = match Name::of(name) {
                own if !own.component.is_empty() => own.axis(),
                _ => name.split_once('.').map_or(name.as_str(), |(_, rest)| rest),
            };
            let mut points = trace.points();
            if self.is_zero(results) {
                points.iter_mut().for_each(|point| point.1 = 0.0);
            }
            Line { name: label.to_owned(), stroke: Stroke::Solid, color, points }
        };
        self.columns.iter().enumerate().map(line).collect()
    }

    /// The parameter of the path over each column, in stretches of stable and unstable equilibria.
    fn branches(&self, results: &Results) -> Vec<Line> {
        let trace = |name: &str| {
            let column = results.columns.iter().find(|column| column.name == name);
            column.map_or(Vec::new(), |column| column.trace.points())
        };
        let (parameter, unstable) = (trace("path.parameter"), trace("path.unstable_motions"));
        let mut lines: Vec<Line> = Vec::new();
        for (color, curve) in self.curves(results).into_iter().enumerate() {
            let mut name = curve.name;
            let mut last: Option<(f64, f64)> = None;
            for (length, value) in curve.points {
                let stroke = if at(&unstable, length) >= 0.5 { Stroke::Dots } else { Stroke::Solid };
                let point = (value, at(&parameter, length));
                match lines.last_mut().filter(|line| line.color == color && line.stroke == stroke) {
                    Some(line) => line.points.push(point),
                    None => {
                        let points = last.into_iter().chain([point]).collect();
                        lines.push(Line { name: std::mem::take(&mut name), stroke, color, points });
                    }
                }
                last = Some(point);
            }
        }
        lines
    }

    fn snapshots(&self, results: &Results) -> Vec<Line> {
        let line = |(color, (time, row)): (usize, &(f64, Vec<f64>))| {
            let values: Vec<f64> = self.columns.iter().map(|column| row[*column]).collect();
            let last = (values.len() - 1).max(1) as f64;
            let points = match self.kind {
                Kind::Shape => values
                    .as_chunks()
                    .0
                    .iter()
                    .map(|place: &[f64; 3]| Projection::Oblique.flat(*place).into())
                    .collect(),
                Kind::Time | Kind::ArcLength | Kind::Path | Kind::Length => {
                    let shown = |value: f64| if self.is_zero(results) { 0.0 } else { value };
                    values.iter().enumerate().map(|(k, value)| (k as f64 / last, shown(*value))).collect()
                }
            };
            // Instants of equal steps have tails: six digits tell them apart.
            let time: f64 = format!("{time:.5e}").parse().unwrap_or(*time);
            Line { name: format!("t = {time} s"), stroke: Stroke::Solid, color, points }
        };
        results.snapshots().enumerate().map(line).collect()
    }
}

/// What the axis of the values of a plot says: `displacement, y (m)` of `shape.displacement.2`.
pub(crate) fn value_axis(name: &str, unit: &str) -> String {
    let unit = if unit.is_empty() { "1" } else { unit };
    let mut words = name.split('.').rev();
    let last = words.next().unwrap_or(name);
    // The component stands behind the quantity.
    let quantity = match last.parse::<u8>() {
        Ok(_) => {
            let quantity = words.next().unwrap_or("");
            format!("{quantity}, {}", Name { quantity, station: "", component: last }.axis())
        }
        Err(_) => last.to_owned(),
    };
    format!("{} ({unit})", quantity.replace('_', " "))
}

/// The value of a curve at `place`, linear between its points.
fn at(curve: &[(f64, f64)], place: f64) -> f64 {
    let next = curve.partition_point(|(own, _)| *own < place);
    match (next.checked_sub(1).map(|before| curve[before]), curve.get(next)) {
        (Some((from, low)), Some((to, high))) if *to > from => low + (high - low) * (place - from) / (to - from),
        (_, Some((_, value))) => *value,
        (Some((_, value)), None) => value,
        (None, None) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::trace::Trace;

    const MODEL: &str = include_str!("../../../models/ring.toml");

    /// Components and energies are lines of one plot; a beam's positions are a shape, its other quantities a plot per
    /// component.
    #[test]
    fn columns_are_grouped() {
        let document = Document::parse("ring.toml", MODEL, &[]).unwrap();
        let output = &document.outputs.iter().find(|output| matches!(output.target, Target::On { .. })).unwrap().name;
        let columns = [
            ("tip.position[1]", "m"),
            ("tip.position[2]", "m"),
            ("tip.twist", "rad"),
            (&format!("{output}.position[1,1]"), "m"),
            (&format!("{output}.position[1,2]"), "m"),
            (&format!("{output}.velocity[1,1]"), "m/s"),
            (&format!("{output}.velocity[1,2]"), "m/s"),
            (&format!("{output}.velocity[2,1]"), "m/s"),
            (&format!("{output}.twist[1]"), "rad"),
            (&format!("{output}.twist[2]"), "rad"),
            ("energy.kinetic", "J"),
            ("energy.total", "J"),
            ("momentum.linear[1]", "N.s"),
            ("statistics.steps", ""),
        ];
        let columns = columns.map(|(name, unit)| Column::of(name, unit, Trace::new(2)));
        let plots = Plot::all(&columns, &document);
        let found: Vec<_> = plots.iter().map(|plot| (plot.name.as_str(), plot.kind, plot.columns.as_slice())).collect();
        assert_eq!(
            found,
            [
                ("tip.position", Kind::Time, &[0, 1][..]),
                ("tip.twist", Kind::Time, &[2]),
                (&format!("{output}.position"), Kind::Shape, &[3, 4]),
                (&format!("{output}.velocity.1"), Kind::Length, &[5, 7]),
                (&format!("{output}.velocity.2"), Kind::Length, &[6]),
                (&format!("{output}.twist"), Kind::Length, &[8, 9]),
                ("energy", Kind::Time, &[10, 11]),
            ]
        );
    }
}
