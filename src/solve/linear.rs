//! Sparse linear systems: LU with true partial pivoting, symbolic analysis reused, scaled and refined; and `L D Lᵀ` for the signs of
//! the pivots. The only file that knows faer.

use crate::math::blocks::Blocks;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::factor::PartialPivLuParams;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::linalg::lu::{LuRef, LuSymbolicParams, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::linalg::{SupernodalThreshold, amd};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Auto, Conj, MatMut, Par, Side, Spec};

/// Sweeps of symmetric Ruiz scaling: each takes the square root of what rows and columns are off from 1.
const SCALING_SWEEPS: usize = 3;
/// Refinement steps at most; one restores the digits that stiff beams cost, the others are for near-singular machines.
pub(super) const REFINEMENTS: usize = 4;
/// Largest componentwise backward error of an accepted solution (Oettli-Prager): a normwise one looks fine on solutions wrong in the fifth digit.
pub(super) const BACKWARD_ERROR: f64 = 1e-12;

/// Terms below this share of a row's largest possible term are taken as round-off of the others.
pub(super) const NEGLIGIBLE: f64 = 1e-10;

/// Smallest size of a scaled solution that its backward error is judged by. Near 1e-308 doubles lose their digits one after the other, and
/// the error of a right solution becomes any share of it: a motor whose rate fades away passes through there.
pub(super) const SMALLEST_SOLUTION: f64 = 1e-280;

/// A direction that the matrix maps to less than this share of its terms is a null direction. Measured: 1e-16 and below for free and
/// doubly held machines (round-off of a row's sum), 2.5e-13 and 3.2e-15 for the softest direction of a slender cantilever of 1,000
/// and 3,000 elements. From some 4,000 on, such a beam cannot be told from a free one in double precision.
pub(super) const ROUND_OFF: f64 = 1e-15;

/// A number between 0.5 and 1.5 for each unknown, with no pattern that a null vector could be orthogonal to.
pub fn irregular(index: usize) -> f64 {
    0.5 + (0.3 + 0.618_033_988_749_895 * index as f64).fract()
}

/// Whether a matrix can be solved with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regularity {
    /// It can.
    Regular,
    /// It has a null vector, which is largest in this unknown.
    Singular(usize),
    /// A pivot vanished: it is singular, but the null vector is not known.
    Unknown,
}

/// The matrix has no usable factorization, or the solution is not accurate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular;

/// Entries of a square sparse matrix, sorted by columns and rows, each once.
struct Columns {
    column_starts: Vec<usize>,
    rows: Vec<usize>,
    /// Where each of the given entries went.
    scatter: Vec<usize>,
}

