//! A function given by points: between them straight lines or a monotone cubic, outside of them what the file says.

use crate::math::bounds::Bounds;
use crate::math::jet::Jet;
use crate::math::monotone::{cubic, slopes};
use crate::math::range::Range;

/// Points of a table at most: a hundred seconds at a kilohertz.
pub const MOST_ROWS: usize = 100_000;

/// Points within an interval at most for which bounds are computed one by one.
const FEW: usize = 8;

/// What stands between two points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Interpolation {
    /// A straight line.
    Linear,
    /// A cubic that is monotone where the points are.
    Monotone,
}

/// What a table is before its first point and behind its last one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// The value of the nearest point.
    Hold,
    /// The table again: the last point is the first one of the next period.
    Repeat,
    /// Nothing: not-a-number.
    Error,
}

/// A function given by points.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    x: Vec<f64>,
    y: Vec<f64>,
    /// The derivatives at the points; empty where the points are joined by straight lines.
    slopes: Vec<f64>,
    outside: Outside,
}

impl Table {
    /// Through points whose `x` ascend: two or more.
    pub fn new(x: Vec<f64>, y: Vec<f64>, interpolation: Interpolation, outside: Outside) -> Self {
        assert!(x.len() == y.len() && x.len() >= 2, "the reader checks the rows");
        let slopes = match interpolation {
            Interpolation::Linear => Vec::new(),
            Interpolation::Monotone => slopes(&x, &y, outside == Outside::Repeat && y.first() == y.last()),
        };
        Self { x, y, slopes, outside }
    }

    /// The arguments of the first and the last point.
    pub fn range(&self) -> [f64; 2] {
        [self.x[0], self.x[self.x.len() - 1]]
    }

    /// Whether it has no value outside of its points.
    pub fn has_an_end(&self) -> bool {
        self.outside == Outside::Error
    }

    /// Whether it has no value at `x`.
    pub fn is_undefined(&self, x: f64) -> bool {
        let [first, last] = self.range();
        self.outside == Outside::Error && (x < first || x > last)
    }

    /// Value and derivatives at `x`; where two pieces meet, those of the piece that begins there.
    pub fn jet(&self, x: f64) -> Jet {
        let [first, last] = self.range();
        if x.is_nan() || self.is_undefined(x) {
            return Jet { value: f64::NAN, first: f64::NAN, second: f64::NAN };
        }
        match self.outside {
            Outside::Hold if x < first => Jet::constant(self.y[0]),
            Outside::Hold if x >= last => Jet::constant(self.y[self.y.len() - 1]),
            Outside::Repeat => self.inside(self.within(x)),
            Outside::Hold | Outside::Error => self.inside(x),
        }
    }

    /// The place in the first period that `x` stands for.
    fn within(&self, x: f64) -> f64 {
        let [first, last] = self.range();
        let within = x - self.periods(x) * (last - first);
        // Rounding may put it on the end, which is the beginning of the next period.
        if (first..last).contains(&within) { within } else { first }
    }

    /// How many periods `x` is behind the first one: a whole number.
    fn periods(&self, x: f64) -> f64 {
        let [first, last] = self.range();
        ((x - first) / (last - first)).floor()
    }

    /// `x`, or the next number where rounding would count it to the period before `number`.
    fn raised(&self, x: f64, number: f64) -> f64 {
        if self.periods(x) < number { x.next_up() } else { x }
    }

    /// The number of the point that begins the piece in which `x` is.
    fn piece(&self, x: f64) -> usize {
        self.x.partition_point(|known| *known <= x).clamp(1, self.x.len() - 1) - 1
    }

    fn inside(&self, x: f64) -> Jet {
        let k = self.piece(x);
        let (ends, values) = ([self.x[k], self.x[k + 1]], [self.y[k], self.y[k + 1]]);
        if self.slopes.is_empty() {
            let slope = (values[1] - values[0]) / (ends[1] - ends[0]);
            // From the nearer end, which makes both of them exact.
            let near = usize::from(x - ends[0] > ends[1] - x);
            return Jet { value: values[near] + slope * (x - ends[near]), first: slope, second: 0.0 };
        }
        cubic(ends, values, [self.slopes[k], self.slopes[k + 1]], x)
    }

