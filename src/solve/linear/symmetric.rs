//! Vibrations of small systems with symmetric dense matrices: `K x = λ M x`.

use super::Singular;
use super::dense::Dense;
use super::dense_products::from_faer;
use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Mat, Par, Side};

/// Vibrations whose `1/(λ + shift)` is below this share of the largest one are round-off, and left out.
const ROUND_OFF: f64 = 1e-13;

impl Dense {
    /// The values `λ` of `self x = λ mass x`, rising, and their vectors with `xᵀ mass x = 1`. Both matrices are
    /// symmetric, and `self + shift mass` is positive definite. Its factors keep the digits of the smallest `λ`, which
    /// those of `mass` would lose under the largest ones. Vibrations that are round-off then are left out.
    ///
    /// # Errors
    /// `self + shift mass` is not positive definite, or the values do not converge.
    pub fn vibrations(&self, mass: &Self, shift: f64) -> Result<(Vec<f64>, Self), Singular> {
        let count = self.rows;
        let shifted = |row: usize, column: usize| self.at(row, column) + shift * mass.at(row, column);
        let scales: Vec<f64> = (0..count).map(|own| 1.0 / shifted(own, own).sqrt()).collect();
        if scales.iter().any(|scale| !scale.is_finite()) {
            return Err(Singular);
        }
        let scaled = Mat::from_fn(count, count, |row, column| shifted(row, column) * scales[row] * scales[column]);
        let factor = scaled.llt(Side::Lower).map_err(|_| Singular)?;
        let lower = factor.L();
        let mut turned = Mat::from_fn(count, count, |row, column| mass.at(row, column) * scales[row] * scales[column]);
        for _ in 0..2 {
            solve_lower_triangular_in_place(lower, turned.as_mut(), Par::Seq);
            turned = turned.transpose().to_owned();
        }
        let turned = Mat::from_fn(count, count, |row, column| 0.5 * (turned[(row, column)] + turned[(column, row)]));
        let found = turned.self_adjoint_eigen(Side::Lower).map_err(|_| Singular)?;
        let mut vectors = found.U().to_owned();
        solve_upper_triangular_in_place(lower.transpose(), vectors.as_mut(), Par::Seq);
        // The largest shares of the mass, the last ones, are the smallest values.
        let shares = found.S().column_vector().iter().rev().copied();
        let mut shares: Vec<f64> = shares.collect();
        let least = ROUND_OFF * shares.first().copied().unwrap_or(0.0);
        shares.retain(|share| *share > least);
        let mut vectors = from_faer(vectors.as_ref().reverse_cols().subcols(0, shares.len()));
        for (number, share) in shares.iter().enumerate() {
            let column = vectors.column_mut(number).iter_mut().zip(&scales);
            column.for_each(|(value, scale)| *value *= scale / share.sqrt());
        }
        let values: Vec<f64> = shares.iter().map(|share| 1.0 / share - shift).collect();
        let is_finite = vectors.values.iter().chain(&values).all(|value| value.is_finite());
        if is_finite { Ok((values, vectors)) } else { Err(Singular) }
    }
}
