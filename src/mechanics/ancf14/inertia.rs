//! Inertia: constant mass matrix and the weight (MECHANICS 3.3). Rotary inertia of bending is neglected, as in the paper.

use super::coordinates::{ELEMENT, ElementMatrix, ElementVector, NODE, SHAPE_PLACES, THETA};
use crate::math::{Vec3, hermite};

/// `M = ρA ∫ N_a N_b dx ⊗ I + ρIp l/6 [2 1; 1 2]`, 14×14; `line_density` ρA in kg/m, `spin_inertia` ρIp in kg m, `length` in m.
pub fn mass(line_density: f64, spin_inertia: f64, length: f64) -> ElementMatrix {
    let products = hermite::products(length);
    let mut sum = ElementMatrix::zeros();
    for (a, row) in SHAPE_PLACES.into_iter().enumerate() {
        for (b, column) in SHAPE_PLACES.into_iter().enumerate() {
            for axis in 0..3 {
                sum[(row + axis, column + axis)] = line_density * products[a][b];
            }
        }
    }
    let thetas = [THETA, NODE + THETA];
    for row in thetas {
        for column in thetas {
            sum[(row, column)] = spin_inertia * length / 6.0 * if row == column { 2.0 } else { 1.0 };
        }
    }
    debug_assert_eq!(sum.nrows(), ELEMENT);
    sum
}

/// Generalized weight, 14×1: `ρA l/12 [6, l, 6, −l] ⊗ gravity`, gravity in m/s².
pub fn weight(line_density: f64, length: f64, gravity: &Vec3) -> ElementVector {
    let mut sum = ElementVector::zeros();
    for (place, integral) in SHAPE_PLACES.into_iter().zip(hermite::integrals(length)) {
        sum.fixed_rows_mut::<3>(place).copy_from(&(gravity * (line_density * integral)));
    }
    sum
}
