//! A constrained system, factorized front by front (`elimination_tree`): LU with partial pivoting within the pivots of
//! a front.
//!
//! Pivots are compared as if rows and columns were scaled: coordinates by the roots of their diagonals, multipliers so
//! that the largest entry of a condition is 1, which then counts for more. What the restricted pivoting and stiff beams
//! cost, refinement restores; a solution counts only with a componentwise backward error at round-off. Where there is
//! none, a general solver has to help (`direct`).

use super::elimination_tree::{Fronts, Unknowns};
use super::front::{Front, Piece, Run};
use super::frontal_matrix::{
    Shape, eliminate, solve_lower, solve_lower_transposed, solve_upper, solve_upper_transposed,
};
use super::transposed::{Room, solve_transposed};
use super::units::Units;
use super::{
    BACKWARD_ERROR, NEGLIGIBLE, REFINEMENTS, ROUND_OFF, SMALLEST_SOLUTION, Singular, irregular, largest_share,
};
use crate::math::blocks::{Block, Blocks};
use std::ops::Range;

/// Rows that are worked on at a time: the coordinates of a node of `ancf14`.
const NODE: usize = 7;

/// How many times more the row of a condition counts as a pivot than it measures. Where a condition holds a stiff beam,
/// both measure the same: if the beam's row went first, all that is soft would be the round-off of its stiffness, and
/// every solution would need refinement.
const PREFERENCE: f64 = 4.0;

/// A diagonal below this share of the largest one is round-off: stiff and soft coordinates differ by 1e12 at most.
const VANISHING: f64 = 1e-13;

/// How many times softer than it was found a matrix may be for all that the fronts know: scaled otherwise than by the
/// general solver, and asked by a vector that is not quite its softest one.
const DOUBT: f64 = 100.0;

/// Order, memory and factors of one matrix.
#[derive(Debug)]
pub struct Multifrontal {
    fronts: Fronts,
    coordinates: usize,
    /// Numbers of the blocks that lie on the diagonal, and of those whose rows are conditions.
    diagonal: Vec<usize>,
    conditions: Vec<usize>,
    /// `L` and `U` of all fronts, column by column.
    factors: Vec<f64>,
    /// The columns of the border of the front in the making.
    right: Vec<f64>,
    /// What fronts leave for their parents.
    rests: Vec<f64>,
    /// Of each renumbered unknown, the row (within its front) that its pivot came from.
    rows: Vec<u16>,
    scale: Vec<f64>,
    /// Right-hand side and solution, renumbered; afterwards the size of the terms of each row.
    work: Vec<f64>,
    column: Vec<f64>,
    solution: Vec<f64>,
    remainder: Vec<f64>,
}

impl Multifrontal {
    /// For the pattern of `blocks`. None where the order does not exist.
    pub fn new(unknowns: Unknowns, blocks: &Blocks) -> Option<Self> {
        let fronts = Fronts::new(unknowns, blocks)?;
        let (size, coordinates) = (unknowns.count(), unknowns.coordinates());
        let select = |is_meant: &dyn Fn(&Block) -> bool| {
            let numbered = blocks.layout().iter().enumerate().filter(|(_, block)| is_meant(block));
            numbered.map(|(number, _)| number).collect()
        };
        Some(Self {
            coordinates,
            diagonal: select(&|block| !diagonal(block).is_empty()),
            conditions: select(&|block| block.row >= coordinates && block.column < coordinates),
            factors: vec![0.0; fronts.storage],
            right: vec![0.0; fronts.right],
            rests: vec![0.0; fronts.rests],
            rows: vec![0; size],
            scale: vec![1.0; size],
            work: vec![0.0; size],
            column: vec![0.0; fronts.longest],
            solution: vec![0.0; size],
            remainder: vec![0.0; size],
            fronts,
        })
    }

