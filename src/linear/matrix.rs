//! Dense matrices, column after column. Sums have a fixed order, so that results have the same bits on every processor.

/// A dense matrix.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Its numbers, column after column.
    pub values: Vec<f64>,
}

impl Matrix {
    /// A matrix of zeros.
    pub fn zeros(rows: usize, columns: usize) -> Self {
        Self { rows, columns, values: vec![0.0; rows * columns] }
    }

    /// Ones on the diagonal.
    pub(super) fn identity(size: usize) -> Self {
        let mut identity = Self::zeros(size, size);
        (0..size).for_each(|number| identity.values[number * size + number] = 1.0);
        identity
    }

    /// The number in a row and a column.
    pub fn at(&self, row: usize, column: usize) -> f64 {
        self.values[column * self.rows + row]
    }

    pub(super) fn at_mut(&mut self, row: usize, column: usize) -> &mut f64 {
        &mut self.values[column * self.rows + row]
    }

    /// A column.
    pub(super) fn column(&self, number: usize) -> &[f64] {
        &self.values[number * self.rows..][..self.rows]
    }

    /// Adds `factor` times the product with `vector` to `target`.
    pub(super) fn add_to(&self, vector: &[f64], factor: f64, target: &mut [f64]) {
        for (number, part) in vector.iter().enumerate() {
            let part = factor * part;
            target.iter_mut().zip(self.column(number)).for_each(|(target, value)| *target += value * part);
        }
    }

    /// The product of a row with a vector.
    pub(super) fn row_times(&self, row: usize, vector: &[f64]) -> f64 {
        vector.iter().enumerate().map(|(column, part)| self.at(row, column) * part).sum()
    }

    /// The product of two matrices.
    pub(super) fn times(&self, other: &Self) -> Self {
        let mut product = Self::zeros(self.rows, other.columns);
        for (number, target) in product.values.chunks_exact_mut(self.rows.max(1)).enumerate() {
            self.add_to(other.column(number), 1.0, target);
        }
        product
    }

    /// The matrix times a number.
    pub(super) fn scaled(mut self, factor: f64) -> Self {
        self.values.iter_mut().for_each(|value| *value *= factor);
        self
    }

    /// Adds another one, times a number.
    pub(super) fn add(&mut self, factor: f64, other: &Self) {
        self.values.iter_mut().zip(&other.values).for_each(|(value, other)| *value += factor * other);
    }

    /// The largest sum of absolute values in a column.
    pub(super) fn norm(&self) -> f64 {
        let columns = self.values.chunks_exact(self.rows.max(1));
        columns.map(|column| column.iter().map(|value| value.abs()).sum::<f64>()).fold(0.0, f64::max)
    }

    pub(super) fn is_finite(&self) -> bool {
        self.values.iter().all(|value| value.is_finite())
    }
}
