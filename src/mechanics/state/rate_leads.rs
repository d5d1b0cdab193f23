//! The part of the velocities that no step resolves, in rates of strains (MECHANICS 7.6).
//!
//! The velocities at the start of a midpoint step make rates of strains that lead those over the step before by `d`. A
//! smooth motion has a smooth `d`, part of which is not a rate of any strain: the velocities of midpoint steps are off
//! by `h²/12` of the jerk, those of drives and frames are exact, and where both meet, a rigid motion seems to strain
//! the beam. The part that no step resolves alternates from step to step. Differences of third order of `d` have all of
//! that part, and of a motion of the frequency `ω` the share `(h ω/2)³`.

use super::lists::Lists;

/// Weights of the differences of third order, which are 1 for a lead that alternates: of the newest lead, and of those
/// before. With the second order the share of a smooth motion is 50 times as large where a step takes a 150th of a
/// period.
const WEIGHTS: [f64; 4] = [0.125, -0.375, 0.375, -0.125];

/// Forgets all leads: the motion begins, or its velocities have jumped.
pub fn clear(lists: &mut Lists) {
    lists.leads_mut().into_iter().for_each(Vec::clear);
}

/// Sets `predicted` to the rates over the last step with the alternating part of those that the velocities make now,
/// `start`.
pub fn predict(lists: &Lists, start: &[f64], predicted: &mut Vec<f64>) {
    let last = &lists.strain_rates;
    predicted.clear();
    let [first, second, third] = lists.leads();
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
pub fn advance(lists: &mut Lists, last: &[f64], start: &[f64]) {
    let lead = || start.iter().zip(last).map(|(start, last)| start - last);
    let [newest, older, oldest] = lists.leads_mut();
    if newest.is_empty() {
        // As if it had always been so: nothing alternates.
        [newest, older, oldest].into_iter().for_each(|list| list.extend(lead()));
        return;
    }
    std::mem::swap(older, oldest);
    std::mem::swap(newest, older);
    newest.clear();
    newest.extend(lead());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn still() -> Lists {
        Lists { strain_rates: vec![0.0], ..Lists::default() }
    }

    /// What is predicted beyond the rates over the last step, 0, where the velocities lead by `lead` at the start of
    /// step `number`, after eight steps.
    fn alternating(lead: impl Fn(usize) -> f64) -> f64 {
        let (mut lists, mut predicted) = (still(), Vec::new());
        for number in 0..8 {
            advance(&mut lists, &[0.0], &[lead(number)]);
        }
        predict(&lists, &[lead(8)], &mut predicted);
        predicted[0]
    }

    /// Leads that grow as the square of time have no alternating part: their differences of third order vanish but for
    /// round-off of 64 squares.
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
        let (mut lists, mut predicted) = (Lists { strain_rates: vec![2.0], ..Lists::default() }, Vec::new());
        predict(&lists, &[5.0], &mut predicted);
        assert_eq!(predicted, [2.0]);
        advance(&mut lists, &[2.0], &[5.0]);
        predict(&lists, &[5.0], &mut predicted);
        assert_eq!(predicted, [2.0]);
    }
}
