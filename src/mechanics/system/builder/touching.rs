//! Contacts of a system in the making.

use super::SystemBuilder;
use crate::mechanics::contact::Contact;
use crate::mechanics::contact::axis::Strand;
use crate::mechanics::contact::grip::REMEMBERED;
use crate::mechanics::contact::law::Law;
use crate::mechanics::contact::mutual::BeamContact;

impl SystemBuilder {
    /// Adds a contact of a beam with a surface.
    pub fn add_contact(&mut self, mut contact: Contact) {
        if let Some(friction) = &mut contact.friction {
            friction.memory = self.memory;
            self.memory += REMEMBERED * contact.elements.len();
        }
        self.system.contacts.push(contact);
    }

    /// Adds a contact of the model file, `named` by its name and number, of two beams with their radii (m) or of a beam
    /// with itself.
    pub fn add_beam_contact(&mut self, named: (String, usize), beams: [(usize, f64); 2], law: Law) {
        let mesh = &self.system.mesh.elements;
        let strands = beams.map(|(beam, radius)| Strand::new(self.elements_of(beam), mesh, radius));
        self.system.beam_contacts.push(BeamContact { name: named.0, number: named.1, strands, law });
    }
}
