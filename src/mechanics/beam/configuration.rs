//! Beams at one instant, and how they pass through it: what every element computes from.

use super::ancf14::frame::NodeFrame;
use super::ancf14::over_step::EndStrains;
use crate::math::jet::Jet;
use crate::mechanics::input::heat::Heat;

/// Beams at one instant: all that their elements and nodes compute from.
#[derive(Clone, Copy, Debug)]
pub struct BeamConfiguration<'a> {
    /// All coordinates.
    pub q: &'a [f64],
    /// Frames at `q` of all nodes that have one: ANCF14's.
    pub frames: &'a [NodeFrame],
    /// Holonomy angles of all elements that have one at the last accepted state, rad.
    pub holonomy: &'a [f64],
    /// Temperatures of beams.
    pub heats: &'a [Heat],
    /// Values of all drives: those of winches are lengths that have been paid out, m.
    pub drives: &'a [Jet],
}

/// How the system passes through the configuration in which its forces are taken, `C`: that of the beams for elements.
#[derive(Clone, Copy, Debug)]
pub enum Passage<'a, C = BeamConfiguration<'a>> {
    /// Not at all: an equilibrium.
    Rest,
    /// An equilibrium that Newton seeks, after this correction of all coordinates: the tangent depends on it (MECHANICS
    /// 7.12).
    Corrected(&'a [f64]),
    /// At an instant.
    Instant {
        /// Velocities of the coordinates, 1/s each.
        velocity: &'a [f64],
        /// What they change by with the coordinates, 1/s, for the tangent of material damping; 0: they are given.
        velocity_by_q: f64,
        /// What the tangent of material damping is for.
        purpose: Purpose,
        /// Rates of the strains as steps show them, in the order of [`TimeStep::strain_rates`], for material damping;
        /// none: they follow from the velocities.
        strain_rates: Option<&'a [f64]>,
    },
    /// Over a step whose middle is the configuration.
    Step(TimeStep<'a, C>),
}

/// What a tangent is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Purpose {
    /// Derivatives: it is exact.
    Derivatives,
    /// Newton's iteration, whose solution does not depend on it but for what the last correction leaves.
    Iteration,
}

/// A step in time, as the forces of its middle ask for it (MECHANICS 7.6).
#[derive(Clone, Copy, Debug)]
pub struct TimeStep<'a, C = BeamConfiguration<'a>> {
    /// Start of the step.
    pub start: &'a C,
    /// End of the step.
    pub end: &'a C,
    /// Change of the coordinates.
    pub increment: &'a [f64],
    /// Length of the step, s.
    pub duration: f64,
    /// Velocities of the coordinates at the start, 1/s each.
    pub velocity: &'a [f64],
    /// Numerical dissipation.
    pub dissipation: Dissipation,
    /// Rates of all strains and relative coordinates over the last step, as
    /// [`crate::mechanics::state::lists::Lists::strain_rates`].
    pub strain_rates: &'a [f64],
    /// The same as the velocities at the start let expect them: `State::rate_leads`.
    pub predicted_rates: &'a [f64],
    /// What elements with holonomy angles have at the start.
    pub starts: &'a [EndStrains],
    /// The velocities that accelerations are counted from less those at the start, 1/s each; empty: they are the same.
    pub velocity_lead: &'a [f64],
}

impl<C> TimeStep<'_, C> {
    /// The part of `rate` that was not predicted, weighted by `dissipation`; `rate` is that of a strain or a relative
    /// coordinate over the step, number `number` in
    /// [`Self::strain_rates`].
    #[inline]
    pub fn unpredicted(&self, rate: f64, number: usize) -> f64 {
        self.dissipation.unpredicted(rate, [self.strain_rates[number], self.predicted_rates[number]])
    }
}

/// How strains that are too fast for the step are damped (MECHANICS 7.6): what multiplies the part of the change of a
/// strain over a step that was not predicted, 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Dissipation {
    /// Not predicted by the rate over the last step, `chi`.
    pub by_last_step: f64,
    /// Not predicted by what alternates of the rates that the velocities at the start make, `psi`.
    pub by_start: f64,
}

impl Dissipation {
    /// Such that the amplitude of a strain that is infinitely fast for the step is multiplied by `spectral_radius` (0.6
    /// to 1) a step.
    pub fn new(spectral_radius: f64) -> Self {
        let (lost, square) = (1.0 - spectral_radius, (1.0 + spectral_radius).powi(2));
        Self { by_last_step: spectral_radius * lost / square, by_start: 0.5 * lost * lost / square }
    }

    /// Over a step of `step` s, where `largest` s is the largest one: as much for every step as for that one, so that
    /// both terms work as constant inertias. Steps of different lengths would pump energy otherwise.
    pub fn over(self, step: f64, largest: f64) -> Self {
        let weight = (largest / step).powi(2).max(1.0);
        Self { by_last_step: weight * self.by_last_step, by_start: weight * self.by_start }
    }

    /// The part of the rate `rate` of a strain that was not predicted by those over the last step and at the start,
    /// weighted.
    #[inline]
    pub fn unpredicted(self, rate: f64, [last, start]: [f64; 2]) -> f64 {
        self.by_last_step * (rate - last) + self.by_start * (rate - start)
    }

    /// Both together: how the weighted change depends on the change over the step.
    pub fn sum(self) -> f64 {
        self.by_last_step + self.by_start
    }
}
