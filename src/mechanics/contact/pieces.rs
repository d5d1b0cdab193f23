//! The pieces of an element over which a contact is integrated: between the positions at which it begins and ends to
//! touch the surface.
//!
//! Points that stay where they are in the element lose a small cylinder between them altogether. The pieces begin and
//! end where the gap is 0 at the start or at the end of the step. The force is 0 there: that they move costs nothing,
//! and inside a piece the law has no kink.

use crate::math::quadrature::{GAUSS_POINTS, GAUSS_WEIGHTS};
use crate::math::{Vec3, hermite};
use crate::mechanics::contact::shape::Shape;

/// Cells of an element, which keep what friction remembers.
pub const CELLS: usize = 2;
/// Intervals of an element between the positions at which its gap is looked at first.
const INTERVALS: usize = 8;
/// Roots that an end of a step may have.
const MOST_ROOTS: usize = 2 * INTERVALS;
/// Halvings and secants that find a root: as many for every root, so that no comparison of round-off decides.
const ROUNDS: usize = 12;
/// Sections by which a least gap between two positions is found.
const SEARCHES: usize = 10;
/// Golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// The axis of an element in the axes of a surface: the vectors that its shape functions multiply.
#[derive(Clone, Copy, Debug)]
pub struct Lying {
    /// Positions and slopes of both ends.
    pub vectors: [Vec3; 4],
    /// Length of the element, m.
    pub length: f64,
}

impl Lying {
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

/// Positions in ascending order.
#[derive(Clone, Copy, Debug)]
struct Borders {
    list: [f64; 2 * MOST_ROOTS + CELLS + 1],
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

/// Calls `take` with the cell, the position and the share of the length of each point at which `gap` of one of the ends
/// is negative; `shape` and `radius` give the gaps of both ends, which may be the same.
pub fn each_point(shape: &Shape, radius: f64, ends: [&Lying; 2], mut take: impl FnMut(usize, f64, f64)) {
    let mut borders = Borders { list: [0.0; 2 * MOST_ROOTS + CELLS + 1], number: 0 };
    let is_instant = std::ptr::eq(ends[0], ends[1]);
    let gaps = ends.map(|end| move |xi: f64| shape.distance(&end.point(xi)) - radius);
    let mut touches = false;
    for gap in &gaps[usize::from(is_instant)..] {
        touches |= find_roots(gap, &mut borders);
    }
    if !touches {
        return;
    }
    (0..=CELLS).for_each(|cell| borders.push(cell as f64 / CELLS as f64));
    let borders = &mut borders.list[..borders.number];
    borders.sort_unstable_by(f64::total_cmp);
    let length = ends[1].length;
    for pair in borders.windows(2) {
        let (from, to) = (pair[0], pair[1]);
        let middle = 0.5 * (from + to);
        if to <= from || gaps.iter().all(|gap| gap(middle) >= 0.0) {
            continue;
        }
        let cell = ((middle * CELLS as f64) as usize).min(CELLS - 1);
        for (point, weight) in GAUSS_POINTS.into_iter().zip(GAUSS_WEIGHTS) {
            take(cell, from + (to - from) * point, weight * (to - from) * length);
        }
    }
}

/// Adds the roots of `gap` to `positions`. Returns whether the gap is negative anywhere.
fn find_roots(gap: &impl Fn(f64) -> f64, borders: &mut Borders) -> bool {
    let at = |number: usize| number as f64 / INTERVALS as f64;
    let samples: [f64; INTERVALS + 1] = std::array::from_fn(|number| gap(at(number)));
    let mut touches = samples.iter().any(|gap| *gap < 0.0);
    for number in 0..INTERVALS {
        if (samples[number] < 0.0) != (samples[number + 1] < 0.0) {
            borders.push(root(gap, [at(number), at(number + 1)], [samples[number], samples[number + 1]]));
        }
    }
    // Between positions that do not touch, a small surface may.
    for number in 0..=INTERVALS {
        let [before, after] = [number.saturating_sub(1), (number + 1).min(INTERVALS)];
        let own = samples[number];
        let is_least = own <= samples[before] && own <= samples[after];
        if !(own >= 0.0 && own.is_finite() && is_least && samples[before] >= 0.0 && samples[after] >= 0.0) {
            continue;
        }
        let (from, to) = (at(before), at(after));
        // The gap changes by less than positions do: the axis is a cubic that is not folded within a part of an
        // element.
        let (lowest, least) = least(gap, [from, to]);
        if least < 0.0 {
            touches = true;
            borders.push(root(gap, [from, lowest], [samples[before], least]));
            borders.push(root(gap, [lowest, to], [least, samples[after]]));
        }
    }
    touches
}

/// The root of `gap` between two positions at which it has different signs: by secants, and by halving where they leave
/// one side standing.
fn root(gap: &impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2], [mut at_low, mut at_high]: [f64; 2]) -> f64 {
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

/// Place and value of the least gap between two positions.
fn least(gap: &impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> (f64, f64) {
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
    let lower = usize::from(values[1] < values[0]);
    (inner[lower], values[lower])
}

#[cfg(test)]
mod tests {
    use super::*;

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
        each_point(&shape, 0.0, [&own, &own], |_, xi, share| sum -= share * shape.distance(&own.point(xi)));
        let half = (radius * radius - height * height).sqrt();
        // ∫ √(y² + h²) dy from −a to a.
        let exact = 2.0 * radius * half - (half * radius + height * height * (half / height).asinh());
        assert!((sum / exact - 1.0).abs() < 1e-3, "{sum} {exact}");
    }

    /// Over a step, both ends' borders are borders of pieces; points of no cell are lost.
    #[test]
    fn both_ends_count() {
        let shape = Shape::Plane;
        let [start, end] = [1e-3, -1e-3].map(|offset| {
            let (border, along) = (Vec3::new(offset, 0.0, 0.0), Vec3::new(0.01, 1.0, 0.0));
            Lying { vectors: [border, along, border + along, along], length: 1.0 }
        });
        let (mut sum, mut cells) = (0.0, [0; CELLS]);
        each_point(&shape, 5e-3, [&start, &end], |cell, _, share| {
            sum += share;
            cells[cell] += 1;
        });
        // The end touches over 0.6 m, the start over 0.4 m, on three pieces.
        assert!((sum - 0.6).abs() < 1e-9, "{sum}");
        assert_eq!(cells, [6, 3]);
    }
}
