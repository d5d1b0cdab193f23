//! Vibrations by the speed of a rotation: a table as CSV, and Campbell's diagram as a chart.

use crate::chart::{Chart, Layout, Line, Stroke};
use crate::numbers::shortest;
use ancf14::model::campbell::{Campbell, Critical, Excitation, Point, Whirl};
use ancf14::model::steady::Frame;
use std::error::Error;
use std::f64::consts::TAU;

/// Frequencies beyond this multiple of the largest speed are not in the chart.
const SHOWN: f64 = 3.0;
/// Colors of modes; the last one is that of the lines of the speed and its double.
const COLORS: usize = 6;

/// How a mode turns, in a word.
pub fn word(whirl: Whirl) -> &'static str {
    match whirl {
        Whirl::Forward => "forward",
        Whirl::Backward => "backward",
        Whirl::None => "none",
    }
}

/// The axes of the frequencies, in words.
pub fn frame(frame: Frame) -> &'static str {
    match frame {
        Frame::Fixed => "fixed",
        Frame::Turning => "turning",
    }
}

/// The force that excites a mode at a critical speed, in words.
pub fn excitation(found: &Campbell, critical: &Critical) -> &'static str {
    match (found.frame, critical.excitation, critical.whirl) {
        (_, Excitation::TurnsAlong, _) | (Frame::Fixed, Excitation::Once, Whirl::Forward) => "unbalance",
        (Frame::Fixed, Excitation::Once, Whirl::Backward) => "unbalance in supports that are not round",
        (Frame::Fixed, Excitation::Once, Whirl::None) => "forces once a revolution",
        (Frame::Turning, Excitation::Once, _) => "loads fixed in space",
    }
}

/// The text of the table: a row for each mode at each speed.
pub fn csv(found: &Campbell) -> String {
    let mut text = "speed,mode,frequency,damping_ratio,real,direction,unstable\n".to_owned();
    for (row, speed) in found.speeds.iter().enumerate() {
        for (mode, points) in found.modes.iter().enumerate() {
            let point = &points[row];
            let [frequency, ratio, real] =
                [point.frequency() / TAU, point.damping_ratio(), point.value[0]].map(shortest);
            let (speed, number, unstable) = (shortest(*speed), mode + 1, u8::from(point.is_unstable));
            let direction = word(point.whirl);
            text.push_str(&format!("{speed},{number},{frequency},{ratio},{real},{direction},{unstable}\n"));
        }
    }
    text
}

/// The diagram: forward solid, backward dashed, unstable thick, with the lines of the speed and its double.
///
/// # Errors
/// It cannot be drawn.
pub fn svg(found: &Campbell, model: &str) -> Result<String, Box<dyn Error>> {
    let last = found.speeds.iter().fold(0.0_f64, |last, speed| last.max(speed.abs()));
    let all = || found.modes.iter().flatten().map(|point| point.frequency());
    let least = all().fold(f64::INFINITY, f64::min);
    let limit = if least < SHOWN * last { SHOWN * last } else { f64::INFINITY };
    let highest = all().filter(|value| *value <= limit).fold(last, f64::max) / TAU;
    let mut lines = Vec::new();
    for (mode, points) in found.modes.iter().enumerate() {
        lines.extend(mode_lines(found, mode, points, limit / TAU));
    }
    for (order, name) in [(1.0, "1 x and 2 x the speed"), (2.0, "")] {
        let end = last.min(highest * TAU / order);
        let points = vec![(0.0, 0.0), (end, order * end / TAU)];
        lines.push(Line { name: name.to_owned(), stroke: Stroke::Thin, color: COLORS, points });
    }
    let frame = match found.frame {
        Frame::Fixed => "fixed frame",
        Frame::Turning => "frame that turns",
    };
    let axes = [format!("speed of {} (rad/s)", found.drive), String::from("frequency (Hz)")];
    Chart { title: format!("{model}, {frame}"), axes, layout: Layout::Single, lines }.svg()
}

/// The lines of one mode: a piece for each direction, and thick pieces where it grows.
fn mode_lines(found: &Campbell, mode: usize, points: &[Point], limit: f64) -> Vec<Line> {
    let place = |row: usize| (found.speeds[row], points[row].frequency() / TAU);
    let is_shown = |row: usize| place(row).1 <= limit;
    let color = mode % COLORS;
    let mut lines: Vec<Line> = Vec::new();
    let mut pieces = |key: &dyn Fn(usize) -> Option<Stroke>, name: &dyn Fn(usize) -> String| {
        let mut before: Option<Stroke> = None;
        for row in (0..points.len()).filter(|row| is_shown(*row)) {
            let own = key(row);
            match (own, before) {
                (Some(own), Some(last)) if own == last => {}
                (Some(stroke), _) => {
                    let name = if lines.iter().any(|line| line.stroke == stroke) { String::new() } else { name(row) };
                    let joint = (row > 0 && is_shown(row - 1)).then(|| place(row - 1));
                    lines.push(Line { name, stroke, color, points: joint.into_iter().collect() });
                }
                (None, _) => {}
            }
            if let (Some(_), Some(line)) = (own, lines.last_mut()) {
                line.points.push(place(row));
            }
            before = own;
        }
    };
    // Nothing has a direction at rest.
    let moving = |row: usize| if found.speeds[row] == 0.0 { (row + 1).min(points.len() - 1) } else { row };
    let direction = |row: usize| match points[moving(row)].whirl {
        Whirl::Forward => (Stroke::Solid, " forward"),
        Whirl::Backward => (Stroke::Dashed, " backward"),
        Whirl::None => (Stroke::Solid, ""),
    };
    pieces(&|row| Some(direction(row).0), &|row| format!("mode {}{}", mode + 1, direction(row).1));
    pieces(&|row| points[row].is_unstable.then_some(Stroke::Heavy), &|_| format!("mode {} unstable", mode + 1));
    lines
}
