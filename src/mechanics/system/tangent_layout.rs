//! The order of the blocks of a system's tangent: those of elements, bodies, load points, springs, actuators, contacts
//! with bodies and of beams with each other, ropes, and what actuators read.

use super::System;
use crate::mechanics::force::load::Site;
use std::ops::Range;

/// Blocks of a spring or an actuator: one for each pair of its sides.
const OF_PAIR: usize = 4;
/// Blocks between an element and the body or the element that it may touch: its force by that, and the other way round.
const OF_CONTACT: usize = 2;

/// The numbers of the blocks of the tangent, which come first in the matrix of every solver.
#[derive(Clone, Copy, Debug)]
pub(super) struct TangentLayout {
    first_body: usize,
    first_load_point: usize,
    first_spring: usize,
    first_actuator: usize,
    first_contact: usize,
    first_beam_contact: usize,
    first_rope: usize,
    first_reading: usize,
}

impl TangentLayout {
    pub fn of(system: &System) -> Self {
        let first_body = system.mesh.elements.len();
        let first_load_point = first_body + system.bodies.len();
        let load_points = system.loads.iter().filter(|load| matches!(load.site, Site::Point(_))).count();
        let first_spring = first_load_point + load_points;
        let first_actuator = first_spring + OF_PAIR * system.springs.len();
        let first_contact = first_actuator + OF_PAIR * system.actuators.len();
        let first_beam_contact = first_contact + OF_CONTACT * system.contact_pairs().count();
        let first_rope = first_beam_contact + OF_CONTACT * system.touching_pairs();
        let first_reading = first_rope + system.rope_blocks();
        Self {
            first_body,
            first_load_point,
            first_spring,
            first_actuator,
            first_contact,
            first_beam_contact,
            first_rope,
            first_reading,
        }
    }

    /// Blocks of a reading of an actuator: two for each pair of a side of the actuator and one of the reading.
    pub const OF_READING: usize = 2 * OF_PAIR;

    /// The first block of the readings of actuators, which are in the order of the actuators.
    pub fn first_reading(self) -> usize {
        self.first_reading
    }

    pub fn element(self, number: usize) -> usize {
        number
    }

    pub fn body(self, number: usize) -> usize {
        self.first_body + number
    }

    /// The blocks of loads on markers, in the order of the loads.
    pub fn load_points(self) -> Range<usize> {
        self.first_load_point..self.first_spring
    }

    /// The blocks of a spring, by pairs of its sides: aa, ab, ba, bb.
    pub fn spring(self, number: usize) -> Range<usize> {
        let first = self.first_spring + OF_PAIR * number;
        first..first + OF_PAIR
    }

    /// The blocks of contacts with bodies, in the order of the contacts and their elements.
    pub fn contact_pairs(self) -> Range<usize> {
        self.first_contact..self.first_beam_contact
    }

    /// The blocks of beams that touch each other, in the order of the contacts and of the pairs of their elements.
    pub fn beam_contacts(self) -> Range<usize> {
        self.first_beam_contact..self.first_rope
    }

    /// The first block of ropes, which are in the order of the ropes and of the pairs of their parts.
    pub fn first_rope(self) -> usize {
        self.first_rope
    }

    /// The blocks of an actuator, by pairs of its sides: aa, ab, ba, bb.
    pub fn actuator(self, number: usize) -> Range<usize> {
        let first = self.first_actuator + OF_PAIR * number;
        first..first + OF_PAIR
    }
}
