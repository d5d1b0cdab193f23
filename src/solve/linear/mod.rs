//! Sparse linear systems: a multifrontal LU, a general one behind it, and factors of symmetric matrices.

pub mod cholesky;
mod columns;
pub mod dense;
mod dense_products;
pub mod direct;
pub mod eigen;
pub mod elimination_tree;
pub mod front;
pub mod frontal_matrix;
pub mod mass_factor;
pub mod multifrontal;
pub mod ordering;
mod repeated;
pub mod sparse_ldl;
pub mod sparse_lu;
mod symmetric;
mod transposed;
pub mod units;
mod waiting_bodies;

/// Refinement steps at most; one restores the digits that stiff beams cost, the others are for near-singular systems.
pub(super) const REFINEMENTS: usize = 4;
/// Largest componentwise backward error of an accepted solution (Oettli-Prager): a normwise one looks fine on solutions
/// wrong in the fifth digit.
pub(super) const BACKWARD_ERROR: f64 = 1e-12;

/// Terms below this share of a row's largest possible term are taken as round-off of the others.
pub(super) const NEGLIGIBLE: f64 = 1e-10;

/// Smallest size of a scaled solution that its backward error is judged by. Near 1e-308 doubles lose their digits one
/// after the other, and the error of a right solution becomes any share of it: a motor whose rate fades away passes
/// through there.
pub(super) const SMALLEST_SOLUTION: f64 = 1e-280;

/// A direction that the matrix maps to less than this share of its terms is a null direction. Measured: 1e-16 and below
/// for free and doubly held systems (round-off of a row's sum), 2.5e-13 and 3.2e-15 for the softest direction of a
/// slender cantilever of 1,000 and 3,000 elements. From some 4,000 on, such a beam cannot be told from a free one in
/// double precision.
pub(super) const ROUND_OFF: f64 = 1e-15;

/// A number between 0.5 and 1.5 for each unknown, with no pattern that a null vector could be orthogonal to.
pub fn irregular(index: usize) -> f64 {
    0.5 + (0.3 + 0.618_033_988_749_895 * index as f64).fract()
}

/// The componentwise backward error `max |r|_i / (|A||x| + |b|)_i` (Oettli-Prager) of the remainder `r` and the sizes
/// of the terms of its rows; infinite when not finite.
fn largest_share(remainder: &[f64], magnitude: &[f64]) -> f64 {
    let mut error = 0.0_f64;
    for (remainder, magnitude) in remainder.iter().zip(magnitude) {
        if !remainder.is_finite() {
            return f64::INFINITY;
        }
        if *magnitude > 0.0 {
            // Compilers divide first and choose afterwards: not by 0, which hosts may trap.
            error = error.max(remainder.abs() / magnitude.max(f64::MIN_POSITIVE));
        }
    }
    error
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
