//! How many pivots of a symmetric matrix are negative: `L D Lᵀ` front by front (`fronts`), without exchanges. By Sylvester's law of inertia as many
//! eigenvalues are.
//!
//! A positive definite matrix needs no exchanges. Of another one a pivot may come out small by chance; what it does to the others tells whether they
//! can still be trusted.

use super::front_matrix::eliminate_symmetric;
use super::fronts::Fronts;
use super::multifrontal::{add_pieces, add_rest};
use crate::math::blocks::Blocks;

/// Order and memory for one matrix.
#[derive(Debug)]
pub struct Signature {
    fronts: Fronts,
    /// The dense matrices of all fronts, column by column.
    matrices: Vec<f64>,
    /// What each pivot of a front is measured by.
    measures: Vec<f64>,
}

impl Signature {
    /// For the pattern of `blocks`, of `size` unknowns, the last of which, from `bodies` on, are those of bodies. None for want of memory.
    pub fn new(size: usize, bodies: usize, blocks: &Blocks) -> Option<Self> {
        let fronts = Fronts::new(size, [bodies, size], blocks)?;
        Some(Self { matrices: vec![0.0; fronts.storage], measures: vec![0.0; fronts.longest], fronts })
    }

    /// How many pivots are negative of the symmetric part of `blocks` (of the same layout as at the start), whose unknowns are measured in `scale`;
    /// none where a pivot vanishes or says nothing.
    pub fn negative_pivots(&mut self, blocks: &Blocks, scale: impl Fn(usize) -> f64) -> Option<usize> {
        let Self { fronts, matrices, measures } = self;
        let mut negative = 0;
        for front in &fronts.fronts {
            let (done, rest) = matrices.split_at_mut(front.start);
            let matrix = &mut rest[..front.shape.size()];
            matrix.fill(0.0);
            add_pieces(fronts, front, blocks.values(), matrix);
            let stride = front.shape.stride();
            symmetrize(matrix, stride);
            let measures = &mut measures[..front.pivots.len()];
            let diagonal = matrix.iter().step_by(stride + 1);
            for ((measure, value), unknown) in
                measures.iter_mut().zip(diagonal).zip(&fronts.unknowns[front.pivots.clone()])
            {
                *measure = f64::max(value.abs(), 1.0 / scale(*unknown).powi(2));
            }
            for child in &fronts.children[front.children.clone()] {
                let child = &fronts.fronts[*child];
                add_rest(done, child, &fronts.runs[child.runs.clone()], matrix, stride);
            }
            negative += eliminate_symmetric(front.shape, matrix, measures)?;
        }
        Some(negative)
    }
}

/// Takes the symmetric part of a matrix whose columns are `stride` apart.
fn symmetrize(matrix: &mut [f64], stride: usize) {
    for column in 0..matrix.len() / stride {
        for row in 0..column {
            let (upper, lower) = (column * stride + row, row * stride + column);
            let mean = 0.5 * (matrix[upper] + matrix[lower]);
            (matrix[upper], matrix[lower]) = (mean, mean);
        }
    }
}
