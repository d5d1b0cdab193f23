//! The system of a model that runs: built, brought to its initial state, advanced on the grid of internal steps.

use super::plan::Plan;
use super::solver::Solver;
use crate::error::Error;
use crate::mechanics::input::switch::Hold;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::builder::{self, Built};
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::{Analysis, Initial};
use crate::model::run::between::Between;
use crate::model::variables::Table;
use crate::solve::dynamics::{start, turning};
use crate::solve::step::course::{Course, Event, Noting};
use crate::solve::step::integrator::Integrator;
use crate::solve::step::limits;
use crate::solve::step::pacing::Pacing;
use crate::solve::step::response::{Responder, Response};
use crate::solve::step::tally::Tally;
use std::sync::Arc;

/// How near to a point of the grid of internal steps a communication point must be to be that point, in steps.
const ON_GRID: f64 = 1e-9;
/// Most internal steps in one call: beyond, times a step apart are hardly different numbers, and nobody waits for the
/// end.
const MOST_STEPS: f64 = 1e9;
/// Round-off of a time that is one sum, relative: far from 0 it can be more than a share of the internal step.
const TIME_ROUNDING: f64 = 4.0 * f64::EPSILON;
/// Round-off that a communication step may have before it takes one internal step more, in steps. A step that is
/// shorter is left to the next one: it would be all round-off, and velocities are differences of positions.
const STEP_ROUNDING: f64 = 1e-6;

/// Finds the response of a state.
type Respond = fn(&mut Responder, &System, &State, &mut Response) -> Result<(), Error>;

/// The system as built, the state it has reached, and the means to go on.
#[derive(Debug)]
pub(super) struct Runner {
    /// The file as it was when the system was built.
    pub(super) drawn: Arc<Document>,
    pub(super) system: Arc<System>,
    pub(super) state: State,
    /// The instant of the drawing, s.
    pub(super) drawn_at: f64,
    /// Tunable parameters have been set since the system was brought to them.
    pub(super) stale: bool,
    /// The state before the running call, to go back to when it fails.
    pub(super) backup: State,
    /// Start of the grid of internal steps, s.
    pub(super) start: f64,
    /// Internal step, s; the largest one where the solver chooses them.
    pub(super) step: f64,
    /// None: internal steps are given.
    pub(super) pacing: Option<Pacing>,
    /// The steps of a motion that are given one by one; none: they follow from the two above.
    pub(super) course: Option<Course>,
    /// A run on a finer mesh follows these equilibria.
    pub(super) is_guide: bool,
    /// The ends of the steps so far, s; none: nobody asks for them.
    pub(super) ends: Option<Vec<f64>>,
    /// The initialization that the system is from; none yet: no solver. Shared with the snapshots taken since, of which
    /// a solver is scratch memory only.
    pub(super) initialization: Arc<()>,
    pub(super) solver: Solver,
    /// Computes accelerations and multipliers, where results ask for them.
    pub(super) responder: Option<Box<Responder>>,
    pub(super) response: Response,
}

impl Runner {
    pub(super) fn new(built: Built, document: &Arc<Document>, start: f64) -> Self {
        Self::drawn(Arc::new(built.system), built.state, document, start)
    }

    /// The system that `document` draws at `start`, s, if this is one and has not been initialized yet: drawing it anew
    /// would give the same.
    pub(super) fn if_drawn(&self, document: &Arc<Document>, start: f64) -> Option<Self> {
        let same = Arc::ptr_eq(&self.drawn, document)
            && self.start == start
            && self.state.time == document.drawn_at(start)
            && !self.is_initialized();
        same.then(|| Self::drawn(Arc::clone(&self.system), self.state.clone(), document, start))
    }

    fn drawn(system: Arc<System>, state: State, document: &Arc<Document>, start: f64) -> Self {
        Self {
            drawn: Arc::clone(document),
            system,
            drawn_at: state.time,
            stale: false,
            backup: state.clone(),
            state,
            start,
            step: document.largest_step(),
            pacing: document.pacing(start),
            course: None,
            is_guide: false,
            ends: None,
            initialization: Arc::new(()),
            solver: Solver::None,
            responder: None,
            response: Response::default(),
        }
    }

    /// Takes the course of another runner, guides if that one does, and notes the ends of steps.
    pub(super) fn take_course(&mut self, other: &Self) {
        self.course.clone_from(&other.course);
        self.is_guide = other.is_guide;
        self.ends = other.ends.as_ref().map(|_| Vec::new());
        if let Some(pacing) = &mut self.pacing {
            pacing.is_given = self.course.is_some();
        }
    }

    pub(super) fn is_initialized(&self) -> bool {
        !matches!(self.solver, Solver::None)
    }

