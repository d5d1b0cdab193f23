//! The instants at which a function of one variable, or one of its derivatives, jumps: by halving intervals whose
//! bounds do not exclude it.

use super::bounds::Bounds;
use super::jet::Jet;
use super::range::Range;

/// Intervals that are looked at for one switch. A switch takes two a halving, about a hundred; more of them where a
/// function compares numbers that hardly differ.
const MOST_INTERVALS: u32 = 1_000;
/// An interval of this share of the whole holds a switch to round-off.
const SHORTEST: f64 = 1e-16;
/// Numbers at most at which a function is neither as before a switch nor as behind it: a few, by the round-off of what
/// it compares.
const MOST_BETWEEN: u32 = 4;
/// Changes below this share of the values are round-off.
const ROUND_OFF: f64 = 1e-9;

/// A function by its values and by its bounds.
#[derive(Clone, Copy)]
pub struct Bounded<'a> {
    /// Value and derivatives at a point.
    pub jet: &'a dyn Fn(f64) -> Jet,
    /// Bounds over an interval.
    pub bounds: &'a dyn Fn(Range) -> Bounds,
}

impl Bounded<'_> {
    /// The first number above `from` and up to `to` at which the function switches: from there on it is as behind the
    /// switch. None: it does not, or it may do so everywhere.
    pub fn first_switch(&self, [from, to]: [f64; 2]) -> Option<f64> {
        let mut left = MOST_INTERVALS;
        if from < to { self.search([from, to], SHORTEST * (to - from), &mut left) } else { None }
    }

    fn search(&self, [from, to]: [f64; 2], shortest: f64, left: &mut u32) -> Option<f64> {
        let bounds = (self.bounds)(Range { low: from, high: to });
        if *left == 0 || !bounds.switches {
            return None;
        }
        *left -= 1;
        let middle = from + 0.5 * (to - from);
        if middle <= from || middle >= to || to - from <= shortest {
            return (bounds.follows || self.jumps(from, to)).then(|| self.behind(to));
        }
        self.search([from, middle], shortest, left).or_else(|| self.search([middle, to], shortest, left))
    }

    /// The first number from `at` on that is behind a switch: `sign(0)` and the slope of `|x|` at 0 are neither what is
    /// before nor what is behind.
    fn behind(&self, mut at: f64) -> f64 {
        for _ in 0..MOST_BETWEEN {
            if !self.jumps(at, at.next_up()) {
                break;
            }
            at = at.next_up();
        }
        at
    }

    /// Whether value or derivatives at two neighboring numbers differ by more than round-off: two pieces of a function
    /// may be the same.
    fn jumps(&self, from: f64, to: f64) -> bool {
        let [before, after] = [from, to].map(self.jet).map(|jet| [jet.value, jet.first, jet.second]);
        before.iter().zip(&after).any(|(a, b)| (b - a).abs() > ROUND_OFF * (a.abs() + b.abs()))
    }
}
