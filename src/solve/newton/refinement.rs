//! How small refinements make what remains of an equilibrium: solutions with the factors of the last iteration.
//!
//! The first refinement is what the last correction has left. The matrix is that of the place before that correction, which has turned slopes by some `w`: a refinement `e` leaves a share of the order of
//! `w`, and an axial strain `w e`, whose force bends the beam by `EA w² e`. So refinements shrink by `w + (λ w)²`, with the slenderness `λ` of beams, `λ² = EA L²/EI`.
//!
//! That holds where the matrix has the axial forces that the last correction was to lead to (MECHANICS 7.12). A matrix with the forces of stretched springs, which are about to relax, makes corrections small, and refinements too.

use super::MOST_REFINEMENTS;

/// Slowest shrinking of corrections from which what remains is estimated.
pub const SLOWEST: f64 = 0.5;
/// What refinements leave, as a share of the size below which a correction ends the iteration: Newton's last correction leaves far less than its own size, too.
const LEFT: f64 = 1e-4;

/// Refinements as they are expected, and as the last one has been.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refinements {
    /// The largest that the next one may be: at first what the corrections have left, then the last one.
    largest: f64,
    /// Each over the one before, as expected.
    ratio: f64,
    /// The same of the last two, at first of corrections.
    measured: f64,
    /// Whether there has been one.
    has_begun: bool,
}

/// What a refinement means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outlook {
    /// What remains is small enough.
    Done,
    /// They go on.
    Promising,
    /// They do not shrink.
    Poor,
}

impl Refinements {
    /// Those behind `corrections` of a system of this slenderness; none where corrections or refinements hardly shrink.
    pub fn behind(corrections: &[f64], slenderness: f64) -> Option<Self> {
        let [.., before, last] = corrections else { return None };
        let ratio = last + (slenderness * last).powi(2);
        let measured = last / before;
        let largest = remainder(*last, measured)?;
        (ratio < SLOWEST).then_some(Self { largest, ratio, measured, has_begun: false })
    }

    /// How many are needed for a remainder far below `size`; none where these are too many.
    pub fn needed(self, size: f64) -> Option<usize> {
        (1..=MOST_REFINEMENTS).find(|number| self.largest * self.ratio.powi(*number as i32) < LEFT * size)
    }

    /// Takes `refinement`, for a remainder far below `size`.
    pub fn take(&mut self, refinement: f64, size: f64) -> Outlook {
        if refinement.is_nan() || refinement > self.largest {
            return Outlook::Poor;
        }
        // The second one may hardly be smaller than the first, and the third far smaller: errors in one direction turn into errors in another one.
        if self.has_begun {
            self.measured = refinement / self.largest;
        }
        (self.largest, self.has_begun) = (refinement, true);
        if self.ratio.max(self.measured) * refinement < LEFT * size { Outlook::Done } else { Outlook::Promising }
    }
}

/// What remains after the correction `last`, where each is `ratio` of the one before; none where they hardly shrink, which says nothing about what remains.
pub fn remainder(last: f64, ratio: f64) -> Option<f64> {
    (ratio < SLOWEST).then(|| last * ratio / (1.0 - ratio))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corrections of 0.1 and 1e-3 leave 1e-5, as far as they tell. A beam 500 times as long as it is thick makes refinements shrink by 0.25, one a tenth as long by 3.5e-3.
    #[test]
    fn slender_beams_are_iterated_further() {
        let needed = |slenderness, size| Refinements::behind(&[0.1, 1e-3], slenderness)?.needed(size);
        assert_eq!(needed(50.0, 1e-8), Some(3));
        assert_eq!(needed(50.0, 1e-3), Some(1));
        assert_eq!(needed(500.0, 1e-8), None);
        // Corrections, or refinements, that hardly shrink promise nothing.
        assert_eq!(needed(1000.0, 1.0), None);
        assert_eq!(Refinements::behind(&[0.1, 0.06], 0.0), None);
        assert_eq!(Refinements::behind(&[1e-3], 0.0), None);
    }

    /// They end where the last one and its ratio to the one before leave enough, and where they do not shrink.
    #[test]
    fn refinements_end_by_what_they_are() {
        let expected = Refinements::behind(&[0.1, 1e-3], 50.0).unwrap();
        let outlook = |sizes: &[f64]| {
            let mut own = expected;
            sizes.iter().map(|size| own.take(*size, 1e-8)).last().unwrap()
        };
        assert_eq!(outlook(&[9e-11]), Outlook::Done);
        assert_eq!(outlook(&[1e-6]), Outlook::Promising);
        assert_eq!(outlook(&[1e-6, 2e-10]), Outlook::Done);
        // A half of the one before leaves a half of itself.
        assert_eq!(outlook(&[4e-10, 2e-10]), Outlook::Promising);
        assert_eq!(outlook(&[4e-10, 2e-10, 1e-12]), Outlook::Done);
        // Larger than what corrections have left, larger than the one before, not a number.
        assert_eq!(outlook(&[2e-5]), Outlook::Poor);
        assert_eq!(outlook(&[1e-6, 2e-6]), Outlook::Poor);
        assert_eq!(outlook(&[f64::NAN]), Outlook::Poor);
    }
}
