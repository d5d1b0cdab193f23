//! How the points of a rigid body move with its 12 natural coordinates (MECHANICS 6).

use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix};
use crate::mechanics::geometry::pose::{PLACE, POSE, Pose, VECTORS, axis_place, axis_vector};
use nalgebra::SMatrix;

/// Coordinates of a body: those of its pose.
pub const BODY: usize = POSE;

/// Center of mass and directors of the body whose coordinates start at `start`.
pub fn pose(q: &[f64], start: usize) -> Pose {
    let part = |place: usize| vec3(q, start + place);
    Pose { place: part(0), axes: Mat3::from_columns(&[0, 1, 2].map(|axis| part(axis_place(axis)))) }
}

/// Each vector of the pose of a point tied to a body as a sum of the body's own vectors: their factors, a column each.
pub fn pose_q(offset: &Vec3, axes: &Mat3) -> SMatrix<f64, VECTORS, VECTORS> {
    let mut factors = SMatrix::zeros();
    factors[(PLACE, PLACE)] = 1.0;
    for director in 0..3 {
        factors[(axis_vector(director), PLACE)] = offset[director];
        for axis in 0..3 {
            factors[(axis_vector(director), axis_vector(axis))] = axes[(director, axis)];
        }
    }
    factors
}

/// How a point tied to a body moves; a moment `m` acts on director `d` as `(m × d)/2` (MECHANICS 6).
pub fn jacobian(q: &[f64], start: usize, offset: &Vec3) -> MarkerJacobian {
    let (mut place_q, mut turn_q) = (ByCoordinates::zeros(), ByCoordinates::zeros());
    place_q.fixed_columns_mut::<3>(0).copy_from(&Mat3::identity());
    for axis in 0..3 {
        let place = axis_place(axis);
        place_q.fixed_columns_mut::<3>(place).copy_from(&(Mat3::identity() * offset[axis]));
        turn_q.fixed_columns_mut::<3>(place).copy_from(&(vec3(q, start + place).cross_matrix() * 0.5));
    }
    MarkerJacobian { place_q, turn_q }
}

/// `∂(place_qᵀ f + turn_qᵀ m)/∂q`, 12×12, of a force and a moment frozen in space.
pub fn wrench_stiffness(moment: &Vec3) -> MarkerMatrix {
    let mut sum = MarkerMatrix::zeros();
    for axis in 0..3 {
        let place = axis_place(axis);
        sum.fixed_view_mut::<3, 3>(place, place).copy_from(&(moment.cross_matrix() * 0.5));
    }
    sum
}
