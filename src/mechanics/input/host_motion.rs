//! What a host moves: where it is between two communication points.
//!
//! A host says where a drive or a frame is to be at the end of a communication step. From where it is it goes there on
//! a cubic, from the velocity that it has to
//!
//! ```text
//! w = s + a H/2,   a = (s − s′)/((H + H′)/2)
//! ```
//!
//! with the mean velocity `s` and the length `H` of this step, `s′` and `H′` of the last one; in the first step `s′` is
//! the velocity of the start, by the derivatives that the host gives, and `H′ = 0`. `a` is the change of velocity
//! between the middles of the two steps. Constant accelerations, along a line or about a fixed axis, are followed
//! exactly; the velocity has no jumps, which would strike all that is held rigidly; and nothing goes further back than
//! two steps, so that no error is carried on. Frames turn by a rotation vector on such a cubic, from where they are
//! along the shortest arc. Temperatures go on a straight line.

use super::excitation::{HostEffort, HostWrench};
use super::heat::Heat;
use super::prescribed::{MovingPose, Prescribed};
use crate::math::Vec3;
use crate::math::jet::Jet;
use crate::math::rotation::{rotation_matrix_jet, rotation_vector_near, rotation_vector_rate};
use crate::mechanics::geometry::pose::{Pose, angular_velocity};
use serde::{Deserialize, Serialize};
use std::ops::{Add, Div, Mul, Sub};

/// What a host wants: drives and frames to be reached, and when; loads and actuators to act.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Targets {
    /// End of the communication step, s.
    pub end: f64,
    /// Whether the way there is straight: in equilibria, which know no velocities.
    pub straight: bool,
    /// Values or rates of the drives; those of functions are not used.
    pub drives: Vec<f64>,
    /// Poses of the frames; those of functions are not used.
    pub frames: Vec<Pose>,
    /// Components of the loads; those of functions are not used.
    pub loads: Vec<HostWrench>,
    /// Efforts of the actuators; those of functions are not used.
    pub efforts: Vec<HostEffort>,
    /// Values of the switches; those of functions are not used.
    pub switches: Vec<f64>,
    /// Temperatures that a host gives.
    pub heats: Vec<Heat>,
    /// From where, and how fast.
    pub departure: Departure,
}

/// How drives and frames moved when a communication step began.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Departure {
    /// The instant, s.
    pub time: f64,
    /// Length of the communication step that ended there, s; 0: none did.
    pub step: f64,
    /// Values of the drives, rad or m; velocities, rad/s or m/s.
    pub drives: Vec<Course<f64, f64>>,
    /// Poses of the frames; velocities in m/s, angular velocities in rad/s.
    pub frames: Vec<Course<Pose, [Vec3; 2]>>,
    /// Temperatures that a host gives.
    pub heats: Vec<Heat>,
}

/// How one of them moves at a communication point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Course<P, V> {
    /// Where it is.
    pub place: P,
    /// Its velocity.
    pub velocity: V,
    /// Its mean velocity in the communication step that ended there.
    pub mean: V,
}

impl<P, V: Copy> Course<P, V> {
    /// Sets the velocity of a start.
    pub fn start_with(&mut self, velocity: V) {
        (self.velocity, self.mean) = (velocity, velocity);
    }
}

impl Departure {
    /// Whether it is the first one: how fast it begins is for the host to say.
    pub fn is_first(&self) -> bool {
        self.step == 0.0
    }
}

