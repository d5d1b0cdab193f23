//! Minimal rotations between unit vectors (MECHANICS 2.2, 2.5, 2.9), rotation vectors and quaternions.

use super::jet::Jet;
use super::{Mat3, Vec3};
use crate::math::elementary::{acos, atan2, cos, sin, sin_cos, tan};
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

/// `P(a, b) w`: the minimal rotation that takes the unit vector `a` to the unit vector `b`, applied to `w ⊥ a`
/// (MECHANICS 2.2).
pub fn carry(a: &Vec3, b: &Vec3, w: &Vec3) -> Vec3 {
    w - (a + b) * (b.dot(w) / (1.0 + a.dot(b)))
}

/// `I − t tᵀ`, the projector on the plane normal to the unit vector `t`.
pub fn normal_projector(t: &Vec3) -> Mat3 {
    Mat3::identity() - t * t.transpose()
}

/// Angle of the turn between two triads, rad, 0 to pi.
pub fn rotation_angle(a: &Mat3, b: &Mat3) -> f64 {
    acos((0.5 * (a.tr_mul(b).trace() - 1.0)).clamp(-1.0, 1.0))
}

/// The rotation matrix of a rotation vector, rad.
pub fn rotation_matrix(vector: &Vec3) -> Mat3 {
    let (axis, (sin, cos)) = (direction(vector), sin_cos(vector.norm()));
    // The part along the axis stays what it is, to the bit.
    let along = axis * axis.transpose();
    along + (Mat3::identity() - along) * cos + axis.cross_matrix() * sin
}

/// The rotation nearest to `matrix`, which is one to some digits: the mean of a matrix and of its inverse transposed is
/// nearer by twice as many digits.
pub fn nearest_rotation(matrix: &Mat3) -> Mat3 {
    let mut turn = *matrix;
    for _ in 0..MEANS {
        let Some(inverse) = turn.try_inverse() else { return turn };
        turn = (turn + inverse.transpose()) * 0.5;
    }
    turn
}

/// Means after which [`nearest_rotation`] has all digits: of 0.1 they leave 1e-2, 1e-4, 1e-8, 1e-16.
const MEANS: usize = 5;

/// The rotation matrix of a rotation vector that changes in time, rad, with its first two derivatives:
/// `I + A(x) [v]× + B(x) [v]×²`, `x = v·v`, `A = sin √x/√x`, `B = (1 − cos √x)/x`.
pub fn rotation_matrix_jet(vector: &[Jet; 3]) -> [Mat3; 3] {
    let square = |a: Jet| a * a;
    let x = square(vector[0]) + square(vector[1]) + square(vector[2]);
    let ([a, a_x, a_xx], [b, b_x, b_xx]) = rotation_coefficients(x.value);
    let (a, b) = (x.chain(a, a_x, a_xx), x.chain(b, b_x, b_xx));
    let mut matrices = [Mat3::zeros(); 3];
    for row in 0..3 {
        for column in 0..3 {
            let entry = if row == column {
                Jet::constant(1.0) - b * (x - square(vector[row]))
            } else {
                let other = 3 - row - column;
                let sine = a * vector[other];
                let product = b * vector[row] * vector[column];
                if (row + 1) % 3 == column { product - sine } else { product + sine }
            };
            for (matrix, part) in matrices.iter_mut().zip([entry.value, entry.first, entry.second]) {
                matrix[(row, column)] = part;
            }
        }
    }
    matrices
}

/// `A(x) = sin √x/√x` and `B(x) = (1 − cos √x)/x`, each with its first two derivatives.
fn rotation_coefficients(x: f64) -> ([f64; 3], [f64; 3]) {
    if x < 1.0 {
        // Σ (−x)ⁿ/(2n+1)! and Σ (−x)ⁿ/(2n+2)!: the closed forms lose digits here.
        let series = |first: f64| {
            let (mut sums, mut term) = ([0.0; 3], 1.0 / first);
            for n in 0..SERIES {
                let order = n as f64;
                sums[0] += term * x.powi(n);
                sums[1] += if n > 0 { order * term * x.powi(n - 1) } else { 0.0 };
                sums[2] += if n > 1 { order * (order - 1.0) * term * x.powi(n - 2) } else { 0.0 };
                term /= -(2.0 * order + first + 1.0) * (2.0 * order + first + 2.0);
            }
            sums
        };
        return (series(1.0), series(2.0));
    }
    let (sin, cos) = sin_cos(x.sqrt());
    let a = sin / x.sqrt();
    let a_x = (cos - a) / (2.0 * x);
    let b = (1.0 - cos) / x;
    let b_x = (0.5 * a - b) / x;
    ([a, a_x, -(0.5 * a + 3.0 * a_x) / (2.0 * x)], [b, b_x, (0.5 * a_x - 2.0 * b_x) / x])
}

