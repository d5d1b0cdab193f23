//! The pieces of an element over which a contact is integrated: between the positions at which it begins and ends to
//! touch the surface.
//!
//! Points that stay where they are in the element lose a small cylinder between them altogether. The pieces begin and
//! end where the gap is 0 at the start or at the end of the step. The force is 0 there: that they move costs nothing,
//! and inside a piece the law has no kink.

use crate::math::quadrature::{FOUR_POINTS, FOUR_WEIGHTS};
use crate::math::{Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::SHAPE_PLACES;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::marker::configuration::Configuration;

/// Cells of an element, which keep what friction remembers.
pub const CELLS: usize = 2;
/// Intervals of an element between the positions at which its gap is looked at first.
const INTERVALS: usize = 8;
/// Roots that an end of a step may have.
const MOST_ROOTS: usize = 2 * INTERVALS;
/// Intervals between positions at which the part of a surface that is nearest is looked at, and the most borders
/// between such parts that an end of a step may have.
const PART_INTERVALS: usize = 32;
const MOST_PARTS: usize = 16;
/// Halvings that find a border between parts.
const HALVINGS: usize = 30;
/// Halvings and secants that find a root: as many for every root, so that no comparison of round-off decides.
const ROUNDS: usize = 12;
/// Sections by which a least gap between two positions is found, and parabolas that find it then to round-off: where
/// two beams cross, they touch over less than a thousandth of an element.
const SEARCHES: usize = 10;
const PARABOLAS: usize = 2;
/// Golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// The axis of an element, in global axes or in those of a surface: the vectors that its shape functions multiply.
#[derive(Clone, Copy, Debug)]
pub struct Lying {
    /// Positions and slopes of both ends.
    pub vectors: [Vec3; 4],
    /// Length of the element, m.
    pub length: f64,
}

impl Lying {
    /// How `element` lies in global axes.
    pub fn of(element: &AnyElement, c: &Configuration) -> Self {
        let q = &c.beams.q[element.coordinates()];
        let vectors = SHAPE_PLACES.map(|start| Vec3::new(q[start], q[start + 1], q[start + 2]));
        Self { vectors, length: element.length() }
    }

    /// The position `xi`.
    pub fn point(&self, xi: f64) -> Vec3 {
        let weights = hermite::shape(xi, self.length);
        self.vectors.iter().zip(weights).fold(Vec3::zeros(), |sum, (vector, weight)| sum + vector * weight)
    }

    /// The most that a point of it is away from its middle, m: by the corners of the Bézier curve that it is.
    pub fn reach(&self) -> f64 {
        let middle = self.point(0.5);
        let [start, slope, end, last_slope] = self.vectors;
        let third = self.length / 3.0;
        let corners = [start, start + slope * third, end - last_slope * third, end];
        corners.into_iter().map(|corner| (corner - middle).norm()).fold(0.0, f64::max)
    }
}

/// How far points of an element are above what they may touch, by their positions, m.
pub type Gap<'a> = &'a dyn Fn(f64) -> f64;

/// The part of a surface that is nearest to points of an element, by their positions: a face, an edge or a corner. A
/// surface that is round all over has one part.
pub type Part<'a> = &'a dyn Fn(f64) -> usize;

/// Most borders of the pieces of an element.
const MOST_BORDERS: usize = 2 * (MOST_ROOTS + MOST_PARTS) + CELLS + 1;

/// Positions in ascending order.
#[derive(Clone, Copy, Debug)]
struct Borders {
    list: [f64; MOST_BORDERS],
    number: usize,
}

impl Borders {
    fn push(&mut self, border: f64) {
        if self.number < self.list.len() {
            self.list[self.number] = border;
            self.number += 1;
        }
    }
}

/// Calls `take` with the cell, the position and the share of `length` of each point of an element at which one of the
/// `gaps` is negative: that of an instant, or those of both ends of a step. Where the nearest part of the surface
/// changes in one of `parts`, the curvature of the gap jumps: pieces end there too.
pub fn each_point(gaps: &[Gap], parts: &[Part], length: f64, take: &mut dyn FnMut(usize, f64, f64)) {
    let mut borders = Borders { list: [0.0; MOST_BORDERS], number: 0 };
    let mut touches = false;
    for gap in gaps {
        touches |= find_roots(gap, &mut borders);
    }
    if !touches {
        return;
    }
    parts.iter().for_each(|part| find_changes(part, &mut borders));
    (0..=CELLS).for_each(|cell| borders.push(cell as f64 / CELLS as f64));
    let borders = &mut borders.list[..borders.number];
    borders.sort_unstable_by(f64::total_cmp);
    for pair in borders.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let middle = 0.5 * (from + to);
        if to <= from || gaps.iter().all(|gap| gap(middle) >= 0.0) {
            continue;
        }
        let cell = ((middle * CELLS as f64) as usize).min(CELLS - 1);
        for (point, weight) in FOUR_POINTS.into_iter().zip(FOUR_WEIGHTS) {
            take(cell, from + (to - from) * point, weight * (to - from) * length);
        }
    }
}

