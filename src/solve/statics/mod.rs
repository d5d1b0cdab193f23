//! Equilibria: `dU/dq − F + Gᵀ λ = 0`, `g = 0`, each found from the one before.
//!
//! Where Newton does not get there in one go, loads, gravity, drives and moving frames are ramped from those of the
//! last equilibrium (at first: from nothing) to the new ones. That finds the first equilibrium, and bridges jumps of
//! loads later. What hangs and was drawn slack has no stiffness before it pulls: it is first let fall to where it hangs
//! (relaxation.rs).

mod crossing;
mod equilibrium;
mod holding;
mod jump;
mod linearized;
pub mod path;
mod ramp;
mod relaxation;
pub mod stability;
mod switching;

use self::equilibrium::{Equilibrium, Tangent};
use self::holding::Holding;
use self::path::Path;
use self::stability::Stability;
use crate::error::Error;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::solve::newton::kkt::Kkt;
use crate::solve::newton::{self, Convergence, Goal, Limit, MOST_ITERATIONS, Problem};
use crate::solve::step::integrator::Integrator;
use crate::solve::step::tally::Tally;

/// Largest turn of a tangent in an increment, rad: `1 + t_r·t < 0.1` (MECHANICS 2.6).
const LARGEST_TURN: f64 = 2.69;
/// Equilibrium solver and its scratch memory; no result depends on what outlives a solve, but remarks do.
#[derive(Debug)]
pub struct Statics {
    tolerance: f64,
    kkt: Kkt,
    right: Vec<f64>,
    /// What acts at the end of the ramp, and at the point of it that is solved for.
    target: Excitation,
    current: Excitation,
    /// The state before the ramp.
    begin: State,
    target_motion: Prescribed,
    current_motion: Prescribed,
    scratch: Scratch,
    stability: Stability,
    holding: Holding,
    /// Whether the equilibrium that an increment starts from is unstable, as far as motions are counted there.
    leaves_unstable: bool,
    /// How fast the path was in its last increment.
    pace: Option<jump::Pace>,
    next: Option<State>,
    /// A run on a finer mesh follows.
    is_guide: bool,
    /// The equilibria around the first point at which the path becomes unstable.
    crossing: Option<Box<[State; 2]>>,
    /// Follows the equilibria by the arc length of their path; none: by time.
    path: Option<Box<Path>>,
    /// How the last solve went.
    pub convergence: Option<Convergence>,
}

#[derive(Debug, Default)]
struct Scratch {
    q: Vec<f64>,
    multipliers: Vec<f64>,
    forces: Vec<f64>,
    conditions: Vec<f64>,
    frames: FrameCache,
    frames_before: FrameCache,
    gradients: Vec<JointGradient>,
}

impl Statics {
    /// For `system`; Newton ends when its correction is below `tolerance`.
    pub fn new(system: &System, tolerance: f64) -> Self {
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        let scratch = Scratch {
            q: vec![0.0; coordinates],
            multipliers: vec![0.0; conditions],
            forces: vec![0.0; coordinates],
            conditions: vec![0.0; conditions],
            ..Scratch::default()
        };
        Self {
            tolerance,
            kkt: Kkt::for_equilibria(system),
            right: vec![0.0; coordinates + conditions],
            target: Excitation::default(),
            current: Excitation::default(),
            begin: State::default(),
            target_motion: Prescribed::default(),
            current_motion: Prescribed::default(),
            scratch,
            stability: Stability::default(),
            holding: Holding::default(),
            leaves_unstable: false,
            pace: None,
            next: None,
            is_guide: false,
            crossing: None,
            path: None,
            convergence: None,
        }
    }

