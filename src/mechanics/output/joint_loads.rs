//! What passes between the two sides of a joint of the model file: constraint forces, springs and dampers, drives,
//! actuators.
//!
//! Constraint forces are those of multipliers `λ` at the time of the configuration: `−Gᵀλ` acts on the system
//! (MECHANICS 6).

use crate::math::Vec3;
use crate::mechanics::beam::balance::Acting;
use crate::mechanics::constraint::joint::{Held, Holding, Joint};
use crate::mechanics::force::actuator;
use crate::mechanics::geometry::pose::{PLACE, moment};
use crate::mechanics::geometry::pose_pair::PairVector;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::{Configuration, Passage};
use crate::mechanics::marker::pose_gradient::of_side;
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::beam_contacts::MeetingPoint;
use crate::mechanics::system::joint_parts::JointParts;
use std::cell::OnceCell;
use std::ops::Range;

/// Which side of a joint or relative coordinate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    A,
    B,
}

/// What acts at an instant: the state with its configuration, how it is passed through, and the multipliers of all
/// conditions.
#[derive(Clone, Debug)]
pub struct JointLoads<'a> {
    /// The system.
    pub system: &'a System,
    /// The state, for its time and what a host gives.
    pub state: &'a State,
    /// The instant.
    pub c: &'a Configuration<'a>,
    /// How fast it moves.
    pub passage: &'a Passage<'a>,
    /// Multipliers of all conditions, N or N m.
    pub multipliers: &'a [f64],
    /// Where beams touch beams, found when a section asks for it first: the search goes over whole beams.
    meetings: OnceCell<Vec<MeetingPoint>>,
}

impl<'a> JointLoads<'a> {
    /// All that acts on `system` in `state`, whose configuration `c` moves as `passage` says, with these multipliers.
    pub fn new(
        (system, state): (&'a System, &'a State),
        (c, passage): (&'a Configuration<'a>, &'a Passage<'a>),
        multipliers: &'a [f64],
    ) -> Self {
        Self { system, state, c, passage, multipliers, meetings: OnceCell::new() }
    }

    /// The points of element `element` that touch beams.
    pub(super) fn meetings_of(&self, element: usize) -> &[MeetingPoint] {
        let all = self.meetings.get_or_init(|| self.system.meeting_points(self.c, self.passage));
        let first = all.partition_point(|point| point.element < element);
        let count = all[first..].partition_point(|point| point.element == element);
        &all[first..first + count]
    }

    /// Force (N) and moment (N m) that b receives through the joint of these `parts`, at b's position, in global axes.
    pub fn reaction(&self, parts: &JointParts) -> (Vec3, Vec3) {
        let joints = parts
            .joint
            .into_iter()
            .flat_map(|joint| self.system.entries(joint))
            .chain(parts.drives.iter().map(|drive| self.drive(*drive)));
        let joints = joints.chain(parts.locks.iter().map(|lock| self.lock(*lock)));
        let joints = joints.chain(parts.gears.iter().map(|(gear, is_second)| self.gear(*gear, *is_second)));
        let by_joints = joints.map(|joint| self.of_joint(joint, Side::B));
        let by_springs = parts.springs.iter().map(|spring| self.of_spring(*spring, Side::B));
        let by_actuators = parts.actuators.iter().map(|actuator| self.of_actuator(*actuator, Side::B));
        by_joints
            .chain(by_springs)
            .chain(by_actuators)
            .fold((Vec3::zeros(), Vec3::zeros()), |(force, moment), acting| {
                (force + acting.force, moment + acting.moment)
            })
    }

    /// Torque (N m) or force (N) of drive `drive` on b, along its coordinate.
    pub fn effort(&self, drive: usize) -> f64 {
        let number = self.drive(drive);
        let multiplier = self.multipliers[self.rows(number).start];
        // 0 where it is released, not -0.
        if self.system.joints[number].holding.is_some() { 0.0 - multiplier } else { -multiplier }
    }

    /// Torque (N m) or force (N) of lock `lock` on b, along its coordinate; 0 while it is released.
    pub fn lock_effort(&self, lock: usize) -> f64 {
        // 0 where it is 0, not -0.
        0.0 - self.multipliers[self.rows(self.lock(lock)).start]
    }

    /// Torque (N m) or force (N) of actuator `actuator` on b, along its coordinate.
    pub fn actuator_effort(&self, actuator: usize) -> f64 {
        let own = &self.system.actuators[actuator];
        let (time, target) = (self.state.instant(), &self.state.targets.efforts[actuator]);
        self.system.effort(own, self.c, self.passage, own.at(time, target), time)
    }

    /// Torque (N m) or force (N) of gear `gear` on side b of its first joint, along the coordinate of that.
    pub fn gear_effort(&self, gear: usize) -> f64 {
        -self.multipliers[self.rows(self.gear(gear, false)).start]
    }

