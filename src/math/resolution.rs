//! How far a midpoint rule sees a function: `∫ f = h f(m) + h³/24 f''(m) + O(h⁵)` over a step of length `h` around `m`.
//! A pulse within the step, which neither value tells, is what the integral has in addition.
//!
//! The integral is that of cells whose bounds prove that the rule is right in each: no pulse is too narrow for it.

use super::jet::Jet;
use super::range::Range;
use super::switches::Bounded;

/// A step that is to see a function may miss this share of `∫ |f|`, without the term of the second derivative: a sine
/// of 2.5 steps a period.
const SEEN: f64 = 0.05;
/// A step that is all there is of a pulse may miss this share, with that term: a sine of 9 steps a period.
const RESOLVED: f64 = 0.02;
/// A part of a step that misses more may miss this share of the whole: a fifth of the default accuracy of the steps.
const FINE: f64 = 2e-4;
/// A cell may miss this share of its own integral at first; then this one, or that share of the whole.
const COARSE_CELL: f64 = 0.25;
const CELL: f64 = 1e-3;
const CELL_OF_WHOLE: f64 = 1e-5;
/// A pulse is what has less than this share of its largest value on average over the step: a sine has 0.64 of it, its
/// square 0.5. What oscillates, the error of the steps tells.
const PULSE: f64 = 0.4;
/// Values that tell an oscillation without an integral, and the distance between them, the golden ratio less 1.
const VALUES: u32 = 8;
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Values below this share of the largest ones of a function are none.
const QUIET: f64 = 1e-6;
/// Cells at first at most: a pulse takes a few dozens, and some more for every halving of its width. What needs more of
/// them oscillates many times within a step, which the error of the steps tells.
const MOST_COARSE_CELLS: u32 = 250;
const MOST_CELLS: u32 = 2_000;
/// Halvings at most.
const DEEPEST: i32 = 50;
/// Halvings on the way to a largest value.
const HALVINGS: usize = 60;

/// What a step has to see of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// That there are no pulses within it: how it changes, other steps see.
    Pulses,
    /// How it changes: the step is all there is of a piece.
    Changes,
}

impl Sight {
    /// The share of the integral that may be missing, and how much of the term of the second derivative counts as seen.
    fn allowed(self) -> (f64, f64) {
        match self {
            Self::Pulses => (SEEN, 1.0),
            Self::Changes => (RESOLVED, 0.0),
        }
    }
}

/// What a cell may miss: a share of its own integral, or an integral, and the values that count as none.
#[derive(Clone, Copy, Debug)]
struct Allowed {
    share: f64,
    least: f64,
    quiet: f64,
    cells: u32,
}

/// An integral by cells.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    /// `∫ f`.
    value: f64,
    /// `∫ |f|`.
    size: f64,
    /// The largest `|f|`.
    largest: f64,
    cells: u32,
}

