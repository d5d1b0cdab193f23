//! The section along a beam whose section is not the same everywhere.

use super::section::Section;
use std::fmt;
use std::sync::Arc;

/// How far inside its element an end is looked at, of the length of the element: where the section jumps from one
/// element to the next, each element has its own.
const INSIDE: f64 = 1e-9;

/// Sections by the fraction of the beam's arc length, 0 to 1; where they jump, the later one.
#[derive(Clone)]
pub struct Profile(Arc<dyn Fn(f64) -> Section + Send + Sync>);

impl Profile {
    /// Of a function of the fraction.
    pub fn new(section: impl Fn(f64) -> Section + Send + Sync + 'static) -> Self {
        Self(Arc::new(section))
    }

    /// The section at `fraction`.
    pub fn at(&self, fraction: f64) -> Section {
        (self.0)(fraction)
    }

    /// The same with the least rigidities of [`Section::with_least_rigidity`].
    #[must_use]
    pub fn with_least_rigidity(self, least: f64) -> Self {
        if least == 0.0 { self } else { Self::new(move |fraction| self.at(fraction).with_least_rigidity(least)) }
    }

    /// The section at the position `xi` (0 to 1) of the element between two fractions.
    pub fn inside(&self, fractions: [f64; 2], xi: f64) -> Section {
        self.at(inside(fractions, xi))
    }
}

/// The fraction at the position `xi` (0 to 1) of the element between two fractions, inside the element.
pub fn inside([begin, end]: [f64; 2], xi: f64) -> f64 {
    begin + (end - begin) * xi.clamp(INSIDE, 1.0 - INSIDE)
}

impl fmt::Debug for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Profile").field(&self.at(0.0)).field(&self.at(1.0)).finish()
    }
}

/// Two profiles are the same if they are one function.
impl PartialEq for Profile {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}
