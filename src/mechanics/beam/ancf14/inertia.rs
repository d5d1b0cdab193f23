//! Inertia: constant mass matrix and the weight (MECHANICS 3.3). Rotary inertia of bending is neglected, as in the paper.

use super::coordinates::{ELEMENT, ElementVector, NODE, SHAPE_PLACES, THETA};
use crate::math::{Vec3, hermite};

/// Places of the angles, which have an inertia of their own.
const ANGLES: [usize; 2] = [THETA, NODE + THETA];

/// `M = ρA ∫ N_a N_b dx ⊗ I + ρIp l/6 [2 1; 1 2]`: what stands before the unit matrix of space, and the angles' part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// `ρA ∫ N_a N_b dx`, kg, kg m and kg m².
    line: [[f64; 4]; 4],
    /// `ρIp l/6`, kg m².
    spin: f64,
}

impl Mass {
    /// `line_density` is ρA, kg/m; `spin_inertia` ρIp, kg m; `length` in m.
    pub fn new(line_density: f64, spin_inertia: f64, length: f64) -> Self {
        let line = hermite::products(length).map(|row| row.map(|product| line_density * product));
        Self { line, spin: spin_inertia * length / 6.0 }
    }

    /// Entry of the angles of the nodes `row` and `column` (0 or 1), kg m².
    #[inline]
    pub fn spin(&self, row: usize, column: usize) -> f64 {
        self.spin * if row == column { 2.0 } else { 1.0 }
    }

    /// Adds `factor` times the mass matrix to the column-major `block`, 14×14.
    pub fn add(&self, factor: f64, block: &mut [f64]) {
        let block = &mut block[..ELEMENT * ELEMENT];
        for (column, products) in SHAPE_PLACES.into_iter().zip(&self.line) {
            for (row, product) in SHAPE_PLACES.into_iter().zip(products) {
                (0..3).for_each(|axis| block[(column + axis) * ELEMENT + row + axis] += factor * product);
            }
        }
        for (node, column) in ANGLES.into_iter().enumerate() {
            for (other, row) in ANGLES.into_iter().enumerate() {
                block[column * ELEMENT + row] += factor * self.spin(other, node);
            }
        }
    }

    /// The product with `vector` (14), 14×1.
    #[inline]
    pub fn times(&self, vector: &[f64]) -> ElementVector {
        let vector = &vector[..ELEMENT];
        let mut product = ElementVector::zeros();
        for (row, products) in SHAPE_PLACES.into_iter().zip(&self.line) {
            for (column, mass) in SHAPE_PLACES.into_iter().zip(products) {
                (0..3).for_each(|axis| product[row + axis] += mass * vector[column + axis]);
            }
        }
        for (node, row) in ANGLES.into_iter().enumerate() {
            product[row] = self.spin(node, 0) * vector[ANGLES[0]] + self.spin(node, 1) * vector[ANGLES[1]];
        }
        product
    }
}

/// Generalized weight, 14×1: `ρA l/12 [6, l, 6, −l] ⊗ gravity`, gravity in m/s².
pub fn weight(line_density: f64, length: f64, gravity: &Vec3) -> ElementVector {
    let mut sum = ElementVector::zeros();
    for (place, integral) in SHAPE_PLACES.into_iter().zip(hermite::integrals(length)) {
        sum.fixed_rows_mut::<3>(place).copy_from(&(gravity * (line_density * integral)));
    }
    sum
}
