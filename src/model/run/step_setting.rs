//! The setting of a model file that the lengths of the steps of a run follow from: warnings name it with its number.

use crate::model::file::entries::simulation::FINEST_ACCURACY;

/// The setting that the lengths of the steps follow from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Setting {
    /// Their length, s.
    Step(f64),
    /// The accuracy asked for.
    Accuracy(f64),
    /// The longest of the steps that their errors do not bound, s: a smaller accuracy would not shorten these.
    Longest(f64),
}

impl Setting {
    /// Its value for an error that is `factor` times as large, in words. Errors grow as the square of the
    /// steps, and as the accuracy.
    pub fn proposed(self, factor: f64) -> String {
        match self {
            Self::Step(step) | Self::Longest(step) => format!("{}: {:.1e} s", self.name(), step * factor.sqrt()),
            Self::Accuracy(accuracy) => {
                format!("{}: {:.1e}", self.name(), (accuracy * factor).max(FINEST_ACCURACY))
            }
        }
    }

    /// Its key in the model file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Step(_) => "simulation.step",
            Self::Accuracy(_) => "simulation.accuracy",
            Self::Longest(_) => "simulation.longest_step in the model file",
        }
    }
}
