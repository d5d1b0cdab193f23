//! Period and logarithmic decrement of a damped oscillation, read off its samples.

use std::f64::consts::TAU;

/// Mean period (s) and logarithmic decrement per period between the first and the last maximum of equally spaced
/// samples.
pub fn period_and_decrement(samples: &[f64], step: f64) -> (f64, f64) {
    let mut maxima = Vec::new();
    for (number, window) in samples.windows(3).enumerate() {
        let [before, here, after] = [window[0], window[1], window[2]];
        if here > 0.0 && here >= before && here > after {
            // The vertex of the parabola through three samples.
            let (slope, bend) = (0.5 * (after - before), after - 2.0 * here + before);
            maxima.push((step * ((number + 1) as f64 - slope / bend), here - 0.5 * slope * slope / bend));
        }
    }
    let (first, last) = (maxima[0], maxima[maxima.len() - 1]);
    let periods = (maxima.len() - 1) as f64;
    assert!(periods >= 2.0, "{maxima:?}");
    ((last.0 - first.0) / periods, (first.1 / last.1).ln() / periods)
}

/// What theory says of an oscillator of this circular frequency (rad/s) and damping ratio: period, s, and decrement.
pub fn theory(omega: f64, ratio: f64) -> (f64, f64) {
    let damped = (1.0 - ratio * ratio).sqrt();
    (TAU / (omega * damped), TAU * ratio / damped)
}
