//! Contact of beams with each other in a system: forces, tangent, energy, what steps may not do.

use super::System;
use super::contacts::add_block;
use super::tangent_layout::TangentLayout;
use crate::error::{Error, Overlap};
use crate::math::blocks::{Block, Blocks};
use crate::math::vectors::add_vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::ancf14::coordinates::{ELEMENT, SHAPE_PLACES};
use crate::mechanics::contact::mutual::{BeamContact, Meeting, VECTORS};
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};

/// A point of an element that touches a beam.
#[derive(Clone, Copy, Debug)]
pub struct MeetingPoint {
    /// The element.
    pub element: usize,
    /// Its position there, 0 to 1.
    pub xi: f64,
    /// Force on it, N.
    pub force: Vec3,
}

impl System {
    /// Number of pairs of elements that may touch each other: each has two blocks of the tangent.
    pub(super) fn touching_pairs(&self) -> usize {
        self.beam_contacts.iter().map(BeamContact::pairs).sum()
    }

    /// Appends the blocks of these pairs: rows of the first element and columns of the second, and the other way round.
    pub(super) fn push_beam_contact_blocks(&self, blocks: &mut Blocks) {
        for contact in &self.beam_contacts {
            let first = blocks.layout().len();
            let [ones, others] = [0, 1].map(|side| contact.strands[side].elements.clone());
            for (one, element) in ones.enumerate() {
                let after = if contact.is_own() { one + 2 } else { 0 };
                for (other, partner) in others.clone().enumerate().skip(after) {
                    debug_assert_eq!(blocks.layout().len(), first + 2 * contact.pair(one, other));
                    let [row, column] = [element, partner].map(|own| self.mesh.elements[own].coordinates().start);
                    blocks.push_occasional(Block { row, column, rows: ELEMENT, columns: ELEMENT });
                    blocks.push_occasional(Block { row: column, column: row, rows: ELEMENT, columns: ELEMENT });
                }
            }
        }
    }

    /// The elements of a meeting, of the point and of what it touches, by their numbers in the mesh.
    fn meeting_elements(contact: &BeamContact, meeting: &Meeting) -> [usize; 2] {
        let sides = [meeting.side, 1 - meeting.side];
        [0, 1].map(|number| contact.strands[sides[number]].elements.start + meeting.elements[number])
    }

    /// The first coordinate of each vector of both elements.
    fn meeting_coordinates(&self, elements: [usize; 2]) -> [usize; VECTORS] {
        let starts = elements.map(|own| self.mesh.elements[own].coordinates().start);
        std::array::from_fn(|vector| starts[vector / 4] + SHAPE_PLACES[vector % 4])
    }

    /// Adds `factor` times the forces of beams that touch each other, internal minus external, at `c` as `passage`
    /// says.
    pub(super) fn add_beam_contact_forces(
        &self,
        c: &Configuration,
        passage: &Passage,
        factor: f64,
        forces: &mut [f64],
    ) {
        for contact in &self.beam_contacts {
            contact.each_meeting(c, passage, &mut |meeting| self.add_meeting(contact, meeting, factor, forces));
        }
    }

    fn add_meeting(&self, contact: &BeamContact, meeting: &Meeting, factor: f64, forces: &mut [f64]) {
        let firsts = self.meeting_coordinates(Self::meeting_elements(contact, meeting));
        for (vector, first) in firsts.into_iter().enumerate() {
            add_vec3(forces, first, &(meeting.force(vector) * factor));
        }
    }

    /// [`Self::add_beam_contact_forces`], adds `scale` times their derivative to the blocks of elements, and sets those
    /// between them; over a step twice the derivative by the coordinates at its end.
    pub(super) fn add_beam_contacts_and_set_tangent(
        &self,
        c: &Configuration,
        passage: &Passage,
        scale: f64,
        forces: &mut [f64],
        tangent: &mut Blocks,
    ) {
        TangentLayout::of(self).beam_contacts().for_each(|block| tangent.block_mut(block).fill(0.0));
        self.each_meeting_with_blocks(c, passage, &mut |contact, meeting, blocks| {
            self.add_meeting(contact, meeting, 1.0, forces);
            add_products(blocks, |row, column| meeting.stiffness(row, column) * scale, tangent);
        });
    }

