//! A tangent with a normal, and how they are carried to another tangent: of nodes as drawn, and of nodes that carry a
//! frame in time.

use crate::math::Vec3;
use crate::math::rotation::carry;
use serde::{Deserialize, Serialize};

/// Tangent `t` and normal `u`, orthonormal; the third axis is `t × u`. Of a node of ANCF14 the reference, constant
/// during a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Triad {
    /// Reference tangent, unit.
    pub t: Vec3,
    /// Reference normal, unit.
    pub u: Vec3,
}

impl Triad {
    /// The triad with the tangent along `tangent` and `u` as near to `normal` as can be.
    pub fn new(tangent: &Vec3, normal: &Vec3) -> Self {
        let t = tangent.normalize();
        Self { t, u: (normal - t * t.dot(normal)).normalize() }
    }

    /// The triad at the unit tangent `tangent`, carried there by one minimal rotation (2.3).
    #[must_use]
    pub fn carried(&self, tangent: &Vec3) -> Self {
        Self::new(tangent, &carry(&self.t, tangent, &self.u))
    }
}
