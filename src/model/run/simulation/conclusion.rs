//! The end of a run: how far its results are off because of its steps and its mesh, and what else the user should know
//! of it as a whole.

use super::Simulation;
use super::critical::CRITICAL;
use super::runner::Runner;
use super::solver::Solver;
use crate::model::run::accuracy::Inexact;
use crate::model::run::levels;
use crate::model::run::step_setting::Setting;
use crate::solve::step::tally::Limit;

/// A run of so many steps says why.
const MANY_STEPS: u64 = 20_000;
/// Where rows and other limits than errors hold more than this share of the steps, a smaller accuracy does not help.
const MOST: f64 = 0.5;
/// A reason that holds a smaller share of the steps is not told.
const LEAST_SHARE: f64 = 0.05;

impl Simulation {
    /// How far results are off because of the lengths of the steps, a family each, as carried along with the motion,
    /// and where they are corrected as is left of that; empty where that is not known.
    pub fn estimated_errors(&self) -> Vec<Inexact> {
        if !self.runner.state.time_error.is_known() {
            return Vec::new();
        }
        self.accuracy.errors(&self.columns, &self.measures(), self.document.simulation.correction)
    }

    /// The families of results that are zero but for round-off: pictures show them as that.
    pub fn zeros(&self) -> Vec<String> {
        self.accuracy.zeros(&self.columns, &self.measures())
    }

    /// The family of results with the largest estimated error.
    pub fn least_accurate(&self) -> Option<Inexact> {
        self.estimated_errors().into_iter().max_by(|a, b| a.error.total_cmp(&b.error))
    }

    /// The limits of the steps of a run that chose many of them, in a sentence; none: there are few, or they are given.
    pub fn step_limits(&self) -> Option<String> {
        let Runner { system, state, solver, .. } = &self.runner;
        let Solver::Midpoint(midpoint) = solver else { return None };
        let tally = midpoint.limits().filter(|_| state.statistics.steps >= MANY_STEPS)?;
        let of = |limit| Some(tally.share(limit)).filter(|share| *share >= LEAST_SHARE);
        let percent = |share: f64| format!("{:.0} %", 100.0 * share);
        let changes = of(Limit::Change)
            .map(|share| format!("{} end where a load, a drive, a joint or a contact changes", percent(share)));
        let accuracy = of(Limit::Accuracy).zip(tally.coordinate()).map(|(share, index)| {
            let (share, part) = (percent(share), system.describe_unknown(index));
            format!(
                "{share} are as long as simulation.accuracy allows, mostly because of {part}. Damping ends vibrations \
                 that do not matter, and a larger simulation.accuracy takes longer steps"
            )
        });
        let clauses: Vec<String> = changes.into_iter().chain(accuracy).collect();
        (!clauses.is_empty()).then(|| clauses.join("; "))
    }

    /// Tells how many steps the bound on their iterations has cut off, and the largest correction that one ended with.
    fn warning_of_iterations(&self) -> Option<String> {
        let Solver::Midpoint(midpoint) = &self.runner.solver else { return None };
        let bound = midpoint.bound().filter(|bound| bound.cut_off > 0)?;
        Some(format!(
            "simulation.iterations = {} has cut off Newton's iteration in {} steps: the last correction was up to {:.1e}, \
             above simulation.tolerance; take a shorter simulation.step, or more iterations",
            bound.iterations, bound.cut_off, bound.largest
        ))
    }

    /// Warns at the end of the errors of these results only, as `tip.position` or a component of it: nobody reads the
    /// others.
    pub fn judge_only(&mut self, names: &[&str]) {
        let family = |name: &&str| name.split('[').next().unwrap_or(name).to_owned();
        self.judged = Some(names.iter().map(family).collect());
    }

    /// Whether errors of a family of results are warned of.
    pub(super) fn is_judged(&self, own: &Inexact) -> bool {
        self.judged.as_ref().is_none_or(|judged| judged.contains(&own.name))
    }

