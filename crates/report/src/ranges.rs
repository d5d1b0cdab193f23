//! Ranges over time along beams: ranges.csv, and a chart of minimum, mean and maximum for each component.

use crate::chart::{Chart, Layout, Line, Stroke};
use crate::extremes::ZERO;
use crate::numbers::shortest;
use crate::plot::value_axis;
use ancf14::error::decimal;
use ancf14::model::ranges::{Envelope, Range, Ranges};
use std::error::Error;
use std::fmt::Write;

/// The whole of ranges.csv.
pub fn table(ranges: &Ranges) -> String {
    let mut text = String::from("output,component,arc_length,minimum,time_of_minimum,maximum,time_of_maximum,mean\n");
    for range in &ranges.list {
        for (number, Envelope { minimum, maximum, mean }) in range.envelopes().enumerate() {
            let (station, component) = (number / range.components, number % range.components + 1);
            let component = if range.components == 1 { String::new() } else { component.to_string() };
            // Writing into a String cannot fail.
            let _ = write!(text, "{},{component}", range.name);
            let [low, high] = [minimum, maximum].map(|[value, time]| [value, decimal(time)]);
            let numbers = [[range.stations[station]].as_slice(), &low, &high, &[mean]].concat();
            numbers.into_iter().for_each(|number| text.extend([",", &shortest(number)]));
            text.push('\n');
        }
    }
    text
}

/// The names of the files of the charts.
pub fn files(ranges: &Ranges) -> impl Iterator<Item = String> + '_ {
    charts(ranges).map(|(range, component)| format!("{}.svg", title(range, component)))
}

/// The charts, in the order of [`files`]; lines of 0 for quantities among `zeros`, and for components, that are zero but
/// for round-off.
///
/// # Errors
/// A chart cannot be drawn.
pub fn pictures(ranges: &Ranges, zeros: &[String]) -> Result<Vec<String>, Box<dyn Error>> {
    charts(ranges).map(|(range, component)| chart(range, component, zeros.contains(&range.name)).svg()).collect()
}

/// Each range with each of its components, from 0.
fn charts(ranges: &Ranges) -> impl Iterator<Item = (&Range, usize)> {
    ranges.list.iter().flat_map(|range| (0..range.components).map(move |component| (range, component)))
}

/// `riser.section_moment.2`, as plots of other stations are called.
fn title(range: &Range, component: usize) -> String {
    if range.components == 1 { range.name.clone() } else { format!("{}.{}", range.name, component + 1) }
}

/// The largest value, without its sign.
fn size(envelopes: impl Iterator<Item = Envelope>) -> f64 {
    envelopes.map(|own| own.minimum[0].abs().max(own.maximum[0].abs())).fold(0.0, f64::max)
}

fn chart(range: &Range, component: usize, is_zero: bool) -> Chart {
    let title = title(range, component);
    let own: Vec<Envelope> = range.envelopes().skip(component).step_by(range.components).collect();
    let is_zero = is_zero || size(own.iter().copied()) < ZERO * size(range.envelopes());
    let line = |name: &str, stroke: Stroke, color: usize, value: fn(&Envelope) -> f64| {
        let values = own.iter().map(|own| if is_zero { 0.0 } else { value(own) });
        Line { name: name.to_owned(), stroke, color, points: range.stations.iter().copied().zip(values).collect() }
    };
    Chart {
        axes: [String::from("arc length from the start (m)"), value_axis(&title, &range.unit)],
        title,
        layout: Layout::Single,
        lines: vec![
            line("maximum", Stroke::Solid, 1, |own| own.maximum[0]),
            line("mean", Stroke::Dashed, 6, |own| own.mean),
            line("minimum", Stroke::Solid, 0, |own| own.minimum[0]),
        ],
    }
}