    /// Finds the equilibrium of `time` (s) from `state` and writes it there, by a ramp where need be.
    ///
    /// # Errors
    /// The ramp got stuck, or a part of the system can move freely; `state` is as it was but for the counts of
    /// iterations and rejections.
    pub fn find(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        let mut next = self.next.take().unwrap_or_else(|| state.clone());
        next.clone_from(state);
        let outcome = match state.statistics.steps {
            0 => {
                let smooth = system.before_friction();
                self.find_first(smooth.as_ref().unwrap_or(system), state, &mut next, time)
            }
            _ => self.find_next(system, state, &mut next, time),
        };
        match outcome {
            Ok(()) => std::mem::swap(state, &mut next),
            Err(_) => state.statistics = next.statistics,
        }
        self.next = Some(next);
        outcome
    }

    /// Sets `next`, a copy of `drawn`, to the first equilibrium: by a ramp of what acts, or, where that finds none or
    /// an unstable one, by letting the system come to rest.
    fn find_first(&mut self, system: &System, drawn: &State, next: &mut State, time: f64) -> Result<(), Error> {
        self.stability.forget();
        self.leaves_unstable = false;
        self.search_holding(system, drawn, next, |statics, system, next| {
            statics.ramp_or_relax(system, drawn, next, time)
        })?;
        let held = next.held.len();
        self.release_held(system, next);
        self.remark_held(system, drawn, next);
        next.statistics.steps += 1;
        let unstable = match next.held.len() == held {
            // The search has judged it.
            true => self.stability.known().is_some_and(|known| known.unstable > 0),
            false => self.is_unstable(system, next),
        };
        if unstable {
            self.remark_start(system, next);
        }
        Ok(())
    }

    /// Sets `next`, a copy of `drawn`, to an equilibrium of `time`, by a ramp or by relaxation, and judges its
    /// stability.
    fn ramp_or_relax(&mut self, system: &System, drawn: &State, next: &mut State, time: f64) -> Result<(), Error> {
        let ramped = self.ramp_to(system, next, time);
        let unstable = ramped.is_ok() && self.is_unstable(system, next);
        match ramped {
            Ok(()) if !unstable => Ok(()),
            hopeless @ Err(Error::NotFinite { .. }) => hopeless,
            // As drawn it may be slack, or Newton has gone up to a position of rest that nothing holds.
            ramped => {
                let tried = next.statistics;
                next.clone_from(drawn);
                next.statistics = tried;
                let relaxed = self.relax(system, next, time).and_then(|()| self.make_unique(system, next, time));
                next.time = time;
                after_relaxation(ramped, relaxed)?;
                self.remark_fall(system, drawn, next);
                self.is_unstable(system, next);
                Ok(())
            }
        }
    }

    /// Sets `next`, a copy of `state`, to the equilibrium after it, and remarks what has become unstable or jumped on
    /// the way.
    fn find_next(&mut self, system: &System, state: &State, next: &mut State, time: f64) -> Result<(), Error> {
        if self.stability.known().is_none_or(|known| known.time != state.time) {
            // A host has gone back.
            self.judge(system, state);
        }
        let before = self.stability.known();
        self.leaves_unstable = before.is_some_and(|known| known.counted > 0);
        let ramped =
            self.search_holding(system, state, next, |statics, system, next| statics.ramp_to(system, next, time));
        match ramped {
            // Beams that touch nothing yet fall until they do.
            Err(reason)
                if (system.has_contacts() || system.pushes_on_one_side())
                    && !matches!(reason, Error::NotFinite { .. }) =>
            {
                let tried = next.statistics;
                next.clone_from(state);
                next.statistics = tried;
                let relaxed = self.relax(system, next, time).and_then(|()| self.make_unique(system, next, time));
                next.time = time;
                after_relaxation(Err(reason), relaxed)?;
            }
            ramped => ramped?,
        }
        self.release_held(system, next);
        self.remark_held(system, state, next);
        next.statistics.steps += 1;
        match before {
            Some(before) => {
                self.watch_stability(system, state, next, before);
                self.watch_pace(system, state, next);
            }
            None if self.is_unstable(system, next) => self.remark_start(system, next),
            None => {}
        }
        Ok(())
    }

