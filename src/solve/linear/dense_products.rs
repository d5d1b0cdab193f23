//! Products of dense matrices, and factors that the reduction of linear systems needs.

use super::dense::Dense;
use super::{Singular, irregular};
use faer::linalg::solvers::Solve;
use faer::{Mat, MatRef};

/// Iterations for a subspace, of which each leaves [`SHIFT`] of what is not in it.
const ITERATIONS: usize = 8;
/// The shift over the size of the first eigenvalue outside.
const SHIFT: f64 = 1e-4;

pub(super) fn from_faer(matrix: MatRef<'_, f64>) -> Dense {
    let mut own = Dense::zeros(matrix.nrows(), matrix.ncols());
    for column in 0..own.columns {
        (0..own.rows).for_each(|row| own.column_mut(column)[row] = matrix[(row, column)]);
    }
    own
}

impl Dense {
    /// `self · other`.
    #[must_use]
    pub fn product(&self, other: &Self) -> Self {
        let mut product = Self::zeros(self.rows, other.columns);
        for column in 0..other.columns {
            product.column_mut(column).copy_from_slice(&self.times(other.column(column)));
        }
        product
    }

    /// The transpose.
    #[must_use]
    pub fn transposed(&self) -> Self {
        let mut own = Self::zeros(self.columns, self.rows);
        for column in 0..self.columns {
            (0..self.rows).for_each(|row| own.column_mut(row)[column] = self.at(row, column));
        }
        own
    }

    /// The rows with these numbers.
    #[must_use]
    pub fn rows_of(&self, rows: &[usize]) -> Self {
        let mut own = Self::zeros(rows.len(), self.columns);
        for column in 0..self.columns {
            rows.iter().enumerate().for_each(|(to, from)| own.column_mut(column)[to] = self.at(*from, column));
        }
        own
    }

    /// The columns with these numbers.
    #[must_use]
    pub fn columns_at(&self, columns: impl IntoIterator<Item = usize>) -> Self {
        let mut own = Self { rows: self.rows, ..Self::default() };
        for column in columns {
            own.columns += 1;
            own.values.extend_from_slice(self.column(column));
        }
        own
    }

    /// The columns of this matrix and of `other`.
    #[must_use]
    pub fn beside(mut self, other: &Self) -> Self {
        self.columns += other.columns;
        self.values.extend_from_slice(&other.values);
        self
    }

    /// `self - other`.
    #[must_use]
    pub fn minus(mut self, other: &Self) -> Self {
        self.values.iter_mut().zip(&other.values).for_each(|(own, other)| *own -= other);
        self
    }

    /// `(self + selfᵀ)/2`.
    #[must_use]
    pub fn symmetric_part(&self) -> Self {
        let mut own = self.transposed();
        own.values.iter_mut().zip(&self.values).for_each(|(own, other)| *own = 0.5 * (*own + other));
        own
    }

    /// `|self|`, entry by entry.
    #[must_use]
    pub fn sizes(&self) -> Self {
        let values = self.values.iter().map(|value| value.abs()).collect();
        Self { rows: self.rows, columns: self.columns, values }
    }

    /// `self⁻¹ · right`.
    #[must_use]
    pub fn solve(&self, right: &Self) -> Self {
        from_faer(self.as_faer().partial_piv_lu().solve(right.as_faer()).as_ref())
    }

    /// `U`, the singular values and `V` of `U S Vᵀ`.
    ///
    /// # Errors
    /// They do not converge.
    pub fn singular(&self) -> Result<(Self, Vec<f64>, Self), Singular> {
        let found = self.as_faer().thin_svd().map_err(|_| Singular)?;
        let values = found.S().column_vector().iter().copied().collect();
        Ok((from_faer(found.U()), values, from_faer(found.V())))
    }

    /// A basis of the space of the `count` eigenvalues near 0, the next one of which has the size `next`.
    ///
    /// # Errors
    /// A number is not finite.
    pub fn space_near_zero(&self, count: usize, next: f64) -> Result<Self, Singular> {
        let shift = SHIFT * next;
        let shifted = Mat::from_fn(self.rows, self.columns, |row, column| {
            self.at(row, column) - if row == column { shift } else { 0.0 }
        });
        let factor = shifted.partial_piv_lu();
        let mut basis = Mat::from_fn(self.rows, count, |row, column| irregular(row * count + column));
        for _ in 0..ITERATIONS {
            basis = factor.solve(&basis).qr().compute_thin_Q();
        }
        let own = from_faer(basis.as_ref());
        if own.values.iter().all(|value| value.is_finite()) { Ok(own) } else { Err(Singular) }
    }
}
