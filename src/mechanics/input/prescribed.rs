//! What is prescribed at an instant: the values of drives, the motion of frames, the temperatures of beams, and what
//! holds.

use super::heat::Heat;
use super::switch::Hold;
use crate::math::jet::Jet;
use crate::math::rotation::{rotation_matrix, rotation_vector_near};
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
    /// Temperatures of beams.
    pub heats: Vec<Heat>,
    /// What the switches do.
    pub holds: Vec<Hold>,
}

/// A pose with its first two derivatives by time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MovingPose {
    /// Position and axes.
    pub pose: Pose,
    /// First derivative.
    pub velocity: Pose,
    /// Second derivative.
    pub acceleration: Pose,
}

impl Prescribed {
    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.drives.clone_from(&other.drives);
        self.frames.clone_from(&other.frames);
        self.heats.clone_from(&other.heats);
        self.holds.clone_from(&other.holds);
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
        for (heat, from) in self.heats.iter_mut().zip(&start.heats) {
            *heat = Heat::between(from, heat, share);
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

    /// The largest turn of a frame from `start` to here, judged by its angular velocity at both ends, over `duration`
    /// s; with the number of the frame.
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

/// The rotation vector of the shortest turn from `from` to `to`, rad.
fn shortest_turn(from: &Mat3, to: &Mat3) -> Vec3 {
    rotation_vector_near(&(to * from.transpose()), &Vec3::zeros())
}
