//! A load along an element, as the element sees it: a force and a moment per undeformed length.

use crate::math::{Mat3, Vec3};

/// Most coordinates of an element: two nodes of ANCF24.
pub const MOST_COORDINATES: usize = 24;

/// Points of an element at which a load per length acts.
pub const LOAD_POINTS: usize = 3;

/// A generalized force in the coordinates of one element; those past its own are 0.
pub type ElementForces = [f64; MOST_COORDINATES];

/// A force and a moment per undeformed length, the same all along the element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineLoad {
    /// Force, N/m.
    pub force: Vec3,
    /// Moment, N.
    pub moment: Vec3,
    /// Whether both are along the axes of each section and turn with it; else along the global axes.
    pub follows: bool,
}

impl LineLoad {
    /// Whether its generalized force depends on no coordinate: that of a force that does not turn.
    pub fn is_constant(&self) -> bool {
        !self.follows && self.moment == Vec3::zeros()
    }

    /// Force and moment on the length `share` (m) of a section with the axes `axes`, in space: N and N m.
    pub fn on(&self, share: f64, axes: &Mat3) -> [Vec3; 2] {
        [self.force, self.moment].map(|own| if self.follows { axes * own * share } else { own * share })
    }
}
