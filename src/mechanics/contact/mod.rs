//! Contact of beams with rigid surfaces and with each other: a force per length of beam that depends on how far its
//! surface is inside.
//!
//! A contact is one surface and the elements of one beam that may touch it; of beams with each other it is a pair of
//! them (`mutual`). Sums over a system are in `system/contacts.rs` and `system/beam_contacts.rs`.

pub mod axis;
mod block;
pub mod cone;
pub mod grip;
pub mod law;
pub mod mutual;
pub mod pieces;
pub mod secant;
pub mod shape;
pub mod touch;

use self::grip::Friction;
use self::law::Law;
use self::pieces::Lying;
use self::shape::Shape;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::body::kinematics;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use std::ops::Range;

/// A rigid surface, fixed to the ground, a moving frame or a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Name in the model file.
    pub name: String,
    /// Where it is; x is along its normal or axis.
    pub marker: Marker,
    /// Its shape.
    pub shape: Shape,
}

/// Contact of the elements of a beam with a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Name in the model file.
    pub name: String,
    /// Its position among the contacts of the model file, of which each may be several here.
    pub number: usize,
    /// The surface.
    pub surface: Surface,
    /// The elements that may touch it.
    pub elements: Range<usize>,
    /// Distance of the surface of the beam from its axis, m.
    pub radius: f64,
    /// Its normal force.
    pub law: Law,
    /// Its friction; none: it is smooth.
    pub friction: Option<Friction>,
    /// Its ground.
    pub ground: Ground,
}

/// The ground that a contact is with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ground {
    /// A rigid surface, on which a beam rolls: friction acts on the surface of the beam.
    Rigid,
    /// A soft seabed, into which a beam sinks: friction acts on its axis.
    Seabed {
        /// The first equilibrium has friction too.
        first: bool,
    },
}

impl Contact {
    /// The body that carries the surface, by its first coordinate.
    pub fn body(&self) -> Option<usize> {
        match self.surface.marker {
            Marker::Body { start, .. } => Some(start),
            _ => None,
        }
    }

    /// The position and the axes of the ground, the frame or the body that carries the surface.
    pub fn carrier(&self, c: &Configuration) -> Pose {
        match self.surface.marker {
            Marker::Body { start, .. } => kinematics::pose(c.beams.q, start),
            _ => self.surface.marker.bare().pose(c),
        }
    }

    /// Place and axes of the surface relative to its carrier.
    fn seat(&self) -> (Vec3, Mat3) {
        match self.surface.marker {
            Marker::Ground(pose) => (pose.place, pose.axes),
            Marker::Frame { offset, axes, .. }
            | Marker::Body { offset, axes, .. }
            | Marker::Node { offset, axes, .. }
            | Marker::Section { offset, axes, .. } => (offset, axes),
        }
    }

    /// How far points of `element` are above the surface at `c`, by their positions in it.
    pub fn gap(&self, element: &AnyElement, c: &Configuration) -> impl Fn(f64) -> f64 {
        let lying = self.lying(element, &self.carrier(c), c);
        let (shape, radius) = (self.surface.shape, self.radius);
        move |xi| shape.distance(&lying.point(xi)) - radius
    }

    /// How `element` lies in the axes of the surface, which `carrier` carries.
    fn lying(&self, element: &AnyElement, carrier: &Pose, c: &Configuration) -> Lying {
        let Lying { vectors: [start, slope, end, last_slope], length } = Lying::of(element, c);
        let (point, axes) = self.seat();
        let into = axes.transpose() * carrier.axes.transpose();
        let seat = axes.tr_mul(&point);
        // Slopes have no position.
        let [start, end] = [start, end].map(|vector| into * (vector - carrier.place) - seat);
        Lying { vectors: [start, into * slope, end, into * last_slope], length }
    }

    /// Whether an element touches the surface neither at one of both ends of a step nor on the way.
    fn is_clear(&self, element: &AnyElement, carriers: &[Pose; 2], configurations: [&Configuration; 2]) -> bool {
        let lying = configurations.map(|c| Lying::of(element, c));
        let (point, axes) = self.seat();
        let middles = [0, 1].map(|end| {
            let from = lying[end].point(0.5) - carriers[end].place;
            axes.tr_mul(&(carriers[end].axes.tr_mul(&from) - point))
        });
        let gap = middles.iter().map(|point| self.surface.shape.least_distance(point)).fold(f64::INFINITY, f64::min);
        gap - self.radius - (middles[1] - middles[0]).norm() > lying[0].reach().max(lying[1].reach())
    }
}
