//! Plots of results: one SVG per quantity of an output, its components as lines, and one of the energies.

use super::results::Results;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// Size of a plot, and of the column for the legend in it, pixels.
const SIZE: (u32, u32) = (960, 540);
const LEGEND: i32 = 210;

/// Colours that everybody can tell apart (Okabe and Ito).
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(230, 159, 0),
    RGBColor(86, 180, 233),
    RGBColor(60, 60, 60),
];
const INK: RGBColor = RGBColor(50, 50, 50);
const GRID: RGBColor = RGBColor(225, 225, 225);

/// Points of a line that are drawn; of more the lowest and highest of each interval.
const POINTS: usize = 4000;

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
    let root = SVGBackend::new(path, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let (left, right) = root.split_horizontally(SIZE.0 as i32 - LEGEND);
    let values = group.columns.iter().flat_map(|column| results.rows.iter().map(move |row| row[*column]));
    let (low, high) = range(values);
    let end = results.times[results.times.len() - 1];
    let mut chart = ChartBuilder::on(&left)
        .caption(&group.name, ("sans-serif", 22).into_font().color(&INK))
        .margin(14)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d(results.times[0]..end, low..high)?;
    let unit = if group.unit.is_empty() { "1" } else { &group.unit };
    let quantity = group.name.rsplit('.').next().unwrap_or(&group.name).replace('_', " ");
    let (time_span, span) = (end - results.times[0], high - low);
    chart
        .configure_mesh()
        .x_labels(9)
        .y_labels(9)
        .max_light_lines(0)
        .bold_line_style(GRID)
        .axis_style(INK)
        .label_style(("sans-serif", 14).into_font().color(&INK))
        .axis_desc_style(("sans-serif", 16).into_font().color(&INK))
        .x_desc("time (s)")
        .y_desc(format!("{quantity} ({unit})"))
        .x_label_formatter(&|value| tick(*value, time_span))
        .y_label_formatter(&|value| tick(*value, span))
        .draw()?;
    for (k, column) in group.columns.iter().enumerate() {
        let points = thinned(&results.times, |row| results.rows[row][*column]);
        chart.draw_series(LineSeries::new(points, style(k)))?;
    }
    legend(&right, results, group)?;
    root.present()?;
    Ok(())
}

fn style(line: usize) -> ShapeStyle {
    COLOURS[line % COLOURS.len()].stroke_width(2)
}

/// Samples and names beside the chart, where they hide nothing.
fn legend(area: &DrawingArea<SVGBackend<'_>, Shift>, results: &Results, group: &Group) -> Result<(), Box<dyn Error>> {
    for (k, column) in group.columns.iter().enumerate() {
        let name = &results.columns[*column].name;
        let y = 64 + 24 * k as i32;
        area.draw(&PathElement::new([(4, y), (30, y)], style(k)))?;
        let label = name
            .strip_prefix(&group.name)
            .filter(|rest| rest.starts_with('.'))
            .map_or_else(|| name.split_once('.').map_or(name.as_str(), |(_, rest)| rest), |rest| &rest[1..]);
        area.draw(&Text::new(label.to_owned(), (38, y - 7), ("sans-serif", 15).into_font().color(&INK)))?;
    }
    Ok(())
}

/// From the lowest to the highest finite value, with a margin; never empty.
fn range(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|value| value.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    if low > high {
        return (-1.0, 1.0);
    }
    // A constant with its round-off is a straight line in the middle, not noise from edge to edge.
    let least = 1e-9 * low.abs().max(high.abs());
    if high - low <= least {
        let half = if least > 0.0 { 0.1 * low.abs().max(high.abs()) } else { 1.0 };
        return (low - half, high + half);
    }
    let margin = 0.06 * (high - low);
    (low - margin, high + margin)
}

/// A number at an axis of this span: as many digits as tell neighbours apart, an exponent where numbers are large or small.
fn tick(value: f64, span: f64) -> String {
    if value.abs() < 1e-9 * span {
        return "0".to_owned();
    }
    let size = span.max(value.abs());
    if !(1e-3..1e5).contains(&size) {
        let digits = (value.abs() / span * 20.0).log10().ceil().clamp(1.0, 6.0) as usize;
        return trimmed_exponent(&format!("{value:.digits$e}"));
    }
    let digits = (1.0 - span.log10()).ceil().clamp(0.0, 9.0) as usize;
    format!("{value:.digits$}")
}

/// `2.50e-4` to `2.5e-4`.
fn trimmed_exponent(text: &str) -> String {
    let Some((mantissa, exponent)) = text.split_once('e') else { return text.to_owned() };
    let mantissa = if mantissa.contains('.') { mantissa.trim_end_matches('0').trim_end_matches('.') } else { mantissa };
    format!("{mantissa}e{exponent}")
}

/// The finite points of a line; of very many the extremes of each interval, so that no peak gets lost.
fn thinned(times: &[f64], value: impl Fn(usize) -> f64) -> Vec<(f64, f64)> {
    let points: Vec<_> =
        times.iter().enumerate().map(|(row, t)| (*t, value(row))).filter(|p| p.1.is_finite()).collect();
    if points.len() <= POINTS {
        return points;
    }
    let chunk = points.len().div_ceil(POINTS / 2);
    let mut kept = Vec::with_capacity(POINTS + 2);
    for part in points.chunks(chunk) {
        let low = part.iter().enumerate().min_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or(0, |(k, _)| k);
        let high = part.iter().enumerate().max_by(|a, b| a.1.1.total_cmp(&b.1.1)).map_or(0, |(k, _)| k);
        kept.push(part[low.min(high)]);
        kept.push(part[low.max(high)]);
    }
    kept
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

    /// Labels are short, differ from their neighbours, and zero is 0 whatever the round-off.
    #[test]
    fn ticks_are_readable() {
        assert_eq!(tick(-0.2, 1.5), "-0.2");
        assert_eq!(tick(1e-17, 1.0), "0");
        assert_eq!(tick(20.0, 100.0), "20");
        assert_eq!(tick(2.5e-7, 1e-6), "2.5e-7");
        assert_eq!(tick(1.5e8, 2e8), "1.5e8");
    }

    /// A single peak among many points survives.
    #[test]
    fn thinning_keeps_peaks() {
        let times: Vec<f64> = (0..50_000).map(f64::from).collect();
        let points = thinned(&times, |row| if row == 12_345 { 7.0 } else { 0.0 });
        assert!(points.len() <= POINTS + 2);
        assert!(points.contains(&(12_345.0, 7.0)));
    }

    /// The axis of a constant is not its round-off.
    #[test]
    fn ranges_are_never_empty() {
        for values in [vec![], vec![0.0], vec![3.0, 3.0 + 1e-12], vec![f64::NAN]] {
            let (low, high) = range(values.iter().copied());
            assert!(high - low > 0.1, "{values:?}: {low} {high}");
        }
    }
}
