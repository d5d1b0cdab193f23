//! A number that may depend on time (or on the curve parameter): one expression, or pieces with ascending limits.

use super::breaks::{breaks, has_corners};
use super::program::Undefined;
use super::{Jet, Program};
use crate::math::bounds::Bounds;
use crate::math::range::Range;
use crate::math::switches::Bounded;

/// Switches of a function at most at which steps end: far more than anybody has steps for.
pub const MOST_SWITCHES: f64 = 1e6;
/// Parts of the time in which they are counted, and how many there.
const PARTS: u32 = 8;
const COUNTED: u32 = 16;
/// Golden ratio less 1: parts at even distances could all miss what repeats itself.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// One piece: valid while the variable is below `until`; the last one has no limit.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// The limit, free of the variable; none: for ever.
    pub until: Option<Program>,
    /// The value.
    pub is: Program,
}

/// A number as written: it still knows the parameters it uses.
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pieces: Vec<Piece>,
}

impl Formula {
    /// One expression.
    pub fn single(is: Program) -> Self {
        Self { pieces: vec![Piece { until: None, is }] }
    }

    /// Several pieces, of which the last has no limit.
    pub fn piecewise(pieces: Vec<Piece>) -> Self {
        assert!(pieces.last().is_some_and(|piece| piece.until.is_none()), "the reader checks the pieces");
        Self { pieces }
    }

    /// Whether the variable does not occur: neither in a piece nor by there being several.
    pub fn is_constant(&self) -> bool {
        self.pieces.len() == 1 && self.pieces[0].is.is_constant()
    }

    /// Whether a table in it has no value outside of its rows.
    pub fn may_be_undefined(&self) -> bool {
        self.pieces.iter().any(|piece| piece.is.may_be_undefined())
    }

    /// Whether the rate of the variable occurs, or what stands in its place.
    pub fn has_rate(&self) -> bool {
        self.pieces.iter().any(|piece| piece.is.has_rate())
    }

    /// The numbers of the readings that occur, ascending.
    pub fn readings(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.pieces.iter().flat_map(|piece| piece.is.readings()).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// The parameters that occur, repeats included.
    pub fn parameters(&self) -> impl Iterator<Item = usize> + '_ {
        let programs = self.pieces.iter().flat_map(|piece| piece.until.iter().chain([&piece.is]));
        programs.flat_map(Program::parameters)
    }

    /// The table that has no value at an end of a piece between `from` and `to`, and that end; none: none is known.
    pub fn undefined_between(&self, range: [f64; 2], parameters: impl Fn(usize) -> f64) -> Option<(f64, Undefined)> {
        self.unfolded(parameters).undefined_between(range)
    }

    /// With the parameters as numbers.
    pub fn bound(&self, parameters: impl Fn(usize) -> f64) -> Function {
        let Function { limits, pieces } = self.unfolded(parameters);
        Function { limits, pieces: pieces.into_iter().map(Program::folded).collect() }
    }

    /// With the parameters as numbers, and pieces as they are written.
    fn unfolded(&self, parameters: impl Fn(usize) -> f64) -> Function {
        let last = self.pieces.len() - 1;
        let limit = |piece: &Piece| piece.until.as_ref().map_or(f64::INFINITY, |until| until.value(0.0, &parameters));
        Function {
            limits: self.pieces[..last].iter().map(limit).collect(),
            pieces: self.pieces.iter().map(|piece| piece.is.bound(&parameters)).collect(),
        }
    }
}

/// A number that may depend on time, ready for evaluation: no parameters, no allocation.
///
/// Outside the domain of a function in it (`sqrt(-1)`) value and derivatives are NaN: the caller knows the time and the
/// name ([`crate::model::document::Document::name`]) for the message.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    limits: Vec<f64>,
    pieces: Vec<Program>,
}

impl Function {
    /// The function that does not change.
    pub fn constant(value: f64) -> Self {
        Self { limits: Vec::new(), pieces: vec![Program::constant(value)] }
    }

    /// Whether it does not depend on the variable.
    pub fn is_constant(&self) -> bool {
        self.limits.is_empty() && self.pieces[0].is_constant()
    }

    /// `f(t)`.
    pub fn value(&self, t: f64) -> f64 {
        self.jet(t).value
    }

    /// `(f, f', f'')` at t; at a limit those of the piece that begins there.
    pub fn jet(&self, t: f64) -> Jet {
        self.pieces[self.piece(t)].jet(t, |_| f64::NAN)
    }

    /// `f` at the variable `x` and its rate `v`, with its derivatives with respect to both.
    pub fn with_rate(&self, x: f64, v: f64) -> [f64; 3] {
        let piece = &self.pieces[self.piece(x)];
        let by_x = piece.evaluated(Jet::variable(x), Jet::constant(v));
        if !piece.has_rate() {
            return [by_x.value, by_x.first, 0.0];
        }
        let by_v = piece.evaluated(Jet::constant(x), Jet::variable(v));
        [by_x.value, by_x.first, by_v.first]
    }

    /// `f` at t with the readings as they are.
    pub fn with_readings(&self, t: f64, readings: &dyn Fn(usize) -> Jet) -> Jet {
        self.pieces[self.piece(t)].with_readings(t, readings)
    }

