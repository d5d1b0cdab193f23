//! What changes in time, as plain data: to save, restore and repeat is to clone this.

pub mod energy_account;
pub mod energy_balance;
pub mod lists;
pub mod pace;
pub mod path_point;
pub mod place;
pub mod rate_leads;
pub mod time_error;
pub mod viscous_rates;

use self::energy_balance::EnergyBalance;
use self::lists::Lists;
use self::pace::Pace;
use self::path_point::PathPoint;
use self::time_error::TimeError;
use crate::math::Vec3;
use crate::mechanics::geometry::triad::Triad;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::host_motion::Targets;
use crate::mechanics::input::prescribed::Prescribed;
use serde::{Deserialize, Serialize};
use std::ops::{Deref, DerefMut};

/// Everything that persists from one step to the next.
#[derive(Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct State {
    /// Time, s.
    pub time: f64,
    /// Lists of numbers, which small changes add to.
    pub lists: Lists,
    /// What a midpoint step starts its iteration from.
    pub prediction: Prediction,
    /// What the lengths of the steps have done to it.
    pub time_error: TimeError,
    /// How long its next step is, where the solver chooses it.
    pub pace: Pace,
    /// Length of the last step that [`Lists::viscous_rates`] were continued over, s; 0 before the first one and behind
    /// a jump.
    pub viscous_step: f64,
    /// Reference triads of the nodes.
    pub triads: Vec<Triad>,
    /// Holonomy angles of the elements, rad: the branch that the next one continues.
    pub holonomy: Vec<f64>,
    /// Values of the relative coordinates: the turns that the next ones continue, m or rad.
    pub relative_values: Vec<f64>,
    /// What drives and moving frames prescribe at `time`.
    pub prescribed: Prescribed,
    /// What a host wants drives and frames to reach.
    pub targets: Targets,
    /// What acted from outside at the last equilibrium: where a jump of loads starts from. Nothing yet: empty.
    pub excitation: Excitation,
    /// Where the path is that is followed by its arc length, which is then the time; none: functions of time are taken
    /// at `time`.
    pub path: Option<PathPoint>,
    /// Coordinates that a free motion would change, held at their values by the statics.
    pub held: Vec<HeldCoordinate>,
    /// Rotation vectors of the sensors from the orientation as drawn, rad, continued over turns.
    pub rotations: Vec<Vec3>,
    /// Steps are `2^-halving` of the step size.
    pub halving: u32,
    /// Whole steps since the last change of `halving`.
    pub good_steps: u32,
    /// Energy against work since the start.
    pub balance: EnergyBalance,
    /// Counts since the start.
    pub statistics: Statistics,
}

impl State {
    /// Stops everything: parts, drives and frames. Nothing is held.
    pub fn stop(&mut self) {
        self.velocity.fill(0.0);
        self.prescribed.stop();
        self.held.clear();
    }

    /// The `t` that functions of time are taken at: the time, or the parameter of a path, s.
    pub fn instant(&self) -> f64 {
        self.path.as_ref().map_or(self.time, |path| path.parameter)
    }

    /// Whether all its lists are as long as those of another state of the same system.
    pub fn has_the_shape_of(&self, other: &Self) -> bool {
        let lengths = |state: &Self| {
            let Self { triads, holonomy, relative_values, rotations, prescribed, targets, .. } = state;
            let lists = [holonomy, relative_values].map(Vec::len);
            let motions =
                [prescribed.drives.len(), prescribed.frames.len(), targets.drives.len(), targets.frames.len()];
            let switches = [prescribed.holds.len(), targets.switches.len()];
            let departure = [targets.departure.drives.len(), targets.departure.frames.len()];
            let given = [targets.loads.len(), targets.efforts.len()];
            let heats = [prescribed.heats.len(), targets.heats.len(), targets.departure.heats.len()];
            (lists, triads.len(), rotations.len(), motions, switches, given, heats, departure)
        };
        // Nothing yet, or all of them.
        let optional = |list: usize, whole: usize| list == 0 || list == whole;
        lengths(self) == lengths(other)
            && self.lists.has_the_shape_of(&other.lists)
            && self.viscous_step.is_finite()
            && self.viscous_step >= 0.0
            && self.balance.account.is_some() == other.balance.account.is_some()
            && self.prediction.is_possible(other.q.len())
            && self.time_error.is_possible(other.q.len(), other.multipliers.len(), other.relative_values.len())
            && self.pace.is_possible(other.q.len())
            && optional(self.excitation.wrenches.len(), other.targets.loads.len())
            && optional(self.excitation.stations.len(), other.targets.loads.len())
            && optional(self.excitation.efforts.len(), other.targets.efforts.len())
            && self.held.iter().all(|held| held.index < other.q.len() && held.stiffness > 0.0)
            && self.path.as_ref().is_none_or(|path| path.tangent.len() == other.q.len() + 1)
    }
}

