//! Steps as long as an asked accuracy allows (MECHANICS 7.9).
//!
//! A step is as long as its own error allows, which is a share of the accuracy times the range of the motion so far: of
//! a few periods of an oscillation the errors add up to about the accuracy, of many periods to more, which the estimate
//! of the run tells. A step whose error is too large is taken again, shorter.

use super::integrator::Integrator;
use super::tally::End;
use crate::error::Error;
use crate::math::elementary::cbrt;
use crate::math::resolution::Sight;
use crate::mechanics::state::State;
use crate::mechanics::state::pace::Pace;
use crate::mechanics::system::{AT_BREAK, System};

/// First step, as a share of the duration.
const FIRST: f64 = 1e-6;
/// The steps grow by at most this factor; and while little is known of the motion, or their errors are this small a
/// share of those allowed.
const GROWTH: f64 = 1.5;
const FIRST_GROWTH: f64 = 4.0;
const SMALL: f64 = 0.05;
/// What a step is shortened by at most when its error is too large.
const SHRINKING: f64 = 0.2;
/// Error over that allowed which a step aims at, and from which it is taken again.
const AIM: f64 = 0.7;
const TOO_LARGE: f64 = 2.0;
/// Share of the largest turn of a step that a step aims at, at most.
const NEAR_LIMIT: f64 = 0.9;
/// What of the error of the last step counts for the next one at least.
const MEMORY: f64 = 0.9;
/// Share of the whole error that a step may have, over its share of the duration: where the third derivative of an
/// oscillation passes through zero the steps become longer, and the error of the motion half as much again.
const EVEN_SHARE: f64 = 0.5;
/// Share of the whole error that every step may have, however short it is, over the root of the accuracy: oscillations
/// of less than this do not shorten steps. The root makes the error of the motion, of second order in the steps, follow
/// the accuracy, where that of a step is of third order. 5e-4 of the whole error with the default accuracy.
const LEAST_SHARE: f64 = 0.015;
/// Steps shorter than one of so many in the duration may have a larger share, by the square of how much shorter they
/// are, up to this one: vibrations that are fast for the whole motion then hold steps up less, and are passed over
/// where they are small.
const MANY_STEPS: f64 = 20_000.0;
const SHORT_SHARE: f64 = 0.02;
/// Where the results are expected to be off by less than the first share of the accuracy at the end, the errors of
/// steps may be larger, up to so many times; beyond the second share they become smaller again, by the same factor.
const EASED: [f64; 2] = [0.1, 0.3];
const MOST_EASED: f64 = 30.0;
const EASE: f64 = 2.0;
/// Share of the duration between two such judgments.
const BETWEEN: f64 = 0.01;
/// Ranges so far are at least this, of the system's size or rad.
const LEAST_RANGE: f64 = 1e-4;
/// The same at a start, and after which share of the duration that has faded.
const STARTING_RANGE: f64 = 1e-2;
const STARTING: f64 = 0.02;
/// What the steps start anew with behind a jump.
const JUMP: f64 = 0.1;
/// What the length that the dissipation is for becomes shorter by in a step.
const FADING: f64 = 0.9;
/// How much longer than wanted a step may be to end where it has to, and the share of that below which it ended early.
const STRETCH: f64 = 1.1;
const ENDED_EARLY: f64 = 0.9;
/// The same over the longest step that is asked for: round-off of its digits and of the ends of steps.
const BEYOND: f64 = 1.0 + 1e-6;
/// Shortest and longest step, as shares of the duration: a system at rest does not step over what happens to it.
const SHORTEST: f64 = 1e-12;
const LONGEST: f64 = 0.02;
/// Shortest step as a share of the time itself: ends of steps are rounded.
const TIME_ROUNDING: f64 = 64.0 * f64::EPSILON;

/// How steps are chosen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pacing {
    /// Error of the positions, slopes and angles that the whole motion may have because of its steps, as a share of its
    /// range.
    pub accuracy: f64,
    /// Length of the motion, s.
    pub duration: f64,
    /// Longest step that may be chosen, s.
    pub longest: f64,
    /// The steps follow a given course: none is refused because of its error.
    pub is_given: bool,
}