/// Terms of the series of [`rotation_coefficients`]: the next one is below 1e-19 at `x = 1`, its second derivative
/// below 1e-16.
const SERIES: i32 = 11;

/// The direction of a vector; 0 where it has none. Compilers divide first and choose afterwards: not by 0, which hosts
/// may trap.
fn direction(vector: &Vec3) -> Vec3 {
    vector / vector.norm().max(f64::MIN_POSITIVE)
}

/// The rotation vector (rad) of the rotation matrix `turn` that lies nearest to `previous`: it goes on continuously
/// over any number of turns.
pub fn rotation_vector_near(turn: &Mat3, previous: &Vec3) -> Vec3 {
    let quaternion = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*turn));
    let (w, imaginary) = (quaternion.w, quaternion.imag());
    let sine = imaginary.norm();
    let full = 2.0 * std::f64::consts::PI;
    if sine < 1e-12 {
        // No turn, or whole turns: their axis is undefined, the previous one goes on.
        let turns = (previous.norm() / full).round();
        let axis = direction(previous);
        return axis * (turns * full) + imaginary * 2.0 * w.signum();
    }
    let axis = direction(&imaginary);
    let angle = 2.0 * atan2(sine, w);
    let turns = ((previous.dot(&axis) - angle) / full).round();
    axis * (angle + turns * full)
}

/// The difference of two rotation vectors, rad, as the turn that leads from the turn of `from` to that of `to`: near a
/// whole turn a rotation vector has any direction and any number of turns, so that the vectors of two near turns may be
/// far apart. Beyond a quarter of a turn it is that of the vectors, which counts the turns about one axis.
pub fn rotation_between(from: &Vec3, to: &Vec3) -> Vec3 {
    let between = quaternion_of(to) * quaternion_of(from).conjugate();
    let (imaginary, cosine) = (between.imag(), between.w);
    let half = atan2(imaginary.norm(), cosine.abs());
    if half > std::f64::consts::FRAC_PI_4 {
        return to - from;
    }
    direction(&imaginary) * (2.0 * half * cosine.signum())
}

/// The derivative by time of the rotation vector `vector` (rad, shorter than a whole turn) of what turns with the
/// angular velocity `spin`, rad/s.
pub fn rotation_vector_rate(vector: &Vec3, spin: &Vec3) -> Vec3 {
    let angle = vector.norm();
    // 1 − (a/2) cot(a/2), by its series where the quotient is none.
    let part = if angle < 1e-4 { angle * angle / 12.0 } else { 1.0 - 0.5 * angle / tan(0.5 * angle) };
    let axis = direction(vector);
    spin - vector.cross(spin) * 0.5 + axis.cross(&axis.cross(spin)) * part
}

/// The quaternion `[w, x, y, z]` of a rotation vector, continuous in it (no jump of sign).
pub fn quaternion_of(vector: &Vec3) -> Quaternion<f64> {
    let angle = vector.norm();
    // sin(a/2)/a, by its series where the division loses digits.
    let scale = if angle < 1e-6 { 0.5 - angle * angle / 48.0 } else { sin(0.5 * angle) / angle };
    Quaternion::from_parts(cos(0.5 * angle), vector * scale)
}

/// The rotation matrix of a quaternion `[w, x, y, z]` of any length but 0.
pub fn quaternion_matrix([w, x, y, z]: [f64; 4]) -> Mat3 {
    *UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().matrix()
}

/// The unit quaternion of a triad whose columns are the axes.
pub fn quaternion_of_triad(triad: &Mat3) -> Quaternion<f64> {
    *UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(*triad)).quaternion()
}

/// A triad whose first axis is along `axis`; the others are as near to the global axes as can be.
pub fn triad_along(axis: &Vec3) -> Mat3 {
    let first = axis.normalize();
    triad_of(&first, &Vec3::ith(first.iamin(), 1.0))
}

