//! Minimal rotations between unit vectors (MECHANICS 2.2, 2.5, 2.9), rotation vectors and quaternions.

use super::{Mat3, Vec3};
use nalgebra::{Quaternion, Rotation3, UnitQuaternion};

/// `kb(a, b) = (a × b) / (1 + a·b)`: half the tangent-scaled turn from the unit vector `a` to the unit vector `b`.
pub fn half_turn(a: &Vec3, b: &Vec3) -> Vec3 {
    a.cross(b) / (1.0 + a.dot(b))
}

/// `∂kb(a, b)/∂a`, 3×3, given `k = kb(a, b)` (MECHANICS 2.9, `D_i`).
pub fn half_turn_by_first(a: &Vec3, b: &Vec3, k: &Vec3) -> Mat3 {
    (-b.cross_matrix() - k * b.transpose()) / (1.0 + a.dot(b))
}

/// `∂kb(a, b)/∂b`, 3×3, given `k = kb(a, b)` (MECHANICS 2.9, `D_j` and `E`).
pub fn half_turn_by_second(a: &Vec3, b: &Vec3, k: &Vec3) -> Mat3 {
    (a.cross_matrix() - k * a.transpose()) / (1.0 + a.dot(b))
}

/// `P(a, b) w`: the minimal rotation that takes the unit vector `a` to the unit vector `b`, applied to `w ⊥ a` (MECHANICS 2.2).
pub fn carry(a: &Vec3, b: &Vec3, w: &Vec3) -> Vec3 {
    w - (a + b) * (b.dot(w) / (1.0 + a.dot(b)))
}

/// `I − t tᵀ`, the projector on the plane normal to the unit vector `t`.
pub fn normal_projector(t: &Vec3) -> Mat3 {
    Mat3::identity() - t * t.transpose()
}

/// The rotation matrix of a rotation vector, rad.
pub fn rotation_matrix(vector: &Vec3) -> Mat3 {
    Rotation3::from_scaled_axis(*vector).into_inner()
}

/// The rotation vector (rad) of the rotation matrix `turn` that lies nearest to `previous`: it goes on continuously over any number of turns.
pub fn rotation_vector_near(turn: &Mat3, previous: &Vec3) -> Vec3 {
    let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*turn));
    let (w, imaginary) = (quaternion.w, quaternion.imag());
    let sine = imaginary.norm();
    let full = 2.0 * std::f64::consts::PI;
    if sine < 1e-12 {
        // No turn, or whole turns: their axis is undefined, the previous one goes on.
        let turns = (previous.norm() / full).round();
        let axis = previous.try_normalize(0.0).unwrap_or_else(Vec3::zeros);
        return axis * (turns * full) + imaginary * 2.0 * w.signum();
    }
    let axis = imaginary / sine;
    let angle = 2.0 * sine.atan2(w);
    let turns = ((previous.dot(&axis) - angle) / full).round();
    axis * (angle + turns * full)
}

/// The quaternion `[w, x, y, z]` of a rotation vector, continuous in it (no jump of sign).
pub fn quaternion_of(vector: &Vec3) -> Quaternion<f64> {
    let angle = vector.norm();
    // sin(a/2)/a, by its series where the division loses digits.
    let scale = if angle < 1e-6 { 0.5 - angle * angle / 48.0 } else { (0.5 * angle).sin() / angle };
    Quaternion::from_parts((0.5 * angle).cos(), vector * scale)
}

/// The unit quaternion of a triad whose columns are the axes.
pub fn quaternion_of_triad(triad: &Mat3) -> Quaternion<f64> {
    *UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*triad)).quaternion()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A wheel that turns on must show an angle that goes on past half a turn and past whole turns, not one that jumps back.
    #[test]
    fn rotation_vector_goes_on_over_turns() {
        let axis = Vec3::new(1.0, 2.0, -0.5).normalize();
        let mut vector = Vec3::zeros();
        for step in 1..=200 {
            let angle = 0.1 * f64::from(step);
            vector = rotation_vector_near(&rotation_matrix(&(axis * angle)), &vector);
            assert!((vector - axis * angle).norm() < 1e-9, "at {angle}: {vector}");
        }
        // Backwards through zero and over a whole turn.
        for step in (-100..200).rev() {
            let angle = 0.1 * f64::from(step);
            vector = rotation_vector_near(&rotation_matrix(&(axis * angle)), &vector);
            assert!((vector - axis * angle).norm() < 1e-9, "at {angle}: {vector}");
        }
        let whole = rotation_vector_near(&Mat3::identity(), &(axis * 6.2));
        assert!((whole - axis * 2.0 * PI).norm() < 1e-9);
    }
}
