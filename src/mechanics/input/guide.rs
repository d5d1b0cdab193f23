//! Drives and moving frames, and where their motion comes from: functions of time, or a host (`host_motion`).
//!
//! A rate that a function gives is integrated to round-off.

use super::host_motion::Targets;
use super::prescribed::MovingPose;
use super::signal::Signal;
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::math::rotation::rotation_matrix_jet;
use crate::mechanics::geometry::pose::Pose;

/// Where a drive has its motion from.
#[derive(Clone, Debug)]
pub enum Guide {
    /// Its value is a function of time.
    Value(Signal),
    /// Its rate is a function of time; the value begins at 0.
    Rate(Signal),
    /// A host gives the value.
    HostValue,
    /// A host gives the rate; the value begins at 0.
    HostRate,
}

/// A drive: prescribes a relative coordinate, or how much of a beam a winch has paid out.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name in the model file.
    pub name: String,
    /// What it prescribes, by the number of the relative coordinate; none: a length that is paid out, m.
    pub coordinate: Option<usize>,
    /// Where its motion comes from.
    pub guide: Guide,
    /// What engages and releases it; none: it always drives.
    pub switch: Option<usize>,
}

/// Where a frame has its motion from.
#[derive(Clone, Debug)]
pub enum FrameGuide {
    /// Position (m) and rotation vector (rad) are functions of time.
    Signals {
        /// Position in global axes, m.
        place: [Signal; 3],
        /// Rotation vector from the global axes, rad.
        rotation: [Signal; 3],
    },
    /// A host gives the pose.
    Host,
}

/// A frame whose motion is prescribed.
#[derive(Clone, Debug)]
pub struct MovingFrame {
    /// Name in the model file.
    pub name: String,
    /// Where its motion comes from.
    pub guide: FrameGuide,
}

impl Drive {
    /// Its value and rate at the start, `time` s; `from` is its value there where a rate drives it.
    pub fn start(&self, time: f64, from: f64, target: f64) -> Jet {
        match &self.guide {
            Guide::Value(signal) => signal.jet(time),
            Guide::Rate(signal) => rated(from, signal.jet(time)),
            Guide::HostValue => Jet::constant(target),
            Guide::HostRate => Jet { value: from, first: target, second: 0.0 },
        }
    }

    /// Its name with what it is.
    pub fn label(&self) -> String {
        let kind = if self.coordinate.is_some() { "drive" } else { "winch" };
        format!("{kind} {}", self.name)
    }

    /// The function of time that its value or rate is; none where a host gives it.
    pub fn signal(&self) -> Option<&Signal> {
        match &self.guide {
            Guide::Value(signal) | Guide::Rate(signal) => Some(signal),
            Guide::HostValue | Guide::HostRate => None,
        }
    }

    /// Its value and rate at `next` s, from the value `from` at `time` s; `number` is its own among the `targets`.
    pub fn advanced(&self, number: usize, from: f64, (time, next): (f64, f64), targets: &Targets) -> Jet {
        match &self.guide {
            Guide::Value(signal) => signal.jet(next),
            Guide::Rate(signal) => rated(from + signal.integral(time, next), signal.jet(next)),
            Guide::HostValue => targets.value(number, next),
            Guide::HostRate => targets.rate(number, next),
        }
    }

    /// [`Self::advanced`], with the rate and the acceleration that it has just before `next`: from then on it drives no
    /// more.
    pub fn advanced_before(&self, number: usize, from: f64, (time, next): (f64, f64), targets: &Targets) -> Jet {
        let before = self.advanced(number, from, (time, next.next_down()), targets);
        Jet { value: self.advanced(number, from, (time, next), targets).value, ..before }
    }
}

/// A value with the rate and acceleration of a signal that is a rate.
fn rated(value: f64, rate: Jet) -> Jet {
    Jet { value, first: rate.value, second: rate.first }
}

impl MovingFrame {
    /// The functions of time that its position and rotation vector are; none where a host gives them.
    pub fn signals(&self) -> impl Iterator<Item = &Signal> {
        let components = match &self.guide {
            FrameGuide::Signals { place, rotation } => Some(place.iter().chain(rotation)),
            FrameGuide::Host => None,
        };
        components.into_iter().flatten()
    }

    /// Its motion at the start, `time` s.
    pub fn start(&self, time: f64, target: &Pose) -> MovingPose {
        match &self.guide {
            FrameGuide::Signals { place, rotation } => of_signals(place, rotation, time),
            FrameGuide::Host => MovingPose::at_rest(*target),
        }
    }

    /// Its motion at `time`, s; `number` is its own among the `targets`.
    pub fn at(&self, number: usize, time: f64, targets: &Targets) -> MovingPose {
        match &self.guide {
            FrameGuide::Signals { place, rotation } => of_signals(place, rotation, time),
            FrameGuide::Host => targets.pose(number, time),
        }
    }
}

fn of_signals(place: &[Signal; 3], rotation: &[Signal; 3], time: f64) -> MovingPose {
    let jets = |signals: &[Signal; 3]| [0, 1, 2].map(|i| signals[i].jet(time));
    let place = jets(place);
    let [axes, axes_t, axes_tt] = rotation_matrix_jet(&jets(rotation));
    let part = |select: fn(&Jet) -> f64| Vec3::from_fn(|i, _| select(&place[i]));
    MovingPose {
        pose: Pose { place: part(|jet| jet.value), axes },
        velocity: Pose { place: part(|jet| jet.first), axes: axes_t },
        acceleration: Pose { place: part(|jet| jet.second), axes: axes_tt },
    }
}
