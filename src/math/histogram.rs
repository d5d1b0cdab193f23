//! How sizes are distributed, of any number of them in little memory: counts of the sizes between two neighboring
//! numbers with four significant bits.

use serde::{Deserialize, Serialize};

/// Bits of a number that a count is not told apart by: all of its mantissa but three.
const IGNORED: u32 = f64::MANTISSA_DIGITS - 1 - 3;

/// Counts of sizes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Histogram {
    /// The leading bits of the sizes in a bin, and how many there are; from the smallest on.
    bins: Vec<(u64, u64)>,
    /// The largest size.
    largest: f64,
}

impl Histogram {
    /// Adds a size, at least 0; one that is not a number counts as infinite.
    pub fn add(&mut self, size: f64) {
        let size = if size.is_nan() { f64::INFINITY } else { size.abs() };
        self.largest = self.largest.max(size);
        let bin = size.to_bits() >> IGNORED;
        match self.bins.binary_search_by_key(&bin, |(own, _)| *own) {
            Ok(bin_number) => self.bins[bin_number].1 = self.bins[bin_number].1.saturating_add(1),
            Err(bin_number) => self.bins.insert(bin_number, (bin, 1)),
        }
    }

    /// The size that at most a share of all sizes exceeds, to a sixteenth of it; the largest one exactly; 0 if there is
    /// none.
    pub fn exceeded_by(&self, share: f64) -> f64 {
        // Counts may come from the bytes of a saved state.
        let total = self.bins.iter().fold(0_u64, |total, (_, count)| total.saturating_add(*count));
        let mut more = (share * total as f64) as u64;
        if more == 0 {
            return self.largest;
        }
        for (bin, count) in self.bins.iter().rev() {
            if more < *count {
                return middle(*bin);
            }
            more -= count;
        }
        0.0
    }
}

/// The middle of a bin; of that of the tiniest sizes, zero among them, 0.
fn middle(bin: u64) -> f64 {
    let edge = f64::from_bits(bin << IGNORED);
    if bin == 0 || edge.is_infinite() { edge } else { 0.5 * (edge + f64::from_bits(bin.saturating_add(1) << IGNORED)) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of 100 sizes the largest five are left out.
    #[test]
    fn a_share_is_left_out() {
        let mut histogram = Histogram::default();
        assert_eq!(histogram.exceeded_by(0.05), 0.0);
        for number in 1..=100_u32 {
            histogram.add(f64::from(number));
        }
        for (share, size) in [(0.0, 100.0), (0.05, 95.0), (0.5, 50.0)] {
            let found = histogram.exceeded_by(share);
            assert!((found / size - 1.0).abs() <= if share == 0.0 { 0.0 } else { 1.0 / 16.0 }, "{share}: {found}");
        }
    }

    /// Zeros are zeros; what is no number is more than any.
    #[test]
    fn zeros_and_worse_have_their_places() {
        let mut histogram = Histogram::default();
        (0..19).for_each(|_| histogram.add(0.0));
        assert_eq!(histogram.exceeded_by(0.0), 0.0);
        histogram.add(f64::NAN);
        assert_eq!(histogram.exceeded_by(0.0), f64::INFINITY);
        assert_eq!(histogram.exceeded_by(0.05), 0.0);
    }
}
