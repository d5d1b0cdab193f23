//! Stretching: `EA/2 eps²` for small strain, `EA/2 e² + E Ip/2 taum² e` (Wagner's term) with the Green strain `e`
//! otherwise, J/m (MECHANICS 3.1, 3.2).
//!
//! Over a step the strain is the mean of the two ends' and its force acts along the mean slope (MECHANICS 7.6): a beam
//! that turns keeps its length. At an increment of zero that is the plain energy of the configuration.

use crate::math::rotation::normal_projector;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::ancf14::strain::{AxialStiffness, Strain};

/// The slope at one axial point, and what it changes by over the step.
#[derive(Clone, Copy, Debug)]
pub struct Slope {
    /// `r'` at the middle of the step, 1.
    pub middle: Vec3,
    /// `r'` at the end of the step minus `r'` at its start, 1; zero: the energy of the configuration itself.
    pub increment: Vec3,
    /// `|r0'|` of the undeformed beam here, 1.
    pub reference_stretch: f64,
    /// `|r0'|²`, 1, as the slope's own square is found: the undeformed beam has no strain, not even of round-off.
    pub reference_square: f64,
    /// Strain without stress, 1.
    pub natural: f64,
}

impl Slope {
    /// `|r'|` at the start and at the end of the step, 1.
    #[inline]
    fn stretches(&self) -> (f64, f64) {
        ((self.middle - self.increment * 0.5).norm(), (self.middle + self.increment * 0.5).norm())
    }

    /// Mean Green strain of the two ends of the step, 1: `((|r'|/J0)² − 1)/2 + |Δr'|²/(8 J0²)`, natural strain taken
    /// off.
    #[inline]
    pub fn green_strain(&self) -> f64 {
        let square = self.reference_square;
        0.5 * (self.middle.norm_squared() / square - 1.0) + 0.125 * self.increment.norm_squared() / square
            - self.natural
    }

    /// Mean engineering strain of the two ends of the step, 1: `(|r'_a| + |r'_b|)/(2 J0) − 1`, natural strain taken
    /// off.
    #[inline]
    pub fn engineering_strain(&self) -> f64 {
        let (start, end) = self.stretches();
        0.5 * (start + end) / self.reference_stretch - 1.0 - self.natural
    }

    /// Derivative of the strain that `strain` names by the slope at the middle of the step, there, 1.
    pub fn strain_p(&self, strain: Strain) -> Vec3 {
        match strain {
            Strain::Small => self.engineering_strain_p(),
            Strain::Large | Strain::LargeTruncated => self.green_strain_p(),
        }
    }

    /// Second derivative of [`Self::strain_p`]'s strain, 1.
    pub fn strain_pp(&self, strain: Strain) -> Mat3 {
        match strain {
            Strain::Small => self.engineering_strain_pp(),
            Strain::Large | Strain::LargeTruncated => self.green_strain_pp(),
        }
    }

    /// The direction of the force over the step by the strain that `strain` names, 1: its product with the increment is
    /// the change of the strain; at an instant [`Self::strain_p`].
    #[inline]
    pub fn strain_mean_p(&self, strain: Strain) -> Vec3 {
        match strain {
            Strain::Small => self.engineering_strain_mean_p(),
            Strain::Large | Strain::LargeTruncated => self.green_strain_p(),
        }
    }

    /// Twice the derivative of the mean strain that `strain` names by the slope at the end of the step, 1.
    #[inline]
    pub fn strain_end(&self, strain: Strain) -> Vec3 {
        match strain {
            Strain::Small => {
                let end = self.middle + self.increment * 0.5;
                end / (end.norm() * self.reference_stretch)
            }
            Strain::Large | Strain::LargeTruncated => self.green_strain_p() + self.green_strain_increment(),
        }
    }

    /// Twice the derivative of `force` (N m) along [`Self::strain_mean_p`] by the slope at the end of the step, N m,
    /// where `force` changes by `stiffness` (N m) with the strain that `strain` names; at an increment of zero the
    /// Hessian.
    #[inline]
    pub fn force_hessian(&self, strain: Strain, force: f64, stiffness: f64) -> Mat3 {
        match strain {
            Strain::Small => small::hessian(self, force, stiffness),
            Strain::Large | Strain::LargeTruncated => {
                self.green_strain_p() * self.strain_end(strain).transpose() * stiffness + self.green_strain_pp() * force
            }
        }
    }

