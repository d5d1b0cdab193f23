//! Accelerations and multipliers at the instant of the state, also where no output asks for them.

use super::Simulation;
use super::runner::Runner;
use crate::mechanics::marker::configuration::Passage;
use crate::solve::step::response::{Responder, Response};

impl Simulation {
    /// Sets `response` to accelerations and multipliers at the instant of the state, which `responder` computes where
    /// no output has asked for them. Returns whether there are such: not before the start, nor where joints are
    /// redundant.
    pub fn respond(&self, responder: &mut Option<Responder>, response: &mut Response) -> bool {
        let Runner { system, state, solver, .. } = &self.runner;
        if !self.runner.is_initialized() {
            return false;
        }
        if self.table.needs_response() {
            response.clone_from(&self.runner.response);
            return true;
        }
        let responder = responder.get_or_insert_with(|| Responder::new(system));
        solver.respond(responder, system, state, response).is_ok()
    }

    /// How the system passes through its state: an equilibrium does not move.
    pub fn passage(&self) -> Passage<'_> {
        self.table.passage(&self.runner.state)
    }
}
