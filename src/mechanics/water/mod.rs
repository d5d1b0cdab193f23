//! The water that beams are in: the medium and its motion, the share of a section below the surface, and how sections
//! resist the flow.

pub mod flow;
pub mod medium;
pub mod spectrum;
pub mod waves;
pub mod wet_section;
pub mod wet_share;

use self::medium::Medium;
use self::wet_section::WetSections;

/// The water with the elements that it acts on.
#[derive(Clone, Debug)]
pub struct Water {
    /// The water itself.
    pub medium: Medium,
    /// The elements in it, in their order.
    pub wetted: Vec<Wetted>,
}

/// An element that the water acts on.
#[derive(Clone, Copy, Debug)]
pub struct Wetted {
    /// Its number.
    pub element: usize,
    /// Its sections.
    pub sections: WetSections,
}

impl Water {
    /// The element with this number; none: it is dry.
    pub fn of(&self, element: usize) -> Option<&Wetted> {
        let index = self.wetted.binary_search_by_key(&element, |own| own.element).ok()?;
        Some(&self.wetted[index])
    }

    /// Whether forces of the water derive from no potential: a current, or waves, that drag an element along.
    pub fn drags(&self) -> bool {
        self.medium.moves() && self.wetted.iter().any(|own| own.sections.is_dragged())
    }
}
