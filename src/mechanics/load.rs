//! Forces and moments on markers: at one point, or spread over a beam; in global directions or turning with the section.

use super::marker::{Configuration, Marker, MarkerMatrix};
use crate::math::Vec3;
use nalgebra::SVector;
use std::fmt;
use std::sync::Arc;

/// A number that may depend on time.
#[derive(Clone)]
pub enum Signal {
    /// Always the same.
    Constant(f64),
    /// A function of time, s.
    Function(Arc<dyn Fn(f64) -> f64 + Send + Sync>),
}

impl Signal {
    /// Its value at `time`, s.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Function(function) => function(time),
        }
    }
}

impl fmt::Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "{value}"),
            Self::Function(_) => write!(f, "f(t)"),
        }
    }
}

/// What a load's components refer to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Global axes: a dead load.
    Global,
    /// Axes of the section, x along the tangent: the load turns with it.
    Follower,
}

/// A load on one or more markers.
#[derive(Clone, Debug)]
pub struct Load {
    /// Name in the model file.
    pub name: String,
    /// Where it acts, each marker with its share: 1 at a point, quadrature weights (m) along a beam.
    pub points: Vec<(Marker, f64)>,
    /// Force, N, or N/m along a beam.
    pub force: [Signal; 3],
    /// Moment, N m, or N along a beam.
    pub moment: [Signal; 3],
    /// Axes of the components.
    pub direction: Direction,
}

impl Load {
    /// Whether all components are finite numbers at `time`, s.
    pub fn is_finite(&self, time: f64) -> bool {
        self.force.iter().chain(&self.moment).all(|signal| signal.at(time).is_finite())
    }

    /// Force (N) and moment (N m) of share `share` at `time`, in space.
    fn wrench(&self, c: &Configuration, marker: &Marker, share: f64, time: f64) -> (Vec3, Vec3) {
        let value = |signals: &[Signal; 3]| Vec3::from_fn(|i, _| signals[i].at(time) * share);
        let (force, moment) = (value(&self.force), value(&self.moment));
        match self.direction {
            Direction::Global => (force, moment),
            Direction::Follower => {
                let axes = marker.pose(c).axes;
                (axes * force, axes * moment)
            }
        }
    }

    /// Generalized force of point `number` at `time` (s), 14×1, in the marker's coordinates.
    pub fn force(&self, c: &Configuration, number: usize, time: f64) -> SVector<f64, 14> {
        let (marker, share) = &self.points[number];
        let (force, moment) = self.wrench(c, marker, *share, time);
        let motion = marker.motion(c);
        motion.place_q.tr_mul(&force) + motion.turn_q.tr_mul(&moment)
    }

    /// `∂(generalized force)/∂q` of point `number` at `time` (s), 14×14.
    pub fn force_q(&self, c: &Configuration, number: usize, time: f64) -> MarkerMatrix {
        let (marker, share) = &self.points[number];
        let (force, moment) = self.wrench(c, marker, *share, time);
        let sum = marker.wrench_stiffness(c, &force, &moment);
        match self.direction {
            Direction::Global => sum,
            Direction::Follower => {
                let motion = marker.motion(c);
                sum - motion.place_q.tr_mul(&(force.cross_matrix() * motion.turn_q))
                    - motion.turn_q.tr_mul(&(moment.cross_matrix() * motion.turn_q))
            }
        }
    }
}
