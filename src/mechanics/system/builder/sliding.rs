//! Loads that move along beams, and joints that slide along them.

use super::SystemBuilder;
use crate::mechanics::constraint::inline;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::constraint::slide::{Slide, Way};
use crate::mechanics::force::load::Site;
use crate::mechanics::force::track::Track;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::Marker;
use std::sync::Arc;

impl SystemBuilder {
    /// A point that moves along a beam: at `station`, a fraction of its length, while `presence` is not negative.
    pub fn moving_along(&self, beam: usize, station: Signal, presence: Signal) -> Site {
        let beam = &self.system.beams[beam];
        let (first_element, division) = (beam.first_element, beam.division.clone());
        Site::Moving(Box::new(Track { first_element, division, station, presence }))
    }

    /// Adds a joint that holds `b` to the axis of beam `beam`, along which it slides from the fraction `station` of its
    /// length on, and returns the number of its first entry.
    pub fn add_slide(&mut self, name: &str, (beam, station): (usize, f64), b: Marker) -> usize {
        let beam = &self.system.beams[beam];
        let first_element = beam.first_element;
        let way = Arc::new(Way { first_element, division: beam.division.clone(), drawn: station });
        let first = self.system.joints.len();
        for element in beam.element_range() {
            self.system.joints.push(Joint {
                name: name.into(),
                a: Marker::section(element, 0.5),
                b,
                primitives: inline::PRIMITIVES,
                drive: None,
                gear: None,
                slide: Some(Slide { way: way.clone(), element, memory: 0 }),
                holding: None,
            });
        }
        first
    }
}
