//! The error of a run because of the mesh, found at its end: that of equilibria from a finer mesh, that of motions from
//! a run with another mesh.

use super::Simulation;
use super::companion::{Beside, Companion, Halt, Lost, Placement};
use super::runner::Runner;
use crate::error::decimal;
use crate::mechanics::state::State;
use crate::model::file::entries::simulation::Analysis;
use crate::model::run::accuracy::{Inexact, ORDER, ORDER_OF_TWIST};
use crate::model::run::finer::Finer;

/// The mesh error over the difference between both meshes: the finer one keeps a sixteenth of the error (order 4).
pub(super) const FINER: f64 = 16.0 / 15.0;

/// An equilibrium of a run.
#[derive(Debug)]
pub(super) struct Peak {
    /// Its strain energy, J.
    energy: f64,
    state: State,
    results: Vec<f64>,
}

impl Simulation {
    /// Asks for the mesh error of motions, and of equilibria with friction of contacts. From the next initialization on
    /// a comparison run with another mesh follows this one, where `placement` says, until
    /// [`crate::fmi::Model::conclude`] compares. Restored states, and parameters that are set on the way, leave the
    /// error unknown. Other equilibria need no such run. The answer halts the comparison runs that this call asks for.
    pub fn ask_for_mesh_error(&mut self, placement: Placement) -> Halt {
        let halt = Halt::default();
        self.placement = Some((placement, halt.clone()));
        halt
    }

    /// Asks for the mesh error of motions, within each step, if the model file does.
    pub fn heed_mesh_error(&mut self) {
        if self.document.simulation.mesh_error {
            self.ask_for_mesh_error(|companion| Box::new(companion));
        }
    }

    /// Ends the comparison run, if there is one, since `what` has happened, and says so.
    pub(super) fn lose_companion(&mut self, what: &str) {
        if self.companion.take().is_some() {
            let time = decimal(self.runner.state.instant());
            self.warnings
                .push(format!("the mesh error is not known: the comparison run ended at t = {time} s, since {what}"));
        }
    }

    /// Whether equilibria of the run can be found again on a finer mesh, without those before them.
    fn finds_equilibria_again(&self) -> bool {
        let is_static = self.document.simulation.analysis == Analysis::Static;
        is_static && !self.runner.system.has_contact_friction()
    }

    /// Whether the end of the run is to find the mesh error: that of equilibria always, that of motions and of
    /// equilibria with friction of contacts where it is asked for.
    pub fn seeks_mesh_error(&self) -> bool {
        let is_sought = self.finds_equilibria_again() || self.placement.is_some();
        is_sought && !self.document.beams.is_empty()
    }

    /// How far results are off because of the mesh, a family each, as [`crate::fmi::Model::conclude`] has found; empty
    /// where that is not known.
    pub fn mesh_errors(&self) -> &[Inexact] {
        &self.mesh_errors
    }

