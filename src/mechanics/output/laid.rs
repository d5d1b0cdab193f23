//! How a beam lies on the seabed: how much of it, and where it comes down.

use crate::mechanics::contact::{Contact, Ground};
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::system::System;

/// Intervals of an element in which a beam may come down.
const INTERVALS: usize = 16;
/// Halvings that find the point of touchdown to round-off of its position.
const HALVINGS: usize = 48;

impl System {
    /// The contact of a beam with the seabed.
    fn on_seabed(&self, beam: usize) -> Option<&Contact> {
        let first = self.beams[beam].first_element;
        let is_own = |own: &&Contact| matches!(own.ground, Ground::Seabed { .. }) && own.elements.start == first;
        self.contacts.iter().find(is_own)
    }

    /// Length of a beam that lies on the seabed at `c`, m.
    pub fn laid_length(&self, beam: usize, c: &Configuration) -> f64 {
        let mut sum = 0.0;
        if let Some(contact) = self.on_seabed(beam) {
            for element in &self.mesh.elements[contact.elements.clone()] {
                contact.each_touch(element, c, &Passage::Rest, |touch| sum += touch.length);
            }
        }
        sum
    }

    /// Arc length at which a beam comes down on the seabed, seen from its end that is higher above it, m; -1: it does
    /// not touch it.
    pub fn touchdown(&self, beam: usize, c: &Configuration) -> f64 {
        let Some(contact) = self.on_seabed(beam) else { return -1.0 };
        let elements = &self.mesh.elements[contact.elements.clone()];
        let (mut first, mut last) = (-1.0, -1.0);
        let (mut start, mut gap_at_start, mut gap_at_end) = (0.0, f64::INFINITY, f64::INFINITY);
        for (number, element) in elements.iter().enumerate() {
            let (gap, length) = (contact.gap(element, c), element.length());
            let mut before = gap(0.0);
            if number == 0 {
                gap_at_start = before;
                if before < 0.0 {
                    first = 0.0;
                }
            }
            for interval in 0..INTERVALS {
                let [from, to] = [interval, interval + 1].map(|own| own as f64 / INTERVALS as f64);
                let after = gap(to);
                if (before < 0.0) != (after < 0.0) {
                    let border = start + length * border(&gap, [from, to], before < 0.0);
                    if after < 0.0 && first < 0.0 {
                        first = border;
                    }
                    last = border;
                }
                before = after;
            }
            start += length;
            gap_at_end = before;
        }
        if gap_at_end < 0.0 {
            last = start;
        }
        if gap_at_start > gap_at_end { first } else { last }
    }
}

/// Where a gap changes its sign between two positions.
fn border(gap: &impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2], touches_first: bool) -> f64 {
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if (gap(middle) < 0.0) == touches_first { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}
