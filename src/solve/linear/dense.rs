//! Dense matrices of small systems: balanced ones, and triangular factors with pivoting. Programs that show a mechanism
//! as a linear system use them; no step does.

use crate::math::elementary::{exp2, log2};
use faer::MatRef;

/// Sweeps of the balancing at most; a few are usual.
const MOST_SWEEPS: usize = 100;
/// A factor that reduces the sizes of a row and a column by less than this share is not worth it.
const WORTHWHILE: f64 = 0.95;

/// A dense matrix, column after column.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dense {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Its values, column-major.
    pub values: Vec<f64>,
}

/// A complex number.
pub type Complex = nalgebra::Complex<f64>;
impl Dense {
    /// Zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, values: vec![0.0; rows * columns] }
    }

    /// The value in row `row` of column `column`.
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.values[column * self.rows + row]
    }

    /// Column `number`.
    pub fn column(&self, number: usize) -> &[f64] {
        &self.values[number * self.rows..(number + 1) * self.rows]
    }

    /// Column `number`.
    pub fn column_mut(&mut self, number: usize) -> &mut [f64] {
        &mut self.values[number * self.rows..(number + 1) * self.rows]
    }

    /// `self · vector`.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.rows];
        for (number, factor) in vector.iter().enumerate().filter(|(_, factor)| **factor != 0.0) {
            add_scaled(&mut product, self.column(number), *factor);
        }
        product
    }

    /// `|left|ᵀ |self| |right|`: what the form would be if nothing canceled, the measure of its round-off.
    pub fn magnitude(&self, left: &[Complex], right: &[Complex]) -> f64 {
        let mut sums = vec![0.0; self.rows];
        for (number, own) in right.iter().enumerate() {
            let size = own.norm();
            sums.iter_mut().zip(self.column(number)).for_each(|(sum, value)| *sum += size * value.abs());
        }
        left.iter().zip(sums).map(|(own, sum)| own.norm() * sum).sum()
    }

    /// Makes rows and columns of a square matrix alike in size by a similarity with powers of 2, whose factors it
    /// returns (Parlett and Reinsch 1969). Positions and their rates of stiff beams differ by their largest frequency,
    /// which would cost the soft modes as many digits.
    pub fn balance(&mut self) -> Vec<f64> {
        let mut scales = vec![1.0; self.columns];
        for _ in 0..MOST_SWEEPS {
            let mut is_balanced = true;
            for (own, scale) in scales.iter_mut().enumerate() {
                let (mut column, mut row) = (0.0, 0.0);
                for other in (0..self.rows).filter(|other| *other != own) {
                    column += self.at(other, own).abs();
                    row += self.at(own, other).abs();
                }
                if column == 0.0 || row == 0.0 {
                    continue;
                }
                let factor = exp2((0.5 * log2(row / column)).round());
                if column * factor + row / factor >= WORTHWHILE * (column + row) {
                    continue;
                }
                is_balanced = false;
                *scale *= factor;
                self.column_mut(own).iter_mut().for_each(|value| *value *= factor);
                (0..self.columns).for_each(|other| self.values[other * self.rows + own] /= factor);
            }
            if is_balanced {
                break;
            }
        }
        scales
    }

    pub(super) fn as_faer(&self) -> MatRef<'_, f64> {
        MatRef::from_column_major_slice(&self.values, self.rows, self.columns)
    }
}

/// `A P = Q R` by Householder's reflections, each with the column that has most left: `R` alone, `Q` is not kept.
#[derive(Clone, Debug)]
pub struct PivotedQr {
    /// The columns of `A` in the order of the columns of `R`.
    pub order: Vec<usize>,
    /// The rank of `A`.
    pub rank: usize,
    factor: Dense,
}

impl PivotedQr {
    /// Factorizes `matrix`; columns of which less than the share `round_off` of the largest one is left depend on those
    /// before.
    pub fn new(mut matrix: Dense, round_off: f64) -> Self {
        let mut order: Vec<usize> = (0..matrix.columns).collect();
        let (mut rank, mut first) = (0, 0.0);
        let rest = |matrix: &Dense, column: usize, row: usize| norm(&matrix.column(column)[row..]);
        while rank < matrix.rows.min(matrix.columns) {
            let norms = (rank..matrix.columns).map(|column| rest(&matrix, column, rank)).enumerate();
            let Some((ahead, largest)) = norms.max_by(|a, b| a.1.total_cmp(&b.1)) else { break };
            first = f64::max(first, largest);
            if largest <= round_off * first || largest == 0.0 {
                break;
            }
            order.swap(rank, rank + ahead);
            for row in 0..matrix.rows {
                matrix.values.swap(rank * matrix.rows + row, (rank + ahead) * matrix.rows + row);
            }
            // The reflection that takes the rest of the column to its first entry.
            let mut mirror = matrix.column(rank)[rank..].to_vec();
            let target = -largest.copysign(mirror[0]);
            mirror[0] -= target;
            let scale = 2.0 / mirror.iter().map(|value| value * value).sum::<f64>();
            for column in rank..matrix.columns {
                let own = &mut matrix.column_mut(column)[rank..];
                let share = scale * own.iter().zip(&mirror).map(|(own, mirror)| own * mirror).sum::<f64>();
                add_scaled(own, &mirror, -share);
            }
            rank += 1;
        }
        Self { order, rank, factor: matrix }
    }

    /// The shares of the independent columns in dependent column `k`, from [`Self::rank`] on in the order: `R₁₁⁻¹ r_k`.
    pub fn combination(&self, column: usize) -> Vec<f64> {
        let mut right = self.factor.column(column)[..self.rank].to_vec();
        self.back_substitute(&mut right);
        right
    }

    /// `right = R₁₁⁻¹ right`.
    fn back_substitute(&self, right: &mut [f64]) {
        for row in (0..self.rank).rev() {
            let column = self.factor.column(row);
            right[row] /= column[row];
            let own = right[row];
            add_scaled(&mut right[..row], &column[..row], -own);
        }
    }
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum::<f64>().sqrt()
}

fn add_scaled(target: &mut [f64], values: &[f64], factor: f64) {
    target.iter_mut().zip(values).for_each(|(target, value)| *target += factor * value);
}
