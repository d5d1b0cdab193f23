//! The machine of a model that runs: built, brought to its initial state, advanced on the grid of internal steps.

use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::build::Built;
use crate::model::document::Document;
use crate::model::entries::simulation::{Analysis, Initial, Integrator as Choice};
use crate::solve::generalized_alpha::GeneralizedAlpha;
use crate::solve::midpoint::{AxialRule, Midpoint};
use crate::solve::response::{Responder, Response};
use crate::solve::start;
use crate::solve::statics::Statics;
use crate::solve::stepping::grid_step;
use std::sync::Arc;

/// How near to a point of the grid of internal steps a communication point must be to be that point, in steps.
const ON_GRID: f64 = 1e-9;
/// Most internal steps in one call: beyond, times a step apart are hardly different numbers, and nobody waits for the end.
const MOST_STEPS: f64 = 1e9;
/// Round-off that a communication step may have before it takes one internal step more, in steps.
const STEP_ROUNDING: f64 = 1e-6;

/// The machine as built, the state it has reached, and the means to go on.
#[derive(Debug)]
pub(super) struct Machine {
    /// The file as it was when the machine was built.
    pub(super) drawn: Arc<Document>,
    pub(super) system: Arc<System>,
    pub(super) state: State,
    /// The state before the running call, to go back to when it fails.
    pub(super) backup: State,
    /// Start of the grid of internal steps, s.
    pub(super) start: f64,
    /// Internal step, s.
    pub(super) step: f64,
    /// The initialization that the machine is from; none yet: no solver. Shared with the snapshots taken since, of which a
    /// solver is scratch memory only.
    pub(super) initialization: Arc<()>,
    pub(super) solver: Solver,
    /// Computes accelerations and multipliers, where results ask for them.
    pub(super) responder: Option<Box<Responder>>,
    pub(super) response: Response,
}

/// What takes a step.
#[derive(Debug)]
pub(super) enum Solver {
    /// Not initialized yet.
    None,
    Midpoint(Box<Midpoint>),
    GeneralizedAlpha(Box<GeneralizedAlpha>),
    Statics(Box<Statics>),
}

impl Machine {
    pub(super) fn new(built: Built, document: &Arc<Document>, start: f64) -> Self {
        let Built { system, state } = built;
        Self {
            drawn: Arc::clone(document),
            system: Arc::new(system),
            backup: state.clone(),
            state,
            start,
            step: document.value(document.simulation.step),
            initialization: Arc::new(()),
            solver: Solver::None,
            responder: None,
            response: Response::default(),
        }
    }

    pub(super) fn is_initialized(&self) -> bool {
        !matches!(self.solver, Solver::None)
    }

    /// Sets up the solver and finds the state at the start; returns what the user should know of it.
    pub(super) fn find_initial_state(&mut self, document: &Document, responds: bool) -> Result<Vec<String>, Error> {
        start::check_assembled(&self.system, &self.state)?;
        self.solver = Solver::new(document, &self.system)?;
        if responds {
            self.responder = Some(Box::new(Responder::new(&self.system)?));
        }
        let simulation = &document.simulation;
        let moving = self.state.velocity.iter().any(|value| *value != 0.0);
        let mut warnings = Vec::new();
        if simulation.analysis == Analysis::Dynamic {
            match simulation.initial {
                Initial::AsDrawn => start::check_drives(&self.system, &self.state)?,
                Initial::Equilibrium => {
                    let tolerance = document.value(simulation.tolerance);
                    warnings.extend(start::find_equilibrium(&self.system, &mut self.state, tolerance)?);
                    if moving {
                        let why = "the motion begins at an equilibrium";
                        warnings.push(format!("the given initial velocities are not used: {why}"));
                    }
                }
            }
        }
        let changed = match &mut self.solver {
            Solver::None => 0.0,
            Solver::Midpoint(midpoint) => start::set_motion(&self.system, midpoint, &mut self.state)?,
            Solver::GeneralizedAlpha(alpha) => {
                warnings.extend(alpha.objection(&self.system));
                start::set_motion(&self.system, alpha, &mut self.state)?
            }
            Solver::Statics(statics) => {
                self.state.velocity.fill(0.0);
                statics.find(&self.system, &mut self.state, self.start)?;
                warnings.extend(statics.take_remarks());
                if moving {
                    warnings.push(String::from("the initial velocities are not used: the analysis is static"));
                }
                if self.system.is_damped() {
                    warnings.push(String::from("dampers are not used: the analysis is static"));
                }
                0.0
            }
        };
        if changed > 0.0 {
            warnings.push(format!(
                "the given initial velocities do not fit the joints: they were changed to the nearest that do, a change of \
                 {:.3} % of their kinetic energy",
                100.0 * changed
            ));
        }
        Ok(warnings)
    }