    /// Where its derivative jumps, ascending, at most `most` places: of one that repeats itself from `from` to `to`.
    pub fn breaks(&self, [from, to]: [f64; 2], most: usize) -> Vec<f64> {
        let last = self.x.len() - 1;
        let is_smooth = !self.slopes.is_empty();
        let is_joined = self.outside == Outside::Repeat && self.y[0] == self.y[last];
        let is_break = |k: usize| if k == 0 || k == last { !(is_smooth && is_joined) } else { !is_smooth };
        let own: Vec<f64> = (0..=last).filter(|k| is_break(*k)).map(|k| self.x[k]).collect();
        if self.outside != Outside::Repeat {
            return own.into_iter().take(most).collect();
        }
        // The last point is the first one of the next period.
        let own = &own[..own.len().saturating_sub(1)];
        let period = self.x[last] - self.x[0];
        let begin = self.periods(from);
        let mut breaks = Vec::new();
        let mut number = begin;
        while !own.is_empty() && breaks.len() < most && self.x[0] + number * period <= to {
            let shifted = own.iter().map(|x| self.raised(x + number * period, number));
            breaks.extend(shifted.filter(|x| (from..=to).contains(x)));
            if number + 1.0 == number {
                break;
            }
            number += 1.0;
        }
        breaks.truncate(most);
        breaks
    }

    /// Bounds of the table and its derivatives over those of its argument.
    pub fn over(&self, argument: Bounds) -> Bounds {
        let Range { low, high } = argument.value;
        let [first, last] = self.range();
        let unbounded = Bounds { follows: argument.follows, ..Bounds::default().unbounded() };
        let may_switch = Bounds { switches: !argument.follows, ..unbounded };
        if !argument.value.is_finite() {
            return may_switch;
        }
        let (low, high) = match self.outside {
            Outside::Hold if high < first || low >= last => return Bounds::constant(self.jet(low).value),
            Outside::Error if low < first || high > last => return may_switch,
            Outside::Hold | Outside::Error => (low, high),
            Outside::Repeat if self.periods(low) == self.periods(high) => (self.within(low), self.within(high)),
            Outside::Repeat => return may_switch,
        };
        let leaves = self.outside == Outside::Hold && (low < first || high >= last);
        let (low, high) = (low.max(first), high.min(last));
        let (begin, end) = (self.piece(low), self.piece(high));
        let passes_corner = leaves || (begin < end && self.slopes.is_empty());
        let found = if end - begin > FEW {
            unbounded
        } else {
            let pieces = (begin..=end).map(|k| self.piece_over(k, [low.max(self.x[k]), high.min(self.x[k + 1])]));
            pieces.reduce(Bounds::either).expect("there is a piece")
        };
        let found = if leaves { found.either(Bounds { value: found.value, ..Bounds::default() }) } else { found };
        Bounds { switches: passes_corner && !argument.follows, follows: argument.follows, ..found }
    }

    /// Bounds of piece `k` between two numbers in it.
    fn piece_over(&self, k: usize, [from, to]: [f64; 2]) -> Bounds {
        let (ends, values) = ([self.x[k], self.x[k + 1]], [self.y[k], self.y[k + 1]]);
        if self.slopes.is_empty() {
            let slope = Range::point((values[1] - values[0]) / (ends[1] - ends[0]));
            let value = |x: f64| if x == ends[1] { values[1] } else { self.inside(x).value };
            return Bounds { value: Range::of(&[value(from), value(to)]), first: slope, ..Bounds::default() };
        }
        let jet = |x: f64| cubic(ends, values, [self.slopes[k], self.slopes[k + 1]], x);
        let [a, b] = [jet(from), jet(to)];
        // The slope is largest, or least, where its derivative, a straight line, is 0.
        let turn = if a.second * b.second < 0.0 { from + (to - from) * a.second / (a.second - b.second) } else { from };
        Bounds {
            value: Range::of(&[a.value, b.value]),
            first: Range::of(&[a.first, b.first, jet(turn).first]),
            second: Range::of(&[a.second, b.second]),
            ..Bounds::default()
        }
    }
}
