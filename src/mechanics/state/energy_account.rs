//! The account of a motion: its energy changes by the work of loads, actuators and drives, by what dampers take, and by
//! the drift, which is the integrator's.
//!
//! `energy.total(t) − energy.total(0) = loads + actuators + drives + fluids − dissipated + drift`, summed over the
//! steps as they take their forces.

use serde::{Deserialize, Serialize};

/// Work by its origin, J; power, W.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Work {
    /// By loads.
    pub loads: f64,
    /// By actuators.
    pub actuators: f64,
    /// By drives and moving frames, through joints and springs.
    pub drives: f64,
    /// Taken by dampers, friction, stops and material damping.
    pub dissipated: f64,
    /// Done by water and air: buoyancy, drag, and the inertia of what moves with beams.
    pub fluids: f64,
}

impl Work {
    /// What it changes the energy by.
    pub fn sum(&self) -> f64 {
        self.loads + self.actuators + self.drives + self.fluids - self.dissipated
    }

    /// Adds `factor` times another one.
    pub fn add(&mut self, other: &Self, factor: f64) {
        self.loads += factor * other.loads;
        self.actuators += factor * other.actuators;
        self.drives += factor * other.drives;
        self.dissipated += factor * other.dissipated;
        self.fluids += factor * other.fluids;
    }
}

/// The account since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EnergyAccount {
    /// The work so far.
    pub work: Work,
    /// What the integrator has added, J; it has taken what is negative.
    pub drift: f64,
    /// Kinetic, elastic and gravity energy at the end of the last step, J; none before the first step, and after a
    /// change of stiffnesses.
    pub energy: Option<f64>,
    /// The power at the end of the last step, W; of integrators that take forces at instants.
    pub power: Work,
}
