//! A flexible line of given length between two points, as it hangs, with the part of it that lies on level ground.
//!
//! Coordinates are those of the vertical plane of both points, `x` from the first one towards the second, `z` upwards.
//! By the arc length `σ` from the lowest point an arc is `x = a asinh(σ/a)`, `z = √(a² + σ²) − a`, with the horizontal
//! force over the weight per length, `a`. On the ground, two arcs of the same `a` end in a straight piece.

use super::jet::Jet;
use crate::math::elementary::{asinh, atanh, hypot, ln_1p, sinh};

/// Least horizontal distance of the ends, as a share of the length.
const LEAST_DISTANCE: f64 = 1e-6;
/// The length beyond the distance of the ends, as a share, below which a line is straight.
const STRAIGHT: f64 = 1e-9;
/// Halvings of an interval that has the solution: more than a double has digits.
const HALVINGS: usize = 200;

/// Why there is no such line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NoCatenary {
    /// The line is not longer than the distance of its ends, m.
    Short(f64),
    /// The ends are above each other.
    Vertical,
    /// An end is below the ground.
    Below,
    /// A line on the ground is so long that it would be in a heap: it must be shorter than this, m.
    Heap(f64),
}

/// The line: two arcs with a straight piece between, which may have no length.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Catenary {
    a: f64,
    /// Arc length at which the first arc ends, or would, and where that is.
    lowest: f64,
    bottom: [f64; 2],
    /// Length of the straight piece.
    laid: f64,
}

impl Catenary {
    /// A line of `length` from the origin to `end`, `x > 0` and `z`, m; `ground` is the height of level ground.
    ///
    /// # Errors
    /// There is none.
    pub fn new(length: f64, end: [f64; 2], ground: Option<f64>) -> Result<Self, NoCatenary> {
        let [distance, rise] = end;
        let chord = hypot(distance, rise);
        if length <= chord * (1.0 + STRAIGHT) {
            return Err(NoCatenary::Short(chord));
        }
        if distance <= LEAST_DISTANCE * length {
            return Err(NoCatenary::Vertical);
        }
        let free = Self::free(length, [distance, rise]);
        let Some(ground) = ground else { return Ok(free) };
        let heights = [-ground, rise - ground];
        if heights.iter().any(|height| *height < -STRAIGHT * length) {
            return Err(NoCatenary::Below);
        }
        let is_inside = 0.0 < free.lowest && free.lowest < length;
        if !is_inside || free.bottom[1] >= ground {
            return Ok(free);
        }
        Self::on_ground(length, distance, heights.map(|height| height.max(0.0)), ground)
    }

    /// Without ground: `√(L² − z²) = 2 a sinh(x/2a)`.
    fn free(length: f64, [distance, rise]: [f64; 2]) -> Self {
        let ratio = (length * length - rise * rise).sqrt() / distance;
        let u = root([1e-12, 1e3], |u| sinh(u) / u < ratio);
        let a = distance / (2.0 * u);
        let first = atanh(rise / length) - u;
        let lowest = -a * sinh(first);
        Self { a, lowest, bottom: [-a * first, a - hypot(a, lowest)], laid: 0.0 }
    }

    /// Both arcs end at the ground, with the ends at these heights above it: `L − x = Σ (σ_i − x_i)`.
    fn on_ground(length: f64, distance: f64, heights: [f64; 2], ground: f64) -> Result<Self, NoCatenary> {
        let longest = distance + heights[0] + heights[1];
        if length >= longest * (1.0 - STRAIGHT) {
            return Err(NoCatenary::Heap(longest));
        }
        let arc = |a: f64, height: f64| [(height * (height + 2.0 * a)).sqrt(), a * acosh_beyond(height / a)];
        let spare = |a: f64| heights.iter().map(|height| arc(a, *height)).map(|[along, x]| along - x).sum::<f64>();
        let a = root([1e-12 * length, 1e9 * length], |a| spare(a) > length - distance);
        let [first, second] = heights.map(|height| arc(a, height));
        Ok(Self { a, lowest: first[0], bottom: [first[1], ground], laid: (length - first[0] - second[0]).max(0.0) })
    }

