//! Whether beams bear thrust that would buckle them, and stay straight because nothing bends them at all.

use crate::error::decimal;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::entries::simulation::Analysis;
use serde::{Deserialize, Serialize};

/// Growth of a bow, as an exponent, that no real beam is straight enough for: a bow of 1/1000 has grown to the beam's
/// own size.
const MOST_GROWTH: f64 = 7.0;

/// What has been seen of straight beams under thrust.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StrutWatch {
    /// Equilibria have their own word for what buckles.
    is_static: bool,
    /// Time of the last look, s; none: there was none.
    time: Option<f64>,
    /// Growth of a bow of each beam since the thrust began, as an exponent.
    growths: Vec<f64>,
    warned: bool,
}

impl StrutWatch {
    /// Watches a run of this analysis.
    pub fn new(analysis: Analysis) -> Self {
        Self { is_static: analysis == Analysis::Static, ..Self::default() }
    }

    /// Looks at a new state, and warns of a beam that would have buckled.
    pub fn look(&mut self, system: &System, state: &State, frames: &mut FrameCache) -> Option<String> {
        if self.is_static || self.warned {
            return None;
        }
        let now = state.instant();
        let passed = now - self.time.replace(now).unwrap_or(now);
        self.growths.resize(system.beams.len(), 0.0);
        let c = frames.of(system, state);
        for (number, growth) in self.growths.iter_mut().enumerate() {
            let thrust = system.straight_thrust(number, state, &c);
            let Some(thrust) = thrust.filter(|thrust| thrust.force > 2.0 * thrust.critical) else {
                *growth = 0.0;
                continue;
            };
            *growth += passed * thrust.rate;
            if *growth > MOST_GROWTH {
                self.warned = true;
                return Some(format!(
                    "beam {} stays straight under a compression of {:.3e} N at t = {} s, {:.1} times the load that \
                     buckles it: nothing bends a perfectly straight beam, and a real one \
                     buckles within {:.1e} s. Draw it with a slight bow, add a small load from the side, or model a \
                     line that only pulls as a spring with only = \"tension\"",
                    system.beams[number].name,
                    thrust.force,
                    decimal(now),
                    thrust.force / thrust.critical,
                    MOST_GROWTH / thrust.rate
                ));
            }
        }
        None
    }
}
