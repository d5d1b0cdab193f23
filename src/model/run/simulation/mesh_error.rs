//! The error of equilibria because of the mesh, found at the end of a run.

use super::Simulation;
use super::runner::Runner;
use crate::error::decimal;
use crate::mechanics::state::State;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::accuracy::Inexact;
use crate::model::run::finer::Finer;
use crate::model::run::levels;

/// The mesh error over the difference between both meshes: the finer one keeps a sixteenth of the error (order 4).
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
    /// How far results of equilibria are off because of the mesh, a family each, as [`crate::fmi::Model::conclude`] has found; empty where that is not known.
    pub fn mesh_errors(&self) -> &[Inexact] {
        &self.mesh_errors
    }

    /// The family of results with the largest error because of the mesh.
    pub fn largest_mesh_error(&self) -> Option<&Inexact> {
        self.mesh_errors.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// Forgets the mesh errors and what they would be found from: another run begins.
    pub(super) fn forget_mesh_errors(&mut self) {
        self.peak = None;
        self.mesh_errors.clear();
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
        let Some(mut finer) = Finer::new(&self.document, &self.overrides, *start) else { return };
        let mut errors = vec![0.0_f64; self.results.len()];
        let mut is_known = false;
        let is_last = state.time == last.time;
        for (state, results) in [(state, results), (last, &self.results)].into_iter().skip(usize::from(is_last)) {
            let finer = match finer.results(system, state) {
                Ok(Some(finer)) if finer.len() == results.len() => finer,
                Ok(_) => return,
                Err(_) => {
                    self.warnings.push(format!(
                        "the mesh error is not known: on a mesh twice as fine, Newton found no equilibrium near the one at t = {} s. The mesh may be too coarse; take more elements",
                        decimal(state.instant())
                    ));
                    continue;
                }
            };
            is_known = true;
            for (error, (finer, own)) in errors.iter_mut().zip(finer.iter().zip(results)) {
                let difference = FINER * (finer - own).abs();
                *error = if difference.is_nan() { f64::INFINITY } else { error.max(difference) };
            }
        }
        if !is_known {
            return;
        }
        self.mesh_errors = self.accuracy.errors_of_mesh(&self.columns, system, last.time - start, &errors);
        let worst = self.mesh_errors.iter().max_by(|a, b| a.excess().total_cmp(&b.excess()));
        let twists = self.document.beams.iter().any(levels::has_linear_twist);
        self.warnings.extend(worst.and_then(|worst| worst.warning_of_mesh(twists)));
    }
}
