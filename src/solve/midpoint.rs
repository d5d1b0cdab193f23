//! The constrained midpoint integrator in position-momentum form (MECHANICS 7): `Variational` (7.1, the paper's) and
//! `Conserving` (7.6), which differ in one term: the axial strain of the middle, or the mean of the two ends'.
//!
//! A step from `q_k, P_k` solves `P_k − M Dq/h − h/2 f(qm) + C = 0` and `g(q_{k+1}) = 0`, `f = dU/dq − F + Gᵀ λ`,
//! `qm = q_k + Dq/2`, for `Dq` and `Λ = h λ/2`. Momentum and references then move on to the new charts (gyroscopic.rs), and what
//! would alternate is taken out of the momentum.
//!
//! Constraint forces act in the middle of the step like all others. MECHANICS 7.1 has `h G(q_k)ᵀ λ` instead, which treats the
//! stiffness that multipliers give a joint as an explicit method would: it is stable only for `h² λ·g_qq/M < 4`. A hinge that transmits
//! 10 N m to a node of 1e-7 kg m² (a four-bar linkage with a tilted hinge) breaks that: seen at 1, 2 and 4 ms, not at 0.2 ms.

use super::gyroscopic;
use super::kkt::Kkt;
use super::limits;
use super::linear::Singular;
use super::newton::{self, Problem};
use super::projection::Projection;
use super::sensitivity::{Linearized, Span};
use super::start::Dynamics;
use super::stepping::Integrator;
use crate::error::Error;
use crate::mechanics::ancf14::frame::NodeFrame;
use crate::mechanics::configuration::{Configuration, Passage, Rates};
use crate::mechanics::energy_balance::Energies;
use crate::mechanics::joint::JointGradient;
use crate::mechanics::load::Excitation;
use crate::mechanics::prescribed::Prescribed;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// How the axial strain of a step is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AxialRule {
    /// At the middle of the step (7.1).
    Variational,
    /// Mean of the two ends' (7.6).
    Conserving,
}

/// Integrator and its scratch memory; nothing in it outlives a step.
#[derive(Debug)]
pub struct Midpoint {
    rule: AxialRule,
    tolerance: f64,
    kkt: Kkt,
    right: Vec<f64>,
    projection: Projection,
    scratch: Scratch,
    /// The state at the end of the step in the making.
    next: Option<State>,
}

/// What a step computes on the way.
#[derive(Debug, Default)]
struct Scratch {
    increment: Vec<f64>,
    impulses: Vec<f64>,
    q_middle: Vec<f64>,
    q_end: Vec<f64>,
    forces: Vec<f64>,
    mass_increment: Vec<f64>,
    conditions: Vec<f64>,
    excitation: Excitation,
    prescribed_middle: Prescribed,
    prescribed_end: Prescribed,
    frames_start: Vec<NodeFrame>,
    frames_middle: Vec<NodeFrame>,
    frames_end: Vec<NodeFrame>,
    gradients_middle: Vec<JointGradient>,
    gradients_end: Vec<JointGradient>,
}

impl Midpoint {
    /// For `system`; Newton ends when its correction is below `tolerance`.
    pub fn new(system: &System, rule: AxialRule, tolerance: f64) -> Self {
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        let scratch = Scratch {
            increment: vec![0.0; coordinates],
            impulses: vec![0.0; conditions],
            q_middle: vec![0.0; coordinates],
            q_end: vec![0.0; coordinates],
            forces: vec![0.0; coordinates],
            mass_increment: vec![0.0; coordinates],
            conditions: vec![0.0; conditions],
            ..Scratch::default()
        };
        Self {
            rule,
            tolerance,
            kkt: Kkt::for_steps(system),
            right: vec![0.0; coordinates + conditions],
            projection: Projection::new(system),
            scratch,
            next: None,
        }
    }
}

impl Dynamics for Midpoint {
    fn kkt(&mut self) -> &mut Kkt {
        &mut self.kkt
    }
}

