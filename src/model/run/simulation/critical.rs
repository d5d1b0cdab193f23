//! The time at which equilibria become unstable, as a result that depends on the mesh.

use super::Simulation;
use super::mesh_error::FINER;
use super::runner::Runner;
use super::solver::Solver;
use crate::mechanics::state::State;
use crate::model::run::accuracy::Inexact;
use crate::model::run::finer::Finer;
use crate::solve::statics::Statics;

/// Its name among the families of results.
pub const CRITICAL: &str = "critical.time";

impl Simulation {
    fn statics(&self) -> Option<&Statics> {
        if let Solver::Statics(statics) = &self.runner.solver { Some(statics) } else { None }
    }

    /// The time at which the equilibria have become unstable for the first time, s; none: they have not.
    pub fn critical_time(&self) -> Option<f64> {
        let Runner { system, state, .. } = &self.runner;
        // Where forces have no potential, the stiffness does not decide.
        if system.follows_no_potential(&state.excitation) { None } else { self.statics()?.critical_time() }
    }

    /// Whether `state`, an equilibrium of this run, counts as unstable.
    pub(super) fn is_unstable_at(&self, state: &State) -> bool {
        match &state.path {
            Some(path) => path.unstable > 0,
            None => self.critical_time().is_some_and(|critical| critical <= state.time),
        }
    }

    /// How far the critical time is off because of the mesh, as a share of it; `hides`: the mesh shows a stable
    /// equilibrium where `finer` has an unstable one. None: nothing becomes unstable.
    pub(super) fn critical_error(&self, finer: &mut Finer, hides: bool) -> Option<Inexact> {
        if self.runner.system.follows_no_potential(&self.runner.state.excitation) {
            return None;
        }
        let found = |error: f64| Inexact { name: String::from(CRITICAL), error, is_rough: false };
        if hides {
            return Some(found(f64::INFINITY));
        }
        let (own, path) = (self.critical_time()?, self.statics()?.crossing()?);
        let other = finer.critical_time(&self.runner.system, path)?;
        Some(found(FINER * (other - own).abs() / (own - self.runner.start).max(f64::MIN_POSITIVE)))
    }
}

impl Inexact {
    /// The critical time of a run that had `before` on a coarser mesh and has `own` now, with errors that are `gain`
    /// times as large there; none: nothing becomes unstable on either.
    pub(crate) fn of_critical([before, own]: [Option<f64>; 2], gain: f64) -> Option<Self> {
        let error = match (before, own) {
            (None, None) => return None,
            (Some(before), Some(own)) => (before - own).abs() / own.abs().max(f64::MIN_POSITIVE) / (gain - 1.0),
            _ => f64::INFINITY,
        };
        Some(Self { name: String::from(CRITICAL), error, is_rough: false })
    }

    /// The warning of a critical time that is off by more than a reader expects, as `seen_from` another mesh.
    pub(crate) fn warning_of_critical(&self, seen_from: &str) -> Option<String> {
        if self.error.is_infinite() {
            return Some(format!(
                "the mesh hides that the structure buckles: {seen_from} has an unstable equilibrium where this \
                 one has a stable one. Take more elements"
            ));
        }
        (self.excess() > 1.0).then(|| {
            format!(
                "the time at which the equilibrium becomes unstable is off by {} because of the mesh, as estimated \
                 from {seen_from}. Take more elements",
                self.size()
            )
        })
    }
}
