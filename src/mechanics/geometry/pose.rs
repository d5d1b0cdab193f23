//! Where something is and how it is turned, as twelve numbers: a place and three axes (MECHANICS 6).
//!
//! Joints are polynomials of the poses of their two sides. In these numbers a rigid body moves linearly, so that
//! nothing but a node's own geometry has second derivatives.

use crate::math::{Mat3, Vec3};
use nalgebra::SMatrix;
use serde::{Deserialize, Serialize};

/// Numbers of a pose: position, then the three axes.
pub const POSE: usize = 3 * VECTORS;
/// Vectors of a pose: position, then the three axes.
pub const VECTORS: usize = 4;
/// The vector that is the position.
pub const PLACE: usize = 0;

/// A vector for each vector of a pose, as columns: position, first, second and third axis.
pub type PoseVector = SMatrix<f64, 3, VECTORS>;

/// Position and axes, or their derivatives by time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pose {
    /// Position, m.
    pub place: Vec3,
    /// Axes as columns.
    pub axes: Mat3,
}

impl Default for Pose {
    /// At the origin, along the global axes.
    fn default() -> Self {
        Self { place: Vec3::zeros(), axes: Mat3::identity() }
    }
}

impl Pose {
    /// Nowhere, no axes: the derivatives of what does not move.
    pub fn zero() -> Self {
        Self { place: Vec3::zeros(), axes: Mat3::zeros() }
    }

    /// The pose of a point rigidly tied to this one: `offset` (m) and `axes` are relative to this one's axes.
    pub fn carried(&self, offset: &Vec3, axes: &Mat3) -> Self {
        Self { place: self.place + self.axes * offset, axes: self.axes * axes }
    }

    /// `offset` and `axes` of `other` relative to this pose: what [`Self::carried`] takes.
    pub fn relative(&self, other: &Self) -> (Vec3, Mat3) {
        (self.axes.tr_mul(&(other.place - self.place)), self.axes.tr_mul(&other.axes))
    }

    /// As four vectors.
    pub fn vectors(&self) -> PoseVector {
        let mut vectors = PoseVector::zeros();
        vectors.set_column(PLACE, &self.place);
        vectors.fixed_columns_mut::<3>(axis_vector(0)).copy_from(&self.axes);
        vectors
    }

    /// Axis `number`.
    pub fn axis(&self, number: usize) -> Vec3 {
        self.axes.column(number).into_owned()
    }

    /// Whether all numbers are finite.
    pub fn is_finite(&self) -> bool {
        self.place.iter().chain(self.axes.iter()).all(|value| value.is_finite())
    }
}

/// Where axis `number` starts among the numbers of a pose.
pub const fn axis_place(number: usize) -> usize {
    3 * axis_vector(number)
}

/// Where axis `number` is among the vectors of a pose.
pub const fn axis_vector(number: usize) -> usize {
    PLACE + 1 + number
}

/// The moment of forces on the vectors of a pose about its place, N m: `Σ axis × force`.
pub fn moment(pose: &Pose, force: &PoseVector) -> Vec3 {
    (0..3).map(|axis| pose.axis(axis).cross(&force.column(axis_vector(axis)))).sum()
}

/// The turning of a pose from its derivative by time: angular velocity, rad/s, `½ Σ axis × axis'`.
pub fn angular_velocity(pose: &Pose, derivative: &Pose) -> Vec3 {
    (0..3).map(|axis| pose.axis(axis).cross(&derivative.axis(axis))).sum::<Vec3>() * 0.5
}
