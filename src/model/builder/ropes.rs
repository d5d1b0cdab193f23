//! Ropes of the file as parts of the system.

use super::Builder;
use crate::mechanics::force::rope::line::Wheel;
use crate::mechanics::force::rope::tensions::{self, Elasticity};
use crate::mechanics::system::System;
use crate::mechanics::system::builder::ropes::{Drawn, RopeDesign, STEEPEST, Slack};
use crate::model::file::document::Document;
use crate::model::file::entries::rope::{self, End, Hold, RopeSpec};

impl Builder<'_> {
    pub(super) fn add_rope(&mut self, written: &RopeSpec) {
        let document = self.document;
        let radius = document.value(written.radius);
        let wheels: Vec<_> = written
            .wheels()
            .map(|(surface, turn)| {
                let spec = &document.surfaces[surface];
                // Without a radius the file is refused.
                let of_surface = spec.shape.winding_radius().map_or(0.0, |radius| document.value(radius));
                let wheel = Wheel { radius: of_surface + radius, turn: turn as f64 };
                (spec.name.clone(), self.surface(spec).marker, wheel)
            })
            .collect();
        // Drums are the first and the last wheel.
        let [first, last] = [(0, "its start"), (1, "its end")].map(|(number, name)| match &written.ends[number] {
            End::Point(anchor) => {
                let marker = self.anchored(anchor);
                self.stiffen_below(&marker);
                Some((String::from(name), marker, Wheel::POINT))
            }
            End::Drum(_) => None,
        });
        let seats: Vec<_> = first.into_iter().chain(wheels).chain(last).collect();
        let names: Vec<String> = seats.iter().map(|(name, ..)| name.clone()).collect();
        let slack = match written.slack {
            rope::Slack::Drawn => Slack::Strain(0.0),
            rope::Slack::Length(length) => Slack::Length(document.value(length)),
            rope::Slack::Pretension(tension) => {
                Slack::Strain(document.value(tension) / document.value(written.stiffness))
            }
        };
        let (elasticity, hold) = (elasticity(document, written), hold(document, written));
        let design = RopeDesign { name: written.name.clone(), seats, elasticity, hold, slack };
        let (message, label, help) = match self.system.add_rope(&design) {
            Drawn::Possible => return,
            Drawn::Impossible(span) => (
                format!("rope {} has no way from {} to {}", written.name, names[span], names[span + 1]),
                String::from("one of them is inside the other, or the axis of one is along the rope"),
                "draw them further apart, or with smaller radii, and with axes across the rope",
            ),
            Drawn::Steep(seat, angle) => (
                format!(
                    "rope {} is drawn at {:.1} degrees to the plane of surface {}",
                    written.name,
                    angle.to_degrees(),
                    names[seat]
                ),
                format!("at most {:.0} are possible: it would not stay in its groove", STEEPEST.to_degrees()),
                "turn the `axis` of the surface across the rope",
            ),
        };
        self.mistakes.push(document.diagnostic(written.place, &message, &label, help));
    }
}

fn elasticity(document: &Document, written: &RopeSpec) -> Elasticity {
    let [stiffness, damping] = [written.stiffness, written.damping].map(|number| document.value(number));
    Elasticity { stiffness, damping }
}

fn hold(document: &Document, written: &RopeSpec) -> Option<tensions::Hold> {
    match written.hold {
        Hold::Free => None,
        Hold::Friction(number) => Some(tensions::Hold::Friction(document.value(number))),
        Hold::Sticks => Some(tensions::Hold::Stick),
    }
}

/// Sets elasticity and friction of ropes to those of now.
pub(super) fn retune(document: &Document, system: &mut System) {
    for (own, written) in system.ropes.iter_mut().zip(&document.ropes) {
        (own.elasticity, own.hold) = (elasticity(document, written), hold(document, written));
    }
}