    /// Sets up the solver and finds the state at the start; returns what the user should know of it.
    pub(super) fn find_initial_state(&mut self, document: &Document, responds: bool) -> Result<Vec<String>, Error> {
        self.state.prescribed.holds =
            self.system.holds_at(self.state.time, &self.state.targets).map(Hold::drawn).collect();
        start::check_assembled(&self.system, &self.state)?;
        start::check_apart(&self.system, &self.state)?;
        let mut warnings = self.set_up(document, responds)?;
        match document.simulation.analysis {
            Analysis::Dynamic => self.find_motion(document, &mut warnings)?,
            Analysis::Static => self.find_equilibrium("the initial velocities", &mut warnings)?,
        }
        Ok(warnings)
    }

    /// Sets up the solver; returns what the user should know of the system.
    pub(super) fn set_up(&mut self, document: &Document, responds: bool) -> Result<Vec<String>, Error> {
        self.solver = Solver::new(document, &self.system, self.pacing)?;
        if let Solver::Statics(statics) = &mut self.solver
            && self.is_guide
        {
            statics.guide();
        }
        self.responder = responds.then(|| Box::new(Responder::new(&self.system)));
        Ok(self.system.too_fine_meshes())
    }

    /// Sets the system in motion where it is drawn, or at an equilibrium.
    fn find_motion(&mut self, document: &Document, warnings: &mut Vec<String>) -> Result<(), Error> {
        let Self { system, state, start: time, .. } = self;
        let simulation = &document.simulation;
        warnings.extend(system.jumps(*time, document.value(simulation.stop)));
        let moves = state.is_moving();
        let unused = |why: &str| format!("the given initial velocities are not used: the motion begins {why}");
        match simulation.initial {
            Initial::AsDrawn => {
                start::check_drives(system, state)?;
                start::move_frames(system, state)?;
            }
            Initial::Equilibrium => {
                warnings.extend(start::find_equilibrium(system, state, *time, document.value(simulation.tolerance))?);
                warnings.extend(moves.then(|| unused("at an equilibrium")));
            }
            Initial::Steady => {
                start::check_drives(system, state)?;
                start::move_frames(system, state)?;
                let tolerance = document.value(simulation.tolerance);
                warnings.extend(turning::find_steady_rotation(system, state, tolerance)?);
                warnings.extend(moves.then(|| unused("as a steady rotation")));
            }
        }
        self.set_motion("the given initial velocities", warnings)
    }

    /// Sets the system in motion where it is, with the nearest velocities to those of the state that joints and drives
    /// allow; messages call these `given`.
    pub(super) fn set_motion(&mut self, given: &str, warnings: &mut Vec<String>) -> Result<(), Error> {
        let Self { system, state, solver, step, pacing, .. } = self;
        let changed = match solver {
            Solver::Midpoint(midpoint) => {
                let changed = start::set_motion(system, midpoint, state)?;
                warnings.extend(start::redundant_later(system, midpoint, state));
                changed
            }
            Solver::GeneralizedAlpha(alpha) => {
                warnings.extend(alpha.objection(system));
                let changed = start::set_motion(system, alpha, state)?;
                warnings.extend(start::redundant_later(system, alpha, state));
                changed
            }
            Solver::None | Solver::Statics(_) => 0.0,
        };
        if pacing.is_none() {
            warnings.extend(start::unresolved_dampers(system, state, *step));
        }
        if changed > 0.0 {
            warnings.push(format!(
                "{given} do not fit the joints: they were changed to the nearest that do, a change of {} of their kinetic energy",
                percent(changed)
            ));
        }
        Ok(())
    }

    /// Finds the first equilibrium of a static analysis; messages call the velocities of the state `given`.
    pub(super) fn find_equilibrium(&mut self, given: &str, warnings: &mut Vec<String>) -> Result<(), Error> {
        let Self { system, state, solver: Solver::Statics(statics), start: time, .. } = self else { return Ok(()) };
        let moves = state.is_moving();
        state.velocity.fill(0.0);
        state.targets.straight = true;
        statics.find(system, state, *time)?;
        statics.begin_path(system, state)?;
        warnings.extend(statics.take_remarks());
        if moves {
            warnings.push(format!("{given} are not used: the analysis is static"));
        }
        Ok(())
    }

    /// Computes the response of the state that is reached, if results ask for it.
    pub(super) fn respond(&mut self) -> Result<(), Error> {
        let Self { system, state, solver, responder, response, .. } = self;
        match responder {
            Some(responder) => solver.respond(responder, system, state, response)?,
            // No result asks for accelerations.
            None if !matches!(solver, Solver::None) => response.multipliers.clone_from(&state.multipliers),
            None => response.set_at_rest(state),
        }
        Ok(())
    }

