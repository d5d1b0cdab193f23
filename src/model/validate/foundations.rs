//! Mistakes of the beam of a foundation.

use super::Checker;
use crate::mechanics::beam::design::Elements;
use crate::model::file::entries::foundation::FoundationSpec;
use crate::model::file::entries::simulation::{Analysis, IntegratorSpec};

impl Checker<'_> {
    /// Reports what a foundation cannot have.
    pub(super) fn check_foundation(&mut self, foundation: &FoundationSpec) {
        let document = self.document;
        if let Some(beam) = document.beams.get(foundation.beam) {
            let is_paid_out = document.winches.iter().any(|own| document.beams[own.beam].name == beam.name);
            let objection = if matches!(beam.formulation, Elements::Ancf24 { .. }) {
                Some(("its elements are of ancf24", "use element = \"ancf14\""))
            } else if is_paid_out {
                Some(("a winch pays it out, and its material passes through the mesh", "divide it into two beams"))
            } else {
                None
            };
            if let Some((label, help)) = objection {
                let message = format!("foundation {} cannot support beam {}", foundation.name, beam.name);
                self.mistake(foundation.place, &message, label, help);
            }
        }
        let simulation = &document.simulation;
        if simulation.analysis == Analysis::Dynamic
            && matches!(simulation.integrator, IntegratorSpec::GeneralizedAlpha { .. })
        {
            let message = format!("generalized_alpha does not support foundations, and {} is one", foundation.name);
            let label = "a model with this foundation needs another integrator";
            self.mistake(foundation.place, &message, label, "leave integrator out: the default supports foundations");
        }
    }
}