impl Targets {
    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        (self.end, self.straight) = (other.end, other.straight);
        self.drives.clone_from(&other.drives);
        self.frames.clone_from(&other.frames);
        self.loads.clone_from(&other.loads);
        self.efforts.clone_from(&other.efforts);
        self.switches.clone_from(&other.switches);
        self.heats.clone_from(&other.heats);
        (self.departure.time, self.departure.step) = (other.departure.time, other.departure.step);
        self.departure.drives.clone_from(&other.departure.drives);
        self.departure.frames.clone_from(&other.departure.frames);
        self.departure.heats.clone_from(&other.departure.heats);
    }

    /// A communication step begins at `time`, s, where everything moves as `prescribed`.
    pub fn depart(&mut self, time: f64, prescribed: &Prescribed) {
        self.departure.heats.resize_with(self.heats.len(), Heat::default);
        for number in 0..self.heats.len() {
            self.departure.heats[number] = self.heat(number, time);
        }
        let Departure { time: own, step, drives, frames, .. } = &mut self.departure;
        *step = time - *own;
        *own = time;
        // The very first one: nothing has moved yet.
        let passed = if *step > 0.0 { *step } else { f64::INFINITY };
        drives.resize_with(prescribed.drives.len(), || Course { place: 0.0, velocity: 0.0, mean: 0.0 });
        for (own, now) in drives.iter_mut().zip(&prescribed.drives) {
            let mean = (now.value - own.place) / passed;
            *own = Course { place: now.value, velocity: now.first, mean };
        }
        let nowhere = || Course { place: Pose::default(), velocity: Default::default(), mean: Default::default() };
        frames.resize_with(prescribed.frames.len(), nowhere);
        for (own, now) in frames.iter_mut().zip(&prescribed.frames) {
            let mean = way(&own.place, &now.pose).map(|way| way / passed);
            *own = Course { place: now.pose, velocity: now.rates(), mean };
        }
    }

    /// Drive number `number` at `time`, s, if the host gives its value.
    pub(super) fn value(&self, number: usize, time: f64) -> Jet {
        let (target, course) = (self.drives[number], &self.departure.drives[number]);
        let Some(leg) = self.leg(time) else { return Jet::constant(target) };
        let change = target - course.place;
        let HermitePath { from, to, acceleration } = leg.path(change, course.velocity, course.mean);
        let way = leg.cubic(change, from, to);
        // At the end the very value that was wanted.
        let value = if leg.share == 1.0 { target } else { course.place + way.value };
        Jet { value, first: way.first, second: acceleration }
    }

    /// Drive number `number` at `time`, s, if the host gives its rate, which goes linearly to the one that is wanted.
    pub(super) fn rate(&self, number: usize, time: f64) -> Jet {
        let (target, course) = (self.drives[number], &self.departure.drives[number]);
        let start = Jet { value: course.place, first: target, second: 0.0 };
        let Some(Leg { share, length, .. }) = self.leg(time) else { return start };
        let change = target - course.velocity;
        let first = if share == 1.0 { target } else { course.velocity + share * change };
        let moved = 0.5 * (course.velocity + first) * share * length;
        Jet { value: course.place + moved, first, second: change / length }
    }

    /// Frame number `number` at `time`, s, if the host moves it.
    pub(super) fn pose(&self, number: usize, time: f64) -> MovingPose {
        let (target, course) = (&self.frames[number], &self.departure.frames[number]);
        let Some(leg) = self.leg(time) else { return MovingPose::at_rest(*target) };
        let changes = way(&course.place, target);
        let [line, spin] = [0, 1].map(|i| leg.path(changes[i], course.velocity[i], course.mean[i]));
        let [turn, place] = {
            let ends = [[spin.from, rotation_vector_rate(&changes[1], &spin.to)], [line.from, line.to]];
            let cubics = |way: Vec3, [from, to]: [Vec3; 2]| [0, 1, 2].map(|i| leg.cubic(way[i], from[i], to[i]));
            [cubics(changes[1], ends[0]), cubics(changes[0], ends[1])]
        };
        let [turn, turn_t, _] = rotation_matrix_jet(&turn);
        let [way, way_t] = [place.map(|jet| jet.value), place.map(|jet| jet.first)].map(Vec3::from);
        let reached = Pose { place: course.place.place + way, axes: turn * course.place.axes };
        // At the end the very pose that was wanted.
        let pose = if leg.share == 1.0 { *target } else { reached };
        let velocity = Pose { place: way_t, axes: turn_t * course.place.axes };
        let omega = angular_velocity(&reached, &velocity).cross_matrix();
        let axes = (omega * omega + spin.acceleration.cross_matrix()) * pose.axes;
        MovingPose { pose, velocity, acceleration: Pose { place: line.acceleration, axes } }
    }

    /// Temperature number `number` of those that a host gives, at `time`, s: it goes linearly to the one that is
    /// wanted.
    pub(super) fn heat(&self, number: usize, time: f64) -> Heat {
        match self.leg(time) {
            // At the end the very temperature that was wanted.
            Some(leg) if leg.share < 1.0 => {
                Heat::between(&self.departure.heats[number], &self.heats[number], leg.share)
            }
            _ => self.heats[number],
        }
    }

    /// The communication step, at `time`, s; none: it has no length.
    fn leg(&self, time: f64) -> Option<Leg> {
        let Departure { time: begin, step: last, .. } = self.departure;
        let length = self.end - begin;
        let share = if time >= self.end { 1.0 } else { (time - begin) / length };
        (length > 0.0).then_some(Leg { share, length, last, straight: self.straight })
    }
}

