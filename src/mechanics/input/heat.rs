//! Temperatures of beams, by which they expand and bend.

use serde::{Deserialize, Serialize};

/// Points of an element at which a temperature is known: as many on the axis as for gradients.
pub const POINTS: usize = 3;

/// The temperature of an element's sections at an instant, against the one at which they are as drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Heat {
    /// On the axis, at both ends and in the middle, K.
    pub temperature: [f64; POINTS],
    /// How it changes along y and z of the section, at the Gauss points, K/m.
    pub gradient: [[f64; 2]; POINTS],
}

impl Heat {
    /// The same along the whole element: a temperature (K) and its gradient (K/m).
    pub fn uniform(temperature: f64, gradient: [f64; 2]) -> Self {
        Self { temperature: [temperature; POINTS], gradient: [gradient; POINTS] }
    }

    /// At `share` (0 to 1) of the way from `start` to `end`.
    pub fn between(start: &Self, end: &Self, share: f64) -> Self {
        let part = |from: f64, to: f64| from + share * (to - from);
        Self {
            temperature: std::array::from_fn(|m| part(start.temperature[m], end.temperature[m])),
            gradient: std::array::from_fn(|g| [0, 1].map(|axis| part(start.gradient[g][axis], end.gradient[g][axis]))),
        }
    }
}
