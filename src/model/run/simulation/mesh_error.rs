//! The error of equilibria because of the mesh, found at the end of a run.

use super::Simulation;
use super::runner::Runner;
use crate::mechanics::state::State;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::accuracy::Inexact;
use crate::model::run::finer::Finer;

/// A mesh twice as fine has a sixteenth of the error left: of order 4.
const FINER: f64 = 16.0 / 15.0;

/// An equilibrium of a run.
#[derive(Debug)]
pub(super) struct Peak {
    /// Its strain energy, J.
    energy: f64,
    state: State,
    results: Vec<f64>,
}

impl Simulation {
    /// How far results of equilibria are off because of the mesh, a family each, as [`Model::conclude`] has found; empty where that is not known.
    pub fn mesh_errors(&self) -> &[Inexact] {
        &self.mesh_errors
    }

    /// The family of results with the largest error because of the mesh.
    pub fn coarsest(&self) -> Option<&Inexact> {
        self.mesh_errors.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// Keeps an equilibrium that has more strain energy than all before.
    pub(super) fn keep_peak(&mut self) {
        let energy = self.watch.strain_energy();
        let is_static = self.document.simulation.analysis == Analysis::Static;
        if !is_static || self.peak.as_ref().is_some_and(|peak| energy <= peak.energy) {
            return;
        }
        match &mut self.peak {
            Some(peak) => {
                peak.energy = energy;
                peak.state.clone_from(&self.runner.state);
                peak.results.clone_from(&self.results);
            }
            None => {
                let (state, results) = (self.runner.state.clone(), self.results.clone());
                self.peak = Some(Peak { energy, state, results });
            }
        }
    }

    /// Finds how far the equilibrium of the most strain energy, and the last one, are off because of the mesh, and warns of it.
    pub(super) fn find_mesh_errors(&mut self) {
        self.mesh_errors.clear();
        let Some(Peak { state, results, .. }) = &self.peak else { return };
        let Runner { system, state: last, start, .. } = &self.runner;
        let Some(mut finer) = Finer::new(&self.document, &self.overrides) else { return };
        let mut errors = vec![0.0_f64; self.results.len()];
        let is_last = state.time == last.time;
        for (state, results) in [(state, results), (last, &self.results)].into_iter().skip(usize::from(is_last)) {
            let Some(finer) = finer.results(system, state).filter(|finer| finer.len() == results.len()) else { return };
            for (error, (finer, own)) in errors.iter_mut().zip(finer.iter().zip(results)) {
                *error = error.max(FINER * (finer - own).abs());
            }
        }
        self.mesh_errors = self.accuracy.errors_of_mesh(&self.columns, system, last.time - start, &errors);
        let worst = self.mesh_errors.iter().max_by(|a, b| a.excess().total_cmp(&b.excess()));
        self.warnings.extend(worst.and_then(Inexact::warning_of_mesh));
    }
}
