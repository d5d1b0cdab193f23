//! Vectors in a list of numbers.

use super::Vec3;
use super::elementary::atan2;

/// The angle between two vectors, rad, 0 to pi.
pub fn angle_between(a: &Vec3, b: &Vec3) -> f64 {
    atan2(a.cross(b).norm(), a.dot(b))
}

/// The three numbers of `q` from `place` on.
pub fn vec3(q: &[f64], place: usize) -> Vec3 {
    Vec3::new(q[place], q[place + 1], q[place + 2])
}

/// Writes three numbers into `q` from `place` on.
pub fn set_vec3(q: &mut [f64], place: usize, value: &Vec3) {
    q[place..place + 3].copy_from_slice(value.as_slice());
}

/// Adds three numbers to `q` from `place` on.
pub fn add_vec3(q: &mut [f64], place: usize, value: &Vec3) {
    for (target, value) in q[place..place + 3].iter_mut().zip(value) {
        *target += value;
    }
}
