//! Eigenvalues of dense matrices with their right and left vectors.

use super::dense::{Complex, Dense};
use super::{Singular, repeated};
use faer::Mat;
use faer::linalg::solvers::DenseSolveCore;

/// An eigenvalue and its eigenvector.
pub type Eigenpair = (Complex, Vec<Complex>);

/// An eigenvalue with both its vectors.
#[derive(Clone, Debug, PartialEq)]
pub struct Eigen {
    /// The eigenvalue.
    pub value: Complex,
    /// The right vector.
    pub right: Vec<Complex>,
    /// The left vector.
    pub left: Vec<Complex>,
}

/// Eigenvalues and vectors of a balanced matrix, with the factors of [`Dense::balance`].
struct Balanced {
    values: Vec<Complex>,
    vectors: Vec<Vec<Complex>>,
    scales: Vec<f64>,
}

impl Eigen {
    /// `|λ|`.
    pub fn size(&self) -> f64 {
        self.value.norm()
    }
}

impl Dense {
    /// Its eigenvalues with their right and left vectors: `yᵢᵀ xⱼ` is 1 for `i = j`, else 0.
    ///
    /// # Errors
    /// They do not converge, a value is not finite, or there are fewer vectors than rows.
    pub fn eigensystem(&self) -> Result<Vec<Eigen>, Singular> {
        let Balanced { values, vectors, scales } = self.balanced_eigen()?;
        let left = Mat::from_fn(self.rows, self.columns, |row, number| vectors[number][row]).partial_piv_lu().inverse();
        let own = (0..self.columns).map(|number| Eigen {
            value: values[number],
            right: vectors[number].iter().zip(&scales).map(|(own, scale)| own * scale).collect(),
            left: (0..self.rows).map(|row| left[(number, row)] / scales[row]).collect(),
        });
        let own: Vec<Eigen> = own.collect();
        let is_finite = |own: &Eigen| own.left.iter().all(|value| value.is_finite());
        if own.iter().all(is_finite) { Ok(own) } else { Err(Singular) }
    }

    /// Its eigenvalues, and of each the eigenvector.
    ///
    /// # Errors
    /// They do not converge, or a value is not finite.
    pub fn eigenvectors(&self) -> Result<Vec<Eigenpair>, Singular> {
        let Balanced { values, vectors, scales } = self.balanced_eigen()?;
        let vectors = vectors.into_iter().map(|own| own.iter().zip(&scales).map(|(own, scale)| own * scale).collect());
        Ok(values.into_iter().zip(vectors).collect())
    }

    /// Eigenvalues and vectors of the balanced matrix.
    fn balanced_eigen(&self) -> Result<Balanced, Singular> {
        if self.values.iter().any(|value| !value.is_finite()) {
            return Err(Singular);
        }
        let mut balanced = self.clone();
        let scales = balanced.balance();
        let found = balanced.as_faer().eigen().map_err(|_| Singular)?;
        let values: Vec<Complex> = found.S().column_vector().iter().copied().collect();
        let column = |number: usize| (0..self.rows).map(|row| found.U()[(row, number)]).collect();
        let mut vectors: Vec<Vec<Complex>> = (0..self.columns).map(column).collect();
        repeated::separate(&balanced, &values, &mut vectors);
        Ok(Balanced { values, vectors, scales })
    }
}
