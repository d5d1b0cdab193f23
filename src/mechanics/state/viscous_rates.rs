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
    pub at_start: Vec<f64>,
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of unequal lengths, each with the mean of `rate` over it; the rate at the end of the last one, and where that is.
    fn after(steps: &[f64], rate: impl Fn(f64) -> f64) -> (f64, f64) {
        let (mut rates, mut time, mut before) = (ViscousRates::default(), 0.0, 0.0);
        for step in steps {
            // Linear rates have their mean in the middle.
            let over = rate(time + 0.5 * step);
            rates.advance(*step, &[over], &[before], &[rate(0.0)]);
            (before, time) = (over, time + step);
        }
        (rates.rates[0], time)
    }

    /// A rate that grows linearly is continued to the end of every step, whatever the lengths of the steps are: also of the first and the second one.
    #[test]
    fn linear_rates_are_exact() {
        let steps = [0.1, 0.3, 0.05, 0.2];
        for number in 1..=steps.len() {
            let (found, time) = after(&steps[..number], |time| 2.0 + 3.0 * time);
            assert!((found - (2.0 + 3.0 * time)).abs() < 1e-13, "after {number} steps: {found} at {time} s");
        }
    }

    /// With equal steps nothing of a rate that alternates from step to step is left from the third step on.
    #[test]
    fn alternating_rates_vanish() {
        let mut rates = ViscousRates::default();
        let mut over = 1.0;
        for number in 0..6 {
            rates.advance(0.1, &[over], &[-over], &[0.0]);
            assert!(number < 2 || rates.rates[0].abs() < 1e-15, "after step {}: {}", number + 1, rates.rates[0]);
            over = -over;
        }
    }

    /// Behind a jump the rate is that over the step, which no step before continues.
    #[test]
    fn jumps_are_not_continued() {
        let mut rates = ViscousRates::default();
        rates.advance(0.1, &[1.0], &[0.0], &[1.0]);
        rates.jump();
        rates.advance(0.1, &[5.0], &[1.0], &[1.0]);
        assert_eq!(rates.known(), Some(&[5.0][..]));
        rates.clear();
        assert_eq!(rates.known(), None);
    }
}
