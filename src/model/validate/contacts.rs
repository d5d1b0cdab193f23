//! Mistakes of the beams and surfaces of a contact.

use super::Checker;
use crate::model::file::entries::contact::ContactSpec;
use crate::model::file::entries::surface::Shape;
use crate::model::shape::contacts::contact_radius;

impl Checker<'_> {
    /// Reports what a contact cannot have.
    pub(super) fn check_contact(&mut self, contact: &ContactSpec) {
        let document = self.document;
        for number in &contact.beams {
            let (Some(beam), Some([label, help])) = (document.beams.get(*number), self.unfit_along(*number)) else {
                continue;
            };
            let message = format!("beam {} cannot touch surfaces in contact {}", beam.name, contact.name);
            self.mistake(contact.place, &message, label, help);
        }
        self.refuse_generalized_alpha(contact.place, ["contact", "contacts"], &contact.name);
        for (beam, surface) in contact.pairs() {
            let (Some(_), Some(surface)) = (document.beams.get(beam), document.surfaces.get(surface)) else { continue };
            let room = match surface.shape {
                Shape::Sheave { groove, .. } => (document.value(groove), "the groove"),
                Shape::Cylinder { radius, inside: true, .. } | Shape::Sphere { radius, inside: true } => {
                    (document.value(radius), "the inside")
                }
                _ => continue,
            };
            let radius = contact_radius(document, contact, beam);
            if radius > room.0 {
                let message = format!(
                    "{} of surface {} has a radius of {} m, and beam {} one of {radius} m",
                    room.1, surface.name, room.0, document.beams[beam].name
                );
                let help = "take a larger surface, or set `radius` of the contact";
                self.mistake(contact.place, &message, "the beam does not fit into it", help);
            }
        }
    }
}
