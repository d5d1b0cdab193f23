//! `L D Lᵀ` of a symmetric sparse matrix, without pivoting: the signs of its pivots count the negative eigenvalues.

use super::Singular;
use super::columns::Columns;
use crate::math::blocks::Blocks;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Par, Side, Spec};

/// A symmetric sparse matrix whose pattern never changes, factorized as `L D Lᵀ` without pivoting: for the signs of
/// `D`.
pub struct SparseLdl {
    size: usize,
    column_starts: Vec<usize>,
    rows: Vec<usize>,
    /// Where each value of the blocks goes.
    scatter: Vec<usize>,
    values: Vec<f64>,
    symbolic: SymbolicCholesky<usize>,
    factor: Vec<f64>,
    memory: MemBuffer,
}

impl std::fmt::Debug for SparseLdl {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("SparseLdl").field("size", &self.size).field("entries", &self.rows.len()).finish_non_exhaustive()
    }
}

impl SparseLdl {
    /// For matrices of `size` rows with the pattern of `blocks`.
    ///
    /// # Errors
    /// The symbolic analysis runs out of memory.
    pub fn new(size: usize, blocks: &Blocks) -> Result<Self, Singular> {
        let mut places = Vec::with_capacity(blocks.values().len() + size);
        for block in blocks.layout() {
            for column in block.column..block.column + block.columns {
                places.extend((block.row..block.row + block.rows).map(|row| (row.min(column), row.max(column))));
            }
        }
        places.extend((0..size).map(|k| (k, k)));
        let Columns { column_starts, rows, scatter } = Columns::new(size, &places);
        let pattern = SymbolicSparseColMatRef::new_checked(size, size, &column_starts, None, &rows);
        // Column by column: `D` then stands at the beginning of each column of `L`.
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SIMPLICIAL,
            ..CholeskySymbolicParams::default()
        };
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, SymmetricOrdering::Amd, parameters)
            .map_err(|_| Singular)?;
        let needed = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Spec::default());
        Ok(Self {
            size,
            scatter,
            values: vec![0.0; rows.len()],
            factor: vec![0.0; symbolic.len_val()],
            memory: MemBuffer::try_new(needed).map_err(|_| Singular)?,
            column_starts,
            rows,
            symbolic,
        })
    }

    /// How many pivots are negative of the symmetric part of `blocks` (of the same layout as at the start), scaled by
    /// `scale` from both sides; none where a pivot vanishes.
    pub fn negative_pivots(&mut self, blocks: &Blocks, scale: impl Fn(usize) -> f64) -> Option<usize> {
        self.values.fill(0.0);
        for (slot, value) in self.scatter.iter().zip(blocks.values()) {
            self.values[*slot] += value;
        }
        for column in 0..self.size {
            for slot in self.column_starts[column]..self.column_starts[column + 1] {
                let row = self.rows[slot];
                // Off the diagonal it is the sum of two.
                let share = if row == column { 1.0 } else { 0.5 };
                self.values[slot] *= share * scale(column) * scale(row);
            }
        }
        if self.values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let pattern = SymbolicSparseColMatRef::new_checked(self.size, self.size, &self.column_starts, None, &self.rows);
        let matrix = SparseColMatRef::new(pattern, &self.values);
        let stack = MemStack::new(&mut self.memory);
        let none = Default::default();
        self.symbolic
            .factorize_numeric_ldlt(&mut self.factor, matrix, Side::Lower, none, Par::Seq, stack, Spec::default())
            .ok()?;
        let SymbolicCholeskyRaw::Simplicial(simplicial) = self.symbolic.raw() else { return None };
        let pivots = simplicial.col_ptr()[..self.size].iter().map(|start| self.factor[*start]);
        pivots.clone().all(f64::is_finite).then(|| pivots.filter(|pivot| *pivot < 0.0).count())
    }
}
