//! A rigid body by 12 natural coordinates (MECHANICS 6): its center of mass and three directors along its principal
//! axes.
//!
//! The mass matrix is constant. That the directors stay orthonormal are six conditions of the system, like those of a
//! joint.

use super::kinematics::BODY;
use crate::math::vectors::set_vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::pose::axis_place;

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct RigidBody {
    /// Name in the model file.
    pub name: String,
    /// Its first coordinate.
    pub start: usize,
    /// Mass, kg.
    pub mass: f64,
    /// `E_i = tr(J)/2 − J_i` of the principal moments of inertia, kg m²: the inertia of the directors.
    pub director_inertia: [f64; 3],
    /// Body axes of the model file relative to the directors.
    pub axes: Mat3,
}

/// A rigid body as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyDesign {
    /// Name in the model file.
    pub name: String,
    /// Mass, kg.
    pub mass: f64,
    /// Center of mass, m.
    pub position: Vec3,
    /// Inertia tensor about it in body axes, kg m².
    pub inertia: Mat3,
    /// Body axes in global directions, as columns.
    pub axes: Mat3,
    /// Initial velocity of the center of mass, m/s.
    pub velocity: Vec3,
    /// Initial angular velocity in global axes, rad/s.
    pub angular_velocity: Vec3,
}

impl RigidBody {
    /// Of its design, with its coordinates and velocities as drawn; the first coordinate is `start`.
    pub fn new(design: &BodyDesign, start: usize) -> (Self, [f64; BODY], [f64; BODY]) {
        let inertia = &design.inertia;
        let diagonal = Mat3::from_diagonal(&inertia.diagonal());
        // Principal already: no rounding of directions, no change of their order.
        let (moments, principal) = if *inertia == diagonal {
            (inertia.diagonal(), Mat3::identity())
        } else {
            let eigen = inertia.symmetric_eigen();
            let (first, second) = (eigen.eigenvectors.column(0), eigen.eigenvectors.column(1));
            let right_handed = Mat3::from_columns(&[first.into(), second.into(), first.cross(&second)]);
            (eigen.eigenvalues, right_handed)
        };
        let half_trace = 0.5 * moments.sum();
        let body = Self {
            name: design.name.clone(),
            start,
            mass: design.mass,
            // A flat disk has none about its plane: rounding must not make it negative.
            director_inertia: [0, 1, 2].map(|i| f64::max(half_trace - moments[i], 0.0)),
            axes: principal.transpose(),
        };
        let directors = design.axes * principal;
        let (mut q, mut velocity) = ([0.0; BODY], [0.0; BODY]);
        set_vec3(&mut q, 0, &design.position);
        set_vec3(&mut velocity, 0, &design.velocity);
        for axis in 0..3 {
            let director = directors.column(axis).into_owned();
            set_vec3(&mut q, axis_place(axis), &director);
            set_vec3(&mut velocity, axis_place(axis), &design.angular_velocity.cross(&director));
        }
        (body, q, velocity)
    }

    /// Inertia of coordinate `local` (0 to 11), kg or kg m²: the mass matrix is diagonal.
    pub fn inertia(&self, local: usize) -> f64 {
        if local < 3 { self.mass } else { self.director_inertia[local / 3 - 1] }
    }
}
