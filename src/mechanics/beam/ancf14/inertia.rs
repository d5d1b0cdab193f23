//! Inertia: constant mass matrix and the weight (MECHANICS 3.3), and the part of the rotary inertia that is not
//! constant (MECHANICS 3.3b).

use super::coordinates::{ELEMENT, ElementVector, NODE, SHAPE_PLACES, THETA};
use super::rotary_inertia::{MassMoments, RotaryInertia, rotary_inertia};
use crate::math::quadrature::{FIVE_POINTS, FIVE_WEIGHTS};
use crate::math::vectors::vec3;
use crate::math::{Vec3, hermite};

/// Number of the stations.
const FIVE: usize = FIVE_POINTS.len();

/// Positions of the angles, which have an inertia of their own.
const ANGLES: [usize; 2] = [THETA, NODE + THETA];

/// Mass matrix and weight of an element as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Inertia {
    /// Constant mass matrix.
    pub mass: Mass,
    /// The part of the mass matrix that follows the section; none where sections resist all turns of the tangent alike.
    pub rotary: Option<Box<RotaryInertia>>,
    /// `ρA`, kg/m; where it varies its mean.
    pub line_density: f64,
    /// `∫ ρA N_a dx`, kg and kg m: the weight is their product with gravity.
    pub weights: [f64; 4],
    /// Mass, kg, and spin inertia, kg m², that each of the five Gauss points stands for.
    pub stations: [[f64; 2]; FIVE],
    /// Rotary inertia of the slope that each of these points stands for, kg m²: along all axes, and beyond that along
    /// the axis that follows the section.
    pub turning: [[f64; 2]; FIVE],
}

impl Inertia {
    /// With the same section everywhere: `[ρA, ρIp]` in kg/m and kg m; `length` in m.
    pub fn new([line_density, spin_inertia]: [f64; 2], length: f64) -> Self {
        Self {
            mass: Mass::new(line_density, spin_inertia, length),
            rotary: None,
            line_density,
            weights: hermite::integrals(length).map(|integral| line_density * integral),
            stations: FIVE_WEIGHTS.map(|weight| [line_density, spin_inertia].map(|own| own * weight * length)),
            turning: [[0.0; 2]; FIVE],
        }
    }

    /// The inertia of `own`, the mass, kg, and the spin inertia, kg m², that each of the five Gauss points stands for,
    /// of an element of length `length`, m.
    pub fn of_stations(own: [[f64; 2]; FIVE], length: f64) -> Self {
        let stations = FIVE_POINTS.into_iter().zip(own);
        let mut weights = [0.0; 4];
        for (xi, [mass, _]) in stations.clone() {
            let shape = hermite::shape(xi, length);
            weights.iter_mut().zip(shape).for_each(|(sum, shape)| *sum += mass * shape);
        }
        let line_density = stations.clone().map(|(_, [mass, _])| mass).sum::<f64>() / length;
        Self {
            mass: Mass::of_stations(stations, length),
            rotary: None,
            line_density,
            weights,
            stations: own,
            turning: [[0.0; 2]; FIVE],
        }
    }

    /// Adds the rotary inertia of the sections at the points of the 5-point Gauss rule; `length` in m.
    pub fn add_rotary(&mut self, moments: [MassMoments; FIVE], length: f64) {
        let (constant, turning, rotary) = rotary_inertia(moments, length);
        for (row, constant) in self.mass.line.iter_mut().zip(constant) {
            row.iter_mut().zip(constant).for_each(|(sum, constant)| *sum += constant);
        }
        self.turning = turning;
        self.rotary = rotary.map(Box::new);
    }
}

/// `M = ρA ∫ N_a N_b dx ⊗ I + ρIp l/6 [2 1; 1 2]`: what stands before the unit matrix of space, and the angles' part.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mass {
    /// `ρA ∫ N_a N_b dx`, and of the rotary inertia `ρI ∫ N'_a N'_b dx`; kg, kg m and kg m².
    line: [[f64; 4]; 4],
    /// Of the angles of both nodes, `ρIp l/6 [2 1; 1 2]`, kg m².
    spin: [[f64; 2]; 2],
}

impl Mass {
    /// `line_density` is ρA, kg/m; `spin_inertia` ρIp, kg m; `length` in m.
    fn new(line_density: f64, spin_inertia: f64, length: f64) -> Self {
        let line = hermite::products(length).map(|row| row.map(|product| line_density * product));
        let spin = spin_inertia * length / 6.0;
        Self { line, spin: [[spin * 2.0, spin], [spin, spin * 2.0]] }
    }

    /// The mass matrix of points with the mass and the spin inertia that each stands for.
    fn of_stations(stations: impl Iterator<Item = (f64, [f64; 2])>, length: f64) -> Self {
        let mut all = Self { line: [[0.0; 4]; 4], spin: [[0.0; 2]; 2] };
        for (xi, [mass, spin]) in stations {
            let (shape, angles) = (hermite::shape(xi, length), [1.0 - xi, xi]);
            for (row, a) in all.line.iter_mut().zip(shape) {
                row.iter_mut().zip(shape).for_each(|(sum, b)| *sum += mass * a * b);
            }
            for (row, a) in all.spin.iter_mut().zip(angles) {
                row.iter_mut().zip(angles).for_each(|(sum, b)| *sum += spin * a * b);
            }
        }
        all
    }

    /// Entry of the angles of the nodes `row` and `column` (0 or 1), kg m².
    #[inline]
    pub fn spin(&self, row: usize, column: usize) -> f64 {
        self.spin[row][column]
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
        let [first, second, third, last] = SHAPE_PLACES;
        let (r_0, p_0) = (vec3(vector, first), vec3(vector, second));
        let (r_1, p_1) = (vec3(vector, third), vec3(vector, last));
        for (row, [a, b, c, d]) in SHAPE_PLACES.into_iter().zip(&self.line) {
            let sum = r_0 * *a + p_0 * *b + r_1 * *c + p_1 * *d;
            (0..3).for_each(|axis| product[row + axis] = sum[axis]);
        }
        for (node, row) in ANGLES.into_iter().enumerate() {
            product[row] = self.spin(node, 0) * vector[ANGLES[0]] + self.spin(node, 1) * vector[ANGLES[1]];
        }
        product
    }
}

/// Generalized weight, 14×1: `weights ⊗ gravity`, with `∫ ρA N_a dx` (kg and kg m) and gravity in m/s².
pub fn weight(weights: &[f64; 4], gravity: &Vec3) -> ElementVector {
    let mut sum = ElementVector::zeros();
    for (start, weight) in SHAPE_PLACES.into_iter().zip(weights) {
        sum.fixed_rows_mut::<3>(start).copy_from(&(gravity * *weight));
    }
    sum
}
