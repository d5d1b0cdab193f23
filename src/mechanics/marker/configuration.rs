//! The system at one instant, and how it passes through it: what joints, springs, loads and sensors compute from.

use crate::mechanics::beam::configuration::{self as beams, BeamConfiguration, Purpose};
use crate::mechanics::beam::mesh::Mesh;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::state::State;

/// The system at one instant.
#[derive(Clone, Copy, Debug)]
pub struct Configuration<'a> {
    /// All coordinates, and what elements and nodes know besides.
    pub beams: BeamConfiguration<'a>,
    /// Values of all relative coordinates at the last accepted state: angles go on from there.
    pub relative_values: &'a [f64],
    /// All coordinates and what was prescribed at the last accepted state.
    pub accepted: (&'a [f64], &'a Prescribed),
    /// What forces remember since the last accepted state.
    pub memory: &'a [f64],
    /// What drives and moving frames prescribe.
    pub prescribed: &'a Prescribed,
    /// All nodes and elements.
    pub mesh: &'a Mesh,
}

impl Configuration<'_> {
    /// The last accepted state, of which positions alone are known: no frames.
    pub fn accepted(&self) -> Self {
        let (q, prescribed) = self.accepted;
        let BeamConfiguration { holonomy, .. } = self.beams;
        let beams =
            BeamConfiguration { q, frames: &[], holonomy, heats: &prescribed.heats, drives: &prescribed.drives };
        Self { beams, prescribed, ..*self }
    }
}

/// How the system passes through the configuration in which its forces are taken.
pub type Passage<'a> = beams::Passage<'a, Configuration<'a>>;

/// A step of the system in time.
pub type TimeStep<'a> = beams::TimeStep<'a, Configuration<'a>>;

impl<'a> Passage<'a> {
    /// Through a state in motion.
    pub fn of(state: &'a State) -> Self {
        let (velocity, strain_rates) = (&state.velocity, state.known_viscous_rates());
        Self::Instant { velocity, velocity_by_q: 0.0, purpose: Purpose::Derivatives, strain_rates }
    }

    /// At an instant whose motion is all in the velocities of the coordinates.
    pub fn with_velocity(velocity: &'a [f64]) -> Self {
        Self::with_velocity_by_q(velocity, 0.0, Purpose::Derivatives)
    }

    /// The same where the velocities change by `velocity_by_q` with the coordinates, 1/s.
    pub fn with_velocity_by_q(velocity: &'a [f64], velocity_by_q: f64, purpose: Purpose) -> Self {
        Self::Instant { velocity, velocity_by_q, purpose, strain_rates: None }
    }

    /// As elements see it.
    pub fn of_beams(&self) -> beams::Passage<'a> {
        match self {
            Self::Rest => beams::Passage::Rest,
            Self::Corrected(correction) => beams::Passage::Corrected(correction),
            &Self::Instant { velocity, velocity_by_q, purpose, strain_rates } => {
                beams::Passage::Instant { velocity, velocity_by_q, purpose, strain_rates }
            }
            Self::Step(step) => beams::Passage::Step(step.of_beams()),
        }
    }
}

impl<'a> TimeStep<'a> {
    /// As elements see it.
    pub fn of_beams(&self) -> beams::TimeStep<'a> {
        let Self {
            start, end, increment, duration, velocity, dissipation, strain_rates, predicted_rates, starts, ..
        } = *self;
        let velocity_lead = self.velocity_lead;
        let (start, end) = (&start.beams, &end.beams);
        beams::TimeStep {
            start,
            end,
            increment,
            duration,
            velocity,
            dissipation,
            strain_rates,
            predicted_rates,
            starts,
            velocity_lead,
        }
    }
}
