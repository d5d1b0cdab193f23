//! The part of the velocities that no step resolves, in rates of strains (MECHANICS 7.6).
//!
//! The velocities at the start of a midpoint step make rates of strains that lead those over the step before by `d`. A smooth motion has a smooth `d`, part of which
//! is not a rate of any strain: the velocities of midpoint steps are off by `h²/12` of the jerk, those of drives and frames are exact, and where both meet, a rigid motion
//! seems to strain the beam. The part that no step resolves alternates from step to step. Differences of third order of `d` have all of that part, and of a motion of
//! the frequency `ω` the share `(h ω/2)³`.

use serde::{Deserialize, Serialize};

/// Order of the differences. With the second order the share of a smooth motion is 50 times as large where a step takes a 150th of a period.
const ORDER: usize = 3;
/// Weights of the differences, which are 1 for a lead that alternates: of the newest lead, and of those before.
const WEIGHTS: [f64; ORDER + 1] = [0.125, -0.375, 0.375, -0.125];

/// By how much the rates of strains that velocities make have led those over the step before, at the starts of the last steps.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RateLeads {
    /// The newest first, each in the order of [`super::State::strain_rates`]; empty before the first step of a motion and behind a switch.
    pub leads: [Vec<f64>; ORDER],
}

impl RateLeads {
    /// Forgets all leads: the motion begins, or its velocities have jumped.
    pub fn clear(&mut self) {
        self.leads.iter_mut().for_each(Vec::clear);
    }

    /// Sets `predicted` to the rates over the last step, `last`, with the alternating part of those that the velocities make now, `start`.
    pub fn predict(&self, last: &[f64], start: &[f64], predicted: &mut Vec<f64>) {
        predicted.clear();
        let [first, second, third] = &self.leads;
        if first.is_empty() {
            predicted.extend_from_slice(last);
            return;
        }
        let known = first.iter().zip(second).zip(third);
        predicted.extend(last.iter().zip(start).zip(known).map(|((last, start), ((first, second), third))| {
            let [now, one, two, three] = WEIGHTS;
            last + now * (start - last) + one * first + two * second + three * third
        }));
    }

    /// Takes the lead of the rates `start` over those of the step before, `last`, as the newest one.
    pub fn advance(&mut self, last: &[f64], start: &[f64]) {
        let lead = || start.iter().zip(last).map(|(start, last)| start - last);
        if self.leads[0].is_empty() {
            // As if it had always been so: nothing alternates.
            self.leads.iter_mut().for_each(|list| list.extend(lead()));
            return;
        }
        self.leads.rotate_right(1);
        self.leads[0].clear();
        self.leads[0].extend(lead());
    }

    /// Whether it may belong to a system with `rates` rates.
    pub fn is_possible(&self, rates: usize) -> bool {
        let lengths = self.leads.each_ref().map(Vec::len);
        lengths == [0; ORDER] || lengths == [rates; ORDER]
    }

    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.leads.iter_mut().zip(&other.leads).for_each(|(own, other)| own.clone_from(other));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is predicted beyond the rates over the last step, 0, where the velocities lead by `lead` at the start of step `number`, after eight steps.
    fn alternating(lead: impl Fn(usize) -> f64) -> f64 {
        let (mut leads, mut predicted) = (RateLeads::default(), Vec::new());
        for number in 0..8 {
            leads.advance(&[0.0], &[lead(number)]);
        }
        leads.predict(&[0.0], &[lead(8)], &mut predicted);
        predicted[0]
    }

    /// Leads that grow as the square of time have no alternating part: their differences of third order vanish but for round-off of 64 squares.
    #[test]
    fn smooth_leads_are_not_predicted() {
        let found = alternating(|number| 3.0 + (number as f64).powi(2));
        assert!(found.abs() < 1e-13, "{found}");
    }

    /// A lead that alternates is predicted whole.
    #[test]
    fn alternating_leads_are_predicted() {
        assert_eq!(alternating(|number| if number % 2 == 0 { 1.0 } else { -1.0 }), 1.0);
    }

    /// Nothing is known before the first step, and at the first one a lead is taken for one that has always been there.
    #[test]
    fn first_leads_are_not_predicted() {
        let (mut leads, mut predicted) = (RateLeads::default(), Vec::new());
        leads.predict(&[2.0], &[5.0], &mut predicted);
        assert_eq!(predicted, [2.0]);
        leads.advance(&[2.0], &[5.0]);
        leads.predict(&[2.0], &[5.0], &mut predicted);
        assert_eq!(predicted, [2.0]);
    }
}
