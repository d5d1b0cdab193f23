//! Mistakes of a contact: of its beams, and of what they touch.

use super::Checker;
use crate::model::file::entries::contact::ContactSpec;
use crate::model::file::entries::surface::Shape;
use crate::model::file::quantity::Quantity;
use crate::model::shape::contacts::contact_radius;

impl Checker<'_> {
    /// Reports what a contact cannot have.
    pub(super) fn check_contact(&mut self, contact: &ContactSpec) {
        let document = self.document;
        for number in contact.beams.iter().chain(&contact.touched) {
            let (Some(beam), Some([label, help])) = (document.beams.get(*number), self.unfit_along(*number)) else {
                continue;
            };
            let message = format!("beam {} cannot touch anything in contact {}", beam.name, contact.name);
            self.mistake(contact.place, &message, label, help);
        }
        self.refuse_generalized_alpha(contact.place, ["contact", "contacts"], &contact.name);
        if contact.is_between_beams() {
            self.check_beam_pairs(contact);
        }
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

    /// Reports outputs of pressures on beams that touch no surface.
    pub(super) fn check_pressures(&mut self) {
        let document = self.document;
        for output in document.outputs.iter().filter(|own| own.quantities.contains(&Quantity::ContactPressure)) {
            let Some(beam) = output.target.beam() else { continue };
            let touches = document.contacts.iter().flat_map(ContactSpec::pairs).any(|pair| pair.0 == beam);
            if !touches && let Some(beam) = document.beams.get(beam) {
                let message = format!(
                    "output {} measures \"contact_pressure\", and beam {} touches no surface",
                    output.name, beam.name
                );
                let help =
                    "add a [contact.NAME] of the beam with a [surface.NAME]; contacts of beams have `normal_force`";
                self.mistake(output.place, &message, "there is no pressure", help);
            }
        }
    }

    /// Reports what a contact of beams with each other cannot have.
    fn check_beam_pairs(&mut self, contact: &ContactSpec) {
        let document = self.document;
        if contact.friction.is_some() {
            let message = format!("contact {} has friction, and beams touch each other without", contact.name);
            let help = "leave `friction` out, and give surfaces a contact of their own";
            self.mistake(contact.place, &message, "friction is only on surfaces", help);
        }
        let pairs = contact.beam_pairs();
        if pairs.is_empty() {
            let message = format!("no two beams touch each other in contact {}", contact.name);
            self.mistake(
                contact.place,
                &message,
                "a beam is with itself here",
                "write with = \"itself\" for its own coils",
            );
        }
        for (one, other) in pairs {
            let mut ends = [one, other].into_iter();
            let has_no_radius = |beam: &usize| contact_radius(document, contact, *beam) <= 0.0;
            let Some(beam) = ends.find(has_no_radius).and_then(|beam| document.beams.get(beam)) else { continue };
            let message = format!("beam {} has no thickness in contact {}", beam.name, contact.name);
            let help = "set `outer_diameter` of its section, or `radius` of the contact for the beams in `of`";
            self.mistake(contact.place, &message, "beams that touch each other need a radius", help);
            return;
        }
    }
}
