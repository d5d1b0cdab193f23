//! What engages and releases a joint, a lock or a drive, by a function of time or by a host, and where it holds what it
//! has engaged (MECHANICS 7.10).

use super::signal::Signal;
use crate::mechanics::geometry::pose::Pose;
use serde::{Deserialize, Serialize};

/// A switch is engaged from this value on: comparisons in expressions give 0 or 1.
pub const ENGAGED: f64 = 0.5;

/// Where a switch has its value from.
#[derive(Clone, Debug)]
pub enum SwitchGuide {
    /// A function of time.
    Signal(Signal),
    /// A host gives it, from one communication point to the next.
    Host,
}

/// A switch.
#[derive(Clone, Debug)]
pub struct Switch {
    /// What it engages, and its name in the model file: `lock brake`.
    pub name: String,
    /// Where its value comes from.
    pub guide: SwitchGuide,
    /// A switch without which this one is released too: that of the joint which a lock or a drive acts on.
    pub within: Option<usize>,
}

/// What a switch does at an instant.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Hold {
    /// Whether it is engaged.
    pub is_engaged: bool,
    /// What a lock holds its coordinate at, or what a drive counts its value from; rad or m, 0 as drawn.
    pub value: f64,
    /// The pose of side b of a joint relative to side a when the joint engaged; as drawn they coincide.
    pub pose: Pose,
}

impl Switch {
    /// The function of time that its value is; none where a host gives it.
    pub fn signal(&self) -> Option<&Signal> {
        match &self.guide {
            SwitchGuide::Signal(signal) => Some(signal),
            SwitchGuide::Host => None,
        }
    }

    /// Whether it is engaged by itself at `time`, s, where a host gives `target`.
    pub fn is_on(&self, time: f64, target: f64) -> bool {
        let value = match &self.guide {
            SwitchGuide::Signal(signal) => signal.at(time),
            SwitchGuide::Host => target,
        };
        value >= ENGAGED
    }
}

impl Hold {
    /// As drawn.
    pub fn drawn(is_engaged: bool) -> Self {
        Self { is_engaged, value: 0.0, pose: Pose::default() }
    }
}