    /// Derivative of the Green strain by the slope at the middle of the step, 1.
    pub fn green_strain_p(&self) -> Vec3 {
        self.middle / self.reference_square
    }

    /// Second derivative of the Green strain by the slope at the middle of the step, 1.
    pub fn green_strain_pp(&self) -> Mat3 {
        Mat3::identity() / self.reference_square
    }

    /// Twice the derivative of the increment's part of the Green strain by the slope at the end of the step, 1.
    pub fn green_strain_increment(&self) -> Vec3 {
        self.increment / (2.0 * self.reference_square)
    }

    /// `n/J0`, 1, with `n = (r'_a + r'_b)/(|r'_a| + |r'_b|)`: its product with the increment is what the engineering
    /// strain changes by over the step.
    #[inline]
    pub fn engineering_strain_mean_p(&self) -> Vec3 {
        let (start, end) = self.stretches();
        self.middle * (2.0 / ((start + end) * self.reference_stretch))
    }

    /// Derivative of the engineering strain `|r'|/J0 − 1` of the middle of the step by the slope there, 1.
    pub fn engineering_strain_p(&self) -> Vec3 {
        self.middle / (self.middle.norm() * self.reference_stretch)
    }

    /// Second derivative of the engineering strain of the middle of the step by the slope there, 1.
    fn engineering_strain_pp(&self) -> Mat3 {
        let stretch = self.middle.norm();
        normal_projector(&(self.middle / stretch)) / (stretch * self.reference_stretch)
    }
}

/// The small-strain energy `EA/2 eps²`, a function of the slope alone.
pub mod small {
    use super::{AxialStiffness, Mat3, Slope};

    /// Energy density, J/m.
    pub fn energy(stiffness: &AxialStiffness, slope: &Slope) -> f64 {
        0.5 * stiffness.axial * slope.engineering_strain().powi(2)
    }

    /// Derivative of the energy density by the strain `strain`, N.
    pub fn force(stiffness: &AxialStiffness, strain: f64) -> f64 {
        stiffness.axial * strain
    }

    /// Twice the derivative of `force` along the mean slope by the slope at the end of the step, N m, where `force` (N
    /// m) changes by `stiffness` (N m) with the strain; at an increment of zero the Hessian.
    #[inline]
    pub fn hessian(slope: &Slope, force: f64, stiffness: f64) -> Mat3 {
        let (start, end) = slope.stretches();
        let n = slope.middle * (2.0 / (start + end));
        let tangent = (slope.middle + slope.increment * 0.5) / end;
        let n_t = n * tangent.transpose();
        let j0 = slope.reference_stretch;
        n_t * (stiffness / (j0 * j0)) + (Mat3::identity() - n_t) * (2.0 * force / (j0 * (start + end)))
    }
}

/// The large-strain energy, a function of the Green strain `e` and of the mean torsion `taum`.
pub mod large {
    use super::AxialStiffness;
    use nalgebra::{Matrix2, Vector2};

    /// Energy density, J/m.
    pub fn energy(stiffness: &AxialStiffness, e: f64, taum: f64) -> f64 {
        0.5 * stiffness.axial * e * e + 0.5 * stiffness.wagner * taum * taum * e
    }

    /// Derivatives by `e` (N) and by `taum` (N m).
    #[inline]
    pub fn gradient(stiffness: &AxialStiffness, e: f64, taum: f64) -> Vector2<f64> {
        Vector2::new(stiffness.axial * e + 0.5 * stiffness.wagner * taum * taum, stiffness.wagner * taum * e)
    }

    /// Second derivatives by `e` and `taum`.
    #[inline]
    pub fn hessian(stiffness: &AxialStiffness, e: f64, taum: f64) -> Matrix2<f64> {
        let mixed = stiffness.wagner * taum;
        Matrix2::new(stiffness.axial, mixed, mixed, stiffness.wagner * e)
    }
}