impl Pacing {
    /// The error of a step of `step` s from `time`, `error` of positions over the system's size and of slopes and
    /// angles, over that allowed.
    fn ratio(self, pace: &Pace, error: [f64; 2], step: f64, time: f64) -> f64 {
        let Self { accuracy, duration, .. } = self;
        let fading = (1.0 - (time - pace.since) / (STARTING * duration)).max(0.0);
        let least_range = LEAST_RANGE.max(STARTING_RANGE * fading);
        // Shares of the duration, of the step and of one that is short.
        let (own, short) = ((step / duration).min(1.0), 1.0 / MANY_STEPS);
        let least = LEAST_SHARE * accuracy.sqrt();
        let least = f64::max(least, f64::min(least * (short / own).powi(2), SHORT_SHARE));
        let share = (EVEN_SHARE * own).max(least) * (1.0 + pace.ease);
        if error.iter().any(|error| !error.is_finite()) {
            return f64::INFINITY;
        }
        let ratios =
            error.iter().zip(pace.range).map(|(error, range)| error / (accuracy * share * range.max(least_range)));
        ratios.fold(0.0, f64::max)
    }

    /// Whether [`Self::ease`] is to be called at `time`.
    pub fn is_due(self, pace: &Pace, time: f64) -> bool {
        !self.is_given && time - pace.since >= STARTING * self.duration && time - pace.judged >= BETWEEN * self.duration
    }

    /// Lets the steps of a motion have larger errors while its results, off by `error` as a share of their ranges, are
    /// far more exact than asked for, and takes that back where they are not: `time` is now.
    pub fn ease(self, pace: &mut Pace, error: f64, time: f64) {
        pace.judged = time;
        // Errors grow as the time at least.
        let expected = error / ((time - pace.since) / self.duration).min(1.0) / self.accuracy;
        let most = 1.0 + pace.ease;
        pace.ease = match expected {
            // Steps that other limits hold ask for nothing.
            low if low < EASED[0] && pace.ratio > SMALL => f64::min(EASE * most, MOST_EASED) - 1.0,
            high if high > EASED[1] => f64::max(most / EASE, 1.0) - 1.0,
            _ => pace.ease,
        };
    }

    /// Refuses a step whose error is too large, unless it was given; otherwise remembers it in `pace`.
    ///
    /// # Errors
    /// It is too large.
    pub fn judge(self, pace: &mut Pace, error: Option<[f64; 2]>, step: f64, time: f64) -> Result<(), Error> {
        let ratio = error.map_or(0.0, |error| self.ratio(pace, error, step, time));
        if ratio > TOO_LARGE && !self.is_given {
            return Err(Error::Inexact { time, step, ratio });
        }
        pace.damping_step = f64::max(FADING * pace.damping_step, step);
        if error.is_some() {
            // The error of an oscillation passes through zero twice a period: steps that followed it would be longest
            // there, and the error of the motion be more.
            let before = pace.ratio;
            pace.ratio = f64::max(ratio, MEMORY * before);
            let most = if before > 0.0 && pace.ratio > SMALL { GROWTH } else { FIRST_GROWTH };
            let wanted = step * cbrt(AIM / pace.ratio).clamp(SHRINKING, most);
            // A step that had to end early asks for no shorter ones.
            let ended_early = step < ENDED_EARLY * pace.wanted && ratio < 1.0;
            pace.wanted = if ended_early { wanted.max(pace.wanted) } else { wanted };
        }
        if pace.turned > 0.0 {
            pace.wanted = pace.wanted.min(NEAR_LIMIT / pace.turned * step);
        }
        Ok(())
    }

    /// Adds the way of an accepted step to the motion so far.
    pub fn include(self, system: &System, increment: &[f64], pace: &mut Pace) {
        pace.travel.resize(increment.len(), 0.0);
        pace.travel.iter_mut().zip(increment).for_each(|(travel, increment)| *travel += increment);
        for (range, size) in pace.range.iter_mut().zip(system.motion_sizes(&pace.travel)) {
            *range = range.max(size);
        }
    }