impl Integrator for Midpoint {
    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        self.scratch.prepare(system, state, step, end);
        self.scratch.predict(state, step);
        limits::check_frames(system, state, &self.scratch.prescribed_end, step, end)?;
        let mut problem = Step { system, state, rule: self.rule, step, scratch: &mut self.scratch };
        let mut iterations = state.statistics.iterations;
        let solved = newton::solve(
            system,
            &mut problem,
            &mut self.kkt,
            &mut self.right,
            (self.tolerance, limits::ITERATIONS),
            end,
            &mut iterations,
        );
        state.statistics.iterations = iterations;
        solved?;
        self.scratch.place(system, state);
        self.scratch.check(system, state, end)?;
        // All that is left may still fail at the velocities: the state changes at the very end.
        let mut next = self.next.take().unwrap_or_else(|| state.clone());
        next.clone_from(state);
        let (energy_before, elastic) = self.scratch.energies(system, state);
        let work = self.scratch.finish(system, &mut next, self.rule, step, end);
        let outcome = self.projection.set_velocity(system, &mut self.kkt, &mut next);
        if outcome.is_ok() {
            let kinetic = self.steady(system, &mut next);
            next.balance.last = Some(energy_before);
            if system.is_sudden(end, step) {
                next.balance.skip_jump();
            }
            next.balance.account(end, work, Energies { kinetic, elastic }, system.energy_noise(), false);
            std::mem::swap(state, &mut next);
        }
        self.next = Some(next);
        outcome
    }
}

impl Midpoint {
    /// Takes out of the momentum at the end of a step what would alternate for ever. The midpoint rule turns the part that the
    /// constraints do not allow, `ν`, into `c − ν`, with a smooth `c` of second order in the step: its rest is `c/2`, the mean of one `ν`
    /// and the next. Taking that mean, a jump of a drive is gone after a step, and smooth motions keep their energy (taking all of
    /// `ν` away would cost some of it at every step). Linear and angular momentum do not change. Returns the kinetic energy, J.
    fn steady(&self, system: &System, state: &mut State) -> f64 {
        let (gradients, strays) = self.projection.stray(system);
        for (own, stray) in state.strays.iter_mut().zip(strays) {
            *own = 0.5 * (*own + stray);
        }
        system.mass_times(&state.velocity, &mut state.momentum);
        let kinetic = 0.5 * state.velocity.iter().zip(&state.momentum).map(|(v, p)| v * p).sum::<f64>();
        system.add_constraint_forces(gradients, &state.strays, 1.0, &mut state.momentum);
        kinetic
    }
}

impl Scratch {
    /// What does not change in the iteration.
    fn prepare(&mut self, system: &System, state: &State, step: f64, end: f64) {
        let middle = state.time + 0.5 * step;
        system.excite(middle, &state.targets, &mut self.excitation);
        system.prescribe(state, middle, &mut self.prescribed_middle);
        system.prescribe(state, end, &mut self.prescribed_end);
        system.frames(&state.q, &state.triads, &mut self.frames_start);
    }

    /// Start of the iteration: `Dq = h v_k`, `Λ = 0`.
    fn predict(&mut self, state: &State, step: f64) {
        for (increment, velocity) in self.increment.iter_mut().zip(&state.velocity) {
            *increment = step * velocity;
        }
        self.impulses.fill(0.0);
    }

    /// Positions and frames in the middle and at the end, for the current increment.
    fn place(&mut self, system: &System, state: &State) {
        for (index, (q, increment)) in state.q.iter().zip(&self.increment).enumerate() {
            self.q_middle[index] = q + 0.5 * increment;
            self.q_end[index] = q + increment;
        }
        system.frames(&self.q_middle, &state.triads, &mut self.frames_middle);
        system.frames(&self.q_end, &state.triads, &mut self.frames_end);
        system.mass_times(&self.increment, &mut self.mass_increment);
    }

    /// Sets the forces without those of the joints, at the current positions; returns the work over the step of what acts from outside, J.
    fn act(&mut self, system: &System, state: &State, rule: AxialRule, step: f64) -> f64 {
        let [start, middle, end] = configurations(
            system,
            state,
            [&self.q_middle, &self.q_end],
            [&self.frames_start, &self.frames_middle, &self.frames_end],
            [&self.prescribed_middle, &self.prescribed_end],
        );
        let rates = Rates::Step { start: &start, end: &end, duration: step, velocity: &state.velocity };
        let passage = Passage { increment: over_step(rule, &self.increment), rates };
        system.forces_and_work(&middle, &passage, &self.excitation, &self.increment, &mut self.forces)
    }

