//! The axis of a beam as one curve over its arc length: its points, and the one nearest to another point.

use crate::math::{Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::interpolate;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::marker::configuration::Configuration;
use std::ops::Range;

/// Corrections that find the nearest point at most. Newton's need five; near a center of curvature they are slower.
const ROUNDS: usize = 20;
/// A correction over the length of the beam that is round-off.
const ROUND_OFF: f64 = 1e-15;
/// Share of a beam so near before a node that a point is of the element behind it. Nearest points that are found from
/// different elements differ by round-off, and beams often cross at nodes: without it both elements or none would have
/// the point.
const AT_NODE: f64 = 1e-12;
/// Share of `|r'|²` below which the second derivative of the distance does not lead downhill surely.
const LEAST_SHARE: f64 = 0.1;

/// A beam that touches beams.
#[derive(Clone, Debug, PartialEq)]
pub struct Strand {
    /// Its elements.
    pub elements: Range<usize>,
    /// The arc lengths at which they begin, and that of the end, m.
    pub starts: Vec<f64>,
    /// Distance of its surface from its axis, m.
    pub radius: f64,
}

impl Strand {
    /// A strand of these `elements` of a mesh.
    pub fn new(elements: Range<usize>, mesh: &[AnyElement], radius: f64) -> Self {
        let mut starts = vec![0.0];
        for element in &mesh[elements.clone()] {
            starts.push(starts[starts.len() - 1] + element.length());
        }
        Self { elements, starts, radius }
    }

    /// Number of its elements.
    pub fn count(&self) -> usize {
        self.elements.len()
    }

    /// The element at an arc length, from 0 within the beam, and the position in it, 0 to 1.
    pub fn at(&self, s: f64) -> (usize, f64) {
        let inner = &self.starts[1..self.count()];
        let near = s + AT_NODE * self.starts[self.count()];
        let element = inner.partition_point(|start| *start <= near);
        (element, (s - self.starts[element]) / (self.starts[element + 1] - self.starts[element]))
    }

    /// Arc length at the position `xi` of an element, m.
    pub fn arc(&self, element: usize, xi: f64) -> f64 {
        self.starts[element] + xi * (self.starts[element + 1] - self.starts[element])
    }

    /// Whether an arc length is that of an end, beyond which the beam is round.
    pub fn is_end(&self, s: f64) -> bool {
        s <= 0.0 || s >= self.starts[self.count()]
    }
}

/// The axis of a beam at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Axis<'a> {
    strand: &'a Strand,
    elements: &'a [AnyElement],
    q: &'a [f64],
}

/// The point of an axis that is nearest to another point.
#[derive(Clone, Copy, Debug)]
pub struct Nearest {
    /// Its arc length, m.
    pub s: f64,
    /// The way from it to the other point, m.
    pub arm: Vec3,
    /// The length of that, m.
    pub distance: f64,
    /// The slope there.
    pub slope: Vec3,
    /// `|r'|² − arm · r''`: the second derivative of half the square of the distance.
    pub bend: f64,
}

impl<'a> Axis<'a> {
    /// The axis of `strand` at `c`.
    pub fn of(strand: &'a Strand, c: &'a Configuration) -> Self {
        Self { strand, elements: &c.mesh.elements[strand.elements.clone()], q: c.beams.q }
    }

    /// Position, slope and its derivative at the position `xi` of an element.
    pub fn point(&self, element: usize, xi: f64) -> [Vec3; 3] {
        let own = &self.elements[element];
        let (q, length) = (&self.q[own.coordinates()], own.length());
        let weights = [hermite::shape(xi, length), hermite::shape_x(xi, length), hermite::shape_xx(xi, length)];
        weights.map(|weights| interpolate(&weights, q))
    }

    /// The point nearest to `y` that is found downhill from the arc length `from`.
    pub fn nearest(&self, y: &Vec3, from: f64) -> Nearest {
        let starts = &self.strand.starts;
        let end = starts[self.strand.count()];
        let mut s = from;
        let mut round = 0;
        loop {
            let (element, xi) = self.strand.at(s);
            let [point, slope, turn] = self.point(element, xi);
            let arm = y - point;
            let (square, bend) = (slope.norm_squared(), slope.norm_squared() - arm.dot(&turn));
            let divisor = if bend > LEAST_SHARE * square { bend } else { square };
            let longest = 0.5 * (starts[element + 1] - starts[element]);
            let next = (s + (arm.dot(&slope) / divisor).clamp(-longest, longest)).clamp(0.0, end);
            round += 1;
            if round == ROUNDS || (next - s).abs() <= ROUND_OFF * end {
                return Nearest { s, arm, distance: arm.norm(), slope, bend };
            }
            s = next;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Arc lengths and positions in elements belong to each other; the ends belong to the beam.
    #[test]
    fn arcs() {
        let own = Strand { elements: 3..6, starts: vec![0.0, 0.5, 0.75, 2.0], radius: 0.1 };
        for (s, at) in [(0.0, (0, 0.0)), (0.25, (0, 0.5)), (0.5, (1, 0.0)), (1.0, (2, 0.2)), (2.0, (2, 1.0))] {
            assert_eq!(own.at(s), at);
            assert_eq!(own.arc(at.0, at.1), s);
        }
        // Both sides of a node but for round-off.
        assert_eq!([own.at(0.5 * (1.0 - f64::EPSILON)).0, own.at(0.5 * (1.0 + f64::EPSILON)).0], [1, 1]);
        assert!(own.is_end(0.0) && own.is_end(2.0) && !own.is_end(1.0));
    }
}
