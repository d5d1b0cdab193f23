//! Forces that a contact transmits, and how beams lie on its surfaces.

use crate::math::{Vec3, hermite};
use crate::mechanics::beam::ancf14::coordinates::interpolate;
use crate::mechanics::contact::grip::{Cells, Pressing};
use crate::mechanics::contact::mutual::{BeamContact, Meeting};
use crate::mechanics::contact::pieces::CELLS;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::system::System;

/// Forces that a contact transmits, summed over its beams and what they touch.
#[derive(Clone, Copy, Debug, Default)]
pub struct ContactLoads {
    /// Force on the beams, N.
    pub force: Vec3,
    /// Moment on the beams about the position of the first surface, or about the origin where beams touch each other,
    /// N m.
    pub moment: Vec3,
    /// Sum of the sizes of all normal forces, N.
    pub normal: f64,
    /// Sum of the sizes of all friction, N.
    pub friction: f64,
    /// Largest penetration, m.
    pub penetration: f64,
    /// Length of beam that touches, m.
    pub length: f64,
    /// Angle by which the beams are bent along that length, rad.
    pub wrap: f64,
    /// Share of the cells with friction that slide.
    pub sliding: f64,
    /// Elastic energy of the penetration, J.
    pub energy: f64,
}

impl System {
    /// Sums of contact `number` of the model file at `c`.
    pub fn contact_loads(&self, number: usize, c: &Configuration, passage: &Passage) -> ContactLoads {
        let (mut found, mut cells_with_friction) = (ContactLoads::default(), 0.0);
        let mut about = None;
        for contact in self.contacts.iter().filter(|contact| contact.number == number) {
            let about = *about.get_or_insert_with(|| contact.surface.marker.pose(c).place);
            for own in contact.elements.clone() {
                let (element, mut cells) = (&self.mesh.elements[own], Cells::default());
                let q = &c.beams.q[element.coordinates()];
                contact.each_touch(element, c, passage, |touch| {
                    Pressing::add(&mut cells, touch);
                    let force = touch.in_space();
                    found.force += force;
                    found.moment += (interpolate(&touch.weights, q) - about).cross(&force);
                    found.normal += touch.pressing;
                    found.penetration = found.penetration.max(touch.penetration);
                    found.length += touch.length;
                    found.energy += touch.energy;
                    found.wrap += touch.length * bending(element.length(), touch.xi, q);
                });
                contact.each_grip(own, element, c, passage, &cells, |grip| {
                    let [force, moment] = grip.in_space();
                    let point = interpolate(&hermite::shape(grip.xi, element.length()), q);
                    found.force += force;
                    found.moment += (point - about).cross(&force) + moment;
                    found.friction += grip.force.norm();
                    cells_with_friction += 1.0;
                    found.sliding += f64::from(grip.slides);
                });
            }
        }
        found.sliding /= f64::max(cells_with_friction, 1.0);
        for contact in self.beam_contacts.iter().filter(|contact| contact.number == number) {
            contact.each_meeting(c, passage, &mut |meeting| self.add_meeting_to(&mut found, contact, meeting, c));
        }
        found
    }

    /// Normal force per undeformed length of all surfaces at a position in an element, N/m: the mean over its half of
    /// the element. Within that, a curve of third degree lies deeper in one part of a round surface than in another.
    pub fn contact_pressure(&self, (number, xi): (usize, f64), c: &Configuration, passage: &Passage) -> f64 {
        let element = &self.mesh.elements[number];
        let (own, cells) = (((xi * CELLS as f64) as usize).min(CELLS - 1), CELLS as f64);
        let mut pressing = 0.0;
        for contact in self.contacts.iter().filter(|contact| contact.elements.contains(&number)) {
            contact.each_touch(element, c, passage, |touch| {
                pressing += if touch.cell == own { touch.pressing } else { 0.0 };
            });
        }
        pressing * cells / element.length()
    }

    /// Adds a point at which beams touch each other: the force on the beam that touches, about the origin.
    fn add_meeting_to(&self, sums: &mut ContactLoads, contact: &BeamContact, meeting: &Meeting, c: &Configuration) {
        let own = contact.strands[meeting.side].elements.start + meeting.elements[0];
        let element = &self.mesh.elements[own];
        let (q, xi) = (&c.beams.q[element.coordinates()], meeting.xi[0]);
        if !contact.is_own() {
            let force = meeting.push * if meeting.side == 0 { meeting.pressing } else { -meeting.pressing };
            // Along the line of the force both beams have the same moment.
            sums.force += force;
            sums.moment += (interpolate(&hermite::shape(xi, element.length()), q) + self.origin).cross(&force);
        }
        sums.normal += meeting.pressing;
        sums.penetration = sums.penetration.max(meeting.penetration);
        sums.length += meeting.length;
        sums.energy += meeting.energy;
        sums.wrap += meeting.length * bending(element.length(), xi, q);
    }
}

/// Angle per length by which an element of this length is bent at `xi`, rad/m.
fn bending(length: f64, xi: f64, q: &[f64]) -> f64 {
    let slope = interpolate(&hermite::shape_x(xi, length), q);
    let bend = interpolate(&hermite::shape_xx(xi, length), q);
    slope.cross(&bend).norm() / slope.norm_squared()
}