    /// Looks a last time, and warns of errors that are larger than a reader expects, of each kind or together.
    pub(super) fn end_run(&mut self) {
        // Results as computed: they were read once, so that they can be read again.
        let _ = self.read_results();
        self.look();
        self.correct();
        let setting = self.step_setting();
        let errors = self.estimated_errors().into_iter().filter(|own| self.is_judged(own));
        let of_steps = errors.max_by(|a, b| a.error.total_cmp(&b.error)).and_then(|worst| worst.warning(setting));
        let is_beside = self.companion.is_some();
        let seen_from = if self.is_compared && !is_beside { "" } else { self.find_mesh_errors() };
        let is_critical = |own: &&Inexact| own.name == CRITICAL;
        let of_stability = self.mesh_errors.iter().find(is_critical).filter(|own| self.is_judged(own));
        let of_stability = of_stability.and_then(|own| own.warning_of_critical(seen_from));
        let errors = self.mesh_errors.iter().filter(|own| self.is_judged(own) && !is_critical(own));
        let worst = errors.max_by(|a, b| a.excess().total_cmp(&b.excess()));
        let twists = self.document.beams.iter().any(levels::has_linear_twist);
        let of_mesh = worst.and_then(|worst| worst.warning_of_mesh(seen_from, twists));
        if self.is_compared {
            if is_beside && !self.mesh_errors.is_empty() {
                self.mesh_known = (self.mesh_errors.clone(), of_mesh);
            }
            let (errors, warning) = &self.mesh_known;
            self.mesh_errors.clone_from(errors);
            self.warnings.extend(warning.clone());
            // Nobody makes steps finer that are given.
            let of_steps = of_steps.filter(|_| self.runner.pacing.is_none());
            self.warnings.extend(of_steps);
        } else {
            self.mesh_known = (self.mesh_errors.clone(), of_mesh.clone());
            let of_both = if of_steps.is_none() && of_mesh.is_none() { self.warning_of_both(setting) } else { None };
            self.warnings.extend(of_both.into_iter().chain(of_steps).chain(of_mesh).chain(of_stability));
        }
        self.warnings.extend(self.warning_of_iterations());
        let (begin, end) = (self.document.drawn_at(self.runner.start), self.runner.state.instant());
        let Runner { system, state, .. } = &self.runner;
        self.warnings.extend(self.watch.conclude(system, state, &self.table, [begin, end]));
    }

    /// The setting that most steps follow from.
    fn step_setting(&self) -> Setting {
        let Runner { pacing, state, start, solver, .. } = &self.runner;
        let Some(pacing) = pacing else { return Setting::Step(state.time_error.step) };
        let tally = if let Solver::Midpoint(midpoint) = solver { midpoint.limits() } else { None };
        let are_held_otherwise = tally.is_some_and(|tally| tally.share(Limit::Other) > MOST);
        let mean = (state.time - start) / state.statistics.steps.max(1) as f64;
        if are_held_otherwise && mean > 0.0 { Setting::Longest(mean) } else { Setting::Accuracy(pacing.accuracy) }
    }

    /// Warns of results that are off by more than a reader expects because of the steps and the mesh together.
    fn warning_of_both(&self, setting: Setting) -> Option<String> {
        let steps = self.estimated_errors();
        let pairs = steps.iter().filter(|own| self.is_judged(own)).filter_map(|steps| {
            let mesh = self.mesh_errors.iter().find(|mesh| mesh.name == steps.name)?;
            Some((steps, mesh))
        });
        let excess = |(steps, mesh): &(&Inexact, &Inexact)| steps.excess_of_steps() + mesh.excess();
        let (steps, mesh) = pairs.max_by(|a, b| excess(a).total_cmp(&excess(b)))?;
        (excess(&(steps, mesh)) > 1.0).then(|| steps.warning_with_mesh(mesh, setting))
    }
}
