//! Rates of strains at an instant, for the viscous forces of the material in accelerations and reactions (MECHANICS
//! 7.5).
//!
//! The velocities at the ends of midpoint steps do not give them: a strain that viscosity stops within far less than a
//! step keeps turning its rate about there, while its change over a step is right but for a little of the same. The
//! rates at the last two starts of steps, each the mean of those over the steps around it, have none of it; they are
//! continued to the end of the last step.

use super::State;
use super::lists::Lists;

/// Forgets all rates: the motion begins.
pub fn clear(state: &mut State) {
    state.lists.viscous_rates.clear();
    state.lists.viscous_rates_at_start.clear();
    state.viscous_step = 0.0;
}

/// What acts has jumped: the rates over the next step do not continue those before.
pub fn jump(state: &mut State) {
    state.viscous_step = 0.0;
}

/// Continues the rates to the end of a step of `step` s: `state.strain_rates` are those over this step, `before` those
/// over the last one, `start` those of the velocities at its start.
pub fn advance(state: &mut State, step: f64, before: &[f64], start: &[f64]) {
    let last = std::mem::replace(&mut state.viscous_step, step);
    let Lists { strain_rates: over, viscous_rates: rates, viscous_rates_at_start: at_start, .. } = &mut state.lists;
    if rates.is_empty() {
        rates.extend(over.iter().zip(start).map(|(over, start)| 2.0 * over - start));
        at_start.extend_from_slice(start);
    } else if last == 0.0 {
        rates.copy_from_slice(over);
        at_start.copy_from_slice(over);
    } else {
        let (share, lead) = (step / (step + last), step / last);
        let rates = rates.iter_mut().zip(at_start);
        for ((end, start), (over, before)) in rates.zip(over.iter().zip(before)) {
            let earlier = std::mem::replace(start, over + share * (before - over));
            *end = *start + lead * (*start - earlier);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of unequal lengths, each with the mean of `rate` over it; the rate at the end of the last one, and where
    /// that is.
    fn after(steps: &[f64], rate: impl Fn(f64) -> f64) -> (f64, f64) {
        let (mut state, mut time, mut before) = (State::default(), 0.0, 0.0);
        for step in steps {
            // Linear rates have their mean in the middle.
            let over = rate(time + 0.5 * step);
            state.lists.strain_rates = vec![over];
            advance(&mut state, *step, &[before], &[rate(0.0)]);
            (before, time) = (over, time + step);
        }
        (state.lists.viscous_rates[0], time)
    }

    /// A rate that grows linearly is continued to the end of every step, whatever the lengths of the steps are: also of
    /// the first and the second one.
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
        let mut state = State::default();
        let mut over = 1.0;
        for number in 0..6 {
            state.lists.strain_rates = vec![over];
            advance(&mut state, 0.1, &[-over], &[0.0]);
            let rate = state.lists.viscous_rates[0];
            assert!(number < 2 || rate.abs() < 1e-15, "after step {}: {rate}", number + 1);
            over = -over;
        }
    }

    /// Behind a jump the rate is that over the step, which no step before continues.
    #[test]
    fn jumps_are_not_continued() {
        let mut state = State::default();
        state.lists.strain_rates = vec![1.0];
        advance(&mut state, 0.1, &[0.0], &[1.0]);
        jump(&mut state);
        state.lists.strain_rates = vec![5.0];
        advance(&mut state, 0.1, &[1.0], &[1.0]);
        assert_eq!(state.known_viscous_rates(), Some(&[5.0][..]));
        clear(&mut state);
        assert_eq!(state.known_viscous_rates(), None);
    }
}