impl Columns {
    /// Of `size` columns; `places` are column and row of each entry, in any order and number.
    fn new(size: usize, places: &[(usize, usize)]) -> Self {
        let mut starts = vec![0; size + 1];
        places.iter().for_each(|(column, _)| starts[column + 1] += 1);
        (0..size).for_each(|column| starts[column + 1] += starts[column]);
        let (mut next, mut by_column) = (starts.clone(), vec![0; places.len()]);
        for (number, (column, _)) in places.iter().enumerate() {
            by_column[next[*column]] = number;
            next[*column] += 1;
        }
        let (mut column_starts, mut rows, mut scatter) = (vec![0], Vec::new(), vec![0; places.len()]);
        // Of each row, the last column that had it, and where.
        let mut last = vec![(size, 0); size];
        for column in 0..size {
            let (own, first) = (&by_column[starts[column]..starts[column + 1]], rows.len());
            for (_, row) in own.iter().map(|number| places[*number]) {
                if last[row].0 != column {
                    last[row].0 = column;
                    rows.push(row);
                }
            }
            rows[first..].sort_unstable();
            (first..rows.len()).for_each(|place| last[rows[place]].1 = place);
            own.iter().for_each(|number| scatter[*number] = last[places[*number].1].1);
            column_starts.push(rows.len());
        }
        Self { column_starts, rows, scatter }
    }
}

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
    units: Vec<f64>,
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
    /// For matrices with the pattern of `blocks`; `units` is the natural size of each unknown, which scaling starts from.
    ///
    /// # Errors
    /// The symbolic analysis runs out of memory.
    pub fn new(units: &[f64], blocks: &Blocks) -> Result<Self, Singular> {
        let size = units.len();
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
            .or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        Ok(Self {
            size,
            values: vec![0.0; rows.len()],
            scaled: vec![0.0; rows.len()],
            column_starts,
            rows,
            scatter,
            scale: units.to_vec(),
            units: units.to_vec(),
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
        for (place, value) in self.scatter.iter().zip(blocks.values()) {
            self.values[*place] += value;
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
        self.scale.copy_from_slice(&self.units);
        for _ in 0..SCALING_SWEEPS {
            let largest = &mut self.magnitude;
            largest.fill(0.0);
            for column in 0..self.size {
                for place in self.column_starts[column]..self.column_starts[column + 1] {
                    let row = self.rows[place];
                    let value = (self.values[place] * self.scale[row] * self.scale[column]).abs();
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
            for place in self.column_starts[column]..self.column_starts[column + 1] {
                self.scaled[place] = self.values[place] * self.scale[self.rows[place]] * self.scale[column];
            }
        }
    }

    /// Solves for the right side `vector`, in place, refined until the backward error is at round-off.
    ///
    /// # Errors
    /// The solution is not finite or not accurate: the matrix is singular to working precision. `vector` is then spoilt.
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

    /// Scaling of unknown `index`: what it is measured in.
    pub fn scale(&self, index: usize) -> f64 {
        self.scale[index]
    }

    /// Whether the factorized matrix is regular to working precision: two inverse iterations find its softest direction `v`,
    /// which a singular matrix maps to round-off.
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
            for place in self.column_starts[column]..self.column_starts[column + 1] {
                let product = self.scaled[place] * self.remainder[column];
                self.solution[self.rows[place]] += product;
                self.magnitude[self.rows[place]] += product.abs();
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

    /// Sets `remainder = vector − A solution` and returns the componentwise backward error `max |r|_i / (|A||x| + |b|)_i`; infinite when not finite.
    ///
    /// A row whose terms are all round-off of the others says nothing by itself: its denominator is at least the row's share
    /// of the largest scaled unknown times [`NEGLIGIBLE`] (Arioli, Demmel, Duff 1989).
    fn backward_error(&mut self, vector: &[f64]) -> f64 {
        for ((remainder, magnitude), value) in self.remainder.iter_mut().zip(&mut self.magnitude).zip(vector) {
            *remainder = *value;
            *magnitude = value.abs();
        }
        let scaled = self.solution.iter().zip(&self.scale).map(|(x, scale)| (x / scale).abs());
        let largest = scaled.fold(SMALLEST_SOLUTION, f64::max);
        for column in 0..self.size {
            let factor = self.solution[column];
            for place in self.column_starts[column]..self.column_starts[column + 1] {
                let row = self.rows[place];
                let product = self.values[place] * factor;
                self.remainder[row] -= product;
                self.magnitude[row] +=
                    product.abs() + NEGLIGIBLE * self.scaled[place].abs() * largest / self.scale[row];
            }
        }
        let mut error = 0.0_f64;
        for (remainder, magnitude) in self.remainder.iter().zip(&self.magnitude) {
            if !remainder.is_finite() {
                return f64::INFINITY;
            }
            if *magnitude > 0.0 {
                error = error.max(remainder.abs() / magnitude);
            }
        }
        error
    }
}

/// An order in which to eliminate the vertices of a graph, given by the neighbours of each, so that few new neighbours come up: the approximate
/// minimum degree. None for want of memory.
pub fn minimum_degree(neighbours: &[Vec<usize>]) -> Option<Vec<usize>> {
    let count = neighbours.len();
    let mut starts = vec![0];
    starts.extend(neighbours.iter().scan(0, |sum, list| {
        *sum += list.len();
        Some(*sum)
    }));
    let list: Vec<usize> = neighbours.concat();
    let pattern = SymbolicSparseColMatRef::new_checked(count, count, &starts, None, &list);
    let mut memory = MemBuffer::try_new(amd::order_scratch::<usize>(count, list.len())).ok()?;
    let (mut order, mut places) = (vec![0; count], vec![0; count]);
    let stack = MemStack::new(&mut memory);
    amd::order(&mut order, &mut places, pattern, amd::Control::default(), stack).ok()?;
    Some(order)
}

/// A symmetric sparse matrix whose pattern never changes, factorized as `L D Lᵀ` without pivoting: for the signs of `D`.
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

    /// How many pivots are negative of the symmetric part of `blocks` (of the same layout as at the start), scaled by `scale` from both
    /// sides; none where a pivot vanishes.
    pub fn negative_pivots(&mut self, blocks: &Blocks, scale: impl Fn(usize) -> f64) -> Option<usize> {
        self.values.fill(0.0);
        for (place, value) in self.scatter.iter().zip(blocks.values()) {
            self.values[*place] += value;
        }
        for column in 0..self.size {
            for place in self.column_starts[column]..self.column_starts[column + 1] {
                let row = self.rows[place];
                // Off the diagonal it is the sum of two.
                let share = if row == column { 1.0 } else { 0.5 };
                self.values[place] *= share * scale(column) * scale(row);
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
