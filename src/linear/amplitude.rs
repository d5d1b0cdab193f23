//! The estimated share of nonlinearity at the present amplitude, which the unit has as an output.
//!
//! Every motion of the states has an amplitude `a`. It moves the outputs with one unit by a linear part `l a`, an even
//! part `e a²` and an odd part `o a³`. These were measured where the file was made. Linear and nonlinear parts of all
//! motions have the sums `L` and `N`, and the share is `N/(L + N)`. The unit with the largest share counts.

use super::matrix::Matrix;
use crate::math::elementary::hypot;

/// The name of the output, and its meaning.
pub(super) const NAME: &str = "amplitude_error";
pub(super) const MEANING: &str = "Estimated share of nonlinearity in the outputs at the present amplitude";
/// The share from which on a warning appears.
pub(super) const WARNED: f64 = 0.01;
/// Most units of outputs: their sums stand on the stack.
pub const MOST_KINDS: usize = 16;

/// Motions of the states, a row each.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Amplitude {
    /// The amplitude is the size of the sum of the states times these complex numbers.
    pub real: Matrix,
    /// Their imaginary parts.
    pub imaginary: Matrix,
    /// Linear parts, a column for each unit of outputs.
    pub linear: Matrix,
    /// Even parts.
    pub even: Matrix,
    /// Odd parts.
    pub odd: Matrix,
}

/// Sums over all motions for each unit, and their derivatives.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    linear: f64,
    nonlinear: f64,
    linear_rate: f64,
    nonlinear_rate: f64,
}

impl Sum {
    fn share(&self) -> f64 {
        match self.linear + self.nonlinear {
            0.0 => 0.0,
            // Far beyond all that is known, also where the third power is too large for a number.
            whole if !whole.is_finite() => 1.0,
            whole => self.nonlinear / whole,
        }
    }

    fn share_rate(&self) -> f64 {
        let whole = self.linear + self.nonlinear;
        let rate = (self.nonlinear_rate - self.share() * (self.linear_rate + self.nonlinear_rate)) / whole;
        if rate.is_finite() { rate } else { 0.0 }
    }
}

impl Amplitude {
    /// The matrices with their keys in the file.
    pub(super) fn parts(&self) -> [(&'static str, &Matrix); 5] {
        let Self { real, imaginary, linear, even, odd } = self;
        let names = ["motions_real", "motions_imaginary", "motions_linear", "motions_even", "motions_odd"];
        let mut parts = names.into_iter().zip([real, imaginary, linear, even, odd]);
        std::array::from_fn(|_| parts.next().expect("as many names as matrices"))
    }

    /// Counts the states in other units.
    pub(super) fn scale(&mut self, unit: impl Fn(usize) -> f64) {
        for matrix in [&mut self.real, &mut self.imaginary] {
            for column in 0..matrix.columns {
                let unit = unit(column);
                (0..matrix.rows).for_each(|row| *matrix.at_mut(row, column) *= unit);
            }
        }
    }

    /// Whether the share depends on a state.
    pub(super) fn depends_on(&self, state: usize) -> bool {
        [&self.real, &self.imaginary].iter().any(|matrix| matrix.column(state).iter().any(|value| *value != 0.0))
    }

    /// The share in a state.
    pub(super) fn share(&self, state: &[f64]) -> f64 {
        self.largest(state, None).share()
    }

    /// The derivative of the share as the state changes; 0 in the middle, where it has a corner.
    pub(super) fn share_rate(&self, state: &[f64], change: &[f64]) -> f64 {
        self.largest(state, Some(change)).share_rate()
    }

    /// The sums of the unit with the largest share.
    fn largest(&self, state: &[f64], change: Option<&[f64]>) -> Sum {
        let count = self.linear.columns.min(MOST_KINDS);
        let mut sums = [Sum::default(); MOST_KINDS];
        for row in 0..self.real.rows {
            let [real, imaginary] = [&self.real, &self.imaginary].map(|matrix| matrix.row_times(row, state));
            let size = hypot(real, imaginary);
            let rate = change.filter(|_| size > 0.0).map_or(0.0, |change| {
                let rates = [&self.real, &self.imaginary].map(|matrix| matrix.row_times(row, change));
                (real * rates[0] + imaginary * rates[1]) / size
            });
            for (kind, sum) in sums[..count].iter_mut().enumerate() {
                let [linear, even, odd] = [&self.linear, &self.even, &self.odd].map(|matrix| matrix.at(row, kind));
                sum.linear += linear * size;
                sum.nonlinear += (even + odd * size) * size * size;
                sum.linear_rate += linear * rate;
                sum.nonlinear_rate += (2.0 * even + 3.0 * odd * size) * size * rate;
            }
        }
        let larger = |a: Sum, b: Sum| if b.share() > a.share() { b } else { a };
        sums[..count].iter().copied().fold(Sum::default(), larger)
    }
}