    /// The numbers of the readings that occur, ascending.
    pub fn readings(&self) -> Vec<usize> {
        let mut all: Vec<usize> = self.pieces.iter().flat_map(Program::readings).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// Whether it may have corners, or jumps, besides those between its pieces.
    pub fn has_corners(&self) -> bool {
        self.pieces.iter().any(has_corners)
    }

    /// Whether the rate of the variable occurs.
    pub fn has_rate(&self) -> bool {
        self.pieces.iter().any(Program::has_rate)
    }

    /// The same function with the rate of the variable, or what stands in its place, as a number.
    #[must_use]
    pub fn at_rate(&self, rate: f64) -> Self {
        let pieces = self.pieces.iter().map(|piece| piece.clone().at_rate(rate)).collect();
        Self { limits: self.limits.clone(), pieces }
    }

    /// Bounds of `f` and its derivatives over an interval; where pieces meet in it, nothing is known but that.
    pub fn over(&self, interval: Range) -> Bounds {
        let piece = self.piece(interval.low);
        if piece == self.piece(interval.high) {
            self.pieces[piece].over(Bounds::variable(interval))
        } else {
            Bounds { switches: true, ..Bounds::default().unbounded() }
        }
    }

    /// What `work` finds with the function and its bounds.
    pub fn bounded<T>(&self, work: impl FnOnce(Bounded) -> T) -> T {
        work(Bounded { jet: &|t| self.jet(t), bounds: &|interval| self.over(interval) })
    }

    /// Whether it switches more than [`MOST_SWITCHES`] times between `from` and `to`, by its switches in a few short
    /// parts of that.
    pub fn switches_too_often(&self, span: [f64; 2]) -> bool {
        self.shortest_switching(span).is_some_and(|period| (span[1] - span[0]) / period > MOST_SWITCHES)
    }

    /// The mean time between its switches, where they are so many in a short part of the time from `from` to `to` that
    /// steps do not follow; none: they are few.
    pub fn shortest_switching(&self, [from, to]: [f64; 2]) -> Option<f64> {
        // One look at the whole time does for most functions.
        if !self.over(Range { low: from, high: to }).switches {
            return None;
        }
        let length = f64::from(COUNTED) * (to - from) / MOST_SWITCHES;
        self.bounded(|bounded| {
            (0..PARTS).find_map(|part| {
                let begin = from + (f64::from(part) * GOLDEN).fract() * (to - from - length);
                let mut at = begin;
                for _ in 0..COUNTED {
                    at = bounded.first_switch([at, begin + length])?;
                }
                Some((at - begin) / f64::from(COUNTED))
            })
        })
    }

    /// The number of the piece that is valid at t.
    fn piece(&self, t: f64) -> usize {
        self.limits.iter().position(|limit| t < *limit).unwrap_or(self.limits.len())
    }

    /// Where its pieces meet, and where tables in it have corners, ascending; of tables that repeat themselves between
    /// `from` and `to` only.
    pub fn breaks(&self, [from, to]: [f64; 2]) -> Vec<f64> {
        let mut all = self.limits.clone();
        for (k, piece) in self.pieces.iter().enumerate() {
            let [begin, end] = self.validity(k, [f64::NEG_INFINITY, f64::INFINITY]);
            let corners = breaks(piece, self.validity(k, [from, to])).into_iter();
            all.extend(corners.filter(|at| at.is_finite() && begin < *at && *at < end));
        }
        if all.len() > self.limits.len() {
            all.sort_by(f64::total_cmp);
            all.dedup();
        }
        all
    }

    /// Where piece `k` is valid between `from` and `to`.
    fn validity(&self, k: usize, [from, to]: [f64; 2]) -> [f64; 2] {
        let begin = k.checked_sub(1).map_or(from, |before| self.limits[before].max(from));
        [begin, self.limits.get(k).map_or(to, |limit| limit.min(to))]
    }

    /// The table that has no value at t; none: all have one.
    pub fn undefined(&self, t: f64) -> Option<Undefined> {
        self.pieces[self.piece(t)].undefined(t)
    }

    /// Whether a table in it has no value outside of its rows.
    pub fn may_be_undefined(&self) -> bool {
        self.pieces.iter().any(Program::may_be_undefined)
    }

    fn undefined_between(&self, range: [f64; 2]) -> Option<(f64, Undefined)> {
        let last = self.pieces.len() - 1;
        let ends = (0..=last).flat_map(|k| {
            let [begin, end] = self.validity(k, range);
            let end = if k < last && end == self.limits[k] { end.next_down() } else { end };
            (begin <= end).then_some([begin, end])
        });
        let undefined = |t: f64| if self.value(t).is_nan() { Some((t, self.undefined(t)?)) } else { None };
        ends.flatten().find_map(undefined)
    }

    /// What is wrong with the limits: they must be finite and ascend.
    pub fn objection(&self) -> Option<String> {
        if let Some(limit) = self.limits.iter().find(|limit| !limit.is_finite()) {
            return Some(format!("must have finite limits, this one is {limit}"));
        }
        let descent = self.limits.windows(2).find(|pair| pair[0] >= pair[1])?;
        Some(format!("must have ascending limits, but {} comes after {}", descent[1], descent[0]))
    }
}