    /// Computes the response of the state that is reached, if results ask for it.
    pub(super) fn respond(&mut self) -> Result<(), Error> {
        match (&mut self.responder, &self.solver) {
            (Some(responder), Solver::Midpoint(_)) => {
                return responder.respond(&self.system, &self.state, &mut self.response);
            }
            // It computes accelerations and multipliers at the ends of steps.
            (Some(_), Solver::GeneralizedAlpha(_)) => self.response.set_from(&self.state),
            _ => self.response.set_at_rest(&self.state),
        }
        Ok(())
    }

    /// Keeps the state, for [`Self::go_back`].
    pub(super) fn keep(&mut self) {
        self.backup.clone_from(&self.state);
    }

    /// Goes back to the state that was kept.
    pub(super) fn go_back(&mut self) {
        self.state.clone_from(&self.backup);
    }

    /// Advances to `end`, on the grid `start + k step` where both ends are on it, else in equal steps.
    pub(super) fn advance(&mut self, end: f64) -> Result<(), Error> {
        let grid = |number: f64| self.start + number * self.step;
        let nearest = |time: f64| ((time - self.start) / self.step).round();
        let last = nearest(end);
        let on_grid = (end - grid(last)).abs() <= ON_GRID * self.step;
        let end = if on_grid { grid(last) } else { end };
        self.state.targets.end = end;
        let first = nearest(self.state.time);
        let needed = (end - self.state.time) / self.step;
        if needed > MOST_STEPS {
            return Err(Error::TooManySteps { count: needed, step: self.step, from: self.state.time, to: end });
        }
        if on_grid && self.state.time == grid(first) {
            let count = (last - first) as u64;
            for number in 1..=count {
                let next = self.start + (first + number as f64) * self.step;
                self.step_to(next, self.step)?;
            }
            return Ok(());
        }
        let begin = self.state.time;
        let count = ((end - begin) / self.step - STEP_ROUNDING).ceil().max(1.0);
        let step = (end - begin) / count;
        for number in 1..=count as u64 {
            let next = if number as f64 == count { end } else { begin + number as f64 * step };
            self.step_to(next, step)?;
        }
        Ok(())
    }

    pub(super) fn step_to(&mut self, end: f64, step: f64) -> Result<(), Error> {
        match &mut self.solver {
            Solver::None => Err(Error::NotInitialized),
            Solver::Midpoint(midpoint) => grid_step(midpoint.as_mut(), &self.system, &mut self.state, step, end),
            Solver::GeneralizedAlpha(alpha) => grid_step(alpha.as_mut(), &self.system, &mut self.state, step, end),
            Solver::Statics(statics) => grid_step(statics.as_mut(), &self.system, &mut self.state, step, end),
        }
    }
}

impl Solver {
    pub(super) fn new(document: &Document, system: &System) -> Result<Self, Error> {
        let simulation = &document.simulation;
        let tolerance = document.value(simulation.tolerance);
        Ok(match (simulation.analysis, simulation.integrator) {
            (Analysis::Static, _) => Self::Statics(Box::new(Statics::new(system, tolerance)?)),
            (Analysis::Dynamic, Choice::Conserving) => {
                Self::Midpoint(Box::new(Midpoint::new(system, AxialRule::Conserving, tolerance)?))
            }
            (Analysis::Dynamic, Choice::Variational) => {
                Self::Midpoint(Box::new(Midpoint::new(system, AxialRule::Variational, tolerance)?))
            }
            (Analysis::Dynamic, Choice::GeneralizedAlpha { spectral_radius }) => {
                let spectral_radius = document.value(spectral_radius);
                Self::GeneralizedAlpha(Box::new(GeneralizedAlpha::new(system, spectral_radius, tolerance)?))
            }
        })
    }
}
