//! Whether stops are stiff enough for what hits them.

use crate::error::decimal;
use crate::mechanics::force::law::Law;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use serde::{Deserialize, Serialize};

/// A penetration beyond this is a motion of its own: of an angle, rad, and of a distance as a share of the mechanism's
/// size. A longer way between both limits is compared with instead.
const DEEP_ANGLE: f64 = 0.5;
const DEEP_SHARE: f64 = 0.25;

/// What has been seen of stops.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StopWatch {
    warned: bool,
}

impl StopWatch {
    /// Looks at a new state, and warns of a stop that is penetrated further than the way that it leaves.
    pub fn look(&mut self, system: &System, state: &State) -> Option<String> {
        if self.warned {
            return None;
        }
        let found = system.springs.iter().find_map(|spring| {
            let Some(Law::Stop { limits: [lower, upper], .. }) = &spring.law else { return None };
            let value = state.relative_values[spring.coordinate];
            let depth = (lower - value).max(value - upper);
            let is_angle = matches!(system.relative_coordinates[spring.coordinate].measure, Measure::Angle(_));
            let (deep, unit) = if is_angle { (DEEP_ANGLE, "rad") } else { (DEEP_SHARE * system.size, "m") };
            let way = upper - lower;
            let most = if way.is_finite() { deep.max(way) } else { deep };
            (depth > most).then_some((&spring.name, depth, unit))
        });
        let (name, depth, unit) = found?;
        self.warned = true;
        Some(format!(
            "stop {name} is penetrated by {depth:.3} {unit} at t = {} s: it is too soft to stop what hits it; raise {name}.stiffness, or check the mass and the speed of \
             what hits it",
            decimal(state.instant())
        ))
    }
}
