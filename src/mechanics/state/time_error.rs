//! The error of a motion that the lengths of its steps have caused, carried along as plain data (MECHANICS 7.8).

use serde::{Deserialize, Serialize};

/// The exact motion minus the computed one, to first order; lists are empty before the first step. Coordinates are
/// those of the charts of the state that this is part of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TimeError {
    /// Of the coordinates: m, 1, rad.
    pub position: Vec<f64>,
    /// Of their velocities, 1/s each.
    pub velocity: Vec<f64>,
    /// Mean rates of `position` over the last step, 1/s each; empty without material damping, whose forces follow from
    /// them.
    pub rates: Vec<f64>,
    /// Mean of the error's own acceleration over the last step, 1/s² each: what the next step starts from.
    pub acceleration: Vec<f64>,
    /// Of the multipliers, N or N m.
    pub multipliers: Vec<f64>,
    /// Third derivatives of the coordinates of the motion between the middles of its last two steps, 1/s³ each.
    pub jerk: Vec<f64>,
    /// Fourth derivatives, likewise a step earlier than the last third ones, 1/s⁴ each.
    pub snap: Vec<f64>,
    /// Of the relative coordinates that forces depend on; 0 of all others.
    pub relative: Vec<Passed>,
    /// Length of the last step, s.
    pub step: f64,
    /// How many steps lie behind since the start or the last jump, up to 3: as many derivatives of the acceleration are
    /// known.
    pub known: u8,
}

/// How a relative coordinate has gone through the last steps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Passed {
    /// Its mean rate over the last step, m/s or rad/s.
    pub rate: f64,
    /// Its acceleration between the middles of the last two steps, m/s² or rad/s².
    pub acceleration: f64,
    /// The force of laws on it over the last step, N or N m, and its first two derivatives by time, from differences
    /// likewise.
    pub forces: [f64; 3],
}

impl TimeError {
    /// No error yet, of a system with `coordinates` coordinates, `conditions` conditions and `relative` relative
    /// coordinates.
    pub fn resize(&mut self, coordinates: usize, conditions: usize, relative: usize) {
        self.relative.resize(relative, Passed::default());
        let Self { position, velocity, acceleration, multipliers, jerk, snap, .. } = self;
        for list in [position, velocity, acceleration, jerk, snap] {
            list.resize(coordinates, 0.0);
        }
        multipliers.resize(conditions, 0.0);
    }

    /// Whether there is an estimate: of integrators that carry one, after the first step.
    pub fn is_known(&self) -> bool {
        !self.position.is_empty()
    }

    /// Whether it may be one of a system with `coordinates` coordinates, `conditions` conditions and `relatives`
    /// relative coordinates.
    pub fn is_possible(&self, coordinates: usize, conditions: usize, relatives: usize) -> bool {
        let Self { position, velocity, rates, acceleration, multipliers, jerk, snap, relative, step, known } = self;
        let lists = [position, velocity, acceleration, jerk, snap].map(Vec::len);
        let is_there = lists == [coordinates; 5] && multipliers.len() == conditions && relative.len() == relatives;
        let is_empty = lists == [0; 5] && multipliers.is_empty() && relative.is_empty() && *known == 0;
        let may_be_rates = rates.is_empty() || rates.len() == coordinates;
        (is_there || is_empty) && may_be_rates && step.is_finite() && *step >= 0.0 && *known <= 3
    }

    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        self.position.clone_from(&other.position);
        self.velocity.clone_from(&other.velocity);
        self.rates.clone_from(&other.rates);
        self.acceleration.clone_from(&other.acceleration);
        self.multipliers.clone_from(&other.multipliers);
        self.jerk.clone_from(&other.jerk);
        self.snap.clone_from(&other.snap);
        self.relative.clone_from(&other.relative);
        (self.step, self.known) = (other.step, other.known);
    }
}
