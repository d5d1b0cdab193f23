//! Differences of two runs that last for several rows.

/// Rows that follow each other.
const SPELL: usize = 5;

/// The differences of the last rows: a jump that two runs have at different instants is in one or two of them, a
/// vibration that one of them loses is in most.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Spell {
    last: [f64; SPELL],
    /// The largest median of rows that follow each other.
    lasting: f64,
}

impl Spell {
    /// Includes the difference of the next row.
    pub(super) fn add(&mut self, difference: f64) {
        self.last.rotate_left(1);
        self.last[SPELL - 1] = difference;
        // The least one that at least half of them do not exceed.
        let exceeds_half = |own: &f64| self.last.iter().filter(|other| *other <= own).count() > SPELL / 2;
        let median = self.last.iter().copied().filter(exceeds_half).fold(f64::INFINITY, f64::min);
        self.lasting = self.lasting.max(median);
    }

    /// The largest median so far.
    pub(super) fn lasting(&self) -> f64 {
        self.lasting
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows that are off do not count, three of five do.
    #[test]
    fn jumps_do_not_last() {
        let lasting = |differences: &[f64]| {
            let mut spell = Spell::default();
            differences.iter().for_each(|difference| spell.add(*difference));
            spell.lasting()
        };
        assert_eq!(lasting(&[0.0, 0.0, 9.0, 9.0, 0.0, 0.0, 0.0, 9.0, 9.0, 0.0]), 0.0);
        assert_eq!(lasting(&[0.0, 3.0, 0.0, 2.0, 1.0, 0.0]), 1.0);
    }
}
