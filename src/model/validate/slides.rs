//! Mistakes of joints that slide along a beam.

use super::Checker;
use crate::model::file::entries::curve::Line;
use crate::model::file::entries::joint::JointSpec;
use crate::model::file::reader::anchor::Spot;

impl Checker<'_> {
    /// Reports what a joint of the type `slide` cannot have.
    pub(super) fn check_slide(&mut self, joint: &JointSpec) {
        self.fraction(&joint.a);
        self.node(&joint.b);
        let Spot::Beam { beam: number, .. } = joint.a.spot else { return };
        let Some(beam) = self.document.beams.get(number) else { return };
        let is_own = matches!(joint.b.spot, Spot::Beam { beam, .. } if beam == number);
        let objection = if matches!(&beam.line, Some(Line::Curved(curve)) if curve.polyline) {
            Some(["it has corners, where its tangent jumps", "draw it as a curve without `polyline`"])
        } else if is_own {
            Some(["side b is on the same beam", "take a place on another beam, or a body"])
        } else {
            self.unfit_along(number)
        };
        if let Some([label, help]) = objection {
            let message = format!("joint {} cannot slide along beam {}", joint.name, beam.name);
            self.mistake(joint.place, &message, label, help);
        }
        self.refuse_generalized_alpha(joint.place, ["joint", "slides"], &joint.name);
    }
}