/// A communication step, and how much of it is over.
#[derive(Clone, Copy, Debug)]
struct Leg {
    /// 0 to 1.
    share: f64,
    /// Its length, s; the length of the one before, s, 0 where there was none.
    length: f64,
    last: f64,
    straight: bool,
}

/// Velocities at the start and the end of a communication step, and the acceleration from the last one to it.
#[derive(Clone, Copy, Debug)]
struct HermitePath<V> {
    from: V,
    to: V,
    acceleration: V,
}

impl Leg {
    /// How what moves on by `change` in this step does so, from `velocity`; `mean` is its mean velocity in the last
    /// one.
    fn path<V>(&self, change: V, velocity: V, mean: V) -> HermitePath<V>
    where
        V: Copy + Add<Output = V> + Sub<Output = V> + Mul<f64, Output = V> + Div<f64, Output = V>,
    {
        let own = change / self.length;
        let acceleration = (own - mean) / (0.5 * (self.length + self.last));
        let to = own + acceleration * (0.5 * self.length);
        if self.straight {
            HermitePath { from: own, to: own, acceleration }
        } else {
            HermitePath { from: velocity, to, acceleration }
        }
    }

    /// The way gone of `change` on the cubic with the velocities `from` and `to` at its ends.
    fn cubic(&self, change: f64, from: f64, to: f64) -> Jet {
        let Self { share, length, .. } = *self;
        // Around the straight way: what the ends are faster than it.
        let own = change / length;
        let (left, right) = (from - own, to - own);
        let rest = 1.0 - share;
        Jet {
            value: share * change + length * share * rest * (rest * left - share * right),
            first: own + rest * (1.0 - 3.0 * share) * left + share * (3.0 * share - 2.0) * right,
            second: ((6.0 * share - 4.0) * left + (6.0 * share - 2.0) * right) / length,
        }
    }
}