/// A triad whose first axis is along `axis` and whose second is as near to `second` as can be.
pub fn triad_of(axis: &Vec3, second: &Vec3) -> Mat3 {
    let first = axis.normalize();
    let second = (second - first * first.dot(second)).normalize();
    Mat3::from_columns(&[first, second, first.cross(&second)])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// The motion of a frame must be the derivative of its pose: against the rule for products, and the group property.
    #[test]
    fn rotation_matrix_jet_is_a_rotation_and_its_derivatives() {
        for scale in [0.0, 1e-9, 1e-3, 0.3, 0.999, 1.001, 3.0, 20.0] {
            let vector = [(0.5, 2.0, -1.0), (-0.3, 0.7, 3.0), (0.81, -1.5, 0.4)].map(|(value, first, second)| Jet {
                value: value * scale,
                first,
                second,
            });
            let [turn, first, second] = rotation_matrix_jet(&vector);
            let plain = rotation_matrix(&Vec3::new(vector[0].value, vector[1].value, vector[2].value));
            assert!((turn - plain).norm() < 1e-14, "at {scale}");
            // R Rᵀ = I, differentiated twice.
            let once = first * turn.transpose();
            assert!((once + once.transpose()).norm() < 1e-12, "at {scale}");
            let twice = second * turn.transpose() + first * first.transpose();
            assert!((twice + twice.transpose()).norm() < 1e-11, "at {scale}");
        }
        // About a fixed axis: the rate is the rate of the angle.
        let angle = Jet { value: 7.3, first: 2.0, second: -3.0 };
        let axis = Vec3::new(2.0, -1.0, 0.5).normalize();
        let [turn, first, second] = rotation_matrix_jet(&[0, 1, 2].map(|i| angle * Jet::constant(axis[i])));
        let skew = axis.cross_matrix();
        assert!((first - skew * turn * 2.0).norm() < 1e-13);
        assert!((second - (skew * skew * 4.0 - skew * 3.0) * turn).norm() < 1e-12);
    }

    /// Axes as written to some digits are a rotation to all digits, and the nearest one: what they differ by is
    /// symmetric in its axes.
    #[test]
    fn the_nearest_rotation_of_written_axes() {
        let turn = rotation_matrix(&Vec3::new(0.4, -1.1, 0.7));
        let written = turn.map(|value| (value * 1e3).round() * 1e-3);
        let nearest = nearest_rotation(&written);
        assert!((nearest * nearest.transpose() - Mat3::identity()).norm() < 1e-15);
        let stretch = nearest.tr_mul(&written);
        assert!((stretch - stretch.transpose()).norm() < 1e-15 && (nearest - turn).norm() < 1e-3);
        assert_eq!(nearest_rotation(&Mat3::identity()), Mat3::identity());
    }

    /// A wheel that turns on must show an angle that goes on past half a turn and past whole turns, not one that jumps
    /// back.
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

    /// A disk that has spun 70 times and is tilted by a thousandth about one axis or another has rotation vectors that
    /// are radians apart; the turn between both is the tilt. Beyond a quarter of a turn about one axis all of it
    /// counts.
    #[test]
    fn the_turn_between_near_turns_is_small() {
        let spin = Vec3::x() * 140.0 * PI;
        let tilted = |tilt: Vec3| rotation_vector_near(&rotation_matrix(&tilt), &spin);
        let [one, other] = [Vec3::new(0.0, 1e-3, 0.0), Vec3::new(0.0, 0.0, 1e-3)].map(tilted);
        // Two turns about different axes do not add up by half of the product of their angles.
        let found = rotation_between(&one, &other);
        assert!((found - Vec3::new(0.0, -1e-3, 1e-3)).norm() < 1e-6, "{found}");
        let axis = Vec3::new(2.0, -1.0, 0.5).normalize();
        for [from, to] in [[0.1, 0.2], [1.0, 30.0], [440.0, 439.0], [-2.0, 2.5], [1e-9, 2e-9]] {
            let found = rotation_between(&(axis * from), &(axis * to));
            // Angles of 440 rad have 13 digits.
            assert!((found - axis * (to - from)).norm() < 1e-12, "{from} {to}: {found}");
        }
        // Lost turns are no difference.
        assert!(rotation_between(&(axis * 3.0), &(axis * (3.0 + 20.0 * PI))).norm() < 1e-12);
    }

    /// The rate of a rotation vector gives back the angular velocity: by the derivative of its matrix.
    #[test]
    fn rates_of_rotation_vectors() {
        let spin = Vec3::new(0.7, -1.1, 0.4);
        for vector in
            [[0.0, 0.0, 0.0], [1e-6, 2e-6, -1e-6], [5e-5, 8e-5, 0.0], [0.1, 0.0, 0.3], [2.0, -2.0, 1.0], [PI, 0.0, 0.0]]
        {
            let vector = Vec3::from(vector);
            let rate = rotation_vector_rate(&vector, &spin);
            let jets = [0, 1, 2].map(|i| Jet { value: vector[i], first: rate[i], second: 0.0 });
            let [turn, turn_t, _] = rotation_matrix_jet(&jets);
            assert!((turn_t * turn.transpose() - spin.cross_matrix()).norm() < 1e-13, "{vector}");
        }
    }
}
