//! Motion that is prescribed: drives and moving frames, by functions of time or by a host.
//!
//! What a host gives is reached at the end of its communication step, linearly from the value last reached; rotations take
//! the shortest arc. A rate that a function gives is integrated to round-off, one that a host gives exactly.

use super::load::{HostWrench, Signal};
use super::pose::Pose;
use crate::math::integral::integral;
use crate::math::jet::Jet;
use crate::math::rotation::{rotation_matrix, rotation_matrix_jet, rotation_vector_near};
use crate::math::{Mat3, Vec3};
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

/// What a host wants: drives and frames to be reached, and when; loads to act.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Targets {
    /// End of the communication step, s.
    pub end: f64,
    /// Values or rates of the drives; those of functions are not used.
    pub drives: Vec<f64>,
    /// Poses of the frames; those of functions are not used.
    pub frames: Vec<Pose>,
    /// Components of the loads; those of functions are not used.
    pub loads: Vec<HostWrench>,
    /// How drives and frames moved when the communication step began.
    pub before: Motion,
}

/// How drives and frames move at one instant.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// The instant, s.
    pub time: f64,
    /// Length of the communication step that ended there, s; 0: none did.
    pub step: f64,
    /// Rates of the drives, rad/s or m/s.
    pub drives: Vec<f64>,
    /// Velocities (m/s) and angular velocities (rad/s) of the frames.
    pub frames: Vec<[Vec3; 2]>,
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

/// A drive: prescribes the reading of a gauge.
#[derive(Clone, Debug)]
pub struct Drive {
    /// Name in the model file.
    pub name: String,
    /// What it prescribes, by the number of the gauge.
    pub gauge: usize,
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
        let speed = |frame: &MovingPose| super::pose::angular_velocity(&frame.pose, &frame.velocity).norm();
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
        [self.velocity.place, super::pose::angular_velocity(&self.pose, &self.velocity)]
    }

    /// Whether pose and velocity are finite: a kink of the acceleration does no harm.
    pub fn is_finite(&self) -> bool {
        self.pose.is_finite() && self.velocity.is_finite()
    }
}

impl Targets {
    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.end = other.end;
        self.drives.clone_from(&other.drives);
        self.frames.clone_from(&other.frames);
        self.loads.clone_from(&other.loads);
        (self.before.time, self.before.step) = (other.before.time, other.before.step);
        self.before.drives.clone_from(&other.before.drives);
        self.before.frames.clone_from(&other.before.frames);
    }

    /// A communication step begins at `time`, s, where everything moves as `prescribed`.
    pub fn begin(&mut self, time: f64, prescribed: &Prescribed) {
        let Motion { time: own, step, drives, frames } = &mut self.before;
        *step = f64::max(self.end - *own, 0.0);
        *own = time;
        drives.clear();
        drives.extend(prescribed.drives.iter().map(|drive| drive.first));
        frames.clear();
        frames.extend(prescribed.frames.iter().map(MovingPose::rates));
    }

    /// The change of a velocity from the last communication step to this one, per time: what a host gives moves linearly in each step, so
    /// that only its velocities from step to step tell how it accelerates. Each belongs to the middle of its step; that of the start to
    /// the start.
    fn acceleration<T: std::ops::Sub<Output = T> + std::ops::Div<f64, Output = T> + Default>(
        &self,
        now: T,
        before: T,
    ) -> T {
        let passed = 0.5 * (self.before.step + self.end - self.before.time);
        if passed > 0.0 { (now - before) / passed } else { T::default() }
    }

    /// How much of the way from `time` to the end of the communication step lies before `next`, and the length of that way, s.
    fn progress(&self, time: f64, next: f64) -> (f64, f64) {
        let way = self.end - time;
        if next >= self.end || way <= 0.0 { (1.0, way.max(0.0)) } else { ((next - time) / way, way) }
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

    /// Its value and rate at `next` s, from those at `time` s.
    /// `target` and `before` are its own in `targets`: value or rate to be reached, and its rate when the communication step began.
    pub fn advanced(
        &self,
        from: Jet,
        (time, next): (f64, f64),
        targets: &Targets,
        (target, before): (f64, f64),
    ) -> Jet {
        match &self.guide {
            Guide::Value(signal) => signal.jet(next),
            Guide::Rate(signal) => rated(from.value + integral(&|time| signal.at(time), time, next), signal.jet(next)),
            Guide::HostValue => {
                let (share, way) = targets.progress(time, next);
                let change = target - from.value;
                let first = if way > 0.0 { change / way } else { 0.0 };
                let value = if share == 1.0 { target } else { from.value + share * change };
                Jet { value, first, second: targets.acceleration(first, before) }
            }
            Guide::HostRate => {
                let (share, way) = targets.progress(time, next);
                let change = target - from.first;
                let first = if share == 1.0 { target } else { from.first + share * change };
                let second = if way > 0.0 { change / way } else { 0.0 };
                // The rate is linear up to the end of the communication step, constant from there.
                let moving = f64::min(next - time, way);
                let value = from.value + 0.5 * (from.first + first) * moving + first * (next - time - moving);
                Jet { value, first, second }
            }
        }
    }
}

/// A value with the rate and acceleration of a signal that is a rate.
fn rated(value: f64, rate: Jet) -> Jet {
    Jet { value, first: rate.value, second: rate.first }
}

impl MovingFrame {
    /// Its motion at the start, `time` s.
    pub fn start(&self, time: f64, target: &Pose) -> MovingPose {
        match &self.guide {
            FrameGuide::Signals { place, rotation } => of_signals(place, rotation, time),
            FrameGuide::Host => MovingPose::at_rest(*target),
        }
    }

    /// Its motion at `next` s, from that at `time` s.
    /// `target` and `before` are its own in `targets`: the pose to be reached, and its velocities when the communication step began.
    pub fn advanced(
        &self,
        from: &Pose,
        (time, next): (f64, f64),
        targets: &Targets,
        (target, before): (&Pose, &[Vec3; 2]),
    ) -> MovingPose {
        match &self.guide {
            FrameGuide::Signals { place, rotation } => of_signals(place, rotation, next),
            FrameGuide::Host => {
                let (share, way) = targets.progress(time, next);
                // Standing still is exact, whatever the steps.
                let stands = from == target;
                let change = target.place - from.place;
                let turn = if stands { Vec3::zeros() } else { shortest_turn(&from.axes, &target.axes) };
                let pose = if stands || share == 1.0 {
                    *target
                } else {
                    Pose { place: from.place + change * share, axes: rotation_matrix(&(turn * share)) * from.axes }
                };
                if way == 0.0 {
                    return MovingPose::at_rest(pose);
                }
                let rates = [change / way, turn / way];
                let [acceleration, spin_rate] = [0, 1].map(|i| targets.acceleration::<Vec3>(rates[i], before[i]));
                let spin = rates[1].cross_matrix();
                MovingPose {
                    pose,
                    velocity: Pose { place: rates[0], axes: spin * pose.axes },
                    acceleration: Pose {
                        place: acceleration,
                        axes: (spin * spin + spin_rate.cross_matrix()) * pose.axes,
                    },
                }
            }
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