    /// Begins anew at `state`, where what acts jumps: what is known of the motion before does not hold behind it.
    pub fn jump(self, state: &mut State) {
        let State { pace, time_error, .. } = state;
        time_error.known = 0;
        pace.wanted *= JUMP;
        pace.ratio = 0.0;
        pace.ease = 0.0;
    }

    /// Takes `state` one step on in an interval from `begin` to `end`, s; returns whether the end is reached. Breaks on
    /// the way end a step.
    ///
    /// # Errors
    /// The shortest step fails; `state` is where the last good one ended.
    pub fn advance(
        self,
        integrator: &mut impl Integrator,
        system: &System,
        state: &mut State,
        [begin, end]: [f64; 2],
    ) -> Result<bool, Error> {
        let shortest = f64::max(SHORTEST * self.duration, TIME_ROUNDING * begin.abs().max(end.abs()));
        if state.pace.wanted == 0.0 {
            state.pace.wanted = shortest.max(FIRST * self.duration);
            state.pace.since = state.time;
        }
        while state.time < end {
            let margin = AT_BREAK * self.next_step(state).min(end - state.time);
            integrator.switch(system, state, state.time + margin)?;
            let wanted = self.next_step(state);
            let boundary = system.break_between(state.time, end, margin).unwrap_or(end);
            // Two steps ahead: none of them is to be a short rest.
            let ahead = boundary.min(state.time + 2.0 * STRETCH * wanted);
            let boundary = system.switch_between(state.time, ahead, margin).unwrap_or(boundary);
            let remaining = boundary - state.time;
            let count = self.count(remaining, wanted);
            let step = remaining / count;
            let step_end = if count == 1.0 { boundary } else { state.time + step };
            let sight = if step_end == boundary && boundary < end { Sight::Changes } else { Sight::Pulses };
            let seen_end = system.seen_until(state.time, step_end, sight);
            let is_cut = seen_end < step_end;
            let (step, step_end) = if is_cut { (seen_end - state.time, seen_end) } else { (step, step_end) };
            if is_cut {
                // The dissipation for longer steps would hold back what a pulse moves.
                state.pace.damping_step = state.pace.damping_step.min(step);
            }
            let Err(reason) = integrator.step(system, state, step, step_end) else {
                if let Some(tally) = integrator.tally() {
                    let changes = is_cut || step_end == boundary && boundary < end;
                    tally.count(
                        &state.pace,
                        if changes {
                            End::Change
                        } else if step_end == end {
                            End::Row
                        } else {
                            End::Own
                        },
                    );
                }
                break;
            };
            state.statistics.rejected += 1;
            let shorter = match reason {
                Error::Inexact { ratio, .. } => cbrt(AIM / ratio).max(SHRINKING),
                Error::Turned { angle, limit, .. } if angle > limit => (NEAR_LIMIT * limit / angle).max(SHRINKING),
                _ => 0.5,
            };
            state.pace.wanted = shorter * step;
            if shorter * step < shortest {
                return Err(Error::NoShorterStep { time: state.time, step, reason: Box::new(reason) });
            }
        }
        // Results show what holds from this instant on.
        integrator.switch(system, state, state.time + AT_BREAK * shortest)?;
        Ok(state.time >= end)
    }

    /// Number of equal steps, each about `wanted` s long, that fill a `way`, s.
    pub fn count(self, way: f64, wanted: f64) -> f64 {
        let fewest = way / (BEYOND * self.longest);
        (way / (STRETCH * wanted)).max(fewest).ceil().max(1.0)
    }

    /// Length of the next step unless it ends earlier, s.
    fn next_step(self, state: &State) -> f64 {
        state.pace.wanted.min(self.longest_of_all())
    }

    /// The longest step that is ever wanted, s.
    pub fn longest_of_all(self) -> f64 {
        self.longest.min(LONGEST * self.duration)
    }
}
