//! Small changes of a state: added to one, or taken from the difference of two.
//!
//! Coordinates of a node with a frame are measured in the chart of the unchanged state's own triad. A changed state has triads of its own,
//! carried from the unchanged ones to its tangents (MECHANICS 2.3, 2.6), which leaves `theta` and all quasi-velocities as they are.

use super::System;
use super::frame_cache::FrameCache;
use crate::mechanics::beam::ancf14::coordinates::THETA;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::geometry::triad::Triad;
use crate::mechanics::state::State;

/// A direction in the space of states: a list for each list of numbers in [`State`], in its units over those of whatever it is a
/// derivative by.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variation {
    /// Of the coordinates.
    pub q: Vec<f64>,
    /// Of the velocities.
    pub velocity: Vec<f64>,
    /// Of the momenta.
    pub momentum: Vec<f64>,
    /// Of the multipliers.
    pub multipliers: Vec<f64>,
    /// Of the momentum that constraints do not allow.
    pub constraint_momenta: Vec<f64>,
    /// Of the strain rates.
    pub strain_rates: Vec<f64>,
    /// Of the leads of rates, the newest first; empty where the state has none.
    pub rate_leads: [Vec<f64>; 3],
    /// Of the rates of strains at the instant, and at the start of the last step; empty where the state has none.
    pub viscous: [Vec<f64>; 2],
    /// Of the accelerations: of the coordinates, and algorithmic; empty where the state has none.
    pub accelerations: [Vec<f64>; 2],
    /// Of what holds: values, and the numbers of poses.
    pub holds: Vec<HoldChange>,
}

/// A small change of what a switch holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoldChange {
    value: f64,
    pose: Pose,
}

/// The lists of a state in the order of a variation's.
fn lists(state: &State) -> [&Vec<f64>; 13] {
    let State { q, velocity, momentum, multipliers, constraint_momenta, strain_rates, .. } = state;
    let State { rate_leads, viscous, accelerations, .. } = state;
    let [newest, older, oldest] = &rate_leads.leads;
    [
        q,
        velocity,
        momentum,
        multipliers,
        constraint_momenta,
        strain_rates,
        newest,
        older,
        oldest,
        &viscous.rates,
        &viscous.at_start,
        &accelerations.of_coordinates,
        &accelerations.algorithmic,
    ]
}

fn lists_mut(state: &mut State) -> [&mut Vec<f64>; 13] {
    let State {
        q,
        velocity,
        momentum,
        multipliers,
        constraint_momenta,
        strain_rates,
        rate_leads,
        viscous,
        accelerations,
        ..
    } = state;
    let [newest, older, oldest] = &mut rate_leads.leads;
    [
        q,
        velocity,
        momentum,
        multipliers,
        constraint_momenta,
        strain_rates,
        newest,
        older,
        oldest,
        &mut viscous.rates,
        &mut viscous.at_start,
        &mut accelerations.of_coordinates,
        &mut accelerations.algorithmic,
    ]
}

impl Variation {
    fn lists(&self) -> [&Vec<f64>; 13] {
        let Self {
            q,
            velocity,
            momentum,
            multipliers,
            constraint_momenta,
            strain_rates: rates,
            rate_leads: [newest, older, oldest],
            viscous: [end, start],
            accelerations: [first, second],
            ..
        } = self;
        [
            q,
            velocity,
            momentum,
            multipliers,
            constraint_momenta,
            rates,
            newest,
            older,
            oldest,
            end,
            start,
            first,
            second,
        ]
    }

    fn lists_mut(&mut self) -> [&mut Vec<f64>; 13] {
        let Self {
            q,
            velocity,
            momentum,
            multipliers,
            constraint_momenta,
            strain_rates: rates,
            rate_leads: [newest, older, oldest],
            viscous: [end, start],
            accelerations: [first, second],
            ..
        } = self;
        [
            q,
            velocity,
            momentum,
            multipliers,
            constraint_momenta,
            rates,
            newest,
            older,
            oldest,
            end,
            start,
            first,
            second,
        ]
    }

    /// No change of `state`.
    pub fn set_zero(&mut self, state: &State) {
        for (own, list) in self.lists_mut().into_iter().zip(lists(state)) {
            own.clear();
            own.resize(list.len(), 0.0);
        }
        self.holds.clear();
        self.holds.resize(state.prescribed.holds.len(), HoldChange { value: 0.0, pose: Pose::zero() });
    }

    /// Changes `state` by `factor` times this; its triads belong to its tangents. What is prescribed, and what hosts want, is the caller's.
    /// `frames` is scratch memory.
    pub fn apply(&self, system: &System, factor: f64, state: &mut State, frames: &mut FrameCache) {
        for (list, own) in lists_mut(state).into_iter().zip(self.lists()) {
            for (value, change) in list.iter_mut().zip(own) {
                *value += factor * change;
            }
        }
        for (hold, change) in state.prescribed.holds.iter_mut().zip(&self.holds) {
            hold.value += factor * change.value;
            hold.pose.place += change.pose.place * factor;
            hold.pose.axes += change.pose.axes * factor;
        }
        follow(system, state, frames);
    }

    /// Adds `weight` times what lies between `from` and `to`, two states of one system that are near each other.
    pub fn add_between(&mut self, system: &System, weight: f64, from: &State, to: &State) {
        for ((own, from), to) in self.lists_mut().into_iter().zip(lists(from)).zip(lists(to)) {
            for ((own, from), to) in own.iter_mut().zip(from).zip(to) {
                *own += weight * (to - from);
            }
        }
        let holds = from.prescribed.holds.iter().zip(&to.prescribed.holds);
        for (own, (from, to)) in self.holds.iter_mut().zip(holds) {
            own.value += weight * (to.value - from.value);
            own.pose.place += (to.pose.place - from.pose.place) * weight;
            own.pose.axes += (to.pose.axes - from.pose.axes) * weight;
        }
        for (node, (from, to)) in system.mesh.framed.iter().zip(from.triads.iter().zip(&to.triads)) {
            self.q[node + THETA] += weight * turn_between(from, to);
        }
    }
}

/// Lets triads, holonomy angles, rotation vectors and relative coordinates follow the coordinates of `state`, which have been changed a little. `frames` is scratch memory.
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
    f64::atan2(carried.u.cross(&to.u).dot(&to.t), carried.u.dot(&to.u))
}