/// The way (m) and the shortest turn (rotation vector, rad) from one pose to another: exactly none where they are the
/// same.
fn way(from: &Pose, to: &Pose) -> [Vec3; 2] {
    let turn = if from.axes == to.axes {
        Vec3::zeros()
    } else {
        rotation_vector_near(&(to.axes * from.axes.transpose()), &Vec3::zeros())
    };
    [to.place - from.place, turn]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rotation::rotation_matrix;

    /// A drive and a frame that a host moves through the values `wanted` at the ends of communication steps; `watch`
    /// gets the targets in each.
    fn move_through(ends: &[f64], wanted: impl Fn(f64) -> (f64, Pose), mut watch: impl FnMut(&Targets)) {
        let mut targets = Targets::default();
        let (value, pose) = wanted(0.0);
        let mut now = Prescribed {
            drives: vec![Jet::constant(value)],
            frames: vec![MovingPose::at_rest(pose)],
            ..Prescribed::default()
        };
        let mut time = 0.0;
        for &end in ends {
            targets.depart(time, &now);
            let (value, pose) = wanted(end);
            (targets.end, targets.drives, targets.frames) = (end, vec![value], vec![pose]);
            watch(&targets);
            now = Prescribed {
                drives: vec![targets.value(0, end)],
                frames: vec![targets.pose(0, end)],
                ..Prescribed::default()
            };
            time = end;
        }
    }

    const ENDS: [f64; 7] = [0.01, 0.02, 0.025, 0.045, 0.05, 0.07, 0.08];

    /// Places and turns with constant acceleration from rest, through steps of any length: followed exactly at every
    /// time between.
    #[test]
    fn constant_accelerations_are_followed() {
        let (way, axis) = (Vec3::new(1.0, -2.0, 0.5), Vec3::new(2.0, 1.0, -3.0));
        let turned = rotation_matrix(&Vec3::new(0.3, -0.8, 0.4));
        let at = |t: f64| {
            let square = 0.5 * t * t;
            (3.0 * square, Pose { place: way * square, axes: rotation_matrix(&(axis * square)) * turned })
        };
        move_through(&ENDS, at, |targets| {
            for share in [0.0, 0.3, 0.5, 0.9, 1.0] {
                let begin = targets.departure.time;
                let t = begin + share * (targets.end - begin);
                let (value, pose) = at(t);
                let drive = targets.value(0, t);
                // Round-off, over the shortest step for velocities and twice for accelerations.
                assert!((drive.value - value).abs() < 1e-16 && (drive.first - 3.0 * t).abs() < 1e-13);
                assert!((drive.second - 3.0).abs() < 1e-11, "{}", drive.second);
                let frame = targets.pose(0, t);
                assert!((frame.pose.place - pose.place).norm() < 1e-16);
                assert!((frame.pose.axes - pose.axes).norm() < 1e-14);
                let [velocity, spin] = frame.rates();
                assert!((velocity - way * t).norm() < 1e-13 && (spin - axis * t).norm() < 1e-12, "{spin}");
                assert!((frame.acceleration.place - way).norm() < 1e-11);
                let omega = (axis * t).cross_matrix();
                let axes = (omega * omega + axis.cross_matrix()) * pose.axes;
                assert!((frame.acceleration.axes - axes).norm() < 1e-9);
            }
        });
    }

    /// Any motion: values are reached, velocities go on from step to step, and are the derivatives of places and axes.
    #[test]
    fn velocities_have_no_jumps() {
        let at = |t: f64| {
            let vector = Vec3::new((60.0 * t).sin(), 2.0 * t - 0.4, (40.0 * t).cos());
            ((50.0 * t).sin(), Pose { place: vector * 2.0, axes: rotation_matrix(&vector) })
        };
        let mut last: Option<(Jet, MovingPose)> = None;
        move_through(&ENDS, at, |targets| {
            let (begin, end) = (targets.departure.time, targets.end);
            let [start, finish] = [begin, end].map(|t| (targets.value(0, t), targets.pose(0, t)));
            if let Some((drive, frame)) = &last {
                assert!((start.0.first - drive.first).abs() < 1e-11);
                for (own, before) in start.1.rates().iter().zip(frame.rates()) {
                    assert!((own - before).norm() < 1e-10, "{own} {before}");
                }
                assert!((start.1.pose.axes - frame.pose.axes).norm() < 1e-14);
            }
            let (value, pose) = at(end);
            assert!(finish.0.value == value && finish.1.pose == pose, "to the bit");
            // The cubic that ends there: just before the end it is as near as the step before the end is short.
            let before = targets.pose(0, end - 1e-9);
            assert!((before.pose.place - pose.place).norm() < 1e-6 && (before.pose.axes - pose.axes).norm() < 1e-6);
            // Central differences over 2e-6 s: curvature 1e7/s³ at most, round-off 1e-16/1e-6.
            for t in [0.2, 0.5, 0.8].map(|share| begin + share * (end - begin)) {
                let [left, right] = [t - 1e-6, t + 1e-6].map(|t| (targets.value(0, t).value, targets.pose(0, t).pose));
                let frame = targets.pose(0, t);
                assert!(((right.0 - left.0) / 2e-6 - targets.value(0, t).first).abs() < 1e-4);
                assert!(((right.1.place - left.1.place) / 2e-6 - frame.velocity.place).norm() < 1e-4);
                assert!(((right.1.axes - left.1.axes) / 2e-6 - frame.velocity.axes).norm() < 1e-4);
            }
            last = Some(finish);
        });
    }

    /// What stands still does so to the bit; in equilibria the way is straight.
    #[test]
    fn standing_still_and_straight_ways() {
        let axes = rotation_matrix(&Vec3::new(0.3, -0.8, 0.4));
        let pose = Pose { place: Vec3::new(0.1, 0.2, 0.3), axes };
        move_through(
            &ENDS,
            |_| (0.7, pose),
            |targets| {
                for t in [0.3, 1.0].map(|share| targets.departure.time + share * (targets.end - targets.departure.time))
                {
                    assert_eq!(targets.value(0, t), Jet::constant(0.7));
                    assert_eq!(targets.pose(0, t), MovingPose::at_rest(pose));
                }
            },
        );
        let turn = Vec3::new(0.5, 1.0, -2.0);
        let to = Pose { place: Vec3::new(1.0, 2.0, 3.0), axes: rotation_matrix(&turn) * axes };
        let mut targets = Targets { straight: true, ..Targets::default() };
        targets.depart(
            0.0,
            &Prescribed {
                drives: vec![Jet::constant(1.0)],
                frames: vec![MovingPose::at_rest(pose)],
                ..Prescribed::default()
            },
        );
        (targets.end, targets.drives, targets.frames) = (0.5, vec![3.0], vec![to]);
        assert!((targets.value(0, 0.125).value - 1.5).abs() < 1e-15);
        let found = targets.pose(0, 0.125).pose;
        assert!((found.place - (pose.place * 0.75 + to.place * 0.25)).norm() < 1e-15);
        assert!((found.axes - rotation_matrix(&(turn * 0.25)) * axes).norm() < 1e-14);
    }

    /// A jump by 1 in the second of some steps is reached at its end; the motion overshoots in the two steps after it,
    /// and rests from then on.
    #[test]
    fn jumps_overshoot_for_two_steps() {
        let ends = [0.1, 0.2, 0.3, 0.4, 0.5];
        let at = |t: f64| (f64::from(u8::from(t > 0.15)), Pose::default());
        let mut extremes = Vec::new();
        move_through(&ends, at, |targets| {
            let values = (0..=100).map(|k| targets.value(0, targets.departure.time + 1e-3 * f64::from(k)).value);
            extremes
                .push(values.fold([f64::MAX, f64::MIN], |[least, most], value| [least.min(value), most.max(value)]));
        });
        // Of `σ (1 − σ) (3/2 − σ)` and `σ (1 − σ)²/2`.
        let expected = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.2641], [0.9259, 1.0], [1.0, 1.0]];
        for (found, expected) in extremes.iter().flatten().zip(expected.iter().flatten()) {
            assert!((found - expected).abs() < 1e-3, "{extremes:?}");
        }
    }

    /// A rate goes linearly to the wanted one, its value is its integral.
    #[test]
    fn rates_are_integrated() {
        let mut targets = Targets::default();
        let moving = Jet { value: 0.2, first: 1.0, second: 0.0 };
        targets.depart(1.0, &Prescribed { drives: vec![moving], ..Prescribed::default() });
        (targets.end, targets.drives) = (1.5, vec![4.0]);
        let (middle, end) = (targets.rate(0, 1.25), targets.rate(0, 1.5));
        assert_eq!((middle.first, middle.second, end.first), (2.5, 6.0, 4.0));
        assert!((middle.value - (0.2 + 0.25 * 1.75)).abs() < 1e-15 && (end.value - (0.2 + 0.5 * 2.5)).abs() < 1e-15);
    }
}
