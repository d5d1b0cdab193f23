//! Order of the coordinates: a node is `r`, `r_x`, `r_y`, `r_z` (3 each); an element is its two nodes.
//!
//! Inside, `r(x, y, z) = r(x) + y r_y(x) + z r_z(x)`: the axis is the cubic through the nodes (`s1, s2, s5, s6` of the
//! element), the gradients across are linear (`s3, s4, s7, s8`). All that strains need of a section are its five
//! directors.

use crate::math::vectors::vec3;
use crate::math::{Vec3, hermite};
use nalgebra::SVector;

/// Coordinates of a node.
pub const NODE: usize = 12;
/// Coordinates of an element.
pub const ELEMENT: usize = 24;
/// Position of the position in a node, m.
pub const R: usize = 0;
/// Place of `r_x`, the slope, in a node, 1.
pub const X: usize = 3;
/// Place of `r_y` in a node, 1.
pub const Y: usize = 6;
/// Place of `r_z` in a node, 1.
pub const Z: usize = 9;

/// Where the vectors start that the axis is interpolated from.
pub const AXIS_PLACES: [usize; 4] = [R, X, NODE + R, NODE + X];
/// Where `r_y` starts in both nodes.
pub const Y_PLACES: [usize; 2] = [Y, NODE + Y];
/// Where `r_z` starts in both nodes.
pub const Z_PLACES: [usize; 2] = [Z, NODE + Z];

/// One number per coordinate of an element.
pub type ElementVector = SVector<f64, ELEMENT>;
/// Numbers of a section's directors.
pub const DIRECTORS: usize = 15;
/// The directors of a section: `r_x`, `r_y`, `r_z` (1), `r_xy`, `r_xz` (1/m), 3 each.
pub type Directors = SVector<f64, DIRECTORS>;
/// Stiffness in the directors of a section, row after row.
pub type DirectorMatrix = [[f64; DIRECTORS]; DIRECTORS];

/// How the directors of a section are interpolated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interpolation {
    /// Weights of the four vectors of the axis in `r_x`.
    shape_x: [f64; 4],
    /// Weights of both nodes in `r_y` and `r_z`.
    linear: [f64; 2],
    /// Weights of both nodes in `r_xy` and `r_xz`, 1/m.
    linear_x: [f64; 2],
}

impl Interpolation {
    /// At `xi` (0 to 1) of an element of this length, m.
    pub fn new(xi: f64, length: f64) -> Self {
        Self { shape_x: hermite::shape_x(xi, length), linear: [1.0 - xi, xi], linear_x: [-1.0 / length, 1.0 / length] }
    }

    /// The eight vectors of an element: where each starts, and what it gives to which directors (number, weight); the
    /// second director of an axis vector has no weight.
    fn shares(&self) -> [(usize, [(usize, f64); 2]); 8] {
        let axis = |a: usize| (AXIS_PLACES[a], [(0, self.shape_x[a]), (0, 0.0)]);
        let across = |places: [usize; 2], director: usize, node: usize| {
            (places[node], [(director, self.linear[node]), (director + 2, self.linear_x[node])])
        };
        let (y, z) = (|node| across(Y_PLACES, 1, node), |node| across(Z_PLACES, 2, node));
        [axis(0), axis(1), y(0), z(0), axis(2), axis(3), y(1), z(1)]
    }

    /// The directors of the element coordinates `q` (24).
    pub fn directors(&self, q: &[f64]) -> Directors {
        let mut sum = Directors::zeros();
        for (place, shares) in self.shares() {
            let vector = vec3(q, place);
            for (director, weight) in shares {
                let mut rows = sum.fixed_rows_mut::<3>(3 * director);
                rows += vector * weight;
            }
        }
        sum
    }

    /// Adds the generalized forces of `forces` on the directors to `sum` (24).
    pub fn spread(&self, forces: &Directors, sum: &mut [f64]) {
        for (place, shares) in self.shares() {
            let [(first, a), (second, b)] = shares;
            let force = part(forces, first) * a + part(forces, second) * b;
            sum[place..place + 3].iter_mut().zip(&force).for_each(|(target, value)| *target += value);
        }
    }

    /// Adds `scale` times the stiffness `matrix` of the directors to the column-major `block`, 24×24.
    pub fn add_spread(&self, matrix: &DirectorMatrix, scale: f64, block: &mut [f64]) {
        let shares = self.shares();
        // Columns first: what each vector of the element moves all directors' forces by.
        for (column_place, [(first, a), (second, b)]) in shares {
            for column in 0..3 {
                let mut forces = [0.0; DIRECTORS];
                for (force, row) in forces.iter_mut().zip(matrix) {
                    *force = scale * (a * row[3 * first + column] + b * row[3 * second + column]);
                }
                let start = (column_place + column) * ELEMENT;
                let target = &mut block[start..start + ELEMENT];
                for (row_place, [(first, a), (second, b)]) in shares {
                    for row in 0..3 {
                        target[row_place + row] += a * forces[3 * first + row] + b * forces[3 * second + row];
                    }
                }
            }
        }
    }
}

/// Director `number` of `directors`.
pub fn part(directors: &Directors, number: usize) -> Vec3 {
    directors.fixed_rows::<3>(3 * number).into_owned()
}