    /// Where difference quotients of the way from the backup to `end`, s, which was left at `stop`, s, begin, and the
    /// response there: at the backup, and in a static analysis before its last increment.
    pub(super) fn before_quotient(&mut self, end: f64, stop: f64) -> Result<(State, Response), Error> {
        let plan = self.plan_until(self.backup.time, end, stop)?;
        let mut before = self.backup.clone();
        if let Solver::Statics(own) = &mut self.solver {
            let mut state = before.clone();
            state.targets.clone_from(&self.state.targets);
            plan.march(&mut Remembering(own.as_mut(), &mut before), &self.system, &mut state)?;
            // They have been told already.
            own.take_remarks();
        }
        let mut response = Response::default();
        self.solver.respond(&mut Responder::new(&self.system), &self.system, &before, &mut response)?;
        Ok((before, response))
    }

    /// The state one internal step after the present one, and its response, with the tunable parameters of now; inputs
    /// stay as they are.
    pub(super) fn after_next_part(&mut self, document: &Document) -> Result<(State, Response), Error> {
        let begin = self.state.time;
        let wanted = if self.pacing.is_some() { self.state.pace.wanted } else { 0.0 };
        let step = if wanted > 0.0 { wanted.min(self.step) } else { self.step };
        let plan = self.plan(begin, begin + step)?;
        let mut state = self.state.clone();
        if let Some(pacing) = self.pacing.filter(|_| self.stale) {
            pacing.jump(&mut state);
        }
        state.targets.depart(begin, &self.state.prescribed);
        state.targets.end = plan.end;
        let system = &self.settled(document);
        match &mut self.solver {
            Solver::None => Err(Error::NotInitialized),
            Solver::Midpoint(own) => plan.march(own.as_mut(), system, &mut state),
            Solver::GeneralizedAlpha(own) => plan.march(own.as_mut(), system, &mut state),
            Solver::Statics(own) => {
                let outcome = plan.march(own.as_mut(), system, &mut state);
                // The step that is taken will tell of what it finds.
                own.take_remarks();
                own.forget();
                outcome
            }
        }?;
        let mut response = Response::default();
        self.solver.respond(&mut Responder::new(system), system, &state, &mut response)?;
        Ok((state, response))
    }

    /// The system with the tunable parameters of now.
    pub(super) fn settled(&self, document: &Document) -> Arc<System> {
        let mut system = Arc::clone(&self.system);
        if self.stale {
            builder::retune(document, Arc::make_mut(&mut system));
        }
        system
    }

    /// Brings the system to the tunable parameters of now.
    pub(super) fn settle(&mut self, document: &Document) {
        if std::mem::take(&mut self.stale) {
            builder::retune(document, Arc::make_mut(&mut self.system));
            self.state.balance.forget_last();
            if let Solver::Statics(own) = &mut self.solver {
                own.forget();
            }
            if let Some(pacing) = self.pacing {
                pacing.jump(&mut self.state);
            }
        }
    }

    /// Keeps the state, for [`Self::go_back`].
    pub(super) fn keep(&mut self) {
        self.backup.clone_from(&self.state);
    }

    /// Goes back to the state that was kept.
    pub(super) fn go_back(&mut self) {
        self.state.clone_from(&self.backup);
    }

    /// The way to `end`, s, on which everything that a host moves goes.
    pub(super) fn depart(&mut self, end: f64) -> Result<Plan, Error> {
        let plan = self.plan(self.state.time, end)?;
        self.state.targets.end = plan.end;
        if matches!(self.solver, Solver::Statics(_)) && self.state.path.is_none() {
            limits::check_drives(&self.system, &self.state, plan.end, plan.count)?;
        }
        Ok(plan)
    }

    /// Takes internal step `number` of `plan`, from 0; returns whether its end is reached.
    pub(super) fn take_part(&mut self, plan: &Plan, number: u64) -> Result<bool, Error> {
        let (system, state) = (&self.system, &mut self.state);
        match &mut self.solver {
            Solver::None => Err(Error::NotInitialized),
            Solver::Midpoint(midpoint) => match &self.course {
                Some(course) => course.part(midpoint.as_mut(), system, state, plan.end),
                None => plan.part(number, midpoint.as_mut(), system, state),
            },
            Solver::GeneralizedAlpha(alpha) => plan.part(number, alpha.as_mut(), system, state),
            Solver::Statics(statics) => plan.part(number, statics.as_mut(), system, state),
        }
    }

