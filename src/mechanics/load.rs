//! Forces and moments on markers: at one point, or spread over a beam; in global directions or turning with the section.

use super::configuration::Configuration;
use super::marker::{ByCoordinates, Marker, MarkerMatrix, MarkerVector};
use super::pose::axis_vector;
use crate::math::Vec3;
use crate::math::integral::integral;
use crate::math::jet::Jet;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::sync::Arc;

/// A number that may depend on time.
#[derive(Clone)]
pub enum Signal {
    /// Always the same.
    Constant(f64),
    /// A function of time, s, with its first two derivatives.
    Function(Arc<dyn Fn(f64) -> Jet + Send + Sync>),
    /// A function of time, s, in pieces.
    Pieces(Arc<Pieces>),
}

/// A function of time in pieces.
pub struct Pieces {
    /// The function with its first two derivatives; where two pieces meet, that of the piece that begins there.
    pub jet: Box<dyn Fn(f64) -> Jet + Send + Sync>,
    /// The times at which pieces meet, ascending, s.
    pub breaks: Vec<f64>,
}

impl Signal {
    /// Its value at `time`, s.
    pub fn at(&self, time: f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Function(function) => function(time).value,
            Self::Pieces(pieces) => (pieces.jet)(time).value,
        }
    }

    /// Its value and first two derivatives at `time`, s.
    pub fn jet(&self, time: f64) -> Jet {
        match self {
            Self::Constant(value) => Jet::constant(*value),
            Self::Function(function) => function(time),
            Self::Pieces(pieces) => (pieces.jet)(time),
        }
    }

    /// The times at which its pieces meet, ascending, s.
    pub fn breaks(&self) -> &[f64] {
        match self {
            Self::Constant(_) | Self::Function(_) => &[],
            Self::Pieces(pieces) => &pieces.breaks,
        }
    }

    /// Its integral from `from` to `to`, s: piece by piece, because a quadrature rule may step over a short piece.
    pub fn integral(&self, from: f64, to: f64) -> f64 {
        let value = |time: f64| self.at(time);
        let inner = self.breaks().iter().copied().filter(|time| from < *time && *time < to);
        let (sum, last) = inner.fold((0.0, from), |(sum, last), time| (sum + integral(&value, last, time), time));
        sum + integral(&value, last, to)
    }

    /// By how much its value jumps at `time`, s, one of its breaks.
    pub fn jump(&self, time: f64) -> f64 {
        self.at(time) - self.at(time.next_down())
    }
}

impl fmt::Debug for Signal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Constant(value) => write!(f, "{value}"),
            Self::Function(_) | Self::Pieces(..) => write!(f, "f(t)"),
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

/// Where a load has its components from.
#[derive(Clone, Debug)]
pub enum LoadGuide {
    /// They are functions of time.
    Signals {
        /// Force, N, or N/m along a beam.
        force: [Signal; 3],
        /// Moment, N m, or N along a beam.
        moment: [Signal; 3],
    },
    /// A host gives them.
    Host,
}

/// What acts on a machine from outside at one instant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Excitation {
    /// Gravity, m/s².
    pub gravity: Vec3,
    /// Components of the loads, in their order.
    pub wrenches: Vec<Wrench>,
}

impl Excitation {
    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.gravity = other.gravity;
        self.wrenches.clone_from(&other.wrenches);
    }

    /// Sets this to what lies between `start` and `end`, at `share` (0 to 1) of the way; loads that `start` lacks begin at nothing.
    pub fn set_between(&mut self, start: &Self, end: &Self, share: f64) {
        self.copy_from(end);
        self.gravity = start.gravity * (1.0 - share) + end.gravity * share;
        for (number, wrench) in self.wrenches.iter_mut().enumerate() {
            let from = start.wrenches.get(number).copied().unwrap_or_default();
            wrench.force = from.force * (1.0 - share) + wrench.force * share;
            wrench.moment = from.moment * (1.0 - share) + wrench.moment * share;
        }
    }
}

/// A load on one or more markers.
#[derive(Clone, Debug)]
pub struct Load {
    /// Name in the model file.
    pub name: String,
    /// Where it acts, each marker with its share: 1 at a point, quadrature weights (m) along a beam.
    pub points: Vec<(Marker, f64)>,
    /// Where its components come from.
    pub guide: LoadGuide,
    /// Axes of the components.
    pub direction: Direction,
}

impl Load {
    /// Its components at `time`, s; `target` is what a host gives.
    pub fn at(&self, time: f64, target: &HostWrench) -> Wrench {
        match &self.guide {
            LoadGuide::Signals { force, moment } => {
                let value = |signals: &[Signal; 3]| Vec3::from_fn(|i, _| signals[i].at(time));
                Wrench { force: value(force), moment: value(moment) }
            }
            LoadGuide::Host => target.at(time),
        }
    }

    /// The functions of time that its components are; none where a host gives them.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let components = match &self.guide {
            LoadGuide::Signals { force, moment } => Some(force.iter().chain(moment)),
            LoadGuide::Host => None,
        };
        components.into_iter().flatten()
    }

    /// The share of point `number` in the components `wrench`, in space: N, N m.
    fn in_space(&self, c: &Configuration, number: usize, wrench: &Wrench) -> (Vec3, Vec3) {
        let (marker, share) = &self.points[number];
        let (force, moment) = (wrench.force * *share, wrench.moment * *share);
        match self.direction {
            Direction::Global => (force, moment),
            Direction::Follower => {
                let axes = marker.pose(c).axes;
                (axes * force, axes * moment)
            }
        }
    }

    /// Generalized force of point `number` under the components `wrench`, 24×1, in the marker's coordinates.
    pub fn force(&self, c: &Configuration, number: usize, wrench: &Wrench) -> MarkerVector {
        let (force, moment) = self.in_space(c, number, wrench);
        let motion = self.points[number].0.motion(c);
        motion.place_q.tr_mul(&force) + motion.turn_q.tr_mul(&moment)
    }

    /// `∂(generalized force)/∂q` of point `number` under the components `wrench`, 24×24.
    pub fn force_q(&self, c: &Configuration, number: usize, wrench: &Wrench) -> MarkerMatrix {
        let marker = &self.points[number].0;
        let (force, moment) = self.in_space(c, number, wrench);
        let sum = marker.wrench_stiffness(c, &force, &moment);
        match self.direction {
            Direction::Global => sum,
            Direction::Follower => {
                let (motion, pose_q) = (marker.motion(c), marker.pose_q(c));
                let turned = |local: &Vec3| -> ByCoordinates {
                    let mut sum = ByCoordinates::zeros();
                    for number in 0..pose_q.count() {
                        sum.set_column(number, &(pose_q.column(number).fixed_columns::<3>(axis_vector(0)) * local));
                    }
                    sum
                };
                let share = self.points[number].1;
                sum + motion.place_q.tr_mul(&turned(&(wrench.force * share)))
                    + motion.turn_q.tr_mul(&turned(&(wrench.moment * share)))
            }
        }
    }
}
