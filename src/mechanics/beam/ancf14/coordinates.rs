//! Order of the coordinates (MECHANICS 3.3): a node is `r` (3), `p = r'` (3), `theta` (1); an element is its two nodes.

use crate::math::vectors::{add_vec3, vec3};
use crate::math::{Mat3, Vec3};
use nalgebra::{SMatrix, SVector};

/// Coordinates of a node.
pub const NODE: usize = 7;
/// Coordinates of an element.
pub const ELEMENT: usize = 14;
/// Position of the position in a node, m.
pub const R: usize = 0;
/// Position of the slope in a node, 1.
pub const P: usize = 3;
/// Position of the twist angle in a node, rad.
pub const THETA: usize = 6;

/// Where `X_a` of `X = (r_0, p_0, r_1, p_1)` starts in an element's coordinates.
pub const SHAPE_PLACES: [usize; 4] = [R, P, NODE + R, NODE + P];

/// Which `X_a` are not `r_0`, and where they start.
pub const CHORD_PLACES: [(usize, usize); 3] = [(1, P), (2, NODE + R), (3, NODE + P)];

/// One number per coordinate of an element.
pub type ElementVector = SVector<f64, ELEMENT>;
/// One number per pair of coordinates of an element.
pub type ElementMatrix = SMatrix<f64, ELEMENT, ELEMENT>;

/// The columns of such a matrix.
pub type ElementColumns = [[f64; ELEMENT]; ELEMENT];

/// `Σ_a weight_a X_a` of the element coordinates `q` (14).
#[inline]
pub fn interpolate(weights: &[f64; 4], q: &[f64]) -> Vec3 {
    let q = &q[..ELEMENT];
    vec3(q, R) * weights[0] + vec3(q, P) * weights[1] + vec3(q, NODE + R) * weights[2] + vec3(q, NODE + P) * weights[3]
}

/// `r'` at the three axial points: at the ends of the element it is the slope of a node, in its middle `X_a` have the
/// weights `weights`.
#[inline]
pub fn slopes(weights: &[f64; 4], q: &[f64]) -> [Vec3; 3] {
    [vec3(q, P), interpolate(weights, q), vec3(q, NODE + P)]
}

/// Which `X_a` alone has a weight in `r'`, and where it starts, at the ends of the element.
#[inline]
fn slope_of_node(weights: &[f64; 4]) -> Option<(usize, usize)> {
    (weights[2] == 0.0).then_some(if weights[1] == 0.0 { (3, NODE + P) } else { (1, P) })
}

/// Adds `weightsᵀ v` to `sum`, 14×1, where `weights` are those of an axial point.
#[inline]
pub fn add_slope_force(weights: &[f64; 4], v: &Vec3, sum: &mut ElementVector) {
    match slope_of_node(weights) {
        Some((a, place)) => add_vec3(sum.as_mut_slice(), place, &(v * weights[a])),
        None => {
            for (weight, place) in weights.iter().zip(SHAPE_PLACES) {
                add_vec3(sum.as_mut_slice(), place, &(v * *weight));
            }
        }
    }
}

/// `weightsᵀ v`, 14×1: the generalized force of a vector `v` that works on `Σ_a weight_a X_a`.
#[inline]
pub fn spread(weights: &[f64; 4], v: &Vec3) -> ElementVector {
    let mut sum = ElementVector::zeros();
    for (weight, place) in weights.iter().zip(SHAPE_PLACES) {
        sum.fixed_rows_mut::<3>(place).copy_from(&(v * *weight));
    }
    sum
}

/// Adds `weightsᵀ block weights`, 14×14, to `sum`: the stiffness of a force that changes by `block` with
/// `Σ_a weight_a X_a`, without the rows and columns of `r_0`, which [`complete`] sets.
#[inline]
pub fn add_spread(weights: &[f64; 4], block: &Mat3, sum: &mut ElementColumns) {
    if let Some((a, place)) = slope_of_node(weights) {
        add_block(&(block * (weights[a] * weights[a])), place, place, sum);
        return;
    }
    for (b, column) in CHORD_PLACES {
        for (a, row) in CHORD_PLACES {
            add_block(&(block * (weights[a] * weights[b])), row, column, sum);
        }
    }
}

#[inline]
fn add_block(block: &Mat3, row: usize, column: usize, sum: &mut ElementColumns) {
    for j in 0..3 {
        for i in 0..3 {
            sum[column + j][row + i] += block[(i, j)];
        }
    }
}

/// Adds `by_q (weightsᵀ right)ᵀ + weightsᵀ left by_endᵀ`, 14×14, to `sum`, without the rows and columns of `r_0`: of
/// what `by_q`, or by the end of a step `by_end`, changes by with a function of `Σ_a weight_a X_a` that has the
/// derivatives `left`, or `right` by the end of a step.
#[inline]
pub fn add_between(
    [by_q, by_end]: [&ElementVector; 2],
    weights: &[f64; 4],
    [left, right]: [&Vec3; 2],
    sum: &mut ElementColumns,
) {
    for (a, place) in CHORD_PLACES {
        // At the ends of the element most weights are 0.
        if weights[a] == 0.0 {
            continue;
        }
        let (left, right) = (left * weights[a], right * weights[a]);
        for i in 0..3 {
            for row in P..ELEMENT {
                sum[place + i][row] += by_q[row] * right[i];
            }
        }
        for column in P..ELEMENT {
            for i in 0..3 {
                sum[column][place + i] += left[i] * by_end[column];
            }
        }
    }
}

/// Adds `factor by_row by_columnᵀ`, 14×14, to `sum`, without the rows and columns of `r_0`.
#[inline]
pub fn add_product(factor: f64, by_row: &ElementVector, by_column: &ElementVector, sum: &mut ElementColumns) {
    for column in P..ELEMENT {
        let factor = factor * by_column[column];
        for row in P..ELEMENT {
            sum[column][row] += by_row[row] * factor;
        }
    }
}

/// Sets the rows and columns of `r_0` to the opposite of those of `r_1`: of the two places only the chord between them
/// counts.
#[inline]
pub fn complete(sum: &mut ElementColumns) {
    for column in &mut sum[P..] {
        for i in 0..3 {
            column[R + i] = -column[NODE + R + i];
        }
    }
    for i in 0..3 {
        sum[R + i] = sum[NODE + R + i].map(|value| -value);
    }
}
