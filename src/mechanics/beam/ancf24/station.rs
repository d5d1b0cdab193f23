//! A section at which the energy is evaluated: four fibers, whose strains follow from the section's five directors.

use super::coordinates::{DIRECTORS, DirectorMatrix, Directors, Interpolation, part};
use super::strain::{STRAINS_OF, Voigt, VoigtMatrix, products, products_g, tensor, to_local};
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::triad::Triad;

/// Fibers of a section: two by two.
pub const FIBERS: usize = 4;

/// Where the fibers of a section are: symmetric, so that they have its area and second moments (Gauss points of a
/// rectangle).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fibers {
    /// Area of all of them, m².
    pub area: f64,
    /// Their distance from the axis along y, `sqrt(Iz/A)`, m.
    pub y: f64,
    /// Their distance from the axis along z, `sqrt(Iy/A)`, m.
    pub z: f64,
}

/// A fiber.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fiber {
    y: f64,
    z: f64,
    /// Undeformed volume, m³: its quadrature weight.
    volume: f64,
    /// Stresses by strains in the undeformed base vectors, quadrature weight included.
    stiffness: VoigtMatrix,
    /// Half the scalar products of the undeformed base vectors.
    reference: Voigt,
}

/// A section with its fibers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// How its directors follow from the coordinates.
    pub interpolation: Interpolation,
    fibers: [Fiber; FIBERS],
}

/// One number per strain of a station.
pub type Strains = [Voigt; FIBERS];

impl Fiber {
    /// `g` of the directors `d`.
    fn base(&self, d: &Directors) -> [Vec3; 3] {
        [part(d, 0) + part(d, 3) * self.y + part(d, 4) * self.z, part(d, 1), part(d, 2)]
    }

    /// [`Station::stiffness`] of this fiber, by the base vectors.
    fn stiffness_by_base(&self, d: &Directors, stress: &Voigt, other: &Directors, factor: f64) -> [[f64; 9]; 9] {
        let (g, h) = (self.base(d), self.base(other));
        let mut stresses_by = [[0.0; 9]; 6];
        for (b, strains) in STRAINS_OF.iter().enumerate() {
            for (strain, partner) in strains {
                for (place, row) in stresses_by.iter_mut().enumerate() {
                    let modulus = factor * self.stiffness[(place, *strain)];
                    for axis in 0..3 {
                        row[3 * b + axis] += modulus * h[*partner][axis];
                    }
                }
            }
        }
        let mut sum = [[0.0; 9]; 9];
        let stress = tensor(stress);
        for (a, strains) in STRAINS_OF.iter().enumerate() {
            for axis in 0..3 {
                let row = &mut sum[3 * a + axis];
                for (strain, partner) in strains {
                    let lever = g[*partner][axis];
                    for (target, value) in row.iter_mut().zip(&stresses_by[*strain]) {
                        *target += lever * value;
                    }
                }
                for b in 0..3 {
                    row[3 * b + axis] += stress[(a, b)];
                }
            }
        }
        sum
    }
}

impl Station {
    /// At `xi` of an element of this length (m) whose undeformed coordinates are `reference` (24), with the material
    /// `law`, Pa; `weight` is the share of the length, m.
    pub fn new(xi: f64, length: f64, reference: &[f64], fibers: &Fibers, law: &VoigtMatrix, weight: f64) -> Self {
        let interpolation = Interpolation::new(xi, length);
        let directors = interpolation.directors(reference);
        let fiber = |number: usize| {
            let sign = |is_plus: bool| if is_plus { 1.0 } else { -1.0 };
            let (y, z) = (fibers.y * sign(number % 2 == 1), fibers.z * sign(number / 2 == 1));
            let mut fiber = Fiber { y, z, volume: 0.0, stiffness: VoigtMatrix::zeros(), reference: Voigt::zeros() };
            let base = fiber.base(&directors);
            fiber.reference = products(&base);
            let triad = Triad::new(&base[0], &base[1]);
            let local =
                Mat3::from_columns(&[triad.t, triad.u, triad.t.cross(&triad.u)]).tr_mul(&Mat3::from_columns(&base));
            fiber.volume = weight * fibers.area / FIBERS as f64 * local.determinant();
            // A base without volume has no stiffness.
            let local_by_base = to_local(&local).unwrap_or_else(VoigtMatrix::zeros);
            fiber.stiffness = local_by_base.tr_mul(&(law * local_by_base)) * fiber.volume;
            fiber
        };
        Self { interpolation, fibers: std::array::from_fn(fiber) }
    }