    /// Takes the values of `blocks` (of the same layout as at the start) and factorizes; diagonals in the natural
    /// `units` of all unknowns can be compared.
    ///
    /// # Errors
    /// A pivot vanishes, or a value is not finite.
    pub fn factorize(&mut self, units: &Units, blocks: &Blocks) -> Result<(), Singular> {
        self.set_scale(units, blocks);
        let Self { fronts, coordinates, factors, right, rests, rows, scale, column, .. } = self;
        for front in &fronts.fronts {
            let (shape, pivots) = (front.shape(), front.pivots.range());
            let (own, upper) = factors[front.factors()].split_at_mut(shape.own());
            let right = &mut right[..shape.right()];
            own.fill(0.0);
            right.fill(0.0);
            add_pieces(fronts, front, blocks.values(), own, right);
            for child in &fronts.children[front.children.range()] {
                let child = &fronts.fronts[*child as usize];
                add_rest(rests, child, &fronts.runs[child.runs.range()], shape, [&mut *own, &mut *right]);
            }
            let weights = &mut column[..shape.pivots];
            for (weight, unknown) in weights.iter_mut().zip(&fronts.unknowns[pivots.clone()]) {
                let unknown = *unknown as usize;
                *weight = if unknown < *coordinates { scale[unknown] } else { PREFERENCE * scale[unknown] };
            }
            eliminate(shape, own, right, weights, &mut rows[pivots])?;
            let left = rests[front.rest()].chunks_exact_mut(shape.border.max(1));
            let kept = upper.chunks_exact_mut(shape.pivots);
            for ((column, kept), left) in right.chunks_exact(shape.stride()).zip(kept).zip(left) {
                copy(&column[..shape.pivots], kept);
                copy(&column[shape.pivots..shape.pivots + shape.border], left);
            }
        }
        Ok(())
    }

    /// Sets the scale of all unknowns by the values of `blocks`, as [`Self::factorize`] does.
    pub fn set_scale(&mut self, units: &Units, blocks: &Blocks) {
        let Self { scale, .. } = self;
        scale.fill(0.0);
        for number in &self.diagonal {
            let (block, values) = (blocks.layout()[*number], blocks.block(*number));
            for unknown in diagonal(&block) {
                scale[unknown] += values[(unknown - block.column) * block.rows + unknown - block.row];
            }
        }
        let (coordinates, multipliers) = scale.split_at_mut(self.coordinates);
        // A diagonal that is round-off of the others, or zero, is replaced by the largest one. Kilograms and kilogram
        // square meters compare in the natural units only: in SI units the ones would be the round-off of the others in
        // a mechanism of some micrometers.
        let sizes = coordinates.iter().zip(units.iter()).map(|(value, unit)| value.abs() * unit * unit);
        let largest = sizes.fold(0.0_f64, f64::max);
        let largest = if largest > 0.0 { largest } else { 1.0 };
        for (value, unit) in coordinates.iter_mut().zip(units.iter()) {
            let size = value.abs() * unit * unit;
            let size = if size > VANISHING * largest { value.abs() } else { largest / (unit * unit) };
            *value = 1.0 / size.sqrt();
        }
        multipliers.fill(0.0);
        for number in &self.conditions {
            let block = blocks.layout()[*number];
            let columns = blocks.block(*number).chunks_exact(block.rows.max(1));
            for (column, values) in columns.enumerate() {
                let factor = coordinates[block.column + column];
                let own = &mut multipliers[block.row - self.coordinates..];
                for (largest, value) in own.iter_mut().zip(values) {
                    *largest = largest.max((value * factor).abs());
                }
            }
        }
        for value in multipliers {
            // Compilers divide first and choose afterwards: not by 0, which hosts may trap.
            *value = if *value > 0.0 { 1.0 / value.max(f64::MIN_POSITIVE) } else { 1.0 };
        }
    }

    /// Sign of the determinant of the factorized matrix: rows and columns are renumbered alike, rows exchanged within
    /// fronts.
    pub fn sign(&self) -> i8 {
        let mut sign = 1;
        for front in &self.fronts.fronts {
            let (factors, stride) = (&self.factors[front.factors()], front.shape().stride());
            for (number, row) in self.rows[front.pivots.range()].iter().enumerate() {
                let is_negative = factors[number * stride + number] < 0.0;
                if is_negative != (usize::from(*row) != number) {
                    sign = -sign;
                }
            }
        }
        sign
    }

