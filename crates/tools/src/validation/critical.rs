//! Critical loads: where the lowest eigenvalue of the stiffness passes zero on a static path.

use ancf14::fmi::Model;
use ancf14_testing::curves::load;

/// Iterations of the regula falsi at most; ten are usual.
const MOST_ITERATIONS: u32 = 60;
/// The last two times are nearer than this, s: the line through both has the square of it as its error. Nearer still
/// the equilibrium would not be unique to round-off.
const NEAR: f64 = 1e-4;

/// The time between `before` and `after` (s) at which the equilibrium of the model becomes unstable.
///
/// # Panics
/// It is not stable before, or stable after.
pub fn time(text: &str, overrides: &[(&str, &str)], [before, after]: [f64; 2]) -> f64 {
    let mut simulation = load(text, overrides);
    let steps = (before / simulation.about().output_step).round().max(1.0);
    for step in 1..=steps as u32 {
        simulation.advance(before * f64::from(step) / steps).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    let begin = simulation.snapshot();
    let mut lowest = |time: f64| {
        simulation.restore(&begin);
        if time > before {
            simulation.advance(time).unwrap_or_else(|failure| panic!("{}", failure.message));
        }
        simulation.modes(1).unwrap_or_else(|failure| panic!("{}", failure.message)).modes[0].eigenvalue
    };
    // Illinois: the end that stays counts half.
    let (mut low, mut high) = ((before, lowest(before)), (after, lowest(after)));
    assert!(low.1 > 0.0 && high.1 < 0.0, "{low:?} {high:?}");
    let (mut last, mut near) = (0.0, before);
    for _ in 0..MOST_ITERATIONS {
        let time = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
        if (time - near).abs() < NEAR {
            return time;
        }
        near = time;
        let value = lowest(time);
        if value > 0.0 {
            low = (time, value);
            if last > 0.0 {
                high.1 *= 0.5;
            }
        } else {
            high = (time, value);
            if last < 0.0 {
                low.1 *= 0.5;
            }
        }
        last = value;
    }
    panic!("no critical time between {low:?} and {high:?}");
}
