//! The fluids around beams and bodies, water below its surface and air above it: the medium and its motion, the share
//! of a section that is in it, and how sections resist the flow.

pub mod flow;
pub mod medium;
pub mod spectrum;
pub mod waves;
pub mod wet_body;
pub mod wet_section;
pub mod wet_share;

use self::medium::Medium;
use self::wet_section::WetSections;
use crate::mechanics::fluid::wet_body::WetBody;

/// A fluid with the elements and the bodies that it acts on.
#[derive(Clone, Debug)]
pub struct Fluid {
    /// The fluid itself.
    pub medium: Medium,
    /// The elements that it may reach, in their order.
    pub wetted: Vec<Wetted>,
    /// The bodies that it may reach.
    pub bodies: Vec<WetBody>,
}

/// An element that a fluid acts on.
#[derive(Clone, Copy, Debug)]
pub struct Wetted {
    /// Its number.
    pub element: usize,
    /// Its sections.
    pub sections: WetSections,
}

impl Fluid {
    /// The element with this number; none: it is never reached.
    pub fn of(&self, element: usize) -> Option<&Wetted> {
        let index = self.wetted.binary_search_by_key(&element, |own| own.element).ok()?;
        Some(&self.wetted[index])
    }

    /// Whether its forces derive from no potential: a current, a wind, or waves, that drag elements or bodies along.
    pub fn drags(&self) -> bool {
        let drags_beams = || self.wetted.iter().any(|own| own.sections.is_dragged());
        self.medium.moves() && (drags_beams() || self.bodies.iter().any(|own| own.drag.amax() > 0.0))
    }
}
