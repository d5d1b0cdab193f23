//! Mistakes of the wheels of a rope.

use super::Checker;
use crate::mechanics::force::rope::tensions::MOST_WHEELS;
use crate::model::file::entries::rope::RopeSpec;
use crate::model::file::entries::surface::Shape;

/// Ends of a rope.
const ENDS: usize = 2;

impl Checker<'_> {
    /// Reports what a rope cannot have.
    pub(super) fn check_rope(&mut self, rope: &RopeSpec) {
        let document = self.document;
        for end in rope.points() {
            self.fraction(&end);
        }
        for surface in rope.wheels().filter_map(|(surface, _)| document.surfaces.get(surface)) {
            let objection = match surface.shape {
                Shape::Plane(_) => "is a plane",
                Shape::Bottom { .. } => "is the seabed",
                Shape::Sphere { .. } => "is a sphere",
                Shape::Ring { .. } => "is a ring",
                Shape::Box { .. } => "is a box",
                Shape::Cone { .. } => "is a cone",
                Shape::Cylinder { inside: true, .. } => "is the inside of a cylinder",
                Shape::Sheave { groove, .. } if document.value(groove) < document.value(rope.radius) => {
                    "has a groove that is smaller than the rope"
                }
                Shape::Cylinder { .. } | Shape::Sheave { .. } => continue,
            };
            let message = format!("rope {} cannot run over surface {}", rope.name, surface.name);
            let help = "take a surface of shape sheave, whose groove the rope fits into, or the outside of a cylinder";
            self.mistake(rope.place, &message, &format!("surface {} {objection}", surface.name), help);
        }
        if rope.over.len() + ENDS > MOST_WHEELS {
            let message = format!("rope {} runs over {} sheaves", rope.name, rope.over.len());
            let label = format!("at most {} are possible", MOST_WHEELS - ENDS);
            self.mistake(rope.place, &message, &label, "divide it into two ropes");
        }
        self.refuse_generalized_alpha(rope.place, ["rope", "ropes"], &rope.name);
    }
}
