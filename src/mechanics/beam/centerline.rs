//! The line of a beam as drawn: its nodes with exact tangents and arc lengths, and how a section without pretwist turns
//! along it.
//!
//! Straight, along a curve, or in straight pieces. At a corner two pieces end in a node each, at one position.

use super::division::Division;
use crate::math::curve::Curve;
use crate::math::curve_defect::{self, CurveDefect};
use crate::math::{Vec3, bishop, hermite};

/// A node as drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// Its position, global, m.
    pub place: Vec3,
    /// Unit tangent, the node's slope.
    pub tangent: Vec3,
    /// Angle (rad) about the tangent from a normal that minimal rotations bring here from node to node to the same
    /// normal carried along the line without twist.
    pub turn: f64,
    /// Fraction of the beam's arc length, 0 to 1.
    pub fraction: f64,
}

/// An element as drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Its first node; the second is the next.
    pub node: usize,
    /// Arc length between the two, m.
    pub length: f64,
}

/// The line of a beam.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    /// Nodes from start to end, at a corner two.
    pub nodes: Vec<Station>,
    /// Elements from start to end.
    pub spans: Vec<Span>,
    /// Where the ends of the elements are.
    pub division: Division,
}

impl Centerline {
    /// The same line, `by` m away.
    pub fn moved(&self, by: &Vec3) -> Self {
        let mut moved = self.clone();
        moved.nodes.iter_mut().for_each(|node| node.place += by);
        moved
    }
}

/// Where the ends of the elements of a curve are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spacing {
    /// At equal arc lengths.
    Arc,
    /// At equal steps of the curve's parameter.
    Parameter,
}

impl Spacing {
    /// The parameters of the ends of `elements` elements; the curve has a length.
    pub fn ends(self, curve: &Curve, elements: usize) -> Vec<f64> {
        match self {
            Self::Arc => curve.equal_arcs(elements),
            Self::Parameter => curve.equal_steps(elements),
        }
    }
}

impl Centerline {
    /// A straight line in `elements` equal elements; the two ends differ.
    pub fn straight(from: Vec3, to: Vec3, elements: usize) -> Self {
        let span = to - from;
        let division = Division::Equal(elements);
        let nodes = (0..=elements).map(|node| {
            let fraction = node as f64 / elements as f64;
            Station { place: from + span * fraction, tangent: span.normalize(), turn: 0.0, fraction }
        });
        let length = span.norm() / elements as f64;
        Self { nodes: nodes.collect(), spans: (0..elements).map(|node| Span { node, length }).collect(), division }
    }

    /// Along a curve in `elements` elements.
    ///
    /// # Errors
    /// What keeps the curve, or one of its elements, from being a beam.
    pub fn curved(curve: &Curve, spacing: Spacing, elements: usize) -> Result<Self, CurveDefect> {
        curve_defect::of_length(curve).map_or(Ok(()), Err)?;
        let ends = spacing.ends(curve, elements);
        let pairs = || ends.windows(2).map(|pair| (pair[0], pair[1]));
        let (lengths, division): (Vec<f64>, _) = match spacing {
            Spacing::Arc => (vec![curve.length() / elements as f64; elements], Division::Equal(elements)),
            Spacing::Parameter => {
                let lengths: Vec<f64> = pairs().map(|(from, to)| curve.arc(from, to)).collect();
                let division = Division::graded(&lengths);
                (lengths, division)
            }
        };
        let defect =
            pairs().zip(&lengths).find_map(|((from, to), length)| curve_defect::of_element(curve, from, to, *length));
        defect.map_or(Ok(()), Err)?;
        let mut turn = 0.0;
        let turns = pairs().map(|(from, to)| {
            turn += bishop::turn(curve, from, to);
            turn
        });
        let turns = [0.0].into_iter().chain(turns);
        let nodes = ends.iter().zip(turns).enumerate().map(|(end, (s, turn))| {
            let fraction = division.fraction(end).unwrap_or(1.0);
            Station { place: curve.at(*s)[0], tangent: curve.tangent(*s), turn, fraction }
        });
        let spans = lengths.iter().enumerate().map(|(node, length)| Span { node, length: *length });
        Ok(Self { nodes: nodes.collect(), spans: spans.collect(), division })
    }