    /// Force (N) and moment (N m) about its origin that moving frame `frame` must supply, in global axes.
    pub fn frame_reaction(&self, frame: usize) -> (Vec3, Vec3) {
        let origin = self.c.prescribed.frames[frame].pose.place;
        let is_own = |marker: &Marker| matches!(marker, Marker::Frame { frame: own, .. } if *own == frame);
        let (mut force, mut moment) = (Vec3::zeros(), Vec3::zeros());
        // The frame gives what it receives, with the other sign.
        let mut give = |acting: Acting| {
            force -= acting.force;
            moment -= acting.moment + (acting.position - origin).cross(&acting.force);
        };
        for (number, joint) in self.system.joints.iter().enumerate() {
            for (marker, side) in [(&joint.a, Side::A), (&joint.b, Side::B)] {
                if is_own(marker) {
                    give(self.of_joint(number, side));
                }
            }
        }
        for (number, spring) in self.system.springs.iter().enumerate() {
            let RelativeCoordinate { a, b, .. } = &self.system.relative_coordinates[spring.coordinate];
            for (marker, side) in [(a, Side::A), (b, Side::B)] {
                if is_own(marker) {
                    give(self.of_spring(number, side));
                }
            }
        }
        for (number, actuator) in self.system.actuators.iter().enumerate() {
            for (marker, side) in self.system.sides(actuator.coordinate).into_iter().zip([Side::A, Side::B]) {
                if is_own(marker) {
                    give(self.of_actuator(number, side));
                }
            }
        }
        for (number, rope) in self.system.ropes.iter().enumerate() {
            for (span, seats) in rope.seats.windows(2).enumerate() {
                for (seat, side) in seats.iter().zip([Side::A, Side::B]) {
                    if is_own(&seat.marker) {
                        give(self.of_rope(number, span, side));
                    }
                }
            }
        }
        (force, moment)
    }

    /// The number among the joints of the condition of a drive.
    fn drive(&self, drive: usize) -> usize {
        let is_own = |joint: &Joint| joint.drive == Some(drive);
        self.system.joints.iter().position(is_own).expect("every drive has its condition")
    }

    /// The number among the joints of the condition of a lock.
    fn lock(&self, lock: usize) -> usize {
        let switch = self.system.locks[lock].switch;
        let is_own = |joint: &Joint| {
            let holds = |holding: Holding| holding.switch == switch && matches!(holding.held, Held::Coordinate(_));
            joint.drive.is_none() && joint.holding.is_some_and(holds)
        };
        self.system.joints.iter().position(is_own).expect("every lock has its condition")
    }

    /// The number among the joints of a side of a gear.
    fn gear(&self, gear: usize, is_second: bool) -> usize {
        let is_own =
            |joint: &Joint| joint.gear.as_ref().is_some_and(|side| side.gear == gear && side.is_second == is_second);
        self.system.joints.iter().position(is_own).expect("every gear has both its sides")
    }

    /// The numbers of the conditions of a joint.
    fn rows(&self, joint: usize) -> Range<usize> {
        let mut all = self.system.joints_with_rows().map(|(_, rows)| rows);
        all.nth(joint).expect("a joint of the system")
    }

    pub(super) fn of_joint(&self, number: usize, side: Side) -> Acting {
        let joint = &self.system.joints[number];
        let lambda = &self.multipliers[self.rows(number)];
        // An entry that holds nothing now acts nowhere, with no force.
        let settled = joint.settle(self.c).unwrap_or_default();
        self.acting(joint.sides(&settled), side, &-joint.phi_x(self.c, lambda))
    }

    pub(super) fn of_spring(&self, number: usize, side: Side) -> Acting {
        let spring = &self.system.springs[number];
        let coordinate = &self.system.relative_coordinates[spring.coordinate];
        self.acting([&coordinate.a, &coordinate.b], side, &-spring.tension_x(coordinate, self.c, self.passage))
    }

    pub(super) fn of_actuator(&self, number: usize, side: Side) -> Acting {
        let coordinate = &self.system.relative_coordinates[self.system.actuators[number].coordinate];
        let forces = actuator::force_x(coordinate, self.c, self.actuator_effort(number));
        self.acting([&coordinate.a, &coordinate.b], side, &forces)
    }

    pub(super) fn of_rope(&self, number: usize, span: usize, side: Side) -> Acting {
        let rope = &self.system.ropes[number];
        let markers = [&rope.seats[span].marker, &rope.seats[span + 1].marker];
        let tension = rope.pull(self.c, self.passage).map_or(f64::NAN, |pull| pull.pulls[rope.stretch_of(span)].value);
        let forces = rope.reach_x(span, self.c).map_or_else(PairVector::zeros, |by_poses| by_poses * -tension);
        self.acting(markers, side, &forces)
    }

    /// Forces on the vectors of both poses as force and moment on one side.
    fn acting(&self, [a, b]: [&Marker; 2], side: Side, forces: &PairVector) -> Acting {
        let (pose, own) = match side {
            Side::A => (a.pose(self.c), of_side(forces, 0)),
            Side::B => (b.pose(self.c), of_side(forces, 1)),
        };
        Acting { position: pose.place, force: own.column(PLACE).into_owned(), moment: moment(&pose, &own) }
    }
}
