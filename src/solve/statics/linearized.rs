//! Equilibria as functions of what acts: the derivatives of their unknowns.

use super::Statics;
use super::equilibrium::{Equilibrium, Tangent};
use crate::error::Error;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::solve::linear::Singular;
use crate::solve::newton::Problem;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::linearized::{Linearized, Span};

impl Statics {
    /// The equilibrium of the time of `state` under what the host wants there, at given unknowns.
    fn at<'a>(&'a mut self, system: &'a System, state: &'a State, unknowns: &[f64]) -> (Equilibrium<'a>, &'a mut Kkt) {
        let time = state.instant();
        system.excite(time, &state.targets, &mut self.current);
        self.current_motion.copy_from(&state.prescribed);
        self.current_motion.stop();
        let (q, multipliers) = unknowns.split_at(state.q.len());
        self.scratch.q.copy_from_slice(q);
        self.scratch.multipliers.copy_from_slice(multipliers);
        let (excitation, motion) = (&self.current, &self.current_motion);
        let scratch = &mut self.scratch;
        (
            Equilibrium { system, state, time, excitation, motion, scratch, tangent: Tangent::Exact, first: None },
            &mut self.kkt,
        )
    }
}

impl Linearized for Statics {
    /// An equilibrium depends on what acts, not on the way to it.
    const MEMORY: bool = false;
    const PROJECTS: bool = false;

    fn unknowns(&self, after: &State, unknowns: &mut Vec<f64>) {
        unknowns.clear();
        unknowns.extend(after.q.iter().chain(&after.multipliers));
    }

    fn factorize(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64]) -> Result<(), Error> {
        let mut right = std::mem::take(&mut self.right);
        let (mut problem, kkt) = self.at(system, state, unknowns);
        problem.linearize(kkt, &mut right);
        self.right = right;
        self.kkt.factorize(system, span.end)
    }

    fn solve(&mut self, right: &mut [f64]) -> Result<(), Singular> {
        self.kkt.solve_again(right)
    }

    fn balance(&mut self, system: &System, state: &State, _span: Span, unknowns: &[f64], right: &mut [f64]) {
        let (mut problem, _) = self.at(system, state, unknowns);
        let scratch = &mut *problem.scratch;
        let configuration = scratch.frames.at(system, &scratch.q, state, problem.motion);
        system.forces(&configuration, &Passage::Rest, problem.excitation, &mut scratch.forces);
        system.constraint_gradients(&configuration, &mut scratch.gradients);
        problem.balance(right);
    }

    fn conclude(&mut self, system: &System, state: &State, _span: Span, unknowns: &[f64], next: &mut State) {
        let (q, multipliers) = unknowns.split_at(state.q.len());
        next.clone_from(state);
        next.multipliers.copy_from_slice(multipliers);
        self.scratch.frames.set(system, q, &next.triads);
        system.arrive(next, (q, &self.scratch.frames, &state.prescribed), None);
    }
}