    /// Scaling of unknown `index`: what it is measured in.
    pub fn scale(&self, index: usize) -> f64 {
        self.scale[index]
    }

    /// Solves for the right side `vector`, in place, refined until the backward error is at round-off. `blocks` are
    /// those that were factorized.
    ///
    /// # Errors
    /// The solution is not finite or not accurate; `vector` is as it was.
    pub fn solve(&mut self, blocks: &Blocks, vector: &mut [f64]) -> Result<(), Singular> {
        self.remainder.copy_from_slice(vector);
        self.solution.fill(0.0);
        for _ in 0..=REFINEMENTS {
            self.apply_inverse();
            add(&mut self.solution, &self.remainder);
            if self.backward_error(blocks, vector) <= BACKWARD_ERROR {
                vector.copy_from_slice(&self.solution);
                return Ok(());
            }
        }
        Err(Singular)
    }

    /// Solves for the right side `vector`, in place, with the factors as they are.
    pub fn substitute_in(&mut self, vector: &mut [f64]) {
        self.remainder.copy_from_slice(vector);
        self.apply_inverse();
        vector.copy_from_slice(&self.remainder);
    }

    /// Solves with the transposed matrix for the right side `vector`, in place, refined as [`Self::solve`] is; `room`
    /// is scratch memory.
    ///
    /// # Errors
    /// As [`Self::solve`].
    pub(super) fn solve_transposed(
        &mut self,
        blocks: &Blocks,
        vector: &mut [f64],
        room: &mut Room,
    ) -> Result<(), Singular> {
        let scale = std::mem::take(&mut self.scale);
        let outcome = solve_transposed(
            blocks,
            vector,
            |index| scale[index],
            room,
            |remainder| {
                self.renumbered(remainder, Self::substitute_transposed);
            },
        );
        self.scale = scale;
        outcome
    }

    /// Whether the factorized matrix, `blocks`, is beyond doubt regular to working precision.
    ///
    /// A null vector `l` of the transpose would leave `lᵀ(b − A x) = lᵀ b` whatever `x` is. So where `b` has no
    /// pattern, an accurate and moderate `x` proves that there is none, however the pivots were found: what is left of
    /// `b`, and the round-off of the terms of `A x`, must be small beside it, all of them scaled. A second `b`, the
    /// first solution, shows a soft direction as it is (`sparse_lu` asks the same way).
    pub fn is_surely_regular(&mut self, blocks: &Blocks) -> bool {
        let mut vector: Vec<f64> =
            self.scale.iter().enumerate().map(|(index, scale)| irregular(index) / scale).collect();
        let (mut terms, mut left) = (0.0, 0.0);
        for _ in 0..2 {
            if self.solve(blocks, &mut vector).is_err() {
                return false;
            }
            let largest = |values: &[f64]| {
                values
                    .iter()
                    .zip(&self.scale)
                    .fold(0.0_f64, |largest, (value, scale)| largest.max((value * scale).abs()))
            };
            // The solution counts in units of the scale, the rows in those of its inverse.
            (terms, left) = (largest(&self.work), largest(&self.remainder));
            for (value, scale) in vector.iter_mut().zip(&self.scale) {
                *value /= scale * scale;
            }
            let size = largest(&vector);
            vector.iter_mut().for_each(|value| *value /= size);
        }
        DOUBT * (ROUND_OFF * terms + left) < 1.0
    }

    /// `remainder = A⁻¹ remainder`.
    fn apply_inverse(&mut self) {
        let mut remainder = std::mem::take(&mut self.remainder);
        self.renumbered(&mut remainder, Self::substitute);
        self.remainder = remainder;
    }

    /// Lets `substitute` solve for `vector`, in place.
    fn renumbered(&mut self, vector: &mut [f64], substitute: impl Fn(&mut Self)) {
        for (unknown, value) in self.fronts.unknowns.iter().zip(&mut self.work) {
            *value = vector[*unknown as usize];
        }
        substitute(self);
        for (unknown, value) in self.fronts.unknowns.iter().zip(&self.work) {
            vector[*unknown as usize] = *value;
        }
    }

