//! Time of a step for each element over the number of elements, both axes logarithmic, as an SVG picture.

use crate::chain::{Cost, SETTINGS};
use plotters::prelude::*;
use std::error::Error;
use std::path::Path;

/// As the charts of the validation page.
const SIZE: (u32, u32) = (960, 540);
const COLORS: [RGBColor; SETTINGS.len() + 1] = [RGBColor(0, 114, 178), RGBColor(204, 121, 167), RGBColor(213, 94, 0)];
const INK: RGBColor = RGBColor(50, 50, 50);
const GRID: RGBColor = RGBColor(225, 225, 225);

/// Times that are written at the axis, microseconds.
const TICKS: [f64; 9] = [1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0];
/// Room around the points, as factors: below and beside them, and above, where the names of the curves are.
const ROOM: [f64; 2] = [1.5, 4.0];

/// Draws ours, and the peer's if it is known, into `file`.
pub fn draw(costs: &[Cost], file: &Path) -> Result<(), Box<dyn Error>> {
    let micro = |cost: &Cost, time: f64| (cost.elements as f64, 1e6 * time / cost.elements as f64);
    let mut series: Vec<(String, Vec<_>)> = Vec::new();
    for (number, [integrator, tolerance]) in SETTINGS.into_iter().enumerate() {
        let points = costs.iter().map(|cost| micro(cost, cost.own[number].0)).collect();
        series.push((format!("ancf14, {integrator}, tolerance {tolerance}"), points));
    }
    let peer = costs.iter().filter_map(|cost| Some(micro(cost, cost.peer?))).collect();
    series.push((String::from("EXUDYN 1.13.6"), peer));
    let all = || series.iter().flat_map(|(_, points)| points);
    let span = |values: &dyn Fn(&(f64, f64)) -> f64, room: f64| {
        let low = all().map(values).fold(f64::INFINITY, f64::min);
        let high = all().map(values).fold(0.0, f64::max);
        low / ROOM[0]..high * room
    };
    let (elements, times) = (span(&|point| point.0, ROOM[0]), span(&|point| point.1, ROOM[1]));
    let ticks = TICKS.into_iter().filter(|tick| times.contains(tick)).collect();
    let root = SVGBackend::new(file, SIZE).into_drawing_area();
    root.fill(&WHITE)?;
    let mut chart = ChartBuilder::on(&root)
        .caption("A falling chain: time of a step, for each element", ("sans-serif", 22).into_font().color(&INK))
        .margin(14)
        .x_label_area_size(48)
        .y_label_area_size(84)
        .build_cartesian_2d(elements.log_scale(), times.log_scale().with_key_points(ticks))?;
    chart
        .configure_mesh()
        .bold_line_style(GRID)
        .light_line_style(WHITE)
        .axis_style(INK)
        .label_style(("sans-serif", 14).into_font().color(&INK))
        .axis_desc_style(("sans-serif", 16).into_font().color(&INK))
        .x_desc("elements")
        .y_desc("CPU time of a step, for each element (microseconds)")
        .x_label_formatter(&|value| value.to_string())
        .y_label_formatter(&|value| value.to_string())
        .draw()?;
    for ((name, points), color) in series.iter().zip(COLORS) {
        if points.is_empty() {
            continue;
        }
        chart.draw_series(LineSeries::new(points.iter().copied(), color.stroke_width(2)))?;
        let dots = chart.draw_series(points.iter().map(|point| Circle::new(*point, 4, color.filled())))?;
        dots.label(name).legend(move |place| Circle::new(place, 4, color.filled()));
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperMiddle)
        .border_style(GRID)
        .background_style(WHITE)
        .label_font(("sans-serif", 15).into_font().color(&INK))
        .draw()?;
    root.present()?;
    Ok(())
}