    /// The energies of `state`, J, and the elastic energy at the current end.
    fn energies(&self, system: &System, state: &State) -> (Energies, f64) {
        let [start, _, end] = configurations(
            system,
            state,
            [&self.q_middle, &self.q_end],
            [&self.frames_start, &self.frames_middle, &self.frames_end],
            [&self.prescribed_middle, &self.prescribed_end],
        );
        let before = state.balance.last.unwrap_or_else(|| system.energies(&start, &state.velocity));
        (before, system.elastic_energy(&end))
    }

    /// Gradients of the conditions in the middle, at the current positions.
    fn differentiate(&mut self, system: &System, state: &State) {
        let middle = system.configuration(&self.q_middle, &self.frames_middle, state, &self.prescribed_middle);
        system.constraint_gradients(&middle, &mut self.gradients_middle);
    }

    /// The step over `span` at given unknowns.
    fn at<'a>(
        &'a mut self,
        system: &'a System,
        state: &'a State,
        rule: AxialRule,
        span: Span,
        unknowns: &[f64],
    ) -> Step<'a> {
        self.prepare(system, state, span.step, span.end);
        let (increment, impulses) = unknowns.split_at(self.increment.len());
        self.increment.copy_from_slice(increment);
        self.impulses.copy_from_slice(impulses);
        Step { system, state, rule, step: span.step, scratch: self }
    }

    /// Refuses what the elements cannot bear (MECHANICS 7.4).
    fn check(&self, system: &System, state: &State, end: f64) -> Result<(), Error> {
        let configuration = system.configuration(&self.q_end, &self.frames_end, state, &self.prescribed_end);
        system.check(&configuration, state, limits::LARGEST_TURN, end)
    }

    /// Writes the end of the converged step into `state`: momentum (7.4), change of charts (7.5), references (2.6). Returns the work over the step
    /// of what acts from outside, J.
    fn finish(&mut self, system: &System, state: &mut State, rule: AxialRule, step: f64, end: f64) -> f64 {
        let work = self.act(system, state, rule, step);
        system.add_constraint_forces(&self.gradients_middle, &self.impulses, 2.0 / step, &mut self.forces);
        // P⁻ = M Dq/h − h/2 f (7.4) with f taken from (7.1): round-off of the stiff f, h²K/M times that of Dq, stays out of it.
        for (momentum, mass_increment) in state.momentum.iter_mut().zip(&self.mass_increment) {
            *momentum = 2.0 * mass_increment / step - *momentum;
        }
        let frames = [&self.frames_start[..], &self.frames_middle, &self.frames_end];
        gyroscopic::add_forces(system, frames, &self.mass_increment, &self.forces, step, -1.0, &mut state.momentum);
        gyroscopic::change_charts(system, &self.frames_end, &mut state.momentum);
        for (multiplier, impulse) in state.multipliers.iter_mut().zip(&self.impulses) {
            *multiplier = 2.0 * impulse / step;
        }
        state.q.copy_from_slice(&self.q_end);
        state.prescribed.copy_from(&self.prescribed_end);
        system.carry_references(state, &self.frames_end);
        state.time = end;
        state.statistics.steps += 1;
        work + system.driven_work(&self.gradients_middle, &state.multipliers, &self.increment)
    }
}

/// The start, the middle and the end of a step from `state`.
fn configurations<'a>(
    system: &'a System,
    state: &'a State,
    [q_middle, q_end]: [&'a [f64]; 2],
    [frames_start, frames_middle, frames_end]: [&'a [NodeFrame]; 3],
    [prescribed_middle, prescribed_end]: [&'a Prescribed; 2],
) -> [Configuration<'a>; 3] {
    [
        system.configuration(&state.q, frames_start, state, &state.prescribed),
        system.configuration(q_middle, frames_middle, state, prescribed_middle),
        system.configuration(q_end, frames_end, state, prescribed_end),
    ]
}

/// The one term in which the two integrators differ.
fn over_step(rule: AxialRule, increment: &[f64]) -> Option<&[f64]> {
    match rule {
        AxialRule::Variational => None,
        AxialRule::Conserving => Some(increment),
    }
}

/// One step as Newton sees it.
struct Step<'a> {
    system: &'a System,
    state: &'a State,
    rule: AxialRule,
    step: f64,
    scratch: &'a mut Scratch,
}

impl Step<'_> {
    /// Minus the residual at the current unknowns, whose forces, positions and gradients are known, into `right`; conditions at the end.
    fn balance(&mut self, right: &mut [f64]) {
        let (system, state, h) = (self.system, self.state, self.step);
        let scratch = &mut *self.scratch;
        let end = system.configuration(&scratch.q_end, &scratch.frames_end, state, &scratch.prescribed_end);
        system.constraint_conditions(&end, &mut scratch.conditions);
        system.add_constraint_forces(&scratch.gradients_middle, &scratch.impulses, 2.0 / h, &mut scratch.forces);

        let (residual, conditions) = right.split_at_mut(state.q.len());
        for (index, residual) in residual.iter_mut().enumerate() {
            *residual = h * state.momentum[index] - scratch.mass_increment[index] - 0.5 * h * h * scratch.forces[index];
        }
        let frames = [&scratch.frames_start[..], &scratch.frames_middle, &scratch.frames_end];
        gyroscopic::add_forces(system, frames, &scratch.mass_increment, &scratch.forces, h, h, residual);
        for (target, condition) in conditions.iter_mut().zip(&scratch.conditions) {
            *target = -condition;
        }
    }
}