    /// Advances to `end`, s; `between` looks at the results of `table` on the way.
    pub(super) fn advance(&mut self, end: f64, table: &Table, mut between: Option<&mut Between>) -> Result<(), Error> {
        let plan = self.depart(end)?;
        let Self { system, state, solver, responder, course, ends, .. } = self;
        let is_static = matches!(solver, Solver::Statics(_));
        let mut look = |event: Event, system: &System, state: &State, respond: Respond| {
            if event == Event::Switch {
                between.iter_mut().for_each(|between| between.begin_step(state));
                return;
            }
            if let Some(ends) = ends {
                ends.push(state.time);
            }
            if let Some(between) = &mut between
                && (is_static || between.is_due(state))
                && state.time < plan.end
            {
                between.include(table, (system, state), |response| match responder {
                    Some(responder) => respond(responder, system, state, response),
                    None => {
                        response.set_at_rest(state);
                        Ok(())
                    }
                });
            }
        };
        match solver {
            Solver::None => Err(Error::NotInitialized),
            Solver::Midpoint(midpoint) => {
                let look =
                    |event: Event, system: &System, state: &State| look(event, system, state, Responder::respond);
                let mut integrator = Noting { integrator: midpoint.as_mut(), look };
                match course {
                    Some(course) => course.advance(&mut integrator, system, state, plan.end),
                    None => plan.march(&mut integrator, system, state),
                }
            }
            Solver::GeneralizedAlpha(alpha) => {
                let look = |event: Event, system: &System, state: &State| look(event, system, state, keep);
                plan.march(&mut Noting { integrator: alpha.as_mut(), look }, system, state)
            }
            Solver::Statics(statics) => {
                let look = |event: Event, system: &System, state: &State| look(event, system, state, rest);
                plan.march(&mut Noting { integrator: statics.as_mut(), look }, system, state)
            }
        }
    }

    /// The shortest communication step that is taken, s.
    pub(super) fn shortest_step(&self) -> f64 {
        f64::max(STEP_ROUNDING * self.step, TIME_ROUNDING * self.state.time.abs())
    }

    /// The internal steps from `begin` on the way to `end`, s, that was left at `stop`, s.
    pub(super) fn plan_until(&self, begin: f64, end: f64, stop: f64) -> Result<Plan, Error> {
        Ok(Plan { stop, ..self.plan(begin, end)? })
    }

    /// The internal steps from `begin` to `end`, s: on the grid `start + k step` where both are on it, else equal ones.
    pub(super) fn plan(&self, begin: f64, end: f64) -> Result<Plan, Error> {
        let Self { start, step, pacing, .. } = *self;
        let grid = |number: f64| start + number * step;
        let nearest = |time: f64| ((time - start) / step).round();
        let last = nearest(end);
        let on_grid = (end - grid(last)).abs() <= ON_GRID * step;
        let end = if on_grid { grid(last) } else { end };
        let first = nearest(begin);
        let needed = (end - begin) / step;
        if needed > MOST_STEPS {
            return Err(Error::TooManySteps { count: needed, step, from: begin, to: end });
        }
        if on_grid && begin == grid(first) {
            let count = (last - first) as u64;
            return Ok(Plan { begin: start, first, from: begin, end, step, count, pacing, stop: f64::INFINITY });
        }
        let count = (needed - STEP_ROUNDING).ceil().max(1.0);
        let (step, count) = ((end - begin) / count, count as u64);
        Ok(Plan { begin, first: 0.0, from: begin, end, step, count, pacing, stop: f64::INFINITY })
    }
}

/// The response that an integrator keeps in its state.
fn keep(_: &mut Responder, _: &System, state: &State, response: &mut Response) -> Result<(), Error> {
    response.set_from(state);
    Ok(())
}

/// The response of an equilibrium.
fn rest(_: &mut Responder, _: &System, state: &State, response: &mut Response) -> Result<(), Error> {
    response.set_at_rest(state);
    Ok(())
}

/// A share in percent, with three decimals.
fn percent(share: f64) -> String {
    if share < 1e-5 { String::from("less than 0.001 %") } else { format!("{:.3} %", 100.0 * share) }
}

/// An integrator that keeps the state before the step it took last.
struct Remembering<'a, I>(&'a mut I, &'a mut State);

impl<I: Integrator> Integrator for Remembering<'_, I> {
    const RESOLVES_TIME: bool = I::RESOLVES_TIME;

    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        let Self(integrator, before) = self;
        before.clone_from(state);
        integrator.step(system, state, step, end)
    }

    fn switch(&mut self, system: &System, state: &mut State, time: f64) -> Result<bool, Error> {
        self.0.switch(system, state, time)
    }

    fn tally(&mut self) -> Option<&mut Tally> {
        self.0.tally()
    }
}
