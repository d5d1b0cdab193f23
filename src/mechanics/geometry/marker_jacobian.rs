//! How a point and its axes move with the coordinates that they depend on.

use crate::math::Vec3;
use nalgebra::{SMatrix, SVector};

/// Most coordinates a marker can depend on: two nodes of ANCF24.
pub const MARKER: usize = 24;

/// A number for each of a marker's coordinates; those past the marker's own count are zero, here and in all that
/// follows.
pub type MarkerVector = SVector<f64, MARKER>;
/// A vector quantity by a marker's coordinates, 3×24.
pub type ByCoordinates = SMatrix<f64, 3, MARKER>;
/// Stiffness in a marker's coordinates, 24×24.
pub type MarkerMatrix = SMatrix<f64, MARKER, MARKER>;

/// How a marker moves with its coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkerJacobian {
    /// `∂place/∂q`, 3×24.
    pub place_q: ByCoordinates,
    /// `∂φ/∂q`, 3×24: the turn in space, rad.
    pub turn_q: ByCoordinates,
}

impl MarkerJacobian {
    /// Of a point at the end of `arm` (m, in space) on what turns by `turn_q` and is placed by the first three of
    /// `count` coordinates.
    pub fn of_arm(arm: &Vec3, turn_q: ByCoordinates, count: usize) -> Self {
        let mut place_q = ByCoordinates::zeros();
        for column in 0..count {
            place_q.set_column(column, &turn_q.column(column).cross(arm));
        }
        (0..3).for_each(|axis| place_q[(axis, axis)] += 1.0);
        Self { place_q, turn_q }
    }

    /// Of a point at the end of `arm` (m, in space) on what moves like this with `count` coordinates.
    #[must_use]
    pub fn at_arm(mut self, arm: &Vec3, count: usize) -> Self {
        for column in 0..count {
            let mut place = self.place_q.column_mut(column);
            place += self.turn_q.column(column).cross(arm);
        }
        self
    }
}