impl Bounded<'_> {
    /// A large absolute value of the function in an interval, that of the narrowest pulse included.
    pub fn peak(&self, [mut from, mut to]: [f64; 2]) -> f64 {
        let largest = |from: f64, to: f64| (self.bounds)(Range { low: from, high: to }).value.largest();
        let mut peak = 0.0;
        for _ in 0..HALVINGS {
            let middle = from + 0.5 * (to - from);
            peak = f64::max(peak, (self.jet)(middle).value.abs());
            if middle <= from || middle >= to {
                break;
            }
            (from, to) = if largest(from, middle) >= largest(middle, to) { (from, middle) } else { (middle, to) };
        }
        peak
    }

    /// The end of a step from `from` on the way to `to` that sees the function, whose largest value is `peak`: `to`,
    /// unless there is a pulse in between.
    pub fn seen_until(&self, [from, to]: [f64; 2], peak: f64, sight: Sight) -> f64 {
        let (share, curvature) = sight.allowed();
        let quiet = QUIET * peak;
        let at_first = Allowed { share, least: 0.0, quiet, cells: 0 };
        if self.is_sure([from, to], curvature, at_first) {
            return to;
        }
        if sight == Sight::Pulses && self.mean([from, to]) > PULSE * peak {
            return to;
        }
        let coarse = Allowed { share: COARSE_CELL, cells: MOST_COARSE_CELLS, ..at_first };
        let first = self.sum([from, to], coarse);
        let oscillates = sight == Sight::Pulses && first.size > PULSE * (to - from) * first.largest;
        if first.cells > MOST_COARSE_CELLS || oscillates {
            return to;
        }
        let fine = Allowed { share: CELL, least: CELL_OF_WHOLE * first.size, quiet, cells: MOST_CELLS };
        let whole = self.sum([from, to], fine);
        let missed = self.missed([from, to], whole.value, curvature);
        // Not-a-number is left to the step.
        if missed.is_nan() || missed <= share * whole.size {
            return to;
        }
        let part = |halvings: i32| from + (to - from) * 0.5_f64.powi(halvings);
        let is_seen = |end: f64| {
            let missed = self.missed([from, end], self.sum([from, end], fine).value, 0.0);
            missed <= FINE * whole.size
        };
        (1..DEEPEST).map(part).find(|end| is_seen(*end)).unwrap_or_else(|| part(DEEPEST))
    }

    /// The mean size by a few values.
    fn mean(&self, [from, to]: [f64; 2]) -> f64 {
        let value = |k: u32| (self.jet)(from + (0.5 + f64::from(k) * GOLDEN).fract() * (to - from)).value.abs();
        (0..VALUES).map(value).sum::<f64>() / f64::from(VALUES)
    }

    /// What the rule misses of an integral, with the share `curvature` of the term of the second derivative.
    fn missed(&self, [from, to]: [f64; 2], integral: f64, curvature: f64) -> f64 {
        let (h, jet) = (to - from, (self.jet)(from + 0.5 * (to - from)));
        (integral - h * jet.value - curvature * bend(h, jet)).abs()
    }

    /// Whether the bounds prove that the rule, with the share `curvature` of the term of the second derivative, misses
    /// no more than is allowed.
    fn is_sure(&self, [from, to]: [f64; 2], curvature: f64, allowed: Allowed) -> bool {
        let bounds = (self.bounds)(Range { low: from, high: to });
        // A function with other variables is not known, and one that still switches here does so everywhere.
        if bounds.follows || bounds.switches || bounds.value.largest() <= allowed.quiet {
            return true;
        }
        let h = to - from;
        let second = if curvature == 0.0 { bounds.second.largest() } else { bounds.second.width() };
        let error = f64::min(bounds.value.width(), h * h / 24.0 * second);
        let value = |time: f64| (self.jet)(time).value.abs();
        let size = || 0.25 * (value(from) + 2.0 * value(from + 0.5 * h) + value(to));
        // Not-a-number is not proved wrong by any halving.
        error.is_nan() || error * h <= allowed.least || error <= allowed.share * size()
    }

    fn sum(&self, range: [f64; 2], allowed: Allowed) -> Sum {
        let mut sum = Sum::default();
        self.add_cells(range, allowed, 0, &mut sum);
        sum
    }

    fn add_cells(&self, [from, to]: [f64; 2], allowed: Allowed, depth: i32, sum: &mut Sum) {
        if depth == DEEPEST || sum.cells > allowed.cells || self.is_sure([from, to], 1.0, allowed) {
            let (h, jet) = (to - from, (self.jet)(from + 0.5 * (to - from)));
            sum.value += h * jet.value + bend(h, jet);
            sum.size += h * jet.value.abs();
            sum.largest = sum.largest.max(jet.value.abs());
            sum.cells += 1;
            return;
        }
        let middle = from + 0.5 * (to - from);
        self.add_cells([from, middle], allowed, depth + 1, sum);
        self.add_cells([middle, to], allowed, depth + 1, sum);
    }
}

/// The term of the second derivative in the integral over `h`; 0 where the derivatives overflow, as in the tail of
/// `1/cosh(x)^2`.
fn bend(h: f64, jet: Jet) -> f64 {
    if jet.second.is_finite() { h * h * h / 24.0 * jet.second } else { 0.0 }
}