impl Problem for Step<'_> {
    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64 {
        let (system, state, h) = (self.system, self.state, self.step);
        let scratch = &mut *self.scratch;
        scratch.place(system, state);
        kkt.blocks.clear();

        let [start, middle, end] = configurations(
            system,
            state,
            [&scratch.q_middle, &scratch.q_end],
            [&scratch.frames_start, &scratch.frames_middle, &scratch.frames_end],
            [&scratch.prescribed_middle, &scratch.prescribed_end],
        );
        let rates = Rates::Step { start: &start, end: &end, duration: h, velocity: &state.velocity };
        let passage = Passage { increment: over_step(self.rule, &scratch.increment), rates };
        system.forces_and_tangent(
            &middle,
            &passage,
            &scratch.excitation,
            0.25 * h * h,
            &mut scratch.forces,
            &mut kkt.blocks,
        );
        system.add_mass(1.0, &mut kkt.blocks);
        system.constraint_gradients(&end, &mut scratch.gradients_end);
        kkt.set_curvatures_and_gradients(system, &middle, &scratch.impulses, 0.5 * h, &mut scratch.gradients_middle);
        let frames = [&scratch.frames_start[..], &scratch.frames_end];
        gyroscopic::add_tangent(system, frames[0], frames[1], &scratch.mass_increment, h, &mut kkt.blocks);
        self.balance(right);
        kkt.set_constraints(system, &self.scratch.gradients_middle, &self.scratch.gradients_end, h);
        state.time + 0.5 * h
    }

    fn correct(&mut self, correction: &[f64]) {
        let (coordinates, impulses) = correction.split_at(self.scratch.increment.len());
        for (value, correction) in self.scratch.increment.iter_mut().zip(coordinates) {
            *value += correction;
        }
        for (value, correction) in self.scratch.impulses.iter_mut().zip(impulses) {
            *value += correction;
        }
    }
}

impl Linearized for Midpoint {
    const MEMORY: bool = true;
    const PROJECTS: bool = true;

    fn unknowns(&self, _after: &State, unknowns: &mut Vec<f64>) {
        unknowns.clear();
        unknowns.extend(self.scratch.increment.iter().chain(&self.scratch.impulses));
    }

    fn factorize(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64]) -> Result<(), Error> {
        let Self { scratch, rule, kkt, right, .. } = self;
        let mut problem = scratch.at(system, state, *rule, span, unknowns);
        problem.linearize(kkt, right);
        kkt.factorize(system, span.end)
    }

    fn solve(&mut self, right: &mut [f64]) -> Result<(), Singular> {
        self.kkt.solve_again(right)
    }

    fn balance(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], right: &mut [f64]) {
        let mut problem = self.scratch.at(system, state, self.rule, span, unknowns);
        problem.scratch.place(system, state);
        problem.scratch.act(system, state, self.rule, span.step);
        problem.scratch.differentiate(system, state);
        problem.balance(right);
    }

    fn conclude(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], next: &mut State) {
        let mut right = std::mem::take(&mut self.right);
        self.balance(system, state, span, unknowns, &mut right);
        self.right = right;
        next.clone_from(state);
        self.scratch.finish(system, next, self.rule, span.step, span.end);
    }
}
