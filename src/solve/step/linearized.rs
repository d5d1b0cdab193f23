//! A step in time that can be differentiated: its unknowns, its residual and its tangent.

use super::integrator::Integrator;
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::solve::linear::Singular;

/// The time of an internal step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Its length, s.
    pub step: f64,
    /// Its end, s.
    pub end: f64,
}

/// An integrator whose steps can be differentiated.
pub trait Linearized: Integrator {
    /// Whether a step depends on the state before it.
    const MEMORY: bool;
    /// Whether velocities at the end follow from momenta by projection on the constraints.
    const PROJECTS: bool;

    /// The unknowns that the last step ended with, at the state `after`.
    fn unknowns(&self, after: &State, unknowns: &mut Vec<f64>);

    /// Factorizes the tangent of a step from `state` at given unknowns.
    ///
    /// # Errors
    /// It is singular.
    fn factorize(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64]) -> Result<(), Error>;

    /// Solves in place with that tangent.
    ///
    /// # Errors
    /// The solution is not accurate.
    fn solve(&mut self, right: &mut [f64]) -> Result<(), Singular>;

    /// Sets `right` to minus the residual of a step from `state` at given unknowns.
    fn balance(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], right: &mut [f64]);

    /// Sets `next` to the end of a step from `state` with given unknowns, before its velocities are projected.
    fn conclude(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], next: &mut State);
}
