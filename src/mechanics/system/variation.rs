//! Small changes of a state: added to one, or taken from the difference of two.
//!
//! Coordinates of a node with a frame are measured in the chart of the unchanged state's own triad. A changed state has
//! triads of its own, carried from the unchanged ones to its tangents (MECHANICS 2.3, 2.6), which leaves `theta` and
//! all quasi-velocities as they are.

use super::System;
use super::frame_cache::FrameCache;
use crate::math::elementary::atan2;
use crate::mechanics::beam::ancf14::coordinates::THETA;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::geometry::triad::Triad;
use crate::mechanics::state::State;
use crate::mechanics::state::lists::Lists;

/// A direction in the space of states, in the units of a state over those of whatever it is a derivative by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variation {
    /// Of the lists of numbers.
    pub lists: Lists,
    /// Of what holds: values, and the numbers of poses.
    pub holds: Vec<HoldChange>,
}

/// A small change of what a switch holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoldChange {
    value: f64,
    pose: Pose,
}

impl Variation {
    /// No change of `state`.
    pub fn set_zero(&mut self, state: &State) {
        self.lists.set_zero(&state.lists);
        self.holds.clear();
        self.holds.resize(state.prescribed.holds.len(), HoldChange { value: 0.0, pose: Pose::zero() });
    }

    /// Changes `state` by `factor` times this; its triads belong to its tangents. What is prescribed, and what hosts
    /// want, is the caller's. `frames` is scratch memory.
    pub fn apply(&self, system: &System, factor: f64, state: &mut State, frames: &mut FrameCache) {
        state.lists.add(factor, &self.lists);
        for (hold, change) in state.prescribed.holds.iter_mut().zip(&self.holds) {
            hold.value += factor * change.value;
            hold.pose.place += change.pose.place * factor;
            hold.pose.axes += change.pose.axes * factor;
        }
        follow(system, state, frames);
    }

    /// Adds `weight` times what lies between `from` and `to`, two states of one system that are near each other.
    pub fn add_between(&mut self, system: &System, weight: f64, from: &State, to: &State) {
        self.lists.add_between(weight, &from.lists, &to.lists);
        let holds = from.prescribed.holds.iter().zip(&to.prescribed.holds);
        for (own, (from, to)) in self.holds.iter_mut().zip(holds) {
            own.value += weight * (to.value - from.value);
            own.pose.place += (to.pose.place - from.pose.place) * weight;
            own.pose.axes += (to.pose.axes - from.pose.axes) * weight;
        }
        for (node, (from, to)) in system.mesh.framed.iter().zip(from.triads.iter().zip(&to.triads)) {
            self.lists.q[node + THETA] += weight * turn_between(from, to);
        }
    }
}

/// Lets triads, holonomy angles, rotation vectors and relative coordinates follow the coordinates of `state`, which
/// have been changed a little. `frames` is scratch memory.
pub fn follow(system: &System, state: &mut State, frames: &mut FrameCache) {
    frames.set(system, &state.q, &state.triads);
    for (triad, frame) in state.triads.iter_mut().zip(&frames.frames) {
        *triad = frame.carried();
    }
    frames.set(system, &state.q, &state.triads);
    system.carry_references(state, frames);
}

/// The angle about the tangent by which `to` is turned from `from` carried there, rad.
fn turn_between(from: &Triad, to: &Triad) -> f64 {
    let carried = from.carried(&to.t);
    atan2(carried.u.cross(&to.u).dot(&to.t), carried.u.dot(&to.u))
}
