//! Efforts of actuators that follow coordinates of the mechanism: controllers without a host.
//!
//! `e(t, x₁, x₂, …)` of coordinates and their rates. Over a step a coordinate is the mean of both its ends and its rate
//! the mean rate, so that the effort is implicit, and exact in the tangent.

use crate::mechanics::geometry::marker_jacobian::MarkerVector;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;
use std::fmt;
use std::sync::Arc;

/// The effort at a time, s, and at what is read, and its derivative with respect to one of these, by its place; beyond
/// the end: none of them.
pub type EffortFunction = dyn Fn(f64, &[f64], usize) -> [f64; 2] + Send + Sync;

/// An effort that follows coordinates.
#[derive(Clone)]
pub struct EffortLaw {
    /// The function of time that it is where everything stands as drawn: for its breaks.
    pub signal: Signal,
    /// The effort, N m or N.
    pub function: Arc<EffortFunction>,
    /// What it reads.
    pub readings: Vec<Reading>,
}

/// A relative coordinate, or its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// The coordinate, by its number.
    pub coordinate: usize,
    /// Its rate, not itself.
    pub is_rate: bool,
}

impl fmt::Debug for EffortLaw {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "f(t, {:?})", self.readings)
    }
}

impl Reading {
    /// What is read as the system passes through `c`, m, rad, m/s or rad/s.
    pub fn value(self, all: &[RelativeCoordinate], c: &Configuration, passage: &Passage) -> f64 {
        let own = &all[self.coordinate];
        let at = |c: &Configuration| own.value(c, c.relative_values[self.coordinate]);
        match (passage, self.is_rate) {
            (Passage::Rest | Passage::Corrected(_), true) => 0.0,
            (Passage::Rest | Passage::Corrected(_) | Passage::Instant { .. }, false) => at(c),
            (Passage::Instant { velocity, .. }, true) => own.rate(c, velocity),
            (Passage::Step(step), false) => 0.5 * (at(step.start) + at(step.end)),
            (Passage::Step(step), true) => (at(step.end) - at(step.start)) / step.duration,
        }
    }

    /// Its derivative with respect to the coordinates of both sides, 24×1 each; over a step twice that with respect to
    /// those at its end.
    pub fn gradient(self, all: &[RelativeCoordinate], c: &Configuration, passage: &Passage) -> [MarkerVector; 2] {
        let own = &all[self.coordinate];
        match (passage, self.is_rate) {
            (Passage::Rest | Passage::Corrected(_), true) => [MarkerVector::zeros(); 2],
            (Passage::Rest | Passage::Corrected(_) | Passage::Instant { .. }, false) => own.gradient(c),
            (Passage::Instant { velocity, .. }, true) => own.rate_gradient(c, velocity),
            (Passage::Step(step), false) => own.gradient(step.end),
            // Divided one by one: a factor `2/duration` would be moved to where there is no step, and hosts may trap a
            // division by zero.
            (Passage::Step(step), true) => own.gradient(step.end).map(|side| 2.0 * side / step.duration),
        }
    }
}
