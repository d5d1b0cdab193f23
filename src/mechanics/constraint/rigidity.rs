//! What keeps rigid that has more coordinates than freedoms: the directors of a body, the section of a node of ANCF24
//! that something holds.

use super::joint::Joint;
use super::primitive::Primitive;
use crate::math::{Mat3, Vec3};
use crate::mechanics::body::rigid_body::RigidBody;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::marker::Marker;

/// Conditions of a rigid body: its directors are orthonormal.
pub const PRIMITIVES: &[Primitive] = &[
    Primitive::Rigid(0, 0),
    Primitive::Rigid(1, 1),
    Primitive::Rigid(2, 2),
    Primitive::Rigid(0, 1),
    Primitive::Rigid(0, 2),
    Primitive::Rigid(1, 2),
];

/// Conditions of a rigid section: `r_y` and `r_z` have length 1 and are perpendicular.
const RIGID: &[Primitive] = &[Primitive::Rigid(1, 1), Primitive::Rigid(2, 2), Primitive::Rigid(1, 2)];

impl RigidBody {
    /// Its own conditions, as a joint to nowhere.
    pub fn rigidity(&self) -> Joint {
        let directors = Marker::Body { start: self.start, offset: Vec3::zeros(), axes: Mat3::identity() };
        Joint {
            name: format!("body {}", self.name),
            a: Marker::Ground(Pose::default()),
            b: directors,
            primitives: PRIMITIVES,
            drive: None,
            gear: None,
            slide: None,
            holding: None,
        }
    }
}

/// The rigidity of the section of the node whose coordinates start at `start`: what it is tied to holds all of it. As a
/// joint to nowhere, of the gradients as the directors of a body, which has the same coordinates.
pub fn section_rigidity(name: String, start: usize) -> Joint {
    let gradients = Marker::Body { start, offset: Vec3::zeros(), axes: Mat3::identity() };
    Joint {
        name,
        a: Marker::Ground(Pose::default()),
        b: gradients,
        primitives: RIGID,
        drive: None,
        gear: None,
        slide: None,
        holding: None,
    }
}