/// Adds the positions at which `part` changes: the end of the one before and the start of the one behind, between which
/// a third one may be.
fn find_changes(part: Part, borders: &mut Borders) {
    let at = |number: usize| number as f64 / PART_INTERVALS as f64;
    let (mut before, mut number_of_changes) = (part(0.0), 0);
    for number in 0..PART_INTERVALS {
        let behind = part(at(number + 1));
        if behind == before || number_of_changes == MOST_PARTS / 2 {
            continue;
        }
        for (own, [mut inner, mut outer]) in
            [(before, [at(number), at(number + 1)]), (behind, [at(number + 1), at(number)])]
        {
            for _ in 0..HALVINGS {
                let middle = 0.5 * (inner + outer);
                if part(middle) == own { inner = middle } else { outer = middle }
            }
            borders.push(inner);
        }
        number_of_changes += 1;
        before = behind;
    }
}

/// Adds the roots of `gap` to `positions`. Returns whether the gap is negative anywhere.
fn find_roots(gap: Gap, borders: &mut Borders) -> bool {
    let at = |number: usize| number as f64 / INTERVALS as f64;
    let samples: [f64; INTERVALS + 1] = std::array::from_fn(|number| gap(at(number)));
    let mut touches = samples.iter().any(|gap| *gap < 0.0);
    for number in 0..INTERVALS {
        let ([from, to], values) = ([at(number), at(number + 1)], [samples[number], samples[number + 1]]);
        if (values[0] < 0.0) != (values[1] < 0.0) {
            borders.push(root(gap, [from, to], values));
            continue;
        }
        // Between positions that do not touch, a small surface may; between positions that do, the beam may have lifted
        // off. Where the gap can become 0 is looked for, so that a piece begins with no length.
        let side = if values[0] < 0.0 { -1.0 } else { 1.0 };
        let [first, last] = values.map(|value| side * value);
        if first.min(last) > f64::max(bend(&samples, number), bend(&samples, number + 1)) {
            continue;
        }
        let toward = |xi: f64| side * gap(xi);
        let (lowest, least) = least(&toward, [from, to]);
        if least < 0.0 {
            touches = true;
            borders.push(root(&toward, [from, lowest], [first, least]));
            borders.push(root(&toward, [lowest, to], [least, last]));
        }
    }
    touches
}

/// The second difference of samples about one of them: more than the gap falls below both samples of an interval, which
/// is an eighth of it for a parabola and half of it beside a small surface.
fn bend(samples: &[f64; INTERVALS + 1], number: usize) -> f64 {
    let middle = number.clamp(1, INTERVALS - 1);
    let bend = samples[middle - 1] - 2.0 * samples[middle] + samples[middle + 1];
    // Beside the end of a surface the distance is infinite.
    if bend.is_finite() { bend.abs() } else { f64::INFINITY }
}

