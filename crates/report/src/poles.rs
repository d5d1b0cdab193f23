//! The poles of a linear system in the complex plane: left of the imaginary axis motions fade, right of it they grow.

use crate::chart::{Chart, Layout, Line, Stroke};
use crate::matrices::word;
use ancf14::model::linear::{Pole, PoleKind};
use std::error::Error;

/// All kinds, in the order of their colors.
const KINDS: [PoleKind; 4] = [PoleKind::Oscillating, PoleKind::Unstable, PoleKind::Overdamped, PoleKind::Rigid];
/// The color of the imaginary axis.
const AXIS: usize = 6;

/// The picture of `poles`, those of `model`: of a pair the one with the positive imaginary part is given, and both are
/// drawn.
///
/// # Errors
/// It cannot be drawn.
pub fn svg(poles: &[Pole], model: &str) -> Result<String, Box<dyn Error>> {
    let axes = ["real part (rad/s)".to_owned(), "imaginary part (rad/s)".to_owned()];
    Chart { title: format!("{model}: poles"), axes, layout: Layout::Single, lines: lines(poles) }.svg()
}

/// The imaginary axis, and the dots of each kind.
fn lines(poles: &[Pole]) -> Vec<Line> {
    let largest = poles.iter().map(|pole| pole.value[1]).fold(0.0, f64::max);
    let axis = vec![(0.0, -largest), (0.0, largest)];
    let axis = Line { name: String::new(), stroke: Stroke::Thin, color: AXIS, points: axis };
    let dots = KINDS.iter().enumerate().map(|(color, kind)| {
        let own = poles.iter().filter(|pole| pole.kind == *kind).map(|pole| pole.value);
        let pairs = own.flat_map(|[real, imaginary]| [(real, imaginary), (real, -imaginary)]);
        let mut points: Vec<(f64, f64)> = pairs.collect();
        points.dedup();
        Line { name: word(*kind).to_owned(), stroke: Stroke::Dots, color, points }
    });
    std::iter::once(axis).chain(dots.filter(|line| !line.points.is_empty())).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pair has two dots, a real pole one.
    #[test]
    fn pairs_have_two_dots() {
        let pole = |value, kind| Pole { value, kind, shape: Vec::new(), parts: [Vec::new(), Vec::new()] };
        let found = lines(&[pole([-1.0, 5.0], PoleKind::Oscillating), pole([-3.0, 0.0], PoleKind::Overdamped)]);
        let points: Vec<_> = found.iter().map(|line| line.points.clone()).collect();
        assert_eq!(points[0], [(0.0, -5.0), (0.0, 5.0)]);
        assert_eq!(points[1], [(-1.0, 5.0), (-1.0, -5.0)]);
        assert_eq!(points[2], [(-3.0, 0.0)]);
        assert!(svg(&[pole([-1.0, 5.0], PoleKind::Oscillating)], "M").unwrap().contains("imaginary part"));
    }
}
