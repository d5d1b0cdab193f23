//! A general sparse LU with true partial pivoting: symbolic analysis reused, scaled and refined.

use super::columns::Columns;
use super::transposed::{Room, solve_transposed};
use super::units::Units;
use super::{
    BACKWARD_ERROR, NEGLIGIBLE, REFINEMENTS, ROUND_OFF, Regularity, SMALLEST_SOLUTION, Singular, irregular,
    largest_share,
};
use crate::math::blocks::Blocks;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::PartialPivLuParams;
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Auto, Conj, MatMut, Par, Spec};

/// Sweeps of symmetric Ruiz scaling: each takes the square root of what rows and columns are off from 1.
const SCALING_SWEEPS: usize = 3;

/// A square sparse matrix whose pattern never changes, and its factorization.
pub struct SparseLu {
    size: usize,
    column_starts: Vec<usize>,
    rows: Vec<usize>,
    /// Where each value of the blocks goes.
    scatter: Vec<usize>,
    values: Vec<f64>,
    scaled: Vec<f64>,
    scale: Vec<f64>,
    /// Natural size of each unknown.
    units: Units,
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    memory: MemBuffer,
    solution: Vec<f64>,
    remainder: Vec<f64>,
    magnitude: Vec<f64>,
}

impl std::fmt::Debug for SparseLu {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SparseLu").field("size", &self.size).field("entries", &self.rows.len()).finish_non_exhaustive()
    }
}

fn parameters() -> Spec<PartialPivLuParams, f64> {
    <PartialPivLuParams as Auto<f64>>::auto().into()
}