    /// Solves the renumbered system for `work`, in place.
    fn substitute(&mut self) {
        self.sweep(solve_lower, |shape, factors, _, column| solve_upper(shape, factors, column));
    }

    /// Solves the renumbered, transposed system for `work`, in place.
    fn substitute_transposed(&mut self) {
        self.sweep(|shape, factors, _, column| solve_upper_transposed(shape, factors, column), solve_lower_transposed);
    }

    /// Changes `work` front by front: by `first` from the leaves to the root, then by `second` back. Both have the
    /// shape of a front, its factors, the rows of its pivots and a column of right sides.
    fn sweep(
        &mut self,
        first: impl Fn(Shape, &[f64], &[u16], &mut [f64]),
        second: impl Fn(Shape, &[f64], &[u16], &mut [f64]),
    ) {
        let Self { fronts, factors, rows, work, column, .. } = self;
        for front in &fronts.fronts {
            let (shape, own) = (front.shape(), front.pivots.range());
            let column = &mut column[..shape.stride()];
            let (pivots, border) = column.split_at_mut(shape.pivots);
            pivots.copy_from_slice(&work[own.clone()]);
            border.fill(0.0);
            first(shape, &factors[front.factors()], &rows[own.clone()], column);
            work[own].copy_from_slice(&column[..shape.pivots]);
            for run in &fronts.borders[front.border.range()] {
                add(&mut work[run.to()], &column[run.from()]);
            }
        }
        for front in fronts.fronts.iter().rev() {
            let (shape, own) = (front.shape(), front.pivots.range());
            let column = &mut column[..shape.pivots + shape.border];
            column[..shape.pivots].copy_from_slice(&work[own.clone()]);
            for run in &fronts.borders[front.border.range()] {
                column[run.from()].copy_from_slice(&work[run.to()]);
            }
            second(shape, &factors[front.factors()], &rows[own.clone()], column);
            work[own].copy_from_slice(&column[..shape.pivots]);
        }
    }

    /// Sets `remainder = vector − A solution` and returns the componentwise backward error `max |r|_i / (|A||x| +
    /// |b|)_i` (Oettli-Prager); infinite when not finite. `|A|` is the sum of the sizes of blocks that overlap, where
    /// `sparse_lu` takes the size of their sum: a little less strict.
    fn backward_error(&mut self, blocks: &Blocks, vector: &[f64]) -> f64 {
        let Self { scale, solution, remainder, work: magnitude, .. } = self;
        remainder.copy_from_slice(vector);
        for (magnitude, value) in magnitude.iter_mut().zip(vector) {
            *magnitude = value.abs();
        }
        let scaled = solution.iter().zip(&*scale).map(|(x, scale)| (x / scale).abs());
        let largest = scaled.fold(SMALLEST_SOLUTION, f64::max);
        for (number, block) in blocks.layout().iter().enumerate() {
            let columns = block.column..block.column + block.columns;
            // A row whose terms are all round-off of the others says nothing by itself.
            let least = NEGLIGIBLE * largest;
            let factors =
                solution[columns.clone()].iter().zip(&scale[columns]).map(|(x, scale)| (*x, x.abs() + least * scale));
            let values = blocks.block(number);
            let mut row = 0;
            while row < block.rows && block.columns > 0 {
                let slot = block.row + row;
                let (values, factors) = (&values[row..], factors.clone());
                let sums = (&mut remainder[slot..], &mut magnitude[slot..]);
                // As many rows as the compiler may keep at hand, of what blocks have: two nodes, a body, the conditions
                // of joints.
                row += match block.rows - row {
                    // Two nodes as eight rows and six: an odd number leaves half of the processor's lanes without work.
                    14 => subtract_rows::<8>(values, block.rows, factors, sums),
                    NODE => subtract_rows::<NODE>(values, block.rows, factors, sums),
                    12.. => subtract_rows::<12>(values, block.rows, factors, sums),
                    6.. => subtract_rows::<6>(values, block.rows, factors, sums),
                    5 => subtract_rows::<5>(values, block.rows, factors, sums),
                    4 => subtract_rows::<4>(values, block.rows, factors, sums),
                    3 => subtract_rows::<3>(values, block.rows, factors, sums),
                    2 => subtract_rows::<2>(values, block.rows, factors, sums),
                    _ => subtract_rows::<1>(values, block.rows, factors, sums),
                };
            }
        }
        largest_share(remainder, magnitude)
    }
}

