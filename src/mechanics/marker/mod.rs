//! A point and a frame that joints, loads and sensors hold on to: on the ground, a moving frame, a body, at a node,
//! inside an element.
//!
//! Loads ask a marker for its pose, how it moves with the coordinates (`jacobian`), and how the generalized force of a
//! wrench changes with them (`wrench_stiffness`). Joints and springs, which are functions of poses, ask for `pose_q`
//! (`pose_gradient`).

pub mod configuration;
mod motion;
pub mod observer;
pub mod pose_gradient;
pub mod relative_coordinate;
pub mod sensor;

use self::pose_gradient::{PoseGradient, Turning};
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::mesh::Mesh;
use crate::mechanics::body::kinematics::{self, BODY};
use crate::mechanics::body::rigid_body::RigidBody;
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose::{Pose, PoseVector};
use crate::mechanics::marker::configuration::Configuration;
use std::ops::Range;

/// `turn_qᵀ block turn_q` over `count` coordinates.
fn turned(turn_q: &ByCoordinates, block: &Mat3, count: usize) -> MarkerMatrix {
    let mut sum = MarkerMatrix::zeros();
    for column in 0..count {
        let right: Vec3 = block * turn_q.column(column);
        for row in 0..count {
            sum[(row, column)] = turn_q.column(row).dot(&right);
        }
    }
    sum
}

/// How the moment of a force frozen in space changes with the turn of its arm:
/// `d(a × f) = (dφ × a) × f = (a fᵀ − (a·f) I) dφ`.
fn of_arm(arm: &Vec3, force: &Vec3) -> Mat3 {
    arm * force.transpose() - Mat3::identity() * arm.dot(force)
}