    /// Adds `factor` times the derivative of these forces with respect to the velocities, at an instant with the
    /// velocities `velocity`, to the first blocks of `tangent`.
    pub(super) fn add_beam_contact_damping(
        &self,
        c: &Configuration,
        velocity: &[f64],
        factor: f64,
        tangent: &mut Blocks,
    ) {
        if self.beam_contacts.iter().any(|contact| contact.law.is_damped()) {
            self.each_meeting_with_blocks(c, &Passage::with_velocity(velocity), &mut |_, meeting, blocks| {
                add_products(blocks, |row, column| meeting.damping(row, column) * factor, tangent);
            });
        }
    }

    /// Calls `take` with each meeting and the four blocks of its elements: both own ones are the first and the last.
    fn each_meeting_with_blocks(
        &self,
        c: &Configuration,
        passage: &Passage,
        take: &mut dyn FnMut(&BeamContact, &Meeting, [usize; 4]),
    ) {
        let layout = TangentLayout::of(self);
        let mut first = layout.beam_contacts().start;
        for contact in &self.beam_contacts {
            contact.each_meeting(c, passage, &mut |meeting| {
                let [element, partner] = Self::meeting_elements(contact, meeting);
                let [own, other] = meeting.elements;
                let is_turned = if contact.is_own() { own > other } else { meeting.side == 1 };
                let pair = if is_turned { contact.pair(other, own) } else { contact.pair(own, other) };
                let [between, back] = [usize::from(is_turned), usize::from(!is_turned)].map(|k| first + 2 * pair + k);
                take(contact, meeting, [layout.element(element), between, back, layout.element(partner)]);
            });
            first += 2 * contact.pairs();
        }
    }

    /// Energy of the penetrations of beams in each other at `c`, J.
    pub(super) fn beam_contact_energy(&self, c: &Configuration) -> f64 {
        let mut sum = 0.0;
        for contact in &self.beam_contacts {
            contact.each_meeting(c, &Passage::Rest, &mut |meeting| sum += meeting.energy);
        }
        sum
    }

    /// Adds the forces of beams that touch each other over `step`, whose middle is `c`. Returns the energy that they
    /// take, J.
    pub(super) fn finish_beam_contacts(&self, c: &Configuration, step: &TimeStep, forces: &mut [f64]) -> f64 {
        let mut dissipated = 0.0;
        for contact in &self.beam_contacts {
            contact.each_meeting(c, &Passage::Step(*step), &mut |meeting| {
                self.add_meeting(contact, meeting, 1.0, forces);
                dissipated += meeting.dissipated;
            });
        }
        dissipated
    }

    /// Checks that no beam has run through another one between two configurations.
    ///
    /// # Errors
    /// One has: it might leave on the other side.
    pub(super) fn check_beam_contacts(&self, ends: [&Configuration; 2], time: f64) -> Result<(), Error> {
        for contact in &self.beam_contacts {
            if let Some(elements) = contact.run_through(ends) {
                let [(beam, element), (other, touched)] =
                    [0, 1].map(|side| self.beam_of(contact.strands[side].elements.start + elements[side]));
                let (beam, other) = (beam.name.clone(), other.name.clone());
                let distance = contact.distance();
                let overlap = Overlap { beam, element, other, touched, distance };
                return Err(Error::BeamThroughBeam { time, overlap });
            }
        }
        Ok(())
    }

    /// The points of beams that touch beams at `c`, through which the system passes as `passage` says, in the order of
    /// their elements.
    pub fn meeting_points(&self, c: &Configuration, passage: &Passage) -> Vec<MeetingPoint> {
        let mut points = Vec::new();
        for contact in &self.beam_contacts {
            contact.each_meeting(c, passage, &mut |meeting| {
                let force = meeting.push * meeting.pressing;
                let sides = Self::meeting_elements(contact, meeting).into_iter().zip(meeting.xi).zip([force, -force]);
                points.extend(sides.map(|((element, xi), force)| MeetingPoint { element, xi, force }));
            });
        }
        points.sort_by_key(|point| point.element);
        points
    }
}

/// Adds the products `of` all vectors of two elements to their four blocks.
fn add_products(blocks: [usize; 4], of: impl Fn(usize, usize) -> Mat3, tangent: &mut Blocks) {
    for row in 0..VECTORS {
        for column in 0..VECTORS {
            let block = tangent.block_mut(blocks[2 * (row / 4) + column / 4]);
            add_block(block, ELEMENT, [SHAPE_PLACES[row % 4], SHAPE_PLACES[column % 4]], &of(row, column));
        }
    }
}
