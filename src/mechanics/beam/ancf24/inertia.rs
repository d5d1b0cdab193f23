//! Inertia: constant mass matrix and the weight. The turning of sections is in it, about all three axes.

use super::coordinates::{AXIS_PLACES, ELEMENT, Y_PLACES, Z_PLACES};
use crate::math::hermite;

/// Products of shape functions, integrated over the element, with the density: the mass matrix is this times the unit
/// matrix of space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// `ρA ∫ N_a N_b dx` of the vectors of the axis, kg.
    axis: [[f64; 4]; 4],
    /// `ρ ∫ y² dA` and `ρ ∫ z² dA` times the length, kg m².
    across: [f64; 2],
}

impl Mass {
    /// `line_density` is `ρA`, kg/m; `across` is `ρ ∫ y² dA`, `ρ ∫ z² dA`, kg m; `length` in m.
    pub fn new(line_density: f64, across: [f64; 2], length: f64) -> Self {
        let axis = hermite::products(length).map(|row| row.map(|product| line_density * product));
        Self { axis, across: across.map(|inertia| inertia * length) }
    }

    /// Calls `entry` with each pair of vectors of the element and their entry.
    fn each(&self, mut entry: impl FnMut(usize, usize, f64)) {
        for (a, row) in AXIS_PLACES.into_iter().enumerate() {
            for (b, column) in AXIS_PLACES.into_iter().enumerate() {
                entry(row, column, self.axis[a][b]);
            }
        }
        for (places, inertia) in [Y_PLACES, Z_PLACES].into_iter().zip(self.across) {
            for row in places {
                for column in places {
                    entry(row, column, inertia / if row == column { 3.0 } else { 6.0 });
                }
            }
        }
    }

    /// Adds `factor` times the mass matrix to the column-major `block`, 24×24.
    pub fn add(&self, factor: f64, block: &mut [f64]) {
        self.each(|row, column, mass| {
            (0..3).for_each(|axis| block[(column + axis) * ELEMENT + row + axis] += factor * mass);
        });
    }

    /// Adds the product with `vector` (24) to `product` (24).
    pub fn add_times(&self, vector: &[f64], product: &mut [f64]) {
        self.each(|row, column, mass| {
            (0..3).for_each(|axis| product[row + axis] += mass * vector[column + axis]);
        });
    }
}
