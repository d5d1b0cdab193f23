//! Mistakes of the beam of a foundation.

use super::Checker;
use crate::model::file::entries::foundation::FoundationSpec;

impl Checker<'_> {
    /// Reports what a foundation cannot have.
    pub(super) fn check_foundation(&mut self, foundation: &FoundationSpec) {
        if let (Some(beam), Some([label, help])) =
            (self.document.beams.get(foundation.beam), self.unfit_along(foundation.beam))
        {
            let message = format!("foundation {} cannot support beam {}", foundation.name, beam.name);
            self.mistake(foundation.place, &message, label, help);
        }
        self.refuse_generalized_alpha(foundation.place, ["foundation", "foundations"], &foundation.name);
    }
}