    /// Whether all of it has a volume, as undeformed: a section thicker than its bend has not.
    pub fn is_possible(&self) -> bool {
        self.fibers.iter().all(|fiber| fiber.volume > 0.0)
    }

    /// Strains at the directors `d`; over a step, in which they change by `change`, the mean of both ends'.
    pub fn strains(&self, d: &Directors, change: &Directors) -> Strains {
        self.fibers
            .each_ref()
            .map(|fiber| products(&fiber.base(d)) + products(&fiber.base(change)) * 0.25 - fiber.reference)
    }

    /// Rates of the strains at the rates `rate` of the directors.
    pub fn strain_rates(&self, d: &Directors, rate: &Directors) -> Strains {
        self.fibers.each_ref().map(|fiber| {
            let g = fiber.base(rate);
            let rates = nalgebra::SVector::<f64, 9>::from_fn(|i, _| g[i / 3][i % 3]);
            products_g(&fiber.base(d)) * rates
        })
    }

    /// Stresses of the strains `strains`, quadrature weights included.
    pub fn stresses(&self, strains: &Strains) -> Strains {
        std::array::from_fn(|i| self.fibers[i].stiffness * strains[i])
    }

    /// Forces of the stresses on the directors `d`: what works on their variations.
    pub fn forces(&self, d: &Directors, stresses: &Strains) -> Directors {
        let mut sum = Directors::zeros();
        for (fiber, stress) in self.fibers.iter().zip(stresses) {
            let base = Mat3::from_columns(&fiber.base(d)) * tensor(stress);
            let along = base.column(0);
            for (director, force) in [
                along.into(),
                base.column(1).into_owned(),
                base.column(2).into_owned(),
                along * fiber.y,
                along * fiber.z,
            ]
            .into_iter()
            .enumerate()
            {
                let mut rows = sum.fixed_rows_mut::<3>(3 * director);
                rows += force;
            }
        }
        sum
    }

    /// `Σ [stress : ∂²strain + factor (∂strain(d))ᵀ C ∂strain(other)]` by the directors: what the forces of the
    /// stresses change by, where the stresses change by `factor C ∂strain(other)`.
    pub fn stiffness(&self, d: &Directors, stresses: &Strains, other: &Directors, factor: f64) -> DirectorMatrix {
        let mut sum = [[0.0; DIRECTORS]; DIRECTORS];
        for (fiber, stress) in self.fibers.iter().zip(stresses) {
            add_fiber(&mut sum, &fiber.stiffness_by_base(d, stress, other, factor), fiber);
        }
        sum
    }
}

/// Adds the stiffness `by_base` of a fiber in its base vectors, 9×9: the first of them has `r_xy` and `r_xz` in it too.
fn add_fiber(sum: &mut DirectorMatrix, by_base: &[[f64; 9]; 9], fiber: &Fiber) {
    for (row, own) in by_base.iter().enumerate() {
        let add = |target: &mut [f64; DIRECTORS], share: f64| {
            for (target, value) in target.iter_mut().zip(own) {
                *target += share * value;
            }
            for axis in 0..3 {
                target[9 + axis] += share * fiber.y * own[axis];
                target[12 + axis] += share * fiber.z * own[axis];
            }
        };
        add(&mut sum[row], 1.0);
        if row < 3 {
            add(&mut sum[9 + row], fiber.y);
            add(&mut sum[12 + row], fiber.z);
        }
    }
}