    /// In straight pieces from corner to corner, of which no two neighbors are at one place; `shares` elements each.
    pub fn polyline(corners: &[Vec3], shares: &[usize]) -> Self {
        let pieces = || corners.windows(2).zip(shares).map(|(ends, share)| (ends[0], ends[1] - ends[0], *share));
        let lengths: Vec<f64> = pieces().flat_map(|(_, span, share)| vec![span.norm() / share as f64; share]).collect();
        let division = Division::graded(&lengths);
        let (mut nodes, mut spans) = (Vec::new(), Vec::new());
        for (from, span, share) in pieces() {
            let tangent = span.normalize();
            let begin = spans.len();
            for k in 0..=share {
                let fraction = division.fraction(begin + k).unwrap_or(1.0);
                let place = from + span * (k as f64 / share as f64);
                if k > 0 {
                    spans.push(Span { node: nodes.len() - 1, length: span.norm() / share as f64 });
                }
                nodes.push(Station { place, tangent, turn: 0.0, fraction });
            }
        }
        Self { nodes, spans, division }
    }

    /// The ends of elements at which two nodes meet, counted from 0 at the start.
    pub fn corners(&self) -> Vec<usize> {
        (1..self.spans.len()).filter(|end| self.spans[*end].node > self.spans[end - 1].node + 1).collect()
    }

    /// The position at a fraction of the arc length, as the elements interpolate it, m.
    pub fn place(&self, fraction: f64) -> Vec3 {
        let (element, xi) = self.division.place(fraction);
        self.point(&self.spans[element], xi)
    }

    /// Points along the line: the nodes, and of curved elements `inner` points between.
    pub fn outline(&self, inner: usize) -> Vec<Vec3> {
        let mut points = vec![self.nodes[0].place];
        for span in &self.spans {
            let is_straight = self.nodes[span.node].tangent == self.nodes[span.node + 1].tangent;
            let steps = if is_straight { 1 } else { inner + 1 };
            points.extend((1..steps).map(|k| self.point(span, k as f64 / steps as f64)));
            points.push(self.nodes[span.node + 1].place);
        }
        points
    }

    fn point(&self, span: &Span, xi: f64) -> Vec3 {
        let [first, second] = [&self.nodes[span.node], &self.nodes[span.node + 1]];
        let [r0, p0, r1, p1] = hermite::shape(xi, span.length);
        first.place * r0 + first.tangent * p0 + second.place * r1 + second.tangent * p1
    }
}

/// Shares `elements` among pieces of the given lengths, at least one each: after that the next one always goes where
/// elements are longest. There are at least as many elements as pieces.
pub fn shares(lengths: &[f64], elements: usize) -> Vec<usize> {
    let whole: f64 = lengths.iter().sum();
    let spare = elements - lengths.len();
    // Rounded down: what is left is fewer than the pieces.
    let mut shares: Vec<usize> =
        lengths.iter().map(|length| 1 + (spare as f64 * length / whole).floor() as usize).collect();
    for _ in shares.iter().sum()..elements {
        let size = |piece: usize| lengths[piece] / shares[piece] as f64;
        let longest = (0..lengths.len()).fold(0, |best, piece| if size(piece) > size(best) { piece } else { best });
        shares[longest] += 1;
    }
    shares
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By length, at least one a piece, all of them, and equal pieces alike where the count allows it.
    #[test]
    fn elements_are_shared_by_length() {
        assert_eq!(shares(&[1.0, 1.0], 6), [3, 3]);
        assert_eq!(shares(&[1.0, 2.0, 1.0], 8), [2, 4, 2]);
        assert_eq!(shares(&[1.0, 1e-9, 1.0], 3), [1, 1, 1]);
        assert_eq!(shares(&[10.0, 1e-9, 1.0], 12), [10, 1, 1]);
        assert_eq!(shares(&[1.0, 1.0], 3), [2, 1]);
        let many: Vec<f64> = (1..200).map(f64::from).collect();
        assert_eq!(shares(&many, 1000).iter().sum::<usize>(), 1000);
    }

    /// A corner has two nodes at one position; fractions go on over it.
    #[test]
    fn corners_have_two_nodes() {
        let line = Centerline::polyline(&[Vec3::zeros(), Vec3::x(), Vec3::new(1.0, 3.0, 0.0)], &[1, 2]);
        assert_eq!((line.nodes.len(), line.spans.len(), line.corners()), (5, 3, vec![1]));
        assert_eq!(line.nodes[1].place, line.nodes[2].place);
        assert_eq!((line.nodes[1].tangent, line.nodes[2].tangent), (Vec3::x(), Vec3::y()));
        assert_eq!((line.nodes[2].fraction, line.nodes[3].fraction), (0.25, 0.625));
        assert_eq!(line.place(0.625), Vec3::new(1.0, 1.5, 0.0));
    }
}
