//! One equilibrium as Newton sees it.

use super::Scratch;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::solve::newton::Problem;
use crate::solve::newton::kkt::Kkt;

/// A first correction by a fast tangent that is larger than `ABSURD` says nothing of the equilibrium. A slack rod
/// between clamps would turn many times, where its own stretching holds it after some degrees. The corrections are then
/// no larger than `CAUTIOUS`. Lengths over the system's size, slopes and angles in rad.
const ABSURD: f64 = 2.0;
const CAUTIOUS: f64 = 0.25;

/// The tangent of an iteration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Tangent {
    /// The derivative of the balance.
    Exact,
    /// The same until the first correction, then [`Self::OfCorrection`].
    Fast,
    /// With the axial forces that the last correction was to lead to (MECHANICS 7.12).
    OfCorrection,
}

/// The unknowns, and what they are in balance with.
pub(super) struct Equilibrium<'a> {
    pub(super) system: &'a System,
    pub(super) state: &'a State,
    pub(super) time: f64,
    pub(super) excitation: &'a Excitation,
    pub(super) motion: &'a Prescribed,
    pub(super) scratch: &'a mut Scratch,
    /// Which tangent an iteration has.
    pub(super) tangent: Tangent,
    /// Size of the first correction, as it was found; none: there is none yet.
    pub(super) first: Option<f64>,
}

impl<'a> Equilibrium<'a> {
    /// Sought from `state` on, under what is given: excitation and motion.
    pub(super) fn near(
        system: &'a System,
        state: &'a State,
        time: f64,
        (excitation, motion): (&'a Excitation, &'a Prescribed),
        scratch: &'a mut Scratch,
    ) -> Self {
        scratch.q.copy_from_slice(&state.q);
        scratch.multipliers.copy_from_slice(&state.multipliers);
        Self { system, state, time, excitation, motion, scratch, tangent: Tangent::Exact, first: None }
    }

    /// Minus the residual at the current unknowns, whose forces, frames and gradients are known, into `right`.
    pub(super) fn balance(&mut self, right: &mut [f64]) {
        let (system, state) = (self.system, self.state);
        let scratch = &mut *self.scratch;
        let configuration = system.configuration(&scratch.q, &scratch.frames, state, self.motion);
        system.constraint_conditions(&configuration, &mut scratch.conditions);
        let (residual, conditions) = right.split_at_mut(state.q.len());
        for (residual, force) in residual.iter_mut().zip(&scratch.forces) {
            *residual = -force;
        }
        system.add_constraint_forces(&scratch.gradients, &scratch.multipliers, -1.0, residual);
        for (target, condition) in conditions.iter_mut().zip(&scratch.conditions) {
            *target = -condition;
        }
    }
}

impl Problem for Equilibrium<'_> {
    fn undefined_law(&self) -> Option<String> {
        undefined_law(self.system, self.state, self.scratch, self.motion)
    }

    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64 {
        let (system, state) = (self.system, self.state);
        let scratch = &mut *self.scratch;
        let configuration = scratch.frames.at(system, &scratch.q, state, self.motion);
        let (forces, tangent) = (&mut scratch.forces, &mut kkt.blocks);
        let passage = match self.tangent {
            Tangent::Exact | Tangent::Fast => Passage::Rest,
            Tangent::OfCorrection => Passage::Corrected(right),
        };
        system.forces_and_tangent(&configuration, &passage, self.excitation, 1.0, forces, tangent);
        kkt.set_curvatures_and_gradients(system, &configuration, &scratch.multipliers, 1.0, &mut scratch.gradients);
        self.balance(right);
        kkt.set_constraints(system, &self.scratch.gradients, &self.scratch.gradients, 1.0);
        state.held.iter().for_each(|held| kkt.stiffen(held.index, held.stiffness));
        self.time
    }

    fn shortened(&mut self, size: f64) -> f64 {
        let first = *self.first.get_or_insert(size);
        if self.tangent == Tangent::Exact || first <= ABSURD { size } else { size.min(CAUTIOUS) }
    }

    fn correct(&mut self, correction: &[f64]) {
        if self.tangent == Tangent::Fast {
            self.tangent = Tangent::OfCorrection;
        }
        let (coordinates, multipliers) = correction.split_at(self.scratch.q.len());
        for (value, correction) in self.scratch.q.iter_mut().zip(coordinates) {
            *value += correction;
        }
        for (value, correction) in self.scratch.multipliers.iter_mut().zip(multipliers) {
            *value += correction;
        }
    }
}

/// The law that has no value at the unknowns of `scratch`, in words.
pub(super) fn undefined_law(system: &System, state: &State, scratch: &Scratch, motion: &Prescribed) -> Option<String> {
    let configuration = system.configuration(&scratch.q, &scratch.frames, state, motion);
    system.undefined_law(&configuration, |_, _| 0.0)
}
