//! A point and a frame that joints, loads and sensors hold on to: on the ground, a moving frame, a body, at a node, inside an element.
//!
//! Loads ask a marker for its pose, how it moves with the coordinates (`motion`), and how the generalized force of a wrench
//! changes with them (`wrench_stiffness`). Joints and springs, which are functions of poses, ask for `pose_q` and `pose_qq`.

use super::beam::coordinates::{NODE, P, R, THETA, vec3};
use super::beam::element::Element;
use super::beam::frame::NodeFrame;
use super::configuration::Configuration;
use super::pose::{Pose, PoseGradient, PoseVector, axis_place, moment};
use super::rigid_body;
use super::section_point::SectionPoint;
use crate::math::{Mat3, Vec3};
use nalgebra::SMatrix;
use std::ops::Range;

/// Most coordinates a marker can depend on: two nodes.
pub const MARKER: usize = 14;

/// A vector quantity by a marker's coordinates, 3×14; columns past the marker's own count are zero.
pub type ByCoordinates = SMatrix<f64, 3, MARKER>;
/// Stiffness in a marker's coordinates, 14×14.
pub type MarkerMatrix = SMatrix<f64, MARKER, MARKER>;

/// How a marker moves with its coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion {
    /// `∂place/∂q`, 3×14.
    pub place_q: ByCoordinates,
    /// `∂φ/∂q`, 3×14: the turn in space, rad.
    pub turn_q: ByCoordinates,
}

/// A point and a frame of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marker {
    /// Fixed in space.
    Ground(Pose),
    /// Rigidly tied to a moving frame.
    Frame {
        /// Number of the frame.
        frame: usize,
        /// Place relative to the frame, in its axes, m.
        offset: Vec3,
        /// Axes relative to the frame's.
        axes: Mat3,
    },
    /// Rigidly tied to a body.
    Body {
        /// First coordinate of the body.
        start: usize,
        /// Place relative to the centre of mass, in directors, m.
        offset: Vec3,
        /// Axes relative to the directors.
        axes: Mat3,
    },
    /// Rigidly tied to a node.
    Node {
        /// Number of the node.
        node: usize,
        /// Place relative to the node, in section axes, m.
        offset: Vec3,
        /// Axes relative to the section axes.
        axes: Mat3,
    },
    /// A section inside an element, with the section's own axes.
    Section {
        /// Number of the element.
        element: usize,
        /// Place in the element, 0 to 1.
        xi: f64,
    },
}

impl Marker {
    /// What the marker is tied to, itself: no offset, own axes.
    #[must_use]
    pub fn bare(&self) -> Self {
        let (offset, axes) = (Vec3::zeros(), Mat3::identity());
        match *self {
            Self::Ground(_) => Self::Ground(Pose::default()),
            Self::Frame { frame, .. } => Self::Frame { frame, offset, axes },
            Self::Body { start, .. } => Self::Body { start, offset, axes },
            Self::Node { node, .. } => Self::Node { node, offset, axes },
            Self::Section { .. } => *self,
        }
    }

    /// The coordinates that the marker depends on.
    pub fn coordinates(&self, elements: &[Element]) -> Range<usize> {
        match self {
            Self::Ground(_) | Self::Frame { .. } => 0..0,
            Self::Body { start, .. } => *start..start + rigid_body::BODY,
            Self::Node { node, .. } => NODE * node..NODE * (node + 1),
            Self::Section { element, .. } => {
                let node = elements[*element].node;
                NODE * node..NODE * (node + 2)
            }
        }
    }

    /// Place and axes.
    pub fn pose(&self, c: &Configuration) -> Pose {
        match self {
            Self::Ground(pose) => *pose,
            Self::Frame { frame, offset, axes } => c.prescribed.frames[*frame].pose.carried(offset, axes),
            Self::Body { start, offset, axes } => rigid_body::pose(c.q, *start).carried(offset, axes),
            Self::Node { node, offset, axes } => {
                let section = &c.frames[*node].section;
                Pose { place: vec3(c.q, NODE * node + R) + section * offset, axes: section * axes }
            }
            Self::Section { element, xi } => SectionPoint::new(c, *element, *xi).pose(c),
        }
    }

    /// First and second derivative of the pose by time at fixed coordinates: of a moving frame.
    pub fn pose_t(&self, c: &Configuration) -> [Pose; 2] {
        match self {
            Self::Frame { frame, offset, axes } => {
                let moving = &c.prescribed.frames[*frame];
                [moving.velocity, moving.acceleration].map(|pose| pose.carried(offset, axes))
            }
            _ => [Pose::zero(); 2],
        }
    }

