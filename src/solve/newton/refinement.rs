//! Refinements of a solution: corrections with the matrix of the last iteration. How many of them do the rest, and
//! whether they are as small as they should be (MECHANICS 7.6).

use crate::math::elementary::pow;
use crate::mechanics::state::Shrinking;

/// Most refinements of a solution: together they take less work than the iteration that they replace.
pub const MOST: usize = 4;
/// What more than one refinement may leave, as a share of what one may: the ratio that all of them rely on is that of
/// an earlier step, or of an iteration whose corrections did not shrink at first.
const STRICTNESS: f64 = 1e-4;
/// Corrections are not expected to shrink faster than this: a motion that was linear so far says nothing about one that
/// is not.
const LEAST_RATIO: f64 = 1e-5;
/// Slowest shrinking of corrections from which what remains is estimated.
const SLOWEST: f64 = 0.5;
/// How many times larger than promised a refinement may be.
pub const SURPRISE: f64 = 10.0;
/// Refinements this small are round-off, which does not shrink: it is 1e-14 in shafts and winches, more in cables of
/// kilometers.
const LEAST_ROUND_OFF: f64 = 1e-12;
/// Round-off of a refinement as a share of the largest coordinate: that of the several operations between them.
const SHARE_OF_COORDINATE: f64 = 16.0 * f64::EPSILON;

/// The size of refinements that are round-off, where the largest coordinate has the size `coordinate`: large far from
/// the origin, and after many turns.
pub fn round_off(coordinate: f64) -> f64 {
    f64::max(SHARE_OF_COORDINATE * coordinate, LEAST_ROUND_OFF)
}

/// How many refinements, of at most `most`, do the rest after `corrections`, by the ratio of the last two, or after the
/// first one by the `expected` ratio. One may leave a `size`, and a `share` of the first correction. None: an iteration
/// has to follow.
pub fn needed(corrections: &[f64], [size, share]: [f64; 2], expected: Shrinking, most: usize) -> Option<usize> {
    let [before @ .., last] = corrections else { return None };
    // A first correction below the size itself leaves less than that, whatever was expected.
    if *last <= size {
        return Some(1);
    }
    let size = size + share * corrections[0];
    let ratio = match before.last() {
        Some(before) => last / before.max(f64::MIN_POSITIVE),
        // Quadratic convergence: the ratio grows with the correction.
        None => expected.ratio.max(LEAST_RATIO) * f64::max(1.0, last / expected.first.max(f64::MIN_POSITIVE)),
    };
    // Corrections that hardly shrink say nothing about what remains.
    if ratio >= SLOWEST {
        return None;
    }
    let remainder = last * ratio / (1.0 - ratio);
    (1..=most).find(|times| remainder < largest_remainder(corrections, size, *times))
}

/// The largest remainder after `corrections` that so many refinements make small enough, where one may leave a
/// remainder of `size`. Each takes off the ratio of what remains to the last correction. Where all corrections have
/// shrunk, the last refinement but one has to reach `size`.
pub fn largest_remainder(corrections: &[f64], size: f64, times: usize) -> f64 {
    let last = match corrections {
        [.., last] if times > 1 => last,
        _ => return size,
    };
    let is_measured = corrections.len() > 1 && corrections.windows(2).all(|pair| pair[1] < SLOWEST * pair[0]);
    if is_measured {
        last * pow(size / last, 1.0 / times as f64)
    } else {
        last * pow(STRICTNESS * (size / last).powi(2), 1.0 / (times + 1) as f64)
    }
}

/// What a refinement is held against.
#[derive(Clone, Copy, Debug)]
pub struct Promise {
    /// What one may leave.
    pub bound: f64,
    /// See [`round_off`].
    pub round_off: f64,
    /// Whether refinements have to shrink.
    pub shrinks: bool,
}

impl Promise {
    /// Every refinement is made that is a number.
    pub const NONE: Self = Self { bound: f64::MAX / SURPRISE, round_off: 0.0, shrinks: false };

    /// Whether a refinement is as small as the corrections promised, at most `largest`; `before` is the size of the
    /// refinement before it. Where a correction has stretched a stiff part, the matrix has its tension. It is then
    /// stiffer than the system, and makes refinements small, however much is left, but they do not shrink.
    pub fn is_kept(&self, refinement: f64, before: Option<f64>, largest: f64) -> bool {
        let negligible = f64::max(STRICTNESS * self.bound, self.round_off);
        let has_shrunk = |before| refinement <= negligible || refinement <= SLOWEST * before;
        refinement <= f64::max(SURPRISE * largest, self.round_off) && (!self.shrinks || before.is_none_or(has_shrunk))
    }

    /// Whether a first refinement has shrunk as the last two `corrections` have.
    pub fn keeps_pace(&self, refinement: f64, corrections: &[f64]) -> bool {
        match corrections {
            [.., before, last] if self.shrinks => refinement <= f64::max(last * last / before, self.round_off),
            _ => true,
        }
    }
}