    /// The family of results with the largest error because of the mesh.
    pub fn largest_mesh_error(&self) -> Option<&Inexact> {
        self.mesh_errors.iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// Forgets the mesh errors and what they would be found from: another run begins.
    pub(super) fn forget_mesh_errors(&mut self) {
        (self.peak, self.companion) = (None, None);
        self.mesh_errors.clear();
    }

    /// Starts the companion, if one is asked for.
    pub(super) fn start_companion(&mut self) {
        let is_found_later = self.finds_equilibria_again();
        let Some((placement, halt)) = self.placement.clone().filter(|_| !is_found_later) else { return };
        self.companion = Companion::new(self, halt).map(|(companion, mesh)| (placement(companion), mesh));
        self.hand_over(self.inputs.parts().map(<[f64]>::to_vec));
    }

    /// Keeps an equilibrium that has more strain energy than all before.
    pub(super) fn keep_peak(&mut self) {
        let energy = self.watch.strain_energy();
        if !self.finds_equilibria_again() || self.peak.as_ref().is_some_and(|peak| energy <= peak.energy) {
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

    /// Finds how far this run is off because of the mesh; returns what it is seen from, in words.
    pub(super) fn find_mesh_errors(&mut self) -> &'static str {
        self.mesh_errors.clear();
        match self.companion.take() {
            Some((companion, mesh)) => {
                let seen_from = match mesh.ratio {
                    2.0 => "a run with half the elements",
                    ratio if ratio > 1.0 => "a run with fewer elements",
                    _ => "a run with twice the elements",
                };
                self.compare_with_companion(companion, mesh.ratio, seen_from);
                seen_from
            }
            None => {
                self.compare_with_finer();
                "a mesh twice as fine"
            }
        }
    }

    /// How far the motion is from that of a run beside it, a family of judged results each, as shares of what it is
    /// compared with, and how many times as long the elements are there; none: there was no such run.
    pub fn mesh_distances(&self) -> Option<&(f64, Vec<Inexact>)> {
        self.mesh_distances.as_ref()
    }

    /// Finds how far the motion is off.
    fn compare_with_companion(&mut self, companion: Box<dyn Beside>, ratio: f64, run: &str) {
        let differences = match companion.finish() {
            Ok(differences) => differences,
            Err(lost) => {
                let (reason, what, remedy) = match &lost {
                    Lost::Motion(reason) => {
                        (reason, "stopped early", ". The mesh may be too coarse; take more elements")
                    }
                    Lost::Start(reason) => (reason, "did not start", ""),
                    Lost::Halted => return,
                };
                let reason = reason.lines().next().unwrap_or("").trim_start_matches("error: ").trim_end_matches('.');
                self.warnings
                    .push(format!("the mesh error is not known: {run}, for comparison, {what} ({reason}){remedy}"));
                return;
            }
        };
        let limit = if self.watch.is_torsion() { ORDER_OF_TWIST } else { ORDER };
        let measures = self.measures();
        self.mesh_errors = self.accuracy.errors_beside(&self.columns, &measures, &differences, (ratio, limit));
        self.mesh_distances = Some((ratio, self.distances(&differences, |_, _| 1.0)));
    }

    /// Finds how far the equilibrium of the most strain energy, and the last one, are off.
    fn compare_with_finer(&mut self) {
        let Some(Peak { state, results, .. }) = &self.peak else { return };
        let Runner { system, state: last, start, .. } = &self.runner;
        let Some(mut finer) = Finer::new(&self.document, &self.overrides, *start) else { return };
        let mut errors = vec![0.0_f64; self.results.len()];
        let (mut is_known, mut hides) = (false, false);
        let is_last = state.time == last.time;
        for (state, results) in [(state, results), (last, &self.results)].into_iter().skip(usize::from(is_last)) {
            let settled = match finer.settled(system, state) {
                Ok(Some(settled)) => settled,
                Ok(None) => return,
                Err(_) => {
                    self.warnings.push(format!(
                        "the mesh error is not known: on a mesh twice as fine, Newton found no equilibrium near the one at t = {} s. The mesh may be too coarse; take more elements",
                        decimal(state.instant())
                    ));
                    continue;
                }
            };
            is_known = true;
            hides |= finer.is_unstable(&settled) && !self.is_unstable_at(state);
            let mut other = finer.results(&settled);
            self.columns.compare_turns(results, &mut other);
            for (error, (finer, own)) in errors.iter_mut().zip(other.iter().zip(results)) {
                let difference = FINER * (finer - own).abs();
                *error = if difference.is_nan() { f64::INFINITY } else { error.max(difference) };
            }
        }
        if !is_known {
            return;
        }
        self.mesh_errors = self.accuracy.errors_of_mesh(&self.columns, &self.measures(), &errors);
        let of_stability = self.critical_error(&mut finer, hides);
        self.mesh_errors.extend(of_stability);
    }
}
