//! A rigid body by 12 natural coordinates (MECHANICS 6): its centre of mass and three directors along its principal axes.
//!
//! The mass matrix is constant. That the directors stay orthonormal are six conditions of the machine, like those of a joint.

use super::joint::Joint;
use super::joint::primitive::Primitive;
use super::marker::{ByCoordinates, Marker, MarkerMatrix, Motion};
use super::pose::{PLACE, POSE, Pose, VECTORS, axis_place, axis_vector};
use crate::math::vectors::{set_vec3, vec3};
use crate::math::{Mat3, Vec3};
use nalgebra::SMatrix;

/// Coordinates of a body: those of its pose.
pub const BODY: usize = POSE;

/// Conditions of a rigid body: its directors are orthonormal.
pub const PRIMITIVES: &[Primitive] = &[
    Primitive::Rigid(0, 0),
    Primitive::Rigid(1, 1),
    Primitive::Rigid(2, 2),
    Primitive::Rigid(0, 1),
    Primitive::Rigid(0, 2),
    Primitive::Rigid(1, 2),
];

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
    /// Centre of mass, m.
    pub position: Vec3,
    /// Inertia tensor about it in body axes, kg m².
    pub inertia: Mat3,
    /// Body axes in global directions, as columns.
    pub axes: Mat3,
    /// Initial velocity of the centre of mass, m/s.
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

    /// The marker at its centre of mass, with its body axes.
    pub fn marker(&self) -> Marker {
        Marker::Body { start: self.start, offset: Vec3::zeros(), axes: self.axes }
    }

    /// Its own conditions, as a joint to nowhere.
    pub fn rigidity(&self) -> Joint {
        let directors = Marker::Body { start: self.start, offset: Vec3::zeros(), axes: Mat3::identity() };
        Joint {
            name: format!("body {}", self.name),
            a: Marker::Ground(Pose::default()),
            b: directors,
            primitives: PRIMITIVES,
            drive: None,
        }
    }

    /// Inertia of coordinate `local` (0 to 11), kg or kg m²: the mass matrix is diagonal.
    pub fn inertia(&self, local: usize) -> f64 {
        if local < 3 { self.mass } else { self.director_inertia[local / 3 - 1] }
    }
}

/// Centre of mass and directors of the body whose coordinates start at `start`.
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
pub fn motion(q: &[f64], start: usize, offset: &Vec3) -> Motion {
    let (mut place_q, mut turn_q) = (ByCoordinates::zeros(), ByCoordinates::zeros());
    place_q.fixed_columns_mut::<3>(0).copy_from(&Mat3::identity());
    for axis in 0..3 {
        let place = axis_place(axis);
        place_q.fixed_columns_mut::<3>(place).copy_from(&(Mat3::identity() * offset[axis]));
        turn_q.fixed_columns_mut::<3>(place).copy_from(&(vec3(q, start + place).cross_matrix() * 0.5));
    }
    Motion { place_q, turn_q }
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
