//! Solutions with a transposed matrix, refined as those with the matrix itself: what adjoint equations ask for.

use super::{BACKWARD_ERROR, NEGLIGIBLE, REFINEMENTS, SMALLEST_SOLUTION, Singular, largest_share};
use crate::math::blocks::Blocks;

/// Memory of a solution: its values, what is left of the right side, and the sizes of terms.
#[derive(Debug, Default)]
pub(super) struct Room {
    pub solution: Vec<f64>,
    pub remainder: Vec<f64>,
    pub magnitude: Vec<f64>,
}

/// Solves with the transpose of `blocks` for the right side `vector`, in place, until the backward error is at
/// round-off; `apply_inverse` does so in place without refinement, `scale` is what unknowns are measured in.
///
/// # Errors
/// The solution is not finite or not accurate; `vector` is as it was.
pub(super) fn solve_transposed(
    blocks: &Blocks,
    vector: &mut [f64],
    scale: impl Fn(usize) -> f64,
    room: &mut Room,
    mut apply_inverse: impl FnMut(&mut [f64]),
) -> Result<(), Singular> {
    let Room { solution, remainder, .. } = room;
    remainder.clear();
    remainder.extend_from_slice(vector);
    solution.clear();
    solution.resize(vector.len(), 0.0);
    for _ in 0..=REFINEMENTS {
        apply_inverse(&mut room.remainder);
        room.solution.iter_mut().zip(&room.remainder).for_each(|(sum, value)| *sum += value);
        if backward_error(blocks, vector, &scale, room) <= BACKWARD_ERROR {
            vector.copy_from_slice(&room.solution);
            return Ok(());
        }
    }
    Err(Singular)
}

/// Sets the remainder to `vector − Aᵀ solution` and returns the componentwise backward error (Oettli-Prager); infinite
/// when not finite.
fn backward_error(blocks: &Blocks, vector: &[f64], scale: &impl Fn(usize) -> f64, room: &mut Room) -> f64 {
    let Room { solution, remainder, magnitude } = room;
    remainder.clear();
    remainder.extend_from_slice(vector);
    magnitude.clear();
    magnitude.extend(vector.iter().map(|value| value.abs()));
    let scaled = solution.iter().enumerate().map(|(index, x)| (x / scale(index)).abs());
    let least = NEGLIGIBLE * scaled.fold(SMALLEST_SOLUTION, f64::max);
    for (number, block) in blocks.layout().iter().enumerate() {
        let columns = blocks.block(number).chunks_exact(block.rows.max(1));
        for (column, values) in (block.column..block.column + block.columns).zip(columns) {
            for (row, value) in (block.row..).zip(values) {
                remainder[column] -= value * solution[row];
                magnitude[column] += value.abs() * (solution[row].abs() + least * scale(row));
            }
        }
    }
    largest_share(remainder, magnitude)
}