    /// Takes `next` to the only equilibrium near the end of the ramp to `time`.
    fn ramp_to(&mut self, system: &System, next: &mut State, time: f64) -> Result<(), Error> {
        self.ramp(system, next, time)?;
        if self.holding.is_allowed {
            self.make_unique(system, next, time)?;
        } else {
            self.kkt.check_unique(system, time).inspect_err(|_| self.holding.has_met_free = true)?;
        }
        next.time = time;
        Ok(())
    }

    /// Takes `state`, which is close to an equilibrium under its own loads and drives, there.
    ///
    /// # Errors
    /// Newton has not found it; `state` is as it was but for the count of iterations.
    pub fn settle(&mut self, system: &System, state: &mut State) -> Result<(), Error> {
        self.current.copy_from(&state.excitation);
        self.current_motion.copy_from(&state.prescribed);
        self.current_motion.stop();
        let time = state.instant();
        // The equilibrium may be unstable.
        match self.iterate(system, state, time, Tangent::Exact) {
            Err(Error::Singular { .. }) => {
                self.hold_unloaded(system, state, time)?;
                self.iterate(system, state, time, Tangent::Exact)
            }
            outcome => outcome,
        }
    }

    /// Forgets what is known of the last equilibrium: the state has been set from outside.
    pub fn forget(&mut self) {
        self.stability.forget();
    }

    /// The time at which the path has become unstable for the first time, s; none: it has not.
    pub fn critical_time(&self) -> Option<f64> {
        self.stability.critical()
    }

    /// What has been seen on the way that the user should know, once.
    pub fn take_remarks(&mut self) -> Vec<String> {
        self.stability.take_remarks(!self.is_guide)
    }

    /// Leaves it to a run on a finer mesh, which follows this one, to tell of the stability.
    pub fn guide(&mut self) {
        self.is_guide = true;
    }

    /// Whether the equilibrium `state` is unstable, beyond doubt as far as its softest motion tells.
    pub fn is_unstable(&mut self, system: &System, state: &State) -> bool {
        let unstable = self.judge(system, state);
        if unstable && stability::softest(system, &mut self.kkt, state).is_some_and(|softest| softest.is_stable()) {
            self.stability.mark_stable(state.time);
            return false;
        }
        unstable
    }

    /// Judges the equilibrium `state`: whether it is unstable, by a count where it is not certain that it is stable.
    /// Not by the matrix that Newton leaves: that is of its last iterate but one, as drawn and without the forces of
    /// constraints where one iteration is enough.
    fn judge(&mut self, system: &System, state: &State) -> bool {
        self.assemble(system, state);
        // Without a factorization nothing is known.
        self.stability.forget();
        if self.kkt.holds_all_motions(system) {
            self.stability.record_stable(state.time);
        } else if self.kkt.factorize(system, state.time).is_ok() {
            self.stability.judge(system, &mut self.kkt, state.time);
        }
        self.stability.known().is_some_and(|known| known.unstable > 0)
    }

    /// Sets the matrix of the equilibrium `state`.
    fn assemble(&mut self, system: &System, state: &State) {
        let given = (&state.excitation, &state.prescribed);
        Equilibrium::near(system, state, state.instant(), given, &mut self.scratch)
            .linearize(&mut self.kkt, &mut self.right);
    }

    /// Factorizes the matrix of the equilibrium `state`.
    fn linearize(&mut self, system: &System, state: &State) -> Result<(), Error> {
        self.assemble(system, state);
        self.kkt.factorize(system, state.time)
    }

    /// Whether the system at `state` has a free part, or one that is held twice: the reason why no load, however small,
    /// can be borne.
    ///
    /// # Errors
    /// It has one.
    fn examine(&mut self, system: &System, state: &State, time: f64) -> Result<(), Error> {
        let given = (&self.current, &self.current_motion);
        Equilibrium::near(system, state, time, given, &mut self.scratch).linearize(&mut self.kkt, &mut self.right);
        self.kkt.factorize(system, time)?;
        self.kkt.check_unique(system, time)
    }

