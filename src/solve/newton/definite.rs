//! Whether the symmetric part of `A + Bᵀ B/ε` is positive definite up to round-off: it is where its Cholesky
//! factorization comes to an end. Otherwise nothing is known.
//!
//! The factorization keeps the order of the coordinates, in which beams have a band: it needs neither the search for an
//! order nor the symbolic analysis of a general one.

use crate::math::blocks::{Block, Blocks};
use crate::solve::linear::cholesky::Cholesky;

/// Largest mean square of the lengths of columns. A column this long takes as much work as the analysis of a column in
/// the general factorization.
const MOST_WORK: usize = 64 * 64;

/// The matrix of the coordinates alone, within its profile.
#[derive(Debug)]
pub(super) struct Definite {
    /// Which blocks of the whole matrix are in it.
    kept: Vec<usize>,
    factor: Cholesky,
    diagonal: Vec<f64>,
}

impl Definite {
    /// For the blocks `whole`, of which the first `coordinates` rows and columns count. None where the profile is too
    /// large to be worth it.
    pub(super) fn new(coordinates: usize, whole: &Blocks) -> Option<Self> {
        let mut lasts: Vec<usize> = (0..coordinates).collect();
        let mut kept = Vec::new();
        for (number, block) in whole.layout().iter().enumerate() {
            let [rows, columns] = [block.row..block.row + block.rows, block.column..block.column + block.columns];
            if rows.is_empty() || columns.is_empty() || rows.end.max(columns.end) > coordinates {
                continue;
            }
            kept.push(number);
            lasts[columns.clone()].iter_mut().for_each(|last| *last = (rows.end - 1).max(*last));
            lasts[rows].iter_mut().for_each(|last| *last = (columns.end - 1).max(*last));
        }
        let factor = Cholesky::within(lasts.into_iter(), MOST_WORK)?;
        Some(Self { kept, factor, diagonal: Vec::new() })
    }

    /// Sets the matrix to the symmetric part of the blocks `whole`, which have the layout of the start.
    pub(super) fn take(&mut self, whole: &Blocks) {
        self.factor.clear();
        for number in &self.kept {
            let (Block { row, column, rows, columns }, values) = (whole.layout()[*number], whole.block(*number));
            if (row, rows) == (column, columns) {
                for own in 0..columns {
                    let target = &mut self.factor.column_mut(column + own)[..rows - own];
                    let below = &values[own * rows + own..(own + 1) * rows];
                    let beside = values[own * rows + own..].iter().step_by(rows);
                    for (target, (below, beside)) in target.iter_mut().zip(below.iter().zip(beside)) {
                        *target += 0.5 * (below + beside);
                    }
                }
                continue;
            }
            for (column, values) in (column..).zip(values.chunks_exact(rows)) {
                for (row, value) in (row..).zip(values) {
                    // Off the diagonal it is the mean of two.
                    let share = if row == column { 1.0 } else { 0.5 };
                    self.factor.column_mut(row.min(column))[row.abs_diff(column)] += share * value;
                }
            }
        }
    }

    /// Adds the spring that stands for a condition: `stiffness` times the outer product of its `gradient`, given by
    /// indices and values, with itself.
    pub(super) fn add_spring(&mut self, gradient: impl Iterator<Item = (usize, f64)> + Clone, stiffness: f64) {
        for (column, first) in gradient.clone().filter(|(_, value)| *value != 0.0) {
            let own = self.factor.column_mut(column);
            for (row, second) in gradient.clone().filter(|(row, _)| *row >= column) {
                own[row - column] += stiffness * first * second;
            }
        }
    }

    /// Whether the matrix is positive definite beyond round-off. Its factor replaces it.
    pub(super) fn is_definite(&mut self) -> bool {
        self.factor.factorize(&mut self.diagonal).is_ok()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `[1 c; c 1]` in blocks of one entry or in one block, with a skew part that must not count.
    fn pair(c: f64, is_whole: bool) -> Blocks {
        let mut blocks = Blocks::default();
        let (above, below) = (c + 0.3, c - 0.3);
        if is_whole {
            let block = blocks.push(Block { row: 0, column: 0, rows: 2, columns: 2 });
            blocks.block_mut(block).copy_from_slice(&[1.0, below, above, 1.0]);
            return blocks;
        }
        for (row, column, value) in [(0, 0, 1.0), (1, 0, below), (0, 1, above), (1, 1, 1.0)] {
            let block = blocks.push(Block { row, column, rows: 1, columns: 1 });
            blocks.block_mut(block)[0] = value;
        }
        blocks
    }

    /// The eigenvalues are `1 + c` and `1 - c`; a spring along the motion of the second one leaves the first alone.
    #[test]
    fn only_what_is_held_is_definite() {
        let cases = [(0.9, 0.0, true), (1.1, 0.0, false), (1.1, 10.0, true), (-1.1, 10.0, false), (1.0, 0.0, false)];
        for ((c, spring, expected), is_whole) in cases.into_iter().flat_map(|case| [(case, false), (case, true)]) {
            let blocks = pair(c, is_whole);
            let mut definite = Definite::new(2, &blocks).unwrap();
            // The second time nothing is left of the first.
            for _ in 0..2 {
                definite.take(&blocks);
                definite.add_spring([(0, 1.0), (1, -1.0)].into_iter(), spring);
                assert_eq!(definite.is_definite(), expected, "c = {c}, spring {spring}, one block: {is_whole}");
            }
        }
    }

    /// A chain is a band, however long it is. Closed to a ring its profile is full: the general factorization does
    /// better then.
    #[test]
    fn full_profiles_are_refused() {
        let (mut blocks, count) = (Blocks::default(), 300);
        for row in 0..count - 1 {
            blocks.push(Block { row, column: row, rows: 2, columns: 2 });
        }
        assert!(Definite::new(count, &blocks).is_some());
        blocks.push(Block { row: 0, column: count - 1, rows: 1, columns: 1 });
        assert!(Definite::new(count, &blocks).is_none());
    }
}
