//! Equilibria on a finer mesh, each found from the one that a run of the same model with half the elements has found.
//!
//! A run of its own could take another branch at a bifurcation, since the errors of its mesh decide which. Here the
//! coarser run goes along, finds every increment, and Newton settles its shape on the finer mesh where a row is wanted.

use super::runner::Runner;
use super::solver::Solver;
use super::{Simulation, failure, wrong};
use crate::fmi::{Failure, Model};
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::run::levels::Override;

impl Simulation {
    /// Builds the same equilibria with `changes` that double elements, to be found from those of this run, which runs
    /// along once more. With friction of contacts they have a way of their own: where it sticks depends on the mesh.
    ///
    /// # Errors
    /// The changed file makes no model.
    pub fn repeated_at_rest(&self, changes: Vec<Override>) -> Result<Self, Failure> {
        let mut other = self.repeated(changes, None)?;
        if self.system().has_contact_friction() {
            return Ok(other);
        }
        other.guide = Some(Box::new(self.afresh()?));
        Ok(other)
    }

    /// This run before its initialization.
    fn afresh(&self) -> Result<Self, Failure> {
        let mut own = Self::of(Document::clone(&self.document), self.overrides.clone())?;
        own.guide = self.guide.as_ref().map(|guide| guide.afresh().map(Box::new)).transpose()?;
        own.is_compared = true;
        own.leads = true;
        own.runner.is_guide = true;
        Ok(own)
    }

    /// Brings `runner` to its first equilibrium along the guide; false where there is none.
    pub(super) fn start_along_guide(&mut self, runner: &mut Runner, start: f64) -> Result<bool, Failure> {
        let responds = self.table.needs_response();
        let Some(guide) = &mut self.guide else { return Ok(false) };
        guide.inputs.set_parts(self.inputs.parts());
        guide.initialize(start)?;
        self.warnings.append(&mut guide.warnings);
        runner.set_up(&self.document, responds).map_err(|error| failure(&error))?;
        runner.settle_on(&guide.runner.system, &guide.runner.state, true)?;
        Ok(true)
    }

    /// Advances to `end`, s, by steps of its own or along the guide.
    pub(super) fn go_to(&mut self, end: f64) -> Result<(), Failure> {
        let Some(guide) = &mut self.guide else {
            return self.runner.advance(end, &self.table, self.between.as_deref_mut()).map_err(|error| failure(&error));
        };
        guide.inputs.set_parts(self.inputs.parts());
        guide.advance(end)?;
        self.warnings.append(&mut guide.warnings);
        self.runner.settle_on(&guide.runner.system, &guide.runner.state, false)
    }
}

impl Runner {
    /// Takes the shape of `from`, an equilibrium of `coarse`, and settles; the first one follows from none.
    pub(super) fn settle_on(&mut self, coarse: &System, from: &State, is_first: bool) -> Result<(), Failure> {
        let Self { system, state, solver: Solver::Statics(statics), .. } = self else { return Ok(()) };
        let before = (!is_first).then(|| state.clone());
        if !system.take_shape(state, coarse, from) {
            return Err(wrong(String::from("the finer mesh does not divide the elements of the coarser one")));
        }
        statics.settle_after(system, before.as_ref(), state).map_err(|error| failure(&error))
    }
}
