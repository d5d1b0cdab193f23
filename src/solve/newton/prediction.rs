//! Where a midpoint step starts its iteration: at the increment that the last steps lead to.
//!
//! Three predictions compete: `Dq = h v`, with the mean acceleration of the last step `h v + h²/2 a`, and with that of
//! the last two continued, `h v + h²/2 (2 a − a')`. The one that would have predicted the last step best is taken: of a
//! smooth motion the last one, of a system that trembles the first.

use super::Convergence;
use crate::mechanics::state::{Prediction, Shrinking, State};
use crate::mechanics::system::System;

/// What an expected shrinking of corrections grows by with every step that does not measure it: one whose first
/// correction is round-off.
const AGING: f64 = 1.2;

/// Sets `increment` to the predicted change of the coordinates over `step` s from `state`.
pub fn predict(state: &State, step: f64, increment: &mut [f64]) {
    set_by(&state.velocity, &state.prediction, state.prediction.order, step, increment);
}

/// Turns the prediction of the converged step of `step` s by `increment` into that of the next step. `before` and
/// `after` are the velocities at the start and at the end of the step; `room` is scratch memory, as long as the
/// coordinates.
pub fn learn(
    system: &System,
    [before, after]: [&[f64]; 2],
    increment: &[f64],
    step: f64,
    convergence: &Convergence,
    (prediction, room): (&mut Prediction, &mut [f64]),
) {
    let known = prediction.known;
    let mut best = (f64::INFINITY, 0);
    for order in 0..=known {
        set_by(before, prediction, order, step, room);
        room.iter_mut().zip(increment).for_each(|(predicted, own)| *predicted -= own);
        let size = system.motion_size(room);
        if size < best.0 {
            best = (size, order);
        }
    }
    std::mem::swap(&mut prediction.acceleration, &mut prediction.acceleration_before);
    prediction.acceleration.clear();
    let change = after.iter().zip(before);
    prediction.acceleration.extend(change.map(|(after, before)| (after - before) / step));
    prediction.known = (known + 1).min(MOST_KNOWN);
    // Until both accelerations are known, whatever is known is used.
    prediction.order = if known < MOST_KNOWN { prediction.known } else { best.1 };
    prediction.shrinking = match convergence.corrections {
        [first, second, ..] if second > 0.0 => Shrinking { first, ratio: second / first.max(f64::MIN_POSITIVE) },
        _ => Shrinking { ratio: f64::min(1.0, AGING * prediction.shrinking.ratio), ..prediction.shrinking },
    };
}

/// How many accelerations are kept.
const MOST_KNOWN: u8 = 2;

/// Sets `increment` to the change of the coordinates over `step` s from the velocities `velocity`, by the `order` last
/// accelerations.
fn set_by(velocity: &[f64], prediction: &Prediction, order: u8, step: f64, increment: &mut [f64]) {
    let Prediction { acceleration, acceleration_before, .. } = prediction;
    for (increment, velocity) in increment.iter_mut().zip(velocity) {
        *increment = step * velocity;
    }
    let half = 0.5 * step * step;
    match order {
        0 => {}
        1 => increment.iter_mut().zip(acceleration).for_each(|(increment, a)| *increment += half * a),
        _ => {
            let accelerations = acceleration.iter().zip(acceleration_before);
            for (increment, (a, before)) in increment.iter_mut().zip(accelerations) {
                *increment += half * (2.0 * a - before);
            }
        }
    }
}
