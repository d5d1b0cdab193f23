//! A fluid: its density, the surface that it ends at, and its motion.

use super::flow::{Flow, Seen};
use super::waves::Waves;
use crate::math::Vec3;
use std::fmt;
use std::sync::Arc;

/// Which side of the surface a fluid fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// That below it: water.
    Below,
    /// That above it: air.
    Above,
}

impl Side {
    /// The sign of heights above the surface by which this side counts as that below it.
    pub fn sign(self) -> f64 {
        match self {
            Self::Below => 1.0,
            Self::Above => -1.0,
        }
    }
}

/// A fluid.
#[derive(Clone, Debug)]
pub struct Medium {
    /// Which side of the surface it fills.
    pub side: Side,
    /// Density, kg/m³.
    pub density: f64,
    /// Height of still water, global, m; negatively infinite without water.
    pub surface: f64,
    /// Depth of the water, m; none: without end.
    pub depth: Option<f64>,
    /// Rise of the bottom per length along x and along y, from the depth at the origin.
    pub slope: [f64; 2],
    /// The flow without waves.
    pub current: Current,
    /// The waves.
    pub waves: Waves,
    /// Time in which current and waves grow, s.
    pub ramp: f64,
    /// Where positions in the state begin, global, m.
    pub origin: Vec3,
}

/// A flow that depends on the height and on time.
#[derive(Clone)]
pub enum Current {
    /// The same everywhere, m/s.
    Uniform(Vec3),
    /// A function of the global height, m, and the time, s.
    Profile(Arc<Profile>),
}

/// Velocity by the global height, m, and the time, s; m/s.
pub type Profile = dyn Fn(f64, f64) -> Vec3 + Send + Sync;

impl fmt::Debug for Current {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Current").field(&self.at(0.0, 0.0)).finish()
    }
}

impl Current {
    /// The velocity at the global height `z`, m, and the time `time`, s.
    pub fn at(&self, z: f64, time: f64) -> Vec3 {
        match self {
            Self::Uniform(velocity) => *velocity,
            Self::Profile(profile) => profile(z, time),
        }
    }
}

impl Medium {
    /// Whether the fluid moves by itself.
    pub fn moves(&self) -> bool {
        self.has_waves() || !matches!(self.current, Current::Uniform(velocity) if velocity == Vec3::zeros())
    }

    /// Whether it has waves.
    pub fn has_waves(&self) -> bool {
        !self.waves.components.is_empty()
    }

    /// Share of the current and of the waves at `time`, s: `s³ (6 s² − 15 s + 10)` of the time over the ramp.
    pub fn share(&self, time: f64) -> f64 {
        if time >= self.ramp {
            return 1.0;
        }
        let s = (time / self.ramp).max(0.0);
        s * s * s * (6.0 * s * s - 15.0 * s + 10.0)
    }

    /// The fluid at `position`, of the state, and `time`, s, without waves.
    pub fn still(&self, position: &Vec3, time: f64) -> Seen {
        let velocity = self.current.at(position.z + self.origin.z, time) * self.share(time);
        Seen { flow: Flow { velocity, acceleration: Vec3::zeros() }, height: self.surface - self.origin.z }
    }

    /// The fluid at `position`, of the state, and `time`, s.
    pub fn seen(&self, position: &Vec3, time: f64) -> Seen {
        let mut seen = self.still(position, time);
        if self.has_waves() {
            let [x, y, z] = (position + self.origin).into();
            let share = self.share(time);
            let elevation = share * self.waves.elevation(x, y, time);
            let waves = self.waves.flow([x, y, z - self.surface], time, self.depth, elevation);
            seen.flow.velocity += waves.velocity * share;
            seen.flow.acceleration += waves.acceleration * share;
            seen.height += elevation;
        }
        seen
    }

    /// The motion at `position`, of the state, and `time`, s.
    pub fn flow(&self, position: &Vec3, time: f64) -> Flow {
        self.seen(position, time).flow
    }

    /// The height of the bottom below `position`, of the state; of the state, m. None: the water has none.
    pub fn bottom(&self, position: &Vec3) -> Option<f64> {
        let [x, y, _] = (position + self.origin).into();
        let rise = self.slope[0] * x + self.slope[1] * y;
        Some(self.surface - self.depth? + rise - self.origin.z)
    }

    /// The height of the surface over or under `position`, of the state, at `time`, s; of the state, m.
    pub fn height(&self, position: &Vec3, time: f64) -> f64 {
        let still = self.surface - self.origin.z;
        if !self.has_waves() {
            return still;
        }
        let [x, y, _] = (position + self.origin).into();
        still + self.share(time) * self.waves.elevation(x, y, time)
    }
}
