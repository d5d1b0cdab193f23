//! Outlines of sections and solids of bodies, from what the system knows of them.

use crate::mechanics::beam::section::{Outline, Section};
use crate::mechanics::body::rigid_body::RigidBody;

/// The outline of a section, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Profile {
    /// `width` along the section's y, `height` along its z.
    Rectangle {
        /// Along y.
        width: f64,
        /// Along z.
        height: f64,
    },
    /// Semi-axes along y and z; a circle has two equal ones. Also what stands for a section that is given by its
    /// integrals alone: the ellipse of the same radii of gyration.
    Ellipse {
        /// Along y.
        y: f64,
        /// Along z.
        z: f64,
    },
    /// A circular tube.
    Tube {
        /// Radius of the hole.
        inner: f64,
        /// Radius outside.
        outer: f64,
    },
}

impl Profile {
    /// Of a section; of thin walls the rectangle around them.
    pub(super) fn new(section: &Section) -> Self {
        match section.outline {
            Outline::Rectangle { width, height } => Self::Rectangle { width, height },
            Outline::Circle { radius } => Self::Ellipse { y: radius, z: radius },
            Outline::Ellipse { y, z } => Self::Ellipse { y, z },
            Outline::Tube { inner, outer } => Self::Tube { inner, outer },
            Outline::Walls { .. } => {
                let [width, height] = section.outline.size().unwrap_or_default();
                Self::Rectangle { width, height }
            }
            Outline::General => {
                // A full ellipse with the semi-axis a has the radius of gyration a/2.
                let semi_axis = |second_moment: f64| 2.0 * (second_moment / section.area).sqrt();
                Self::Ellipse { y: semi_axis(section.second_moment_z), z: semi_axis(section.second_moment_y) }
            }
        }
    }
}

impl Profile {
    /// Extent along y and along z, m.
    pub(super) fn size(&self) -> [f64; 2] {
        match self {
            Self::Rectangle { width, height } => [*width, *height],
            Self::Ellipse { y, z } => [2.0 * y, 2.0 * z],
            Self::Tube { outer, .. } => [2.0 * outer; 2],
        }
    }
}

/// A homogeneous solid with the mass and the principal moments of inertia of a body, in its principal axes, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Solid {
    /// Lengths of the edges along the three axes.
    Box([f64; 3]),
    /// A cylinder about one of the axes.
    Cylinder {
        /// Which axis, 0 to 2.
        axis: usize,
        /// Its radius.
        radius: f64,
        /// Its length.
        length: f64,
    },
}

/// Two moments of inertia that differ less than this, of the larger one, are equal: of something round.
const EQUAL: f64 = 1e-6;

impl Solid {
    /// A cylinder where exactly two principal moments are equal, a box otherwise.
    pub(super) fn new(body: &RigidBody) -> Self {
        let squares = body.director_inertia.map(|inertia| inertia / body.mass); // ∫ x² dm / m, m²
        let alike = |a: usize, b: usize| (squares[a] - squares[b]).abs() <= EQUAL * squares[a].max(squares[b]);
        let round = (0..3).find(|axis| {
            let [b, c] = [(axis + 1) % 3, (axis + 2) % 3];
            alike(b, c) && !alike(*axis, b)
        });
        let edge = |axis: usize| (12.0 * squares[axis]).sqrt();
        match round {
            // ∫ x² dm of a disk is m r²/4.
            Some(axis) => Self::Cylinder { axis, radius: 2.0 * squares[(axis + 1) % 3].sqrt(), length: edge(axis) },
            None => Self::Box([0, 1, 2].map(edge)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{Mat3, Vec3};
    use crate::mechanics::body::rigid_body::BodyDesign;

    fn solid(mass: f64, moments: [f64; 3]) -> Solid {
        let design = BodyDesign {
            name: String::from("disk"),
            mass,
            position: Vec3::zeros(),
            inertia: Mat3::from_diagonal(&Vec3::from(moments)),
            axes: Mat3::identity(),
            velocity: Vec3::zeros(),
            angular_velocity: Vec3::zeros(),
        };
        Solid::new(&RigidBody::new(&design, 0).0)
    }

    /// The solid must have the inertia that it was made of: textbook moments of a box and of a disk.
    #[test]
    fn solids_have_the_inertia_of_their_bodies() {
        let mass = 3.0;
        let [a, b, c] = [0.1, 0.2, 0.4_f64];
        let of_box = [b * b + c * c, a * a + c * c, a * a + b * b].map(|sum| mass * sum / 12.0);
        let Solid::Box(edges) = solid(mass, of_box) else { panic!("a box was expected") };
        edges
            .iter()
            .zip([a, b, c])
            .for_each(|(edge, expected)| approx::assert_relative_eq!(*edge, expected, epsilon = 1e-12));
        let (r, h) = (0.3_f64, 0.05);
        let across = mass * (3.0 * r * r + h * h) / 12.0;
        let Solid::Cylinder { axis, radius, length } = solid(mass, [across, 0.5 * mass * r * r, across]) else {
            panic!("a cylinder was expected")
        };
        assert_eq!(axis, 1);
        approx::assert_relative_eq!(radius, r, epsilon = 1e-12);
        approx::assert_relative_eq!(length, h, epsilon = 1e-12);
    }
}
