//! `A = L Lᵀ` of a symmetric positive definite matrix within its profile: of each column what lies from the diagonal to
//! the last row that it or a column before it reaches, which is where `L` is not zero. A band and a full matrix are
//! profiles.

use super::Singular;

/// A pivot below this share of its diagonal is round-off of the others, or nearly: too few of its digits are left.
const VANISHING: f64 = 1e-10;

/// Numbers that are worked on side by side: the processor need not wait for one before the next.
const LANES: usize = 4;

/// The columns of a matrix, then of its factor `L`, whose diagonal holds inverses.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cholesky {
    /// Where each column begins among the values; at the end where the last one ends.
    starts: Vec<usize>,
    values: Vec<f64>,
}

impl Cholesky {
    /// Of zeros; `lasts` are the last rows of all columns.
    pub fn new(lasts: impl Iterator<Item = usize>) -> Self {
        let (mut starts, mut last) = (vec![0], 0);
        for (column, own) in lasts.enumerate() {
            last = own.max(last).max(column);
            starts.push(starts[column] + last + 1 - column);
        }
        starts.shrink_to_fit();
        Self { values: vec![0.0; starts.last().copied().unwrap_or_default()], starts }
    }

    /// As [`Self::new`]; none where the mean square of the lengths of columns, to which the work of a factorization is
    /// proportional, is above `most`.
    pub fn within(lasts: impl Iterator<Item = usize> + Clone, most: usize) -> Option<Self> {
        let (mut last, mut work, mut allowed) = (0, 0.0, 0.0);
        for (column, own) in lasts.clone().enumerate() {
            last = own.max(last).max(column);
            // Their sum may be too large for 32 bits.
            work += ((last + 1 - column) as f64).powi(2);
            allowed += most as f64;
        }
        (work <= allowed).then(|| Self::new(lasts))
    }

    /// Number of columns.
    pub fn size(&self) -> usize {
        self.starts.len() - 1
    }

    /// Sets all values to zero.
    pub fn clear(&mut self) {
        self.values.fill(0.0);
    }

    /// Column `column` from the diagonal on.
    pub fn column_mut(&mut self, column: usize) -> &mut [f64] {
        &mut self.values[self.starts[column]..self.starts[column + 1]]
    }

    /// Turns the matrix into its factor; `diagonal` is scratch memory.
    ///
    /// # Errors
    /// It is not positive definite, or only just.
    pub fn factorize(&mut self, diagonal: &mut Vec<f64>) -> Result<(), Singular> {
        diagonal.clear();
        diagonal.extend(self.starts[..self.size()].iter().map(|start| self.values[*start]));
        for (column, given) in diagonal.iter().enumerate() {
            let (before, later) = self.values.split_at_mut(self.starts[column + 1]);
            let own = &mut before[self.starts[column]..];
            let pivot = own[0];
            if !pivot.is_finite() || pivot <= VANISHING * given {
                return Err(Singular);
            }
            let inverse = 1.0 / pivot.sqrt();
            own.iter_mut().for_each(|value| *value *= inverse);
            own[0] = inverse;
            let mut begin = 0;
            for number in 1..own.len() {
                subtract_times(own[number], &own[number..], &mut later[begin..]);
                begin = self.starts[column + number + 1] - self.starts[column + 1];
            }
        }
        Ok(())
    }

    /// Solves with the factor, in place.
    pub fn solve(&self, vector: &mut [f64]) {
        for (column, own) in self.columns().enumerate() {
            let Some((value, rest)) = vector[column..].split_first_mut() else { continue };
            *value *= own[0];
            subtract_times(*value, &own[1..], rest);
        }
        for (column, own) in self.columns().enumerate().rev() {
            let Some((value, rest)) = vector[column..].split_first_mut() else { continue };
            *value = (*value - dot(&own[1..], &rest[..own.len() - 1])) * own[0];
        }
    }

    /// The same for `WIDTH` right-hand sides at a time: those of row `r` are in `vector` from `places[r]` on.
    pub fn solve_at<const WIDTH: usize>(&self, places: &[usize], vector: &mut [f64]) {
        for (column, own) in self.columns().enumerate() {
            let value = at::<WIDTH>(vector, places[column]).map(|value| value * own[0]);
            vector[places[column]..places[column] + WIDTH].copy_from_slice(&value);
            for (entry, place) in own[1..].iter().zip(&places[column + 1..]) {
                let target = &mut vector[*place..place + WIDTH];
                (0..WIDTH).for_each(|lane| target[lane] -= entry * value[lane]);
            }
        }
        for (column, own) in self.columns().enumerate().rev() {
            let mut value = at::<WIDTH>(vector, places[column]);
            for (entry, place) in own[1..].iter().zip(&places[column + 1..]) {
                let other = at::<WIDTH>(vector, *place);
                (0..WIDTH).for_each(|lane| value[lane] -= entry * other[lane]);
            }
            vector[places[column]..places[column] + WIDTH].copy_from_slice(&value.map(|value| value * own[0]));
        }
    }

    fn columns(&self) -> impl DoubleEndedIterator<Item = &[f64]> + ExactSizeIterator {
        self.starts.windows(2).map(|ends| &self.values[ends[0]..ends[1]])
    }
}

/// The values of `vector` from `place` on.
fn at<const WIDTH: usize>(vector: &[f64], place: usize) -> [f64; WIDTH] {
    let mut values = [0.0; WIDTH];
    values.copy_from_slice(&vector[place..place + WIDTH]);
    values
}

/// `target -= factor entries`, of as many as there are entries.
fn subtract_times(factor: f64, entries: &[f64], target: &mut [f64]) {
    let target = &mut target[..entries.len()];
    let ((lanes, rest), (targets, last)) = (entries.as_chunks::<LANES>(), target.as_chunks_mut::<LANES>());
    for (target, entries) in targets.iter_mut().zip(lanes) {
        (0..LANES).for_each(|lane| target[lane] -= factor * entries[lane]);
    }
    for (target, entry) in last.iter_mut().zip(rest) {
        *target -= factor * entry;
    }
}

/// `a · b`.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    let ((a_lanes, a_rest), (b_lanes, b_rest)) = (a.as_chunks::<LANES>(), b.as_chunks::<LANES>());
    let mut sums = [0.0; LANES];
    for (a, b) in a_lanes.iter().zip(b_lanes) {
        (0..LANES).for_each(|lane| sums[lane] += a[lane] * b[lane]);
    }
    let rest: f64 = a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum();
    sums.iter().sum::<f64>() + rest
}
