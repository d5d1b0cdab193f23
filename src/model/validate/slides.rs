//! Mistakes of joints that slide along a beam.

use super::Checker;
use crate::mechanics::beam::design::Elements;
use crate::model::file::entries::joint::JointSpec;
use crate::model::file::entries::simulation::{Analysis, IntegratorSpec};
use crate::model::file::reader::anchor::Spot;

impl Checker<'_> {
    /// Reports what a joint of the type `slide` cannot have.
    pub(super) fn check_slide(&mut self, joint: &JointSpec) {
        let document = self.document;
        self.fraction(&joint.a);
        self.node(&joint.b);
        let Spot::Beam { beam: number, .. } = joint.a.spot else { return };
        let Some(beam) = document.beams.get(number) else { return };
        let is_paid_out = document.winches.iter().any(|own| own.beam == number);
        let is_own = matches!(joint.b.spot, Spot::Beam { beam, .. } if beam == number);
        let objection = if matches!(beam.formulation, Elements::Ancf24 { .. }) {
            Some(("its elements are of ancf24", "use element = \"ancf14\""))
        } else if is_paid_out {
            Some(("a winch pays it out, and its material passes through the mesh", "divide it into two beams"))
        } else if is_own {
            Some(("side b is on the same beam", "take a place on another beam, or a body"))
        } else {
            None
        };
        if let Some((label, help)) = objection {
            let message = format!("joint {} cannot slide along beam {}", joint.name, beam.name);
            self.mistake(joint.place, &message, label, help);
        }
        let simulation = &document.simulation;
        if simulation.analysis == Analysis::Dynamic
            && matches!(simulation.integrator, IntegratorSpec::GeneralizedAlpha { .. })
        {
            let message = format!("generalized_alpha does not support slides, and {} is one", joint.name);
            let label = "a model with this joint needs another integrator";
            self.mistake(joint.place, &message, label, "leave integrator out: the default supports slides");
        }
    }
}
