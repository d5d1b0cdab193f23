//! Temperatures of beams, by which they expand and bend.

use super::signal::Signal;
use serde::{Deserialize, Serialize};

/// The temperature of a beam's sections at an instant, against the one at which they are as drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Heat {
    /// On the axis, K.
    pub temperature: f64,
    /// How it changes along y and z of the section, K/m.
    pub gradient: [f64; 2],
}

impl Heat {
    /// At `share` (0 to 1) of the way from `start` to `end`.
    pub fn between(start: &Self, end: &Self, share: f64) -> Self {
        let part = |from: f64, to: f64| from + share * (to - from);
        Self {
            temperature: part(start.temperature, end.temperature),
            gradient: [0, 1].map(|axis| part(start.gradient[axis], end.gradient[axis])),
        }
    }
}

/// The temperature of a beam as a function of time.
#[derive(Clone, Debug)]
pub struct HeatGuide {
    /// On the axis, K.
    pub temperature: Signal,
    /// Along y and z of the section, K/m.
    pub gradient: [Signal; 2],
}

impl HeatGuide {
    /// At `time`, s.
    pub fn at(&self, time: f64) -> Heat {
        Heat {
            temperature: self.temperature.at(time),
            gradient: self.gradient.each_ref().map(|signal| signal.at(time)),
        }
    }

    /// Its functions of time.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        [&self.temperature].into_iter().chain(&self.gradient)
    }
}
