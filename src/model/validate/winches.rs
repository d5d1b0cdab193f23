//! What is wrong with the beams that winches pay out: the material passes through the mesh, so that it must be the same
//! everywhere and free between the ends.

use super::Checker;
use crate::mechanics::beam::design::Elements;
use crate::model::file::entries::actuator::Action;
use crate::model::file::entries::curve::Line;
use crate::model::file::entries::load::Target;
use crate::model::file::entries::winch::WinchSpec;
use crate::model::file::reader::anchor::{Anchor, Spot};
use crate::model::shape::sections;

impl Checker<'_> {
    /// Reports what a winch and its beam cannot have.
    pub(super) fn check_winch(&mut self, winch: &WinchSpec) {
        self.check_paid_out(winch);
        let document = self.document;
        let Some(paid_out) = document.beams.get(winch.beam).map(|_| winch.beam) else { return };
        let mut held: Vec<(&str, &str, Anchor)> = Vec::new();
        for joint in &document.joints {
            held.extend(joint.held().map(|side| ("joint", joint.name.as_str(), side)));
        }
        for spring in &document.springs {
            held.extend(spring.ends().into_iter().flatten().map(|end| ("spring", spring.name.as_str(), end)));
        }
        for actuator in &document.actuators {
            if let Action::Between { a, b } = actuator.action {
                held.extend([a, b].map(|end| ("actuator", actuator.name.as_str(), end)));
            }
        }
        for rope in &document.ropes {
            held.extend(rope.points().map(|end| ("rope", rope.name.as_str(), end)));
        }
        for load in &document.loads {
            match load.target {
                Target::At(anchor) => held.push(("load", &load.name, anchor)),
                Target::Moving { beam, .. } if beam == winch.beam => {
                    let message = format!("load {} moves along a beam that winch {} pays out", load.name, winch.name);
                    let label = "a beam that is paid out may have forces per length along it";
                    let help = "apply the load to the far end of the beam, or to another beam";
                    self.mistake(load.place, &message, label, help);
                }
                Target::On(_) | Target::Moving { .. } => {}
            }
        }
        for (kind, name, anchor) in held {
            if matches!(anchor.spot, Spot::Beam { beam, .. } if beam == winch.beam)
                && let Spot::Beam { along, .. } = anchor.spot
                && let Some(fraction) = self.lines.fraction(document, paid_out, along)
                && fraction > 0.0
                && fraction < 1.0
            {
                let message =
                    format!("{kind} {name} holds on to a beam that winch {} pays out, between its ends", winch.name);
                let label = "the material passes through there: only .start and .end can be held";
                self.mistake(anchor.place, &message, label, "hold an end of the beam, or divide it into two beams");
            }
        }
        self.refuse_generalized_alpha(winch.place, ["winch", "winches"], &winch.name);
    }

    /// Reports a beam that cannot be paid out.
    fn check_paid_out(&mut self, winch: &WinchSpec) {
        let document = self.document;
        let Some(beam) = document.beams.get(winch.beam) else { return };
        let varies =
            document.sections.get(beam.section).is_some_and(|own| sections::along(document, own, 1.0).is_some());
        let has_corners = matches!(&beam.line, Some(Line::Curved(curve)) if curve.polyline);
        let objection = if matches!(beam.formulation, Elements::Ancf24 { .. }) {
            "its elements are of ancf24: use element = \"ancf14\""
        } else if varies {
            "its section must be the same everywhere, with y and z as its principal axes and the tension center on the axis"
        } else if beam.free_curvature.is_some() || beam.free_torsion.is_some() {
            "it can have no free_curvature or free_torsion of its own"
        } else if beam.temperature.is_some() || beam.temperature_gradient.is_some() {
            "it can have no temperature: its material passes from place to place"
        } else if sections::damping(document, beam).is_some_and(|[_, mass]| mass != 0.0) {
            "it can have no damping in proportion to its mass (mass_damping, damping_ratios), which does not know how fast its material moves"
        } else if has_corners {
            "it has corners: use a straight line, or a smooth curve"
        } else {
            return;
        };
        let message = format!("winch {} cannot pay out beam {}", winch.name, beam.name);
        self.mistake(winch.place, &message, objection, "");
    }
}