/// The root of `gap` between two positions at which it has different signs: by secants, and by halving where they leave
/// one side standing.
fn root(gap: Gap, [mut low, mut high]: [f64; 2], [mut at_low, mut at_high]: [f64; 2]) -> f64 {
    let (mut best, mut moved) = ((f64::INFINITY, 0.5 * (low + high)), 0);
    for round in 0..ROUNDS {
        let secant = low - at_low * (high - low) / (at_high - at_low);
        let middle = if round % 4 == 3 || !secant.is_finite() { 0.5 * (low + high) } else { secant };
        let here = gap(middle);
        if here.abs() < best.0 {
            best = (here.abs(), middle);
        }
        // A side that stands still twice is pulled nearer.
        if (here < 0.0) == (at_low < 0.0) {
            (low, at_low) = (middle, here);
            at_high *= if moved == -1 { 0.5 } else { 1.0 };
            moved = -1;
        } else {
            (high, at_high) = (middle, here);
            at_low *= if moved == 1 { 0.5 } else { 1.0 };
            moved = 1;
        }
    }
    best.1
}

/// Position and value of the least gap between two positions.
pub fn least(gap: Gap, [mut low, mut high]: [f64; 2]) -> (f64, f64) {
    let mut inner = [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
    let mut values = inner.map(gap);
    for _ in 0..SEARCHES {
        if values[0] < values[1] {
            high = inner[1];
            (inner[1], values[1]) = (inner[0], values[0]);
            inner[0] = high - GOLDEN * (high - low);
            values[0] = gap(inner[0]);
        } else {
            low = inner[0];
            (inner[0], values[0]) = (inner[1], values[1]);
            inner[1] = low + GOLDEN * (high - low);
            values[1] = gap(inner[1]);
        }
    }
    let middle = 0.5 * (low + high);
    let mut points = [(inner[0], values[0]), (inner[1], values[1]), (middle, gap(middle))];
    for _ in 0..PARABOLAS {
        points.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
        match vertex(&points).filter(|position| (low..=high).contains(position)) {
            Some(position) => points[2] = (position, gap(position)),
            None => break,
        }
    }
    points.into_iter().fold(points[0], |least, point| if point.1 < least.1 { point } else { least })
}

/// Where the parabola through three points is least; none: nowhere.
fn vertex(points: &[(f64, f64); 3]) -> Option<f64> {
    let [(from, at_from), (second, at_second), (third, at_third)] = *points;
    let [slope, other] = [(at_second - at_from) / (second - from), (at_third - at_from) / (third - from)];
    let bend = (other - slope) / (third - second);
    let position = from + 0.5 * (second - from - slope / bend);
    (bend > 0.0 && position.is_finite()).then_some(position)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanics::contact::shape::Shape;

    /// A straight element of 1 m along y, `height` m above the middle of a small cylinder at 0.313 of its length.
    fn lying(height: f64) -> Lying {
        let (start, along) = (Vec3::new(0.0, -0.313, height), Vec3::y());
        Lying { vectors: [start, along, start + along, along], length: 1.0 }
    }

    /// The force of a small cylinder, an integral of penetrations, does not depend on where it is between the points:
    /// its second-order part is exact, `∫ (R − √(y² + h²)) dy` in closed form.
    #[test]
    fn small_cylinders_are_found() {
        let (radius, height) = (0.02_f64, 0.019);
        let shape = Shape::Cylinder { radius, half_length: f64::INFINITY, inside: false };
        let own = lying(height);
        let mut sum = 0.0;
        let gap = |xi: f64| shape.distance(&own.point(xi));
        each_point(&[&gap], &[], 1.0, &mut |_, xi, share| sum -= share * gap(xi));
        let half = (radius * radius - height * height).sqrt();
        // ∫ √(y² + h²) dy from −a to a.
        let exact = 2.0 * radius * half - (half * radius + height * height * (half / height).asinh());
        assert!((sum / exact - 1.0).abs() < 1e-3, "{sum} {exact}");
    }

    /// An element that has lifted off between two samples of the gap: nothing jumps where a sample begins to see it.
    #[test]
    fn lift_offs_between_samples() {
        // The gap (ξ − 0.31)² (1 + ξ/2) 0.01 below `top`; 0.25 is a sample.
        let (middle, curvature) = (0.31, 0.01);
        let fall = |xi: f64| (xi - middle) * (xi - middle) * (1.0 + 0.5 * xi) * curvature;
        let slope =
            |xi: f64| ((xi - middle) * (1.0 + 0.5 * xi) * 2.0 + (xi - middle) * (xi - middle) * 0.5) * curvature;
        let sums = |top: f64| {
            let position = |xi: f64| Vec3::new(top - fall(xi), xi, 0.0);
            let along = |xi: f64| Vec3::new(-slope(xi), 1.0, 0.0);
            let own = Lying { vectors: [position(0.0), along(0.0), position(1.0), along(1.0)], length: 1.0 };
            let (mut force, mut squares, mut length) = (0.0, 0.0, 0.0);
            let gap = |xi: f64| own.point(xi).x;
            each_point(&[&gap], &[], 1.0, &mut |_, xi, share| {
                let pressure = -gap(xi);
                force += share * pressure;
                squares += share * pressure * pressure;
                length += share;
            });
            [force, squares, length]
        };
        let seen = fall(0.25);
        let [below, above] = [0.999_999, 1.000_001].map(|share| sums(share * seen));
        for (below, above) in below.into_iter().zip(above) {
            assert!((above / below - 1.0).abs() < 1e-5, "{below} {above}");
        }
        // It has lifted off over about 0.12 m.
        assert!((0.85..0.9).contains(&below[2]), "{below:?}");
    }

    /// A bar across the edge of a plate, above its face and beside it: the gap is flat, then rises as a circle. The
    /// pieces end where it begins to, and the integral of the penetration is that of both parts.
    #[test]
    fn pieces_end_at_edges() {
        let shape = Shape::Box { half: Vec3::new(0.1, 0.213, 1.0) };
        let (radius, depth) = (0.02, 1e-3);
        let along = Vec3::y();
        let start = Vec3::new(0.1 + radius - depth, 0.0, 0.0);
        let own = Lying { vectors: [start, along, start + along, along], length: 1.0 };
        let (gap, part) = (|xi: f64| shape.distance(&own.point(xi)) - radius, |xi: f64| shape.part(&own.point(xi)));
        let mut sum = 0.0;
        each_point(&[&gap], &[&part], 1.0, &mut |_, xi, share| sum -= share * gap(xi));
        let height = radius - depth;
        let half = (radius * radius - height * height).sqrt();
        let beside = radius * half - 0.5 * (half * radius + height * height * (half / height).asinh());
        let exact = 0.213 * depth + beside;
        // The root behind the edge is found to 3e-5 m: the integral misses half the square of that times the slope.
        let missed = 0.5 * (half / radius) * 3e-5_f64.powi(2);
        assert!((sum - exact).abs() < missed, "{sum} {exact}");
    }

    /// Over a step, both ends' borders are borders of pieces; points of no cell are lost.
    #[test]
    fn both_ends_count() {
        let [start, end] = [1e-3, -1e-3].map(|offset| {
            let (border, along) = (Vec3::new(offset, 0.0, 0.0), Vec3::new(0.01, 1.0, 0.0));
            Lying { vectors: [border, along, border + along, along], length: 1.0 }
        });
        let (mut sum, mut cells) = (0.0, [0; CELLS]);
        let gap = |own: &Lying, xi: f64| own.point(xi).x - 5e-3;
        each_point(&[&|xi| gap(&start, xi), &|xi| gap(&end, xi)], &[], 1.0, &mut |cell, _, share| {
            sum += share;
            cells[cell] += 1;
        });
        // The end touches over 0.6 m, the start over 0.4 m, on three pieces.
        assert!((sum - 0.6).abs() < 1e-9, "{sum}");
        assert_eq!(cells, [8, 4]);
    }
}
