//! What acts from outside at one instant: gravity, the components of loads and the efforts of actuators, by functions
//! of time or by a host.

use crate::math::Vec3;
use crate::mechanics::fluid::flow::Seen;
use serde::{Deserialize, Serialize};

/// Components of a load at one instant, in the load's own axes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Wrench {
    /// Force, N, or N/m along a beam.
    pub force: Vec3,
    /// Moment, N m, or N along a beam.
    pub moment: Vec3,
}

impl Wrench {
    /// Whether all components are numbers.
    pub fn is_finite(&self) -> bool {
        self.force.iter().chain(&self.moment).all(|value| value.is_finite())
    }
}

/// Components of a load that a host gives: held from the time it gave them, or linear in time from there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HostWrench {
    /// Components at `since`.
    pub value: Wrench,
    /// Their derivatives by time, 1/s of their units.
    pub rate: Wrench,
    /// When they were given, s.
    pub since: f64,
}

impl HostWrench {
    /// The components at `time`, s.
    pub fn at(&self, time: f64) -> Wrench {
        let passed = time - self.since;
        Wrench {
            force: self.value.force + self.rate.force * passed,
            moment: self.value.moment + self.rate.moment * passed,
        }
    }
}

/// An effort that a host gives: held from the time it gave it, or linear in time from there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct HostEffort {
    /// Effort at `since`, N m or N.
    pub value: f64,
    /// Its derivative by time, 1/s of its unit.
    pub rate: f64,
    /// When it was given, s.
    pub since: f64,
}

impl HostEffort {
    /// The effort at `time`, s.
    pub fn at(&self, time: f64) -> f64 {
        self.value + self.rate * (time - self.since)
    }
}

/// What acts on a system from outside at one instant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Excitation {
    /// The instant, s.
    pub time: f64,
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// Components of the loads, in their order.
    pub wrenches: Vec<Wrench>,
    /// Stations of the loads, in their order, fractions of the lengths of beams; 0 of those that do not move along one.
    pub stations: Vec<f64>,
    /// Efforts of the actuators, in their order, N m or N; of those that follow coordinates the share that acts.
    pub efforts: Vec<f64>,
    /// Share of the drag of fluids that acts, 0 to 1; their buoyancy follows gravity.
    pub drag: f64,
    /// The water at four points of each element in it, where a step looks at it once; empty: it is looked at where the
    /// elements are.
    pub seen: Vec<[Seen; 4]>,
}

impl Excitation {
    /// Components and station of each load, in their order.
    pub fn loads(&self) -> impl Iterator<Item = (&Wrench, f64)> {
        self.wrenches.iter().zip(self.stations.iter().copied())
    }

    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        (self.time, self.gravity, self.drag) = (other.time, other.gravity, other.drag);
        self.wrenches.clone_from(&other.wrenches);
        self.stations.clone_from(&other.stations);
        self.efforts.clone_from(&other.efforts);
        self.seen.clone_from(&other.seen);
    }

    /// Sets this to what lies between `start` and `end`, at `share` (0 to 1) of the way; loads and efforts that `start`
    /// lacks begin at nothing.
    pub fn set_between(&mut self, start: &Self, end: &Self, share: f64) {
        self.copy_from(end);
        self.gravity = start.gravity * (1.0 - share) + end.gravity * share;
        self.drag = start.drag * (1.0 - share) + end.drag * share;
        for (number, wrench) in self.wrenches.iter_mut().enumerate() {
            let from = start.wrenches.get(number).copied().unwrap_or_default();
            wrench.force = from.force * (1.0 - share) + wrench.force * share;
            wrench.moment = from.moment * (1.0 - share) + wrench.moment * share;
        }
        for (station, from) in self.stations.iter_mut().zip(&start.stations) {
            *station = from * (1.0 - share) + *station * share;
        }
        for (number, effort) in self.efforts.iter_mut().enumerate() {
            let from = start.efforts.get(number).copied().unwrap_or_default();
            *effort = from * (1.0 - share) + *effort * share;
        }
    }
}
