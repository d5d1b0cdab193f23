//! Vectors of equal eigenvalues. An eigenvalue that several motions have, as that of two equal bearings, has a space of
//! vectors. Those that back substitution finds of it one by one can be nearly parallel: the inverse of all vectors, the
//! left ones, is then round-off. Inverse iteration with all of them at once finds a basis that is not.

use super::dense::{Complex, Dense};
use super::irregular;
use faer::Mat;
use faer::prelude::Solve;

/// Eigenvalues are one if they differ by less than this share.
const SAME: f64 = 1e-7;
/// Vectors of which less than this share is left without the ones before are nearly parallel.
const NEARLY_PARALLEL: f64 = 1e-2;
/// The eigenvalue that is iterated with is off by this share: the matrix is then not singular.
const SHIFT: f64 = 1e-6;
/// Each reduces the share of other motions by [`SHIFT`] over the share by which their eigenvalues differ.
const ITERATIONS: usize = 3;
/// Largest remainder of a new vector, over its eigenvalue: an eigenvalue without a whole space of vectors, as that of
/// critical damping, has a larger one, and keeps the vectors that it has.
const LARGEST_REMAINDER: f64 = 1e-5;

/// Replaces vectors of equal eigenvalues of `matrix` that are nearly parallel by an orthonormal basis of their space.
pub(super) fn separate(matrix: &Dense, values: &[Complex], vectors: &mut [Vec<Complex>]) {
    for group in groups(values) {
        let mut own: Vec<Vec<Complex>> = group.iter().map(|number| vectors[*number].clone()).collect();
        if orthonormalize(&mut own) > NEARLY_PARALLEL {
            continue;
        }
        let Some(basis) = invariant(matrix, values[group[0]], group.len()) else { continue };
        for (number, vector) in group.into_iter().zip(basis) {
            // The other one of a pair follows it.
            if values[number].im > 0.0 && values.get(number + 1) == Some(&values[number].conj()) {
                vectors[number + 1] = vector.iter().map(|own| own.conj()).collect();
            }
            vectors[number] = vector;
        }
    }
}

/// The numbers of equal eigenvalues that are not 0, of pairs those with the positive imaginary part.
fn groups(values: &[Complex]) -> Vec<Vec<usize>> {
    let mut groups: Vec<Vec<usize>> = Vec::new();
    for (number, value) in values.iter().enumerate().filter(|(_, value)| value.im >= 0.0) {
        let is_same = |group: &&mut Vec<usize>| (values[group[0]] - value).norm() < SAME * value.norm();
        match groups.iter_mut().find(is_same) {
            Some(group) => group.push(number),
            None => groups.push(vec![number]),
        }
    }
    groups.retain(|group| group.len() > 1);
    groups
}

/// Makes `vectors` orthonormal, each without the ones before, and returns the least share that is left of one.
fn orthonormalize(vectors: &mut [Vec<Complex>]) -> f64 {
    let mut least = 1.0_f64;
    for number in 0..vectors.len() {
        let (before, rest) = vectors.split_at_mut(number);
        let own = &mut rest[0];
        let whole = norm(own);
        // Twice: the first time leaves round-off over what is left.
        for other in before.iter().chain(before.iter()) {
            let share: Complex = other.iter().zip(own.iter()).map(|(other, own)| other.conj() * own).sum();
            own.iter_mut().zip(other).for_each(|(own, other)| *own -= share * other);
        }
        let left = norm(own);
        least = least.min(left / whole);
        own.iter_mut().for_each(|own| *own /= left);
    }
    least
}

/// An orthonormal basis of the `count` vectors of `matrix` with the eigenvalue `value`; none: it has fewer.
fn invariant(matrix: &Dense, value: Complex, count: usize) -> Option<Vec<Vec<Complex>>> {
    let size = matrix.rows;
    let shifted = value * (1.0 + SHIFT);
    // Real and imaginary parts one above the other: the kernels of complex numbers would come for this alone.
    let entry = |row: usize, column: usize| match (row < size, column < size) {
        (true, true) | (false, false) => {
            matrix.at(row % size, column % size) - if row % size == column % size { shifted.re } else { 0.0 }
        }
        (true, false) if row == column - size => shifted.im,
        (false, true) if row - size == column => -shifted.im,
        _ => 0.0,
    };
    let factor = Mat::from_fn(2 * size, 2 * size, entry).partial_piv_lu();
    let start = |part: usize, row: usize, number: usize| irregular((2 * number + part) * size + row) - 1.0;
    let first = |number: usize| {
        (0..size).map(|row| Complex::new(start(0, row, number), start(1, row, number))).collect::<Vec<_>>()
    };
    let mut basis: Vec<Vec<Complex>> = (0..count).map(first).collect();
    for _ in 0..ITERATIONS {
        let parts = |row: usize, number: usize| match row.checked_sub(size) {
            None => basis[number][row].re,
            Some(row) => basis[number][row].im,
        };
        let found = factor.solve(Mat::from_fn(2 * size, count, parts));
        let vector = |number: usize| {
            (0..size).map(|row| Complex::new(found[(row, number)], found[(size + row, number)])).collect()
        };
        basis = (0..count).map(vector).collect();
        if orthonormalize(&mut basis) == 0.0 {
            return None;
        }
    }
    let is_exact = |vector: &Vec<Complex>| remainder(matrix, value, vector) <= LARGEST_REMAINDER * value.norm();
    basis.iter().all(is_exact).then_some(basis)
}

/// `|A x − λ x|`.
fn remainder(matrix: &Dense, value: Complex, vector: &[Complex]) -> f64 {
    let [real, imaginary] = [|own: &Complex| own.re, |own: &Complex| own.im]
        .map(|part| matrix.times(&vector.iter().map(part).collect::<Vec<f64>>()));
    let rows = vector.iter().zip(real).zip(imaginary);
    rows.map(|((own, re), im)| (Complex::new(re, im) - value * own).norm_sqr()).sum::<f64>().sqrt()
}

fn norm(vector: &[Complex]) -> f64 {
    vector.iter().map(|own| own.norm_sqr()).sum::<f64>().sqrt()
}