impl SparseLu {
    /// For matrices with the pattern of `blocks`; `units` is the natural size of each unknown, which scaling starts
    /// from.
    ///
    /// # Errors
    /// The symbolic analysis runs out of memory.
    pub fn new(units: &Units, blocks: &Blocks) -> Result<Self, Singular> {
        let size = units.count();
        let mut places = Vec::with_capacity(blocks.values().len());
        for block in blocks.layout() {
            for column in 0..block.columns {
                places.extend((0..block.rows).map(|row| (block.column + column, block.row + row)));
            }
        }
        let Columns { column_starts, rows, scatter } = Columns::new(size, &places);
        let pattern = SymbolicSparseColMatRef::new_checked(size, size, &column_starts, None, &rows);
        let symbolic = factorize_symbolic_lu(pattern, LuSymbolicParams::default()).map_err(|_| Singular)?;
        let needed = symbolic
            .factorize_numeric_lu_scratch::<f64>(Par::Seq, parameters())
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))
            .or(symbolic.solve_transpose_in_place_scratch::<f64>(1, Par::Seq));
        Ok(Self {
            size,
            values: vec![0.0; rows.len()],
            scaled: vec![0.0; rows.len()],
            column_starts,
            rows,
            scatter,
            scale: units.iter().collect(),
            units: units.clone(),
            symbolic,
            numeric: NumericLu::new(),
            memory: MemBuffer::try_new(needed).map_err(|_| Singular)?,
            solution: vec![0.0; size],
            remainder: vec![0.0; size],
            magnitude: vec![0.0; size],
        })
    }

    /// Takes the values of `blocks` (of the same layout as at the start) and factorizes.
    ///
    /// # Errors
    /// A value is not finite, or a pivot vanishes exactly.
    pub fn factorize(&mut self, blocks: &Blocks) -> Result<(), Singular> {
        self.values.fill(0.0);
        for (slot, value) in self.scatter.iter().zip(blocks.values()) {
            self.values[*slot] += value;
        }
        if self.values.iter().any(|value| !value.is_finite()) {
            return Err(Singular);
        }
        self.equilibrate();
        let pattern = SymbolicSparseColMatRef::new_checked(self.size, self.size, &self.column_starts, None, &self.rows);
        let matrix = SparseColMatRef::new(pattern, &self.scaled);
        let stack = MemStack::new(&mut self.memory);
        self.symbolic
            .factorize_numeric_lu(&mut self.numeric, matrix, Par::Seq, stack, parameters())
            .map(|_| ())
            .map_err(|_| Singular)
    }

    /// Symmetric Ruiz scaling: `scaled = D values D` with rows and columns of largest entry near 1.
    fn equilibrate(&mut self) {
        self.scale.iter_mut().zip(self.units.iter()).for_each(|(scale, unit)| *scale = unit);
        for _ in 0..SCALING_SWEEPS {
            let largest = &mut self.magnitude;
            largest.fill(0.0);
            for column in 0..self.size {
                for slot in self.column_starts[column]..self.column_starts[column + 1] {
                    let row = self.rows[slot];
                    let value = (self.values[slot] * self.scale[row] * self.scale[column]).abs();
                    largest[row] = largest[row].max(value);
                    largest[column] = largest[column].max(value);
                }
            }
            for (scale, largest) in self.scale.iter_mut().zip(largest) {
                if *largest > 0.0 {
                    *scale /= largest.sqrt();
                }
            }
        }
        for column in 0..self.size {
            for slot in self.column_starts[column]..self.column_starts[column + 1] {
                self.scaled[slot] = self.values[slot] * self.scale[self.rows[slot]] * self.scale[column];
            }
        }
    }

    /// Solves for the right side `vector`, in place, refined until the backward error is at round-off.
    ///
    /// # Errors
    /// The solution is not finite or not accurate: the matrix is singular to working precision. `vector` is then
    /// spoilt.
    pub fn solve(&mut self, vector: &mut [f64]) -> Result<(), Singular> {
        self.solution.fill(0.0);
        self.remainder.copy_from_slice(vector);
        for _ in 0..=REFINEMENTS {
            self.add_back_substitution();
            if self.backward_error(vector) <= BACKWARD_ERROR {
                vector.copy_from_slice(&self.solution);
                return Ok(());
            }
        }
        Err(Singular)
    }

    /// Solves with the transposed matrix for the right side `vector`, in place, refined as [`Self::solve`] is. `blocks`
    /// are those that were factorized, `room` is scratch memory.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub(super) fn solve_transposed(
        &mut self,
        blocks: &Blocks,
        vector: &mut [f64],
        room: &mut Room,
    ) -> Result<(), Singular> {
        let Self { size, scale, symbolic, numeric, memory, .. } = self;
        solve_transposed(
            blocks,
            vector,
            |index| scale[index],
            room,
            |remainder| {
                remainder.iter_mut().zip(&*scale).for_each(|(value, scale)| *value *= scale);
                let right = MatMut::from_column_major_slice_mut(&mut *remainder, *size, 1);
                let factors = LuRef::new_unchecked(symbolic, numeric);
                factors.solve_transpose_in_place_with_conj(Conj::No, right, Par::Seq, MemStack::new(memory));
                remainder.iter_mut().zip(&*scale).for_each(|(value, scale)| *value *= scale);
            },
        )
    }

    /// Scaling of unknown `index`: what it is measured in.
    pub fn scale(&self, index: usize) -> f64 {
        self.scale[index]
    }

    /// Whether the factorized matrix is regular to working precision: two inverse iterations find its softest direction
    /// `v`, which a singular matrix maps to round-off.
    pub fn regularity(&mut self) -> Regularity {
        for (index, value) in self.remainder.iter_mut().enumerate() {
            *value = irregular(index);
        }
        for _ in 0..2 {
            let stack = MemStack::new(&mut self.memory);
            let right = MatMut::from_column_major_slice_mut(&mut self.remainder, self.size, 1);
            LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(
                Conj::No,
                right,
                Par::Seq,
                stack,
            );
            let largest = self.remainder.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
            if !self.remainder.iter().all(|value| value.is_finite()) || largest == 0.0 {
                return Regularity::Unknown;
            }
            self.remainder.iter_mut().for_each(|value| *value /= largest);
        }
        self.solution.fill(0.0);
        self.magnitude.fill(0.0);
        for column in 0..self.size {
            for slot in self.column_starts[column]..self.column_starts[column + 1] {
                let product = self.scaled[slot] * self.remainder[column];
                self.solution[self.rows[slot]] += product;
                self.magnitude[self.rows[slot]] += product.abs();
            }
        }
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
        if largest(&self.solution) > ROUND_OFF * largest(&self.magnitude) {
            return Regularity::Regular;
        }
        let most = self.remainder.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs()));
        most.map_or(Regularity::Unknown, |(index, _)| Regularity::Singular(index))
    }

    /// `solution += A⁻¹ remainder`.
    fn add_back_substitution(&mut self) {
        for (value, scale) in self.remainder.iter_mut().zip(&self.scale) {
            *value *= scale;
        }
        let stack = MemStack::new(&mut self.memory);
        let right = MatMut::from_column_major_slice_mut(&mut self.remainder, self.size, 1);
        LuRef::new_unchecked(&self.symbolic, &self.numeric).solve_in_place_with_conj(Conj::No, right, Par::Seq, stack);
        for ((solution, value), scale) in self.solution.iter_mut().zip(&self.remainder).zip(&self.scale) {
            *solution += value * scale;
        }
    }

    /// Sets `remainder = vector − A solution` and returns the componentwise backward error `max |r|_i / (|A||x| +
    /// |b|)_i`; infinite when not finite.
    ///
    /// A row whose terms are all round-off of the others says nothing by itself: its denominator is at least the row's
    /// share of the largest scaled unknown times [`NEGLIGIBLE`] (Arioli, Demmel, Duff 1989).
    fn backward_error(&mut self, vector: &[f64]) -> f64 {
        for ((remainder, magnitude), value) in self.remainder.iter_mut().zip(&mut self.magnitude).zip(vector) {
            *remainder = *value;
            *magnitude = value.abs();
        }
        let scaled = self.solution.iter().zip(&self.scale).map(|(x, scale)| (x / scale).abs());
        let largest = scaled.fold(SMALLEST_SOLUTION, f64::max);
        for column in 0..self.size {
            let factor = self.solution[column];
            for slot in self.column_starts[column]..self.column_starts[column + 1] {
                let row = self.rows[slot];
                let product = self.values[slot] * factor;
                self.remainder[row] -= product;
                self.magnitude[row] += product.abs() + NEGLIGIBLE * self.scaled[slot].abs() * largest / self.scale[row];
            }
        }
        largest_share(&self.remainder, &self.magnitude)
    }
}