/// A point and a frame of the system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Marker {
    /// Fixed in space.
    Ground(Pose),
    /// Rigidly tied to a moving frame.
    Frame {
        /// Number of the frame.
        frame: usize,
        /// Position relative to the frame, in its axes, m.
        offset: Vec3,
        /// Axes relative to the frame's.
        axes: Mat3,
    },
    /// Rigidly tied to a body.
    Body {
        /// First coordinate of the body.
        start: usize,
        /// Position relative to the center of mass, in directors, m.
        offset: Vec3,
        /// Axes relative to the directors.
        axes: Mat3,
    },
    /// Rigidly tied to a node.
    Node {
        /// Number of the node.
        node: usize,
        /// Position relative to the node, in section axes, m.
        offset: Vec3,
        /// Axes relative to the section axes.
        axes: Mat3,
    },
    /// Rigidly tied to a section inside an element.
    Section {
        /// Number of the element.
        element: usize,
        /// Position in the element, 0 to 1.
        xi: f64,
        /// Position relative to the section, in its axes, m.
        offset: Vec3,
        /// Axes relative to the section axes.
        axes: Mat3,
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
            Self::Section { element, xi, .. } => Self::Section { element, xi, offset, axes },
        }
    }

    /// A section inside an element, with its own axes.
    pub fn section(element: usize, xi: f64) -> Self {
        Self::Section { element, xi, offset: Vec3::zeros(), axes: Mat3::identity() }
    }

    /// The marker `offset` (m) away from this one, with axes turned by `axes`: both relative to this one's axes, to
    /// which it is rigidly tied.
    #[must_use]
    pub fn carried(&self, offset: &Vec3, axes: &Mat3) -> Self {
        let tie = |own: &Vec3, turned: &Mat3| (own + turned * offset, turned * axes);
        match *self {
            Self::Ground(pose) => Self::Ground(pose.carried(offset, axes)),
            Self::Frame { frame, offset, axes } => {
                let (offset, axes) = tie(&offset, &axes);
                Self::Frame { frame, offset, axes }
            }
            Self::Body { start, offset, axes } => {
                let (offset, axes) = tie(&offset, &axes);
                Self::Body { start, offset, axes }
            }
            Self::Node { node, offset, axes } => {
                let (offset, axes) = tie(&offset, &axes);
                Self::Node { node, offset, axes }
            }
            Self::Section { element, xi, offset, axes } => {
                let (offset, axes) = tie(&offset, &axes);
                Self::Section { element, xi, offset, axes }
            }
        }
    }

    /// Position relative to what the marker is tied to, in its axes, m; 0 on the ground.
    pub fn arm(&self) -> Vec3 {
        match self {
            Self::Ground(_) => Vec3::zeros(),
            Self::Frame { offset, .. }
            | Self::Body { offset, .. }
            | Self::Node { offset, .. }
            | Self::Section { offset, .. } => *offset,
        }
    }

    /// The coordinates that the marker depends on.
    pub fn coordinates(&self, mesh: &Mesh) -> Range<usize> {
        match self {
            Self::Ground(_) | Self::Frame { .. } => 0..0,
            Self::Body { start, .. } => *start..start + BODY,
            Self::Node { node, .. } => mesh.nodes[*node].coordinates(),
            Self::Section { element, .. } => mesh.elements[*element].coordinates(),
        }
    }

    /// Position and axes.
    pub fn pose(&self, c: &Configuration) -> Pose {
        match self {
            Self::Ground(pose) => *pose,
            Self::Frame { frame, offset, axes } => c.prescribed.frames[*frame].pose.carried(offset, axes),
            Self::Body { start, offset, axes } => kinematics::pose(c.beams.q, *start).carried(offset, axes),
            Self::Node { node, offset, axes } => c.mesh.nodes[*node].pose(&c.beams).carried(offset, axes),
            Self::Section { element, xi, offset, axes } => {
                let own = c.mesh.elements[*element].section_pose(&c.beams, *xi);
                // Nearly all are the section itself, also for loads along a beam.
                let is_own = *offset == Vec3::zeros() && *axes == Mat3::identity();
                if is_own { own } else { own.carried(offset, axes) }
            }
        }
    }

    /// The element and the position in it where its position is on the axis, which does not turn with the section.
    fn on_axis(&self) -> Option<(usize, f64)> {
        match self {
            Self::Section { element, xi, offset, .. } if *offset == Vec3::zeros() => Some((*element, *xi)),
            _ => None,
        }
    }

    /// The pose, of which the position alone counts: the axes of a section inside an element are not computed.
    pub fn placed(&self, c: &Configuration) -> Pose {
        match self.on_axis() {
            Some((element, xi)) => {
                Pose { place: c.mesh.elements[element].axis_point(xi, c.beams.q), axes: Mat3::identity() }
            }
            None => self.pose(c),
        }
    }

    /// How [`Self::placed`] moves with the marker's coordinates.
    pub fn placed_q(&self, c: &Configuration) -> PoseGradient {
        let Some((element, xi)) = self.on_axis() else { return self.pose_q(c) };
        let element = &c.mesh.elements[element];
        let count = element.coordinates().len();
        PoseGradient::Beam(Turning {
            arms: PoseVector::zeros(),
            place_q: element.axis_q(xi),
            turn_q: ByCoordinates::zeros(),
            count,
            placing: count,
            turning: count,
        })
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

    /// Derivatives of position and turn by the marker's coordinates.
    pub fn jacobian(&self, c: &Configuration) -> MarkerJacobian {
        match self {
            Self::Ground(_) | Self::Frame { .. } => {
                MarkerJacobian { place_q: ByCoordinates::zeros(), turn_q: ByCoordinates::zeros() }
            }
            Self::Body { start, offset, .. } => kinematics::jacobian(c.beams.q, *start, offset),
            Self::Node { node, offset, .. } => c.mesh.nodes[*node].jacobian(&c.beams, offset),
            Self::Section { element, xi, offset, .. } => {
                let element = &c.mesh.elements[*element];
                let own = element.section_jacobian(&c.beams, *xi);
                if *offset == Vec3::zeros() {
                    return own;
                }
                own.at_arm(&(element.section_pose(&c.beams, *xi).axes * offset), element.coordinates().len())
            }
        }
    }

    /// `∂(place_qᵀ f + turn_qᵀ m)/∂q`, 24×24, of a force (N) and a moment (N m) frozen in space.
    pub fn wrench_stiffness(&self, c: &Configuration, force: &Vec3, moment: &Vec3) -> MarkerMatrix {
        match self {
            Self::Ground(_) | Self::Frame { .. } => MarkerMatrix::zeros(),
            Self::Body { .. } => kinematics::wrench_stiffness(moment),
            Self::Node { node, offset, .. } => {
                let node = &c.mesh.nodes[*node];
                let arm = node.pose(&c.beams).axes * offset;
                let mut sum = turned(&node.turn_q(&c.beams), &of_arm(&arm, force), node.coordinates().len());
                node.add_moment_stiffness(&c.beams, &(moment + arm.cross(force)), &mut sum);
                sum
            }
            Self::Section { element, xi, offset, .. } => {
                let element = &c.mesh.elements[*element];
                let (mut sum, mut moment) = (MarkerMatrix::zeros(), *moment);
                if *offset != Vec3::zeros() {
                    let arm = element.section_pose(&c.beams, *xi).axes * offset;
                    let turn_q = element.section_jacobian(&c.beams, *xi).turn_q;
                    sum = turned(&turn_q, &of_arm(&arm, force), element.coordinates().len());
                    moment += arm.cross(force);
                }
                element.add_section_moment_stiffness(&c.beams, *xi, &moment, &mut sum);
                sum
            }
        }
    }

    /// How the vectors of the pose move with the marker's coordinates.
    pub fn pose_q(&self, c: &Configuration) -> PoseGradient {
        match self {
            Self::Ground(_) | Self::Frame { .. } => PoseGradient::Fixed,
            Self::Body { offset, axes, .. } => PoseGradient::Body(kinematics::pose_q(offset, axes)),
            Self::Node { node, offset, axes } => {
                let node = &c.mesh.nodes[*node];
                let section = node.pose(&c.beams).axes;
                let mut place_q = ByCoordinates::zeros();
                (0..3).for_each(|axis| place_q[(axis, axis)] = 1.0);
                PoseGradient::Beam(Turning {
                    arms: Pose { place: section * offset, axes: section * axes }.vectors(),
                    place_q,
                    turn_q: node.turn_q(&c.beams),
                    count: node.coordinates().len(),
                    placing: 3,
                    turning: 3,
                })
            }
            Self::Section { element, xi, offset, axes } => {
                let element = &c.mesh.elements[*element];
                let MarkerJacobian { place_q, turn_q } = element.section_jacobian(&c.beams, *xi);
                let section = element.section_pose(&c.beams, *xi).axes;
                let arms = Pose { place: section * offset, axes: section * axes }.vectors();
                let count = element.coordinates().len();
                PoseGradient::Beam(Turning { arms, place_q, turn_q, count, placing: count, turning: 0 })
            }
        }
    }

    /// Adds `∂(turn_qᵀ m)/∂q` of a moment (N m) frozen in space to `sum`, of what turns in itself: a section of a beam,
    /// at a node or between.
    pub fn add_moment_stiffness(&self, c: &Configuration, moment: &Vec3, sum: &mut MarkerMatrix) {
        match self {
            Self::Ground(_) | Self::Frame { .. } | Self::Body { .. } => {}
            Self::Node { node, .. } => c.mesh.nodes[*node].add_moment_stiffness(&c.beams, moment, sum),
            Self::Section { element, xi, .. } => {
                c.mesh.elements[*element].add_section_moment_stiffness(&c.beams, *xi, moment, sum);
            }
        }
    }
}

impl RigidBody {
    /// The marker at its center of mass, with its body axes.
    pub fn marker(&self) -> Marker {
        Marker::Body { start: self.start, offset: Vec3::zeros(), axes: self.axes }
    }
}

/// The velocities of a marker's own coordinates, padded with zeros.
pub fn own_velocity(c: &Configuration, marker: &Marker, velocity: &[f64]) -> MarkerVector {
    let range = marker.coordinates(c.mesh);
    let mut own = MarkerVector::zeros();
    own.as_mut_slice()[..range.len()].copy_from_slice(&velocity[range]);
    own
}
