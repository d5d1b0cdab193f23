//! Mistakes of the beams and surfaces of a contact.

use super::Checker;
use crate::mechanics::beam::design::Elements;
use crate::model::file::entries::contact::ContactSpec;
use crate::model::file::entries::simulation::{Analysis, IntegratorSpec};
use crate::model::file::entries::surface::Shape;
use crate::model::shape::contacts::contact_radius;

impl Checker<'_> {
    /// Reports what a contact cannot have.
    pub(super) fn check_contact(&mut self, contact: &ContactSpec) {
        let document = self.document;
        for beam in contact.beams.iter().filter_map(|beam| document.beams.get(*beam)) {
            let winch = document.winches.iter().find(|own| document.beams[own.beam].name == beam.name);
            let (objection, help) = if matches!(beam.formulation, Elements::Ancf24 { .. }) {
                ("its elements are of ancf24", "use element = \"ancf14\"")
            } else if winch.is_some() {
                ("a winch pays it out, and its material passes through the mesh", "divide it into two beams")
            } else {
                continue;
            };
            let message = format!("beam {} cannot touch surfaces in contact {}", beam.name, contact.name);
            self.mistake(contact.place, &message, objection, help);
        }
        let simulation = &document.simulation;
        if simulation.analysis == Analysis::Dynamic
            && matches!(simulation.integrator, IntegratorSpec::GeneralizedAlpha { .. })
        {
            let message = format!("generalized_alpha does not support contacts, and {} is one", contact.name);
            let label = "a model with this contact needs another integrator";
            self.mistake(contact.place, &message, label, "leave integrator out: the default supports contacts");
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
}
