//! Motion that is prescribed: drives and moving frames, by functions of time or by a host (`host_motion`).
//!
//! A rate that a function gives is integrated to round-off.

use super::host_motion::Targets;
use super::signal::Signal;
use crate::math::jet::Jet;
use crate::math::rotation::{rotation_matrix, rotation_matrix_jet, rotation_vector_near};
use crate::math::{Mat3, Vec3};
use crate::mechanics::geometry::pose::Pose;
use serde::{Deserialize, Serialize};

/// What is prescribed at one instant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Prescribed {
    /// Values of the drives with their rates and accelerations, rad or m.
    pub drives: Vec<Jet>,
    /// Motion of the frames.
    pub frames: Vec<MovingPose>,
}

/// A pose with its first two derivatives by time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MovingPose {
    /// Place and axes.
    pub pose: Pose,
    /// First derivative.
    pub velocity: Pose,
    /// Second derivative.
    pub acceleration: Pose,
}

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

/// A drive: prescribes a relative coordinate.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name in the model file.
    pub name: String,
    /// What it prescribes, by the number of the relative coordinate.
    pub coordinate: usize,
    /// Where its motion comes from.
    pub guide: Guide,
}

/// Where a frame has its motion from.
#[derive(Clone, Debug)]
pub enum FrameGuide {
    /// Place (m) and rotation vector (rad) are functions of time.
    Signals {
        /// Place in global axes, m.
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

impl Prescribed {
    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.drives.clone_from(&other.drives);
        self.frames.clone_from(&other.frames);
    }

    /// Takes all motion away: what is prescribed in an equilibrium.
    pub fn stop(&mut self) {
        for drive in &mut self.drives {
            *drive = Jet::constant(drive.value);
        }
        for frame in &mut self.frames {
            *frame = MovingPose::at_rest(frame.pose);
        }
    }

    /// Sets this to the pose between `start` and `end`, at `share` (0 to 1) of the way, at rest.
    pub fn set_between(&mut self, start: &Self, end: &Self, share: f64) {
        self.copy_from(end);
        for (drive, from) in self.drives.iter_mut().zip(&start.drives) {
            *drive = Jet::constant(from.value + share * (drive.value - from.value));
        }
        for (frame, from) in self.frames.iter_mut().zip(&start.frames) {
            let place = from.pose.place + (frame.pose.place - from.pose.place) * share;
            let turn = shortest_turn(&from.pose.axes, &frame.pose.axes);
            // Whole: the very axes of the end, without the rounding of a rotation.
            let axes = if share == 1.0 { frame.pose.axes } else { rotation_matrix(&(turn * share)) * from.pose.axes };
            *frame = MovingPose::at_rest(Pose { place, axes });
        }
    }

    /// Moves everything on by `time` (s) along its present motion, to first order.
    pub fn drift(&mut self, time: f64) {
        for drive in &mut self.drives {
            drive.value += time * drive.first;
            drive.first += time * drive.second;
        }
        let drift = |pose: &mut Pose, rate: &Pose| {
            pose.place += rate.place * time;
            pose.axes += rate.axes * time;
        };
        for MovingPose { pose, velocity, acceleration } in &mut self.frames {
            drift(pose, velocity);
            drift(velocity, acceleration);
        }
    }

    /// The largest speed of drives and frames, lengths over `size` (m), 1/s.
    pub fn fastest(&self, size: f64) -> f64 {
        let drives = self.drives.iter().map(|drive| drive.first.abs() / f64::min(size, 1.0));
        let frames =
            self.frames.iter().map(|frame| (frame.velocity.place.norm() / size).max(frame.velocity.axes.norm()));
        drives.chain(frames).fold(0.0, f64::max)
    }

    /// The largest turn of a frame from `start` to here, judged by its angular velocity at both ends, over `duration` s; with the number of the frame.
    pub fn largest_turn(&self, start: &Self, duration: f64) -> Option<(usize, f64)> {
        let speed = |frame: &MovingPose| {
            crate::mechanics::geometry::pose::angular_velocity(&frame.pose, &frame.velocity).norm()
        };
        let turns = self.frames.iter().zip(&start.frames).map(|(end, start)| duration * speed(end).max(speed(start)));
        turns.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl MovingPose {
    /// That does not move.
    pub fn at_rest(pose: Pose) -> Self {
        Self { pose, velocity: Pose::zero(), acceleration: Pose::zero() }
    }

    /// Velocity (m/s) and angular velocity (rad/s).
    pub fn rates(&self) -> [Vec3; 2] {
        [self.velocity.place, crate::mechanics::geometry::pose::angular_velocity(&self.pose, &self.velocity)]
    }

    /// Whether pose and velocity are finite: a kink of the acceleration does no harm.
    pub fn is_finite(&self) -> bool {
        self.pose.is_finite() && self.velocity.is_finite()
    }
}

impl Drive {
    /// Its value and rate at the start, `time` s.
    pub fn start(&self, time: f64, target: f64) -> Jet {
        match &self.guide {
            Guide::Value(signal) => signal.jet(time),
            Guide::Rate(signal) => rated(0.0, signal.jet(time)),
            Guide::HostValue => Jet::constant(target),
            Guide::HostRate => Jet { value: 0.0, first: target, second: 0.0 },
        }
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

/// The rotation vector of the shortest turn from `from` to `to`, rad.
fn shortest_turn(from: &Mat3, to: &Mat3) -> Vec3 {
    rotation_vector_near(&(to * from.transpose()), &Vec3::zeros())
}