    /// Solves for the equilibrium under the current excitation from `state` and writes it there, references carried on.
    fn solve(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        // Behind a limit point, or beside an unstable equilibrium, the fast tangent finds fewer of the equilibria that
        // are far away.
        if !self.leaves_unstable && self.iterate(system, state, time, Tangent::Fast).is_ok() {
            return Ok(());
        }
        let reason = match self.iterate(system, state, time, Tangent::Exact) {
            Err(reason) => reason,
            outcome => return outcome,
        };
        self.holding.has_met_free |= matches!(reason, Error::Singular { .. });
        if !self.holding.is_allowed {
            return Err(reason);
        }
        let held = state.held.clone();
        self.hold_free_motions(system, state, time).inspect_err(|_| self.holding.is_hopeless = true)?;
        if state.held == held {
            return Err(reason);
        }
        self.iterate(system, state, time, Tangent::Exact)
    }

    /// [`Self::solve`] with the tangents that `tangent` says.
    fn iterate(&mut self, system: &System, state: &mut State, time: f64, tangent: Tangent) -> Result<(), Error> {
        let given = (&self.current, &self.current_motion);
        let mut problem = Equilibrium { tangent, ..Equilibrium::near(system, state, time, given, &mut self.scratch) };
        let mut iterations = state.statistics.iterations;
        let control = (Goal::Correction(self.tolerance), Limit::Fails(MOST_ITERATIONS));
        let solved =
            newton::solve(system, &mut problem, &mut self.kkt, &mut self.right, control, time, &mut iterations);
        state.statistics.iterations = iterations;
        self.convergence = Some(solved?);
        self.take_over(system, state, time)
    }

    /// Writes the solution to `state`, references carried on.
    ///
    /// # Errors
    /// It is too far from `state`.
    fn take_over(&mut self, system: &System, state: &mut State, time: f64) -> Result<(), Error> {
        let scratch = &mut self.scratch;
        let before = scratch.frames_before.of(system, state);
        let configuration = scratch.frames.at(system, &scratch.q, state, &self.current_motion);
        system.check_twist_change(&before, &configuration, time)?;
        system.check(&configuration, state, LARGEST_TURN, time)?;
        state.multipliers.copy_from_slice(&scratch.multipliers);
        system.arrive(state, (&scratch.q, &scratch.frames, &self.current_motion), None);
        Ok(())
    }
}

impl Integrator for Statics {
    /// An equilibrium knows its own instant only.
    const RESOLVES_TIME: bool = false;

    /// The equilibrium of `end`, with what is engaged then; or that at the arc length `end` of a path.
    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        match &self.path {
            None => self.step_switching(system, state, step, end),
            Some(_) => self.step_along(system, state, step, end),
        }
    }

    /// An increment switches at its end.
    fn switch(&mut self, _system: &System, _state: &mut State, _time: f64) -> Result<bool, Error> {
        Ok(false)
    }

    fn tally(&mut self) -> Option<&mut Tally> {
        None
    }
}

/// What to report of a ramp that found no stable equilibrium and of the relaxation that followed. Of two failures the
/// first one is about the system as drawn.
fn after_relaxation(ramped: Result<(), Error>, relaxed: Result<(), Error>) -> Result<(), Error> {
    match (ramped, relaxed) {
        (Err(reason @ Error::RampStuck { .. }), Err(_)) => Err(reason),
        (_, relaxed @ Err(Error::Singular { .. })) => relaxed,
        // It may be meant to hang, or nothing may hold it.
        (Err(Error::Singular { time, what }), Err(fall)) => {
            let what = format!(
                "{what}. Or, if it is meant to hang: falling from where it is drawn it comes to no rest: {fall}"
            );
            Err(Error::Singular { time, what })
        }
        (_, relaxed) => relaxed,
    }
}