/// The unknowns whose diagonal entries are in a block.
fn diagonal(block: &Block) -> Range<usize> {
    block.row.max(block.column)..(block.row + block.rows).min(block.column + block.columns)
}

/// Takes the products of some rows of a block, whose columns are `stride` apart, with the solution out of `remainder`,
/// and adds their sizes to `magnitude`; `factors` are the solution and what sizes are multiplied with. Returns how many
/// rows.
fn subtract_rows<const ROWS: usize>(
    values: &[f64],
    stride: usize,
    factors: impl Iterator<Item = (f64, f64)>,
    (remainder, magnitude): (&mut [f64], &mut [f64]),
) -> usize {
    let (Some(remainder), Some(magnitude)) = (remainder.first_chunk_mut::<ROWS>(), magnitude.first_chunk_mut::<ROWS>())
    else {
        return ROWS;
    };
    let (mut left, mut size) = (*remainder, *magnitude);
    for (column, (factor, most)) in values.chunks(stride).zip(factors) {
        let Some(column) = column.first_chunk::<ROWS>() else { continue };
        for row in 0..ROWS {
            left[row] -= column[row] * factor;
            size[row] += column[row].abs() * most;
        }
    }
    (*remainder, *magnitude) = (left, size);
    ROWS
}

/// `target += column`.
fn add(target: &mut [f64], column: &[f64]) {
    // The coordinates of a node: the compiler unrolls what it knows.
    if let (Ok(target), Ok(column)) = (<&mut [f64; NODE]>::try_from(&mut *target), <&[f64; NODE]>::try_from(column)) {
        (0..NODE).for_each(|row| target[row] += column[row]);
        return;
    }
    for (target, value) in target.iter_mut().zip(column) {
        *target += value;
    }
}

/// `target = column`.
fn copy(column: &[f64], target: &mut [f64]) {
    if let (Ok(target), Ok(column)) = (<&mut [f64; NODE]>::try_from(&mut *target), <&[f64; NODE]>::try_from(column)) {
        *target = *column;
        return;
    }
    target.copy_from_slice(column);
}

/// Adds the pieces of the matrix that belong to a front, whose columns of pivots are `own`, those of the border
/// `right`.
fn add_pieces(fronts: &Fronts, front: &Front, values: &[f64], own: &mut [f64], right: &mut [f64]) {
    let stride = front.shape().stride();
    for piece in &fronts.pieces[front.pieces.range()] {
        let Piece { source, target, .. } = *piece;
        let (mut from, target, rows) = (source as usize, target as usize, piece.rows as usize);
        // A piece has columns of one group.
        let (mut to, columns) =
            if target < own.len() { (target, &mut *own) } else { (target - own.len(), &mut *right) };
        for _ in 0..piece.columns {
            add(&mut columns[to..to + rows], &values[from..from + rows]);
            from += piece.stride as usize;
            to += stride;
        }
    }
}

/// Adds what is left of a child, among `rests`, to the columns of its parent of the shape `shape`: of pivots, of the
/// border.
fn add_rest(rests: &[f64], child: &Front, runs: &[Run], shape: Shape, [own, right]: [&mut [f64]; 2]) {
    let (stride, Shape { pivots, border }) = (shape.stride(), child.shape());
    let rest = &rests[child.rest()];
    for columns in runs {
        for (from, to) in columns.from().zip(columns.to()) {
            let left = &rest[(from - pivots) * border..][..border];
            let target = if to < shape.pivots {
                &mut own[to * stride..(to + 1) * stride]
            } else {
                &mut right[(to - shape.pivots) * stride..(to - shape.pivots + 1) * stride]
            };
            for run in runs {
                let rows = run.from();
                add(&mut target[run.to()], &left[rows.start - pivots..rows.end - pivots]);
            }
        }
    }
}