impl Deref for State {
    type Target = Lists;

    fn deref(&self) -> &Lists {
        &self.lists
    }
}

impl DerefMut for State {
    fn deref_mut(&mut self) -> &mut Lists {
        &mut self.lists
    }
}

impl Clone for State {
    fn clone(&self) -> Self {
        Self {
            lists: self.lists.clone(),
            prediction: self.prediction.clone(),
            time_error: self.time_error.clone(),
            pace: self.pace.clone(),
            triads: self.triads.clone(),
            holonomy: self.holonomy.clone(),
            relative_values: self.relative_values.clone(),
            prescribed: self.prescribed.clone(),
            targets: self.targets.clone(),
            excitation: self.excitation.clone(),
            path: self.path.clone(),
            held: self.held.clone(),
            rotations: self.rotations.clone(),
            ..*self
        }
    }

    /// Keeps the memory that is there: a step that makes a backup must not allocate.
    fn clone_from(&mut self, source: &Self) {
        self.copy_motion_from(source);
        self.prediction.copy_from(&source.prediction);
        self.time_error.copy_from(&source.time_error);
    }
}

impl State {
    /// Takes the motion of `source`, keeping its own memory: all but the prediction of the next step and the error of
    /// those before, which a state beside the computed motion does without.
    pub fn copy_motion_from(&mut self, source: &Self) {
        let Self { triads, holonomy, relative_values, rotations, .. } = self;
        self.time = source.time;
        self.viscous_step = source.viscous_step;
        self.lists.clone_from(&source.lists);
        triads.clone_from(&source.triads);
        holonomy.clone_from(&source.holonomy);
        relative_values.clone_from(&source.relative_values);
        rotations.clone_from(&source.rotations);
        self.pace.copy_from(&source.pace);
        self.prescribed.copy_from(&source.prescribed);
        self.targets.copy_from(&source.targets);
        self.excitation.copy_from(&source.excitation);
        self.path.clone_from(&source.path);
        self.held.clone_from(&source.held);
        self.halving = source.halving;
        self.good_steps = source.good_steps;
        self.balance = source.balance;
        self.statistics = source.statistics;
    }
}

/// A coordinate that the statics hold: it stands for a motion that takes no load and costs no energy.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct HeldCoordinate {
    /// Its index.
    pub index: usize,
    /// What the tangent has more on its diagonal, J per square of the coordinate's unit; the residual has no term of
    /// it.
    pub stiffness: f64,
}

/// What a midpoint step starts its iteration from, and how its corrections are expected to shrink.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Prediction {
    /// Mean accelerations of the coordinates over the last step, 1/s² each; empty before the first.
    pub acceleration: Vec<f64>,
    /// Those of the step before; empty before the second.
    pub acceleration_before: Vec<f64>,
    /// How many of both are known, 0 to 2.
    pub known: u8,
    /// How many of both predicted the last step best.
    pub order: u8,
    /// How the first two corrections of a step are expected to shrink.
    pub shrinking: Shrinking,
}

/// How the first two corrections of an iteration shrank.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Shrinking {
    /// Size of the first one.
    pub first: f64,
    /// Size of the second one over that of the first.
    pub ratio: f64,
}

impl Default for Shrinking {
    /// Nothing is known: corrections may not shrink at all.
    fn default() -> Self {
        Self { first: 0.0, ratio: 1.0 }
    }
}

impl Prediction {
    /// Whether it may be one of a system with `coordinates` coordinates.
    fn is_possible(&self, coordinates: usize) -> bool {
        let Self { acceleration, acceleration_before, known, order, shrinking: Shrinking { first, ratio } } = self;
        let is_there = |list: &[f64], number: u8| list.len() == coordinates || (list.is_empty() && *known < number);
        let is_size = |value: f64| value.is_finite() && value >= 0.0;
        is_there(acceleration, 1)
            && is_there(acceleration_before, 2)
            && (*known <= 2 && order <= known)
            && (is_size(*first) && is_size(*ratio))
    }

    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.acceleration.clone_from(&other.acceleration);
        self.acceleration_before.clone_from(&other.acceleration_before);
        (self.known, self.order, self.shrinking) = (other.known, other.order, other.shrinking);
    }
}

/// Counts since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: u64,
    /// Newton iterations, of rejected steps too.
    pub iterations: u64,
    /// Rejected steps.
    pub rejected: u64,
}

impl Statistics {
    /// The counts since `before`.
    pub fn since(self, before: Self) -> Self {
        Self {
            steps: self.steps.saturating_sub(before.steps),
            iterations: self.iterations.saturating_sub(before.iterations),
            rejected: self.rejected.saturating_sub(before.rejected),
        }
    }
}
