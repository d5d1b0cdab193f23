//! Rates of strains at an instant, for the viscous forces of the material in accelerations and reactions (MECHANICS 7.5).
//!
//! The velocities at the ends of midpoint steps do not give them: a strain that viscosity stops within far less than a step keeps turning its rate about there,
//! while its change over a step is right but for a little of the same. The rates at the last two starts of steps, each the mean of those over the steps around it, have
//! none of it; they are continued to the end of the last step.

use serde::{Deserialize, Serialize};

/// Rates of strains at the time of a state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ViscousRates {
    /// In the order of [`super::State::strain_rates`]; empty before the first step, and of systems without material damping.
    pub rates: Vec<f64>,
    /// The rates at the start of the last step, between those over it and over the step before.
    at_start: Vec<f64>,
    /// Length of the last step, s; 0 before the first step and behind a jump.
    step: f64,
}

impl ViscousRates {
    /// The rates, where there are any.
    pub fn known(&self) -> Option<&[f64]> {
        (!self.rates.is_empty()).then_some(&self.rates)
    }

    /// Forgets all: the motion begins.
    pub fn clear(&mut self) {
        self.rates.clear();
        self.at_start.clear();
        self.step = 0.0;
    }

    /// What acts has jumped: the rates over the next step do not continue those before.
    pub fn jump(&mut self) {
        self.step = 0.0;
    }

    /// Continues the rates to the end of a step of `step` s: `over` are those over this step, `before` those over the last one, `start` those of the velocities at its start.
    pub fn advance(&mut self, step: f64, over: &[f64], before: &[f64], start: &[f64]) {
        let last = std::mem::replace(&mut self.step, step);
        if self.rates.is_empty() {
            self.rates.extend(over.iter().zip(start).map(|(over, start)| 2.0 * over - start));
            self.at_start.extend_from_slice(start);
        } else if last == 0.0 {
            self.rates.copy_from_slice(over);
            self.at_start.copy_from_slice(over);
        } else {
            let (share, lead) = (step / (step + last), step / last);
            let rates = self.rates.iter_mut().zip(&mut self.at_start);
            for ((end, start), (over, before)) in rates.zip(over.iter().zip(before)) {
                let earlier = std::mem::replace(start, over + share * (before - over));
                *end = *start + lead * (*start - earlier);
            }
        }
    }

    /// Whether it may be one of a system with `rates` rates.
    pub fn is_possible(&self, rates: usize) -> bool {
        let lengths = [self.rates.len(), self.at_start.len()];
        (lengths == [0; 2] || lengths == [rates; 2]) && self.step.is_finite() && self.step >= 0.0
    }

    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.rates.clone_from(&other.rates);
        self.at_start.clone_from(&other.at_start);
        self.step = other.step;
    }
}
