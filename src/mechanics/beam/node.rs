//! A node of a beam: where its coordinates are, and how what is tied to it moves with them.

use super::ancf14::coordinates as ancf14;
use super::ancf24::coordinates as ancf24;
use super::ancf24::frame::SectionFrame;
use super::configuration::BeamConfiguration;
use crate::math::Vec3;
use crate::math::rotation::rotation_angle;
use crate::math::vectors::vec3;
use crate::mechanics::geometry::marker_jacobian::{ByCoordinates, MarkerJacobian, MarkerMatrix};
use crate::mechanics::geometry::pose::Pose;
use std::ops::Range;

/// A node of a beam. Its first three coordinates are its position, the next three its slope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Node {
    /// Of ANCF14: position, slope, twist about it.
    Ancf14 {
        /// First coordinate.
        start: usize,
        /// Number of its frame, which is carried in time.
        frame: usize,
    },
    /// Of ANCF24: position and three gradients.
    Ancf24 {
        /// First coordinate.
        start: usize,
    },
}

impl Node {
    /// Its coordinates.
    pub fn coordinates(&self) -> Range<usize> {
        match *self {
            Self::Ancf14 { start, .. } => start..start + ancf14::NODE,
            Self::Ancf24 { start } => start..start + ancf24::NODE,
        }
    }

    /// Its place, of what `q` describes, m.
    pub fn place(&self, q: &[f64]) -> Vec3 {
        vec3(q, self.coordinates().start)
    }

    /// Its slope, of what `q` describes, 1.
    pub fn slope(&self, q: &[f64]) -> Vec3 {
        vec3(q, self.coordinates().start + ancf14::P)
    }

    /// Position and section axes.
    pub fn pose(&self, c: &BeamConfiguration) -> Pose {
        let axes = match *self {
            Self::Ancf14 { frame, .. } => c.frames[frame].section(),
            Self::Ancf24 { start } => SectionFrame::of_node(&c.q[start..]).axes,
        };
        Pose { place: self.place(c.q), axes }
    }

    /// How far the section has turned from the coordinates `before` to `after`, rad; 0 where no coordinate but an angle
    /// turns it.
    pub fn section_turn(&self, before: &[f64], after: &[f64]) -> f64 {
        match *self {
            Self::Ancf14 { .. } => 0.0,
            Self::Ancf24 { start } => {
                let [before, after] = [before, after].map(|q| SectionFrame::of_node(&q[start..]).axes);
                rotation_angle(&before, &after)
            }
        }
    }

    /// How a point `offset` (section axes, m) away moves.
    pub fn jacobian(&self, c: &BeamConfiguration, offset: &Vec3) -> MarkerJacobian {
        MarkerJacobian::of_arm(&(self.pose(c).axes * offset), self.turn_q(c), self.coordinates().len())
    }

    /// `∂φ/∂q`, 3×24: turn of the section.
    pub fn turn_q(&self, c: &BeamConfiguration) -> ByCoordinates {
        match *self {
            Self::Ancf14 { frame, .. } => c.frames[frame].turn_q(),
            Self::Ancf24 { start } => SectionFrame::of_node(&c.q[start..]).node_turn_q(),
        }
    }

    /// Adds `∂(turn_qᵀ m)/∂q` of a moment (N m) frozen in space to `sum`.
    pub fn add_moment_stiffness(&self, c: &BeamConfiguration, moment: &Vec3, sum: &mut MarkerMatrix) {
        match *self {
            Self::Ancf14 { frame, .. } => c.frames[frame].add_moment_stiffness(moment, sum),
            Self::Ancf24 { start } => SectionFrame::of_node(&c.q[start..]).add_node_moment_stiffness(moment, sum),
        }
    }

    /// Whether its coordinate `local` turns the section alone.
    pub fn is_turn(&self, local: usize) -> bool {
        match self {
            Self::Ancf14 { .. } => local == ancf14::THETA,
            Self::Ancf24 { .. } => local >= ancf24::Y,
        }
    }

    /// Those of its coordinates that are directions fixed to its section; none where an angle turns it.
    pub fn directors(&self) -> Range<usize> {
        let range = self.coordinates();
        match self {
            Self::Ancf14 { .. } => range.end..range.end,
            Self::Ancf24 { .. } => range.start + ancf24::Y..range.end,
        }
    }

    /// Whether coordinate `index` of the system is its angle about the tangent.
    pub fn is_spin(&self, index: usize) -> bool {
        matches!(self, Self::Ancf14 { start, .. } if index == start + ancf14::THETA)
    }

    /// What its coordinate `local` beyond its place is, in words.
    pub fn describe(&self, local: usize) -> &'static str {
        match self {
            Self::Ancf14 { .. } if local == ancf14::THETA => "turning about the beam",
            Self::Ancf24 { .. } if local >= ancf24::Y => "its section",
            _ => "its slope",
        }
    }

    /// Angular momentum about the origin of the momenta `momentum` at `q`, kg m²/s (MECHANICS 7.2).
    pub fn angular_momentum(&self, q: &[f64], momentum: &[f64]) -> Vec3 {
        let part = |place: usize| vec3(q, place).cross(&vec3(momentum, place));
        match *self {
            Self::Ancf14 { start, .. } => {
                let spin = self.slope(q).normalize() * momentum[start + ancf14::THETA];
                part(start) + part(start + ancf14::P) + spin
            }
            Self::Ancf24 { start } => {
                [ancf24::R, ancf24::X, ancf24::Y, ancf24::Z].into_iter().map(|place| part(start + place)).sum()
            }
        }
    }
}
