//! A picture of natural modes: a cell each, the shape over the mechanism at rest, in the oblique projection of draw.rs.

use crate::draw::{Projection, escaped};
use crate::modes::pace;
use ancf14::model::modes::{Mode, Modes};
use std::fmt::Write;

/// The view of all cells.
const VIEW: Projection = Projection::Oblique;
/// Cells in a row, their size, and what is left free around a shape, pixels.
const COLUMNS: usize = 3;
const CELL: [f64; 2] = [400.0, 280.0];
const BORDER: f64 = 44.0;
/// Height of the title, and of the two lines above a shape, pixels.
const TITLE: f64 = 56.0;
const CAPTION: f64 = 46.0;
/// Largest displacement in a picture, as a share of the larger extent of the mechanism on paper.
const AMPLITUDE: f64 = 0.18;
/// Largest turn in a picture, rad: what turns and hardly moves is not blown up to a displacement.
const TURN: f64 = 6.0;
/// Most modes in the picture.
const MOST: usize = 30;

/// From meters to pixels inside a cell.
struct View {
    scale: f64,
    center: [f64; 2],
    middle: [f64; 2],
}

impl View {
    fn place(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y] = VIEW.flat(point);
        [self.middle[0] + self.scale * (x - self.center[0]), self.middle[1] - self.scale * (y - self.center[1])]
    }
}

/// The picture of the first modes.
pub fn svg(found: &Modes, title: &str) -> String {
    let shown = &found.modes[..found.modes.len().min(MOST)];
    let columns = COLUMNS.min(shown.len()).max(1);
    let rows = shown.len().div_ceil(columns);
    let (width, height) = (CELL[0] * columns as f64, TITLE + CELL[1] * rows as f64);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\" \
         font-family=\"sans-serif\" font-size=\"14\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n<text x=\"24\" y=\"36\" \
         font-size=\"20\" fill=\"#323232\">{}: natural modes</text>\n",
        escaped(title)
    );
    for (number, mode) in shown.iter().enumerate() {
        let corner = [CELL[0] * (number % columns) as f64, TITLE + CELL[1] * (number / columns) as f64];
        cell(&mut text, found, mode, number + 1, corner);
    }
    text.push_str("</svg>\n");
    text
}

/// One mode, in the cell with this upper left corner.
fn cell(text: &mut String, found: &Modes, mode: &Mode, number: usize, corner: [f64; 2]) {
    let (x, y) = (corner[0] + 24.0, corner[1] + 16.0);
    // Writing into a String cannot fail.
    let _ = writeln!(
        text,
        "<text x=\"{x}\" y=\"{y}\" fill=\"#323232\"><tspan font-weight=\"bold\">{number}</tspan>  {}</text>\n\
         <text x=\"{x}\" y=\"{}\" font-size=\"13\" fill=\"#777777\">{}</text>",
        pace(mode),
        y + 19.0,
        escaped(&mode.moves)
    );
    let bodies = || found.places[found.nodes..].iter();
    let body_motions = &mode.motions[found.nodes..];
    let amplitude = amplitude(found, mode);
    let moved = |at: [f64; 3], by: [f64; 3]| [0, 1, 2].map(|axis| at[axis] + amplitude * by[axis]);
    let shape: Vec<Vec<[f64; 3]>> = found
        .lines
        .iter()
        .zip(&mode.lines)
        .map(|(line, motion)| line.iter().zip(motion).map(|(at, by)| moved(*at, *by)).collect())
        .collect();
    let places: Vec<[f64; 3]> =
        bodies().zip(body_motions).map(|(body, motion)| moved(body.position, motion.displacement)).collect();
    let view = view(found, &shape, &places, corner);
    for line in &found.lines {
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"#aaaaaa\" stroke-width=\"1.5\" stroke-dasharray=\"5 4\"/>",
            path(&view, line)
        );
    }
    for line in &shape {
        let _ = writeln!(
            text,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"3\" stroke-linejoin=\"round\"/>",
            path(&view, line)
        );
    }
    for (body, place) in bodies().zip(&places) {
        let ([left, top], [x, y]) = (view.place(body.position), view.place(*place));
        let _ = writeln!(
            text,
            "<circle cx=\"{left:.1}\" cy=\"{top:.1}\" r=\"8\" fill=\"none\" stroke=\"#aaaaaa\" stroke-dasharray=\"3 3\"/>\n\
             <circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"8\" fill=\"#0072b2\" fill-opacity=\"0.25\" stroke=\"#0072b2\" stroke-width=\"2\"/>"
        );
    }
}

/// Factor of a shape in its picture.
fn amplitude(found: &Modes, mode: &Mode) -> f64 {
    let largest = |vectors: &mut dyn Iterator<Item = [f64; 3]>| vectors.map(length).fold(0.0, f64::max);
    let bodies = mode.motions.iter().map(|motion| motion.displacement);
    let displacement = largest(&mut mode.lines.iter().flatten().copied().chain(bodies));
    let turn = largest(&mut mode.motions.iter().map(|motion| motion.turn));
    let [low, high] =
        extent(found.lines.iter().flatten().copied().chain(found.places.iter().map(|place| place.position)));
    let size = f64::max(high[0] - low[0], high[1] - low[1]);
    let displaced = AMPLITUDE * if size > 0.0 { size } else { 1.0 } / displacement;
    let factor = displaced.min(TURN / turn);
    if factor.is_finite() { factor } else { 0.0 }
}

fn length(vector: [f64; 3]) -> f64 {
    vector.iter().map(|value| value * value).sum::<f64>().sqrt()
}

/// Lowest and highest place on paper.
fn extent(points: impl Iterator<Item = [f64; 3]>) -> [[f64; 2]; 2] {
    points.map(|point| VIEW.flat(point)).fold([[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]], |[low, high], point| {
        [[0, 1].map(|axis| low[axis].min(point[axis])), [0, 1].map(|axis| high[axis].max(point[axis]))]
    })
}

/// A view in which mechanism and shape fill the cell.
fn view(found: &Modes, shape: &[Vec<[f64; 3]>], bodies: &[[f64; 3]], corner: [f64; 2]) -> View {
    let rest = found.lines.iter().flatten().chain(found.places.iter().map(|place| &place.position));
    let [low, high] = extent(rest.chain(shape.iter().flatten()).chain(bodies).copied());
    let room = [CELL[0] - 2.0 * BORDER, CELL[1] - CAPTION - 2.0 * BORDER];
    let scale = [0, 1].map(|axis| room[axis] / (high[axis] - low[axis])).into_iter().fold(f64::INFINITY, f64::min);
    let center = [0, 1].map(|axis| 0.5 * (low[axis] + high[axis]));
    let middle = [corner[0] + 0.5 * CELL[0], corner[1] + CAPTION + 0.5 * (CELL[1] - CAPTION)];
    // A single body has no extent.
    if scale.is_finite() { View { scale, center, middle } } else { View { scale: 100.0, center, middle } }
}

fn path(view: &View, points: &[[f64; 3]]) -> String {
    let places = points.iter().map(|point| view.place(*point)).map(|[x, y]| format!("{x:.1},{y:.1}"));
    places.collect::<Vec<_>>().join(" ")
}