    /// Derivatives of place and turn by the marker's coordinates.
    pub fn motion(&self, c: &Configuration) -> Motion {
        match self {
            Self::Ground(_) | Self::Frame { .. } => {
                Motion { place_q: ByCoordinates::zeros(), turn_q: ByCoordinates::zeros() }
            }
            Self::Body { start, offset, .. } => rigid_body::motion(c.q, *start, offset),
            Self::Node { node, offset, .. } => node_motion(&c.frames[*node], offset),
            Self::Section { element, xi } => SectionPoint::new(c, *element, *xi).motion(c),
        }
    }

    /// `∂(place_qᵀ f + turn_qᵀ m)/∂q`, 14×14, of a force (N) and a moment (N m) frozen in space.
    pub fn wrench_stiffness(&self, c: &Configuration, force: &Vec3, moment: &Vec3) -> MarkerMatrix {
        match self {
            Self::Ground(_) | Self::Frame { .. } => MarkerMatrix::zeros(),
            Self::Body { .. } => rigid_body::wrench_stiffness(moment),
            Self::Node { node, offset, .. } => node_wrench_stiffness(&c.frames[*node], offset, force, moment),
            Self::Section { element, xi } => SectionPoint::new(c, *element, *xi).moment_stiffness(c, moment),
        }
    }

    /// `∂pose/∂q`, 12×14.
    pub fn pose_q(&self, c: &Configuration) -> PoseGradient {
        match self {
            Self::Ground(_) | Self::Frame { .. } => PoseGradient::zeros(),
            Self::Body { offset, axes, .. } => rigid_body::pose_q(offset, axes),
            Self::Node { .. } | Self::Section { .. } => {
                let (pose, motion) = (self.pose(c), self.motion(c));
                let mut sum = PoseGradient::zeros();
                sum.fixed_rows_mut::<3>(0).copy_from(&motion.place_q);
                for axis in 0..3 {
                    let turned = -pose.axis(axis).cross_matrix() * motion.turn_q;
                    sum.fixed_rows_mut::<3>(axis_place(axis)).copy_from(&turned);
                }
                sum
            }
        }
    }

    /// `∂(pose_qᵀ f)/∂q`, 14×14, of frozen forces `f` on the numbers of the pose.
    pub fn pose_qq(&self, c: &Configuration, force: &PoseVector) -> MarkerMatrix {
        match self {
            Self::Ground(_) | Self::Frame { .. } | Self::Body { .. } => MarkerMatrix::zeros(),
            Self::Node { .. } | Self::Section { .. } => {
                let pose = self.pose(c);
                let part = |place: usize| force.fixed_rows::<3>(place).into_owned();
                let frozen = self.wrench_stiffness(c, &part(0), &moment(&pose, force));
                // The axes turn: d(a × f) = (dφ × a) × f = (a fᵀ − (a·f) I) dφ.
                let turning: Mat3 = (0..3)
                    .map(|number| {
                        let (axis, force) = (pose.axis(number), part(axis_place(number)));
                        axis * force.transpose() - Mat3::identity() * axis.dot(&force)
                    })
                    .sum();
                let turn_q = self.motion(c).turn_q;
                frozen + turn_q.tr_mul(&(turning * turn_q))
            }
        }
    }
}

fn node_motion(frame: &NodeFrame, offset: &Vec3) -> Motion {
    let mut turn_q = ByCoordinates::zeros();
    turn_q.fixed_columns_mut::<3>(P).copy_from(&frame.turn_p());
    turn_q.set_column(THETA, &frame.t);
    let arm = frame.section * offset;
    let mut place_q = -arm.cross_matrix() * turn_q;
    place_q.fixed_columns_mut::<3>(R).copy_from(&Mat3::identity());
    Motion { place_q, turn_q }
}

fn node_wrench_stiffness(frame: &NodeFrame, offset: &Vec3, force: &Vec3, moment: &Vec3) -> MarkerMatrix {
    let arm = frame.section * offset;
    let (by_p, along_p) = frame.moment_force_p(&(moment + arm.cross(force)));
    let mut sum = MarkerMatrix::zeros();
    sum.fixed_view_mut::<3, 3>(P, P).copy_from(&by_p);
    sum.fixed_view_mut::<1, 3>(THETA, P).copy_from(&along_p.transpose());
    // The arm turns: d(a × f) = (dφ × a) × f = (a fᵀ − (a·f) I) dφ.
    let turn_q = node_motion(frame, offset).turn_q;
    sum + turn_q.transpose() * (arm * force.transpose() - Mat3::identity() * arm.dot(force)) * turn_q
}
