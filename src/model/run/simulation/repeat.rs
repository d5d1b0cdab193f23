//! Runs of one model that are compared row by row: the same file with finer steps, and with other numbers of elements.

use super::Simulation;
use super::runner::Runner;
use crate::fmi::Failure;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::accuracy::{Differences, Inexact};
use crate::model::run::finer::Finer;
use crate::model::run::levels::{self, Override};
use crate::solve::step::course::Course;

impl Simulation {
    /// Notes the ends of the steps, from the next initialization on.
    pub fn note_steps(&mut self) {
        self.runner.ends = Some(Vec::new());
    }

    /// The longest of the steps that have been noted, s; none: there are none.
    pub fn longest_step(&self) -> Option<f64> {
        let ends = self.runner.ends.as_deref()?;
        let begins = std::iter::once(self.runner.start).chain(ends.iter().copied());
        begins.zip(ends).map(|(begin, end)| end - begin).reduce(f64::max)
    }

    /// Builds the same model with `changes`, not initialized, whose motion follows the steps of this run, each divided
    /// into `parts`; none: the steps follow from the file. It notes its own steps, and leaves it to its user to warn of
    /// errors that a comparison of the runs shows.
    ///
    /// # Errors
    /// The changed file makes no model.
    pub fn repeated(&self, changes: Vec<Override>, parts: Option<u32>) -> Result<Self, Failure> {
        let is_same_mesh = changes.is_empty();
        let overrides = levels::merged(&self.document.remaining(&self.overrides), changes.clone());
        let document = levels::changed(&self.document, &self.overrides, changes).ok_or_else(|| {
            let message = String::from("the model file with finer steps or meshes cannot be read");
            super::wrong(message)
        })?;
        let mut other = Self::of(document, overrides)?;
        if is_same_mesh {
            other.mesh_known.clone_from(&self.mesh_known);
            // The comparison beside a coarse run has errors of its steps too: a warning needs the finer steps.
            if self.mesh_known.1.is_some() {
                other.placement.clone_from(&self.placement);
            }
        }
        other.is_compared = true;
        other.judged.clone_from(&self.judged);
        other.note_steps();
        let ends = self.runner.ends.as_deref().unwrap_or_default();
        other.runner.course = parts.map(|parts| Course::divided(self.runner.start, ends, parts));
        Ok(other)
    }

    /// Builds the same model with `changes`, not initialized, as the first of its runs.
    ///
    /// # Errors
    /// The changed file makes no model.
    pub fn begun_anew(&self, changes: Vec<Override>) -> Result<Self, Failure> {
        let mut other = self.repeated(changes, None)?;
        other.is_compared = self.is_compared;
        other.placement.clone_from(&self.placement);
        Ok(other)
    }

    /// The number of elements of all beams.
    pub fn elements(&self) -> usize {
        self.document.beams.iter().map(|beam| levels::elements(&self.document, beam)).sum()
    }

    /// All results of the row that is reached, as users get them.
    pub fn results(&self) -> &[f64] {
        &self.results
    }

    /// Includes how far the row that is reached is from that of another run.
    pub fn compare(&self, other: &[f64], differences: &mut Differences) {
        differences.include(&self.columns, &self.results, other);
    }

    /// Leaves the mesh error of this run, not initialized yet, to a comparison of its rows.
    pub fn leave_mesh_error(&mut self) {
        self.is_compared = true;
        self.placement = None;
    }

    /// The same mechanism on a mesh twice as fine; none if a beam has no such mesh.
    pub fn twice_as_fine(&self) -> Option<Finer> {
        Finer::new(&self.document, &self.overrides, self.runner.start)
    }

    /// Includes how far the equilibrium that is reached is from the nearest one of `finer`, and returns whether both
    /// are stable, or both are not; none where that is not known.
    pub fn compare_nearest(&self, finer: &mut Finer, differences: &mut Differences) -> Option<bool> {
        let settled = finer.settled(&self.runner.system, &self.runner.state).ok()??;
        differences.include(&self.columns, &self.results, &finer.results(&settled));
        let Runner { system, state, .. } = &self.runner;
        // Where forces have no potential, the stiffness does not decide.
        let is_decided = !system.follows_no_potential(&state.excitation);
        Some(!is_decided || finer.is_unstable(&settled) == self.is_unstable_at(state))
    }

    /// How far this run and another one are apart, a family of judged results each, as shares of what it is compared
    /// with, over the `divisor` of a family by its name and whether it is a configuration.
    pub fn distances(&self, differences: &Differences, divisor: impl Fn(&str, bool) -> f64) -> Vec<Inexact> {
        let pair = (differences, self.document.simulation.analysis == Analysis::Dynamic);
        let mut found = self.accuracy.errors_of_pair(&self.columns, &self.measures(), pair, divisor);
        found.retain(|own| self.is_judged(own));
        found
    }

    /// The estimated errors of judged results because of the steps, and because of the mesh.
    pub fn judged_errors(&self) -> [Vec<Inexact>; 2] {
        let judged = |errors: Vec<Inexact>| errors.into_iter().filter(|own| self.is_judged(own)).collect();
        [judged(self.estimated_errors()), judged(self.mesh_errors.clone())]
    }

    /// Whether all judged results are zero but for round-off: finer steps and meshes change nothing.
    pub fn is_at_rest(&self) -> bool {
        let none = vec![0.0; self.results.len()];
        let judged = self.accuracy.errors_of_mesh(&self.columns, &self.measures(), &none);
        judged.iter().all(|own| !self.is_judged(own))
    }

    /// Whether the run was warned of a mesh that may be too coarse.
    pub fn doubts_mesh(&self) -> bool {
        self.watch.doubts_mesh()
    }

    /// The cost of the run so far, in steps times elements.
    pub fn cost(&self) -> f64 {
        let elements = self.runner.system.mesh.elements.len().max(1);
        self.tried_steps() as f64 * elements as f64
    }

    /// The cost of finding so many equilibria again on a mesh twice as fine, as [`Self::cost`] counts.
    pub fn cost_of_finer(&self, equilibria: u64) -> f64 {
        2.0 * self.runner.system.mesh.elements.len() as f64 * equilibria as f64
    }
}