    /// `x` and `z` at the arc length `s`.
    pub fn at(&self, s: f64) -> [Jet; 2] {
        let Self { a, lowest, bottom: [x, z], laid } = *self;
        let (sigma, before) = if s < lowest {
            (s - lowest, 0.0)
        } else if s <= lowest + laid {
            return [Jet { value: x + s - lowest, first: 1.0, second: 0.0 }, Jet::constant(z)];
        } else {
            (s - lowest - laid, laid)
        };
        let root = hypot(a, sigma);
        let cube = root * root * root;
        [
            Jet { value: x + before + a * asinh(sigma / a), first: a / root, second: -a * sigma / cube },
            Jet { value: z + root - a, first: sigma / root, second: a * a / cube },
        ]
    }

    /// Where its pieces meet.
    pub fn limits(&self) -> Vec<f64> {
        if self.laid > 0.0 { vec![self.lowest, self.lowest + self.laid] } else { Vec::new() }
    }
}

/// `acosh(1 + x)`.
fn acosh_beyond(x: f64) -> f64 {
    ln_1p(x + (x * (x + 2.0)).sqrt())
}

/// Where `is_first` ends in an interval of positive numbers.
fn root([mut from, mut to]: [f64; 2], is_first: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = (from * to).sqrt();
        *(if is_first(middle) { &mut from } else { &mut to }) = middle;
    }
    (from * to).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// It begins and ends where it must, has the speed 1, and on the ground it is level.
    #[test]
    fn ends_and_speed() {
        let cases = [(170.0, [100.0, 50.0], None), (110.0, [100.0, -30.0], None), (410.0, [400.0, 50.0], Some(0.0))];
        for (length, end, ground) in cases.into_iter().chain([(480.0, [400.0, 10.0], Some(-50.0))]) {
            let line = Catenary::new(length, end, ground).unwrap();
            let [first, last] = [0.0, length].map(|s| line.at(s).map(|jet| jet.value));
            assert!(first.iter().all(|value| value.abs() < 1e-9 * length), "{first:?}");
            assert!((0..2).all(|i| (last[i] - end[i]).abs() < 1e-9 * length), "{last:?}");
            for number in 0..=40 {
                let [x, z] = line.at(length * f64::from(number) / 40.0);
                assert!((x.first.hypot(z.first) - 1.0).abs() < 1e-12);
                assert!(ground.is_none_or(|ground| z.value >= ground - 1e-9));
            }
        }
    }

    /// A chain of 410 m with its end 50 m above the ground lies there up to the point that the closed form of a line
    /// without stretch gives: `a = (σ² − z²)/2z` with `L − σ + a asinh(σ/a) = 400`.
    #[test]
    fn laid_length() {
        let line = Catenary::new(410.0, [400.0, 50.0], Some(0.0)).unwrap();
        let sigma = 410.0 - line.laid;
        let a = (sigma * sigma - 2500.0) / 100.0;
        assert!((line.a - a).abs() < 1e-6 * a && line.lowest == 0.0);
        assert!((line.laid + a * (sigma / a).asinh() - 400.0).abs() < 1e-9);
    }

    /// Impossible lines are told.
    #[test]
    fn impossible_lines() {
        assert_eq!(Catenary::new(5.0, [3.0, 4.0], None), Err(NoCatenary::Short(5.0)));
        assert_eq!(Catenary::new(5.0, [0.0, 4.0], None), Err(NoCatenary::Vertical));
        assert_eq!(Catenary::new(9.0, [3.0, 4.0], Some(1.0)), Err(NoCatenary::Below));
        assert_eq!(Catenary::new(9.0, [3.0, 4.0], Some(0.0)), Err(NoCatenary::Heap(7.0)));
    }
}
