//! Actuators: an effort, a torque or a force, between the two sides of a relative coordinate.
//!
//! The effort `e` does the work `e dx` on the coordinate `x`: it acts on side b along the growing of the coordinate,
//! and on side a against it.

use crate::mechanics::force::effort_law::{EffortLaw, Reading};
use crate::mechanics::geometry::marker_jacobian::{MarkerMatrix, MarkerVector};
use crate::mechanics::geometry::pose_pair::PairVector;
use crate::mechanics::input::excitation::HostEffort;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;

/// Where an actuator has its effort from.
#[derive(Clone, Debug)]
pub enum EffortGuide {
    /// It is a function of time, N m or N.
    Signal(Signal),
    /// It follows coordinates of the mechanism.
    Law(EffortLaw),
    /// A host gives it.
    Host,
}

/// An effort on a relative coordinate.
#[derive(Clone, Debug)]
pub struct Actuator {
    /// Name in the model file.
    pub name: String,
    /// What it acts on, by the number of the relative coordinate.
    pub coordinate: usize,
    /// Where its effort comes from.
    pub guide: EffortGuide,
}

impl Actuator {
    /// Its effort at `time`, s, in N m or N, where `target` is what a host gives; of one that follows coordinates the
    /// share that acts, 1.
    pub fn at(&self, time: f64, target: &HostEffort) -> f64 {
        match &self.guide {
            EffortGuide::Signal(signal) => signal.at(time),
            EffortGuide::Law(_) => 1.0,
            EffortGuide::Host => target.at(time),
        }
    }

    /// The function of time that its effort is; none where a host gives it.
    pub fn signal(&self) -> Option<&Signal> {
        match &self.guide {
            EffortGuide::Signal(signal) | EffortGuide::Law(EffortLaw { signal, .. }) => Some(signal),
            EffortGuide::Host => None,
        }
    }

    /// What its effort reads.
    pub fn readings(&self) -> &[Reading] {
        match &self.guide {
            EffortGuide::Law(law) => &law.readings,
            EffortGuide::Signal(_) | EffortGuide::Host => &[],
        }
    }
}

/// Generalized forces of an effort on both sides, 24×1 each: `e ∂x/∂q`.
pub fn force(coordinate: &RelativeCoordinate, c: &Configuration, effort: f64) -> [MarkerVector; 2] {
    coordinate.gradient(c).map(|by_side| by_side * effort)
}

/// Derivative of [`force`] by the coordinates of both sides, blocks `aa, ab, ba, bb`: `e ∂²x/∂q²`.
pub fn force_q(coordinate: &RelativeCoordinate, c: &Configuration, effort: f64) -> [MarkerMatrix; 4] {
    coordinate.hessian(c, effort)
}

/// The forces of an effort on the vectors of both poses.
pub fn force_x(coordinate: &RelativeCoordinate, c: &Configuration, effort: f64) -> PairVector {
    coordinate.measure.gradient(&coordinate.a.pose(c), &coordinate.b.pose(c)) * effort
}
