//! The constrained generalized-alpha method (Arnold, Brüls: Convergence of the generalized-α scheme for constrained
//! mechanical systems, Multibody System Dynamics 18, 2007), which damps what the step does not resolve (MECHANICS 7.2,
//! 7.3).
//!
//! A step from `q_n, v_n, a_n, q''_n` solves `M q'' + f + C + Gᵀ λ = 0` and `g(q) = 0` at its end, `f = dU/dq − F`,
//! where `q = q_n + h v_n + h² [(1/2 − β) a_n + β a]`, `v = v_n + h [(1 − γ) a_n + γ a]`,
//! `(1 − α_m) a + α_m a_n = (1 − α_f) q'' + α_f q''_n`, for `Dq = q − q_n` and `Λ = λ/β'`, `β' = ∂q''/∂q`: Newton's
//! matrix `[M + K/β' + …, Gᵀ; G, 0]` has entries of like sizes.
//!
//! The rate of `theta` is the spin, a quasi-velocity that charts do not change (7.2): so velocities and accelerations
//! go on as they are when references are carried. It differs from the derivative of the chart's angle by a term of
//! second order in the step. The forces are those of the start's chart; `C` of gyroscopic.rs makes up for it.

use super::power::{begin_balance, driven_work, shares};
use super::start::Dynamics;
use crate::error::Error;
use crate::mechanics::beam::configuration::Purpose;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::state::energy_account::{EnergyAccount, Work};
use crate::mechanics::state::energy_balance::{EnergyBalance, Losses};
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::gyroscopic;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::{AT_BREAK, System};
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::newton::{self, Convergence, Goal, Limit, Problem};
use crate::solve::step::integrator::Integrator;
use crate::solve::step::limits;
use crate::solve::step::linearized::{Linearized, Span};
use crate::solve::step::response::{Responder, Response};
use crate::solve::step::switching;
use crate::solve::step::tally::Tally;

/// Largest spectral radius for systems with joints: with 1 a pendulum fails within 10 s, with this one the forces stay
/// smooth.
const LARGEST_RADIUS: f64 = 0.99;

/// Integrator and its scratch memory; nothing in it outlives a step.
#[derive(Debug)]
pub struct GeneralizedAlpha {
    spectral_radius: f64,
    weights: Weights,
    tolerance: f64,
    kkt: Kkt,
    right: Vec<f64>,
    scratch: Scratch,
    /// Made when a step first ends at a break of loads or drives.
    responder: Option<Box<Responder>>,
    /// How the last step went.
    pub convergence: Option<Convergence>,
}

/// The four weights of the method.
#[derive(Clone, Copy, Debug)]
struct Weights {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
}

impl Weights {
    /// Those whose amplification of infinitely fast vibrations is `spectral_radius`, and the least of slow ones (Chung,
    /// Hulbert).
    fn new(spectral_radius: f64) -> Self {
        let alpha_m = (2.0 * spectral_radius - 1.0) / (spectral_radius + 1.0);
        let alpha_f = spectral_radius / (spectral_radius + 1.0);
        let gamma = 0.5 + alpha_f - alpha_m;
        Self { alpha_m, alpha_f, beta: 0.25 * (0.5 + gamma) * (0.5 + gamma), gamma }
    }

    /// `∂v/∂q = γ/(β h)`, 1/s, and `β' = ∂q''/∂q = (1 − α_m)/((1 − α_f) β h²)`, 1/s², at the end of a step.
    fn by_q(&self, step: f64) -> [f64; 2] {
        let algorithmic_by_q = 1.0 / (self.beta * step * step);
        [self.gamma * step * algorithmic_by_q, (1.0 - self.alpha_m) / (1.0 - self.alpha_f) * algorithmic_by_q]
    }
}

/// What a step computes on the way; all of it at the step's end.
#[derive(Debug, Default)]
struct Scratch {
    increment: Vec<f64>,
    scaled_multipliers: Vec<f64>,
    q: Vec<f64>,
    velocity: Vec<f64>,
    acceleration: Vec<f64>,
    algorithmic: Vec<f64>,
    momentum: Vec<f64>,
    momentum_rate: Vec<f64>,
    forces: Vec<f64>,
    conditions: Vec<f64>,
    excitation: Excitation,
    prescribed: Prescribed,
    frames: FrameCache,
    gradients: Vec<JointGradient>,
}

impl GeneralizedAlpha {
    /// For `system`; the amplitude of a vibration far too fast for the step is multiplied by `spectral_radius` (0 to 1)
    /// a step. With 1, multipliers are not damped and grow: systems with joints need less. Newton ends when its
    /// correction is below `tolerance`.
    pub fn new(system: &System, spectral_radius: f64, tolerance: f64) -> Self {
        assert!((0.0..=1.0).contains(&spectral_radius), "a spectral radius of {spectral_radius}");
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        let scratch = Scratch {
            increment: vec![0.0; coordinates],
            scaled_multipliers: vec![0.0; conditions],
            q: vec![0.0; coordinates],
            velocity: vec![0.0; coordinates],
            acceleration: vec![0.0; coordinates],
            algorithmic: vec![0.0; coordinates],
            momentum: vec![0.0; coordinates],
            momentum_rate: vec![0.0; coordinates],
            forces: vec![0.0; coordinates],
            conditions: vec![0.0; conditions],
            ..Scratch::default()
        };
        Self {
            spectral_radius,
            weights: Weights::new(spectral_radius),
            tolerance,
            kkt: Kkt::for_steps(system),
            right: vec![0.0; coordinates + conditions],
            scratch,
            responder: None,
            convergence: None,
        }
    }

    /// Starts anew from `state`, the end of a step of `step` s, if loads or drives jump there: the accelerations before
    /// it are not those behind it, and what the method carries on would spread the jump over many steps. Accelerations
    /// that are not finite behind it are left to the next step to refuse.
    fn restart_at_break(&mut self, system: &System, state: &mut State, step: f64) {
        if system.is_sudden(state.time, step) {
            self.restart(system, state);
        }
    }

    /// Starts anew from `state`.
    fn restart(&mut self, system: &System, state: &mut State) {
        let responder = self.responder.get_or_insert_with(|| Box::new(Responder::new(system)));
        let _ = set_accelerations(responder, system, state);
        state.balance.forget_last();
    }
}

/// Sets what `state` carries on from step to step to the accelerations and multipliers of its instant (MECHANICS 7.5).
fn set_accelerations(responder: &mut Responder, system: &System, state: &mut State) -> Result<(), Error> {
    let mut response = Response::default();
    responder.respond(system, state, &mut response)?;
    state.lists.algorithmic_acceleration.clone_from(&response.acceleration);
    state.lists.acceleration = response.acceleration;
    state.multipliers = response.multipliers;
    Ok(())
}

impl GeneralizedAlpha {
    /// Why its spectral radius should not be used with a system; none: it can.
    pub fn objection(&self, system: &System) -> Option<String> {
        let spectral_radius = self.spectral_radius;
        (spectral_radius > LARGEST_RADIUS && system.constraints() > 0).then(|| {
            format!(
                "spectral_radius = {spectral_radius} does not damp the forces of joints, which grow without end: take at most \
                 {LARGEST_RADIUS}"
            )
        })
    }
}

impl Dynamics for GeneralizedAlpha {
    fn kkt(&mut self) -> &mut Kkt {
        &mut self.kkt
    }

    /// Accelerations and multipliers are those of the instant (MECHANICS 7.5).
    fn begin(&mut self, system: &System, state: &mut State) -> Result<(), Error> {
        set_accelerations(&mut Responder::new(system), system, state)
    }
}

impl Integrator for GeneralizedAlpha {
    fn step(&mut self, system: &System, state: &mut State, step: f64, end: f64) -> Result<(), Error> {
        assert_eq!(state.lists.algorithmic_acceleration.len(), state.q.len(), "the state has not begun to move");
        self.scratch.prepare(system, state, step, end);
        self.scratch.predict(state, self.weights, step);
        limits::check_frames(system, state, &self.scratch.prescribed, step, end)?;
        let mut solved = self.iterate(system, state, Span { step, end }, Purpose::Iteration);
        if matches!(solved, Err(Error::NotConverged { .. })) && system.has_material_damping() {
            self.scratch.predict(state, self.weights, step);
            solved = self.iterate(system, state, Span { step, end }, Purpose::Derivatives);
        }
        self.convergence = Some(solved?);
        self.scratch.place(system, state, self.weights, step);
        self.scratch.check(system, state, end)?;
        let balance = self.scratch.balance(system, state, self.weights, step, end);
        self.scratch.finish(system, state, self.weights, step, end);
        state.balance = balance;
        if !system.heats.is_empty() {
            // The power of heat is not in it.
            state.balance.skip_jump();
        }
        self.restart_at_break(system, state, step);
        Ok(())
    }

    fn switch(&mut self, system: &System, state: &mut State, time: f64) -> Result<bool, Error> {
        let switched = switching::switch(system, &mut self.kkt, state, time)?;
        if switched {
            self.restart(system, state);
        }
        Ok(switched)
    }

    fn tally(&mut self) -> Option<&mut Tally> {
        None
    }
}

impl GeneralizedAlpha {
    /// Solves for the step over `span` from `state`, from where the scratch memory is, with tangents for `purpose`.
    fn iterate(
        &mut self,
        system: &System,
        state: &mut State,
        Span { step, end }: Span,
        purpose: Purpose,
    ) -> Result<Convergence, Error> {
        let (weights, scratch) = (self.weights, &mut self.scratch);
        let mut problem = Step { system, state, weights, step, end, scratch, purpose };
        let mut iterations = state.statistics.iterations;
        let control = (Goal::Correction(self.tolerance), Limit::Fails(limits::ITERATIONS));
        let solved = newton::solve(system, &mut problem, &mut self.kkt, &mut self.right, control, end, &mut iterations);
        state.statistics.iterations = iterations;
        solved
    }
}

impl Scratch {
    /// What does not change in the iteration. Where a load goes over to another piece at the end, the step is still
    /// under the one before.
    fn prepare(&mut self, system: &System, state: &State, step: f64, end: f64) {
        let under = if system.is_sudden(end, step) { (end - AT_BREAK * step).next_down() } else { end };
        system.excite(under, &state.targets, &mut self.excitation);
        system.prescribe(state, end, &mut self.prescribed);
    }

    /// Start of the iteration: `Dq = h v_n`, `λ = λ_n`.
    fn predict(&mut self, state: &State, weights: Weights, step: f64) {
        for (increment, velocity) in self.increment.iter_mut().zip(&state.velocity) {
            *increment = step * velocity;
        }
        let [_, acceleration_by_q] = weights.by_q(step);
        for (scaled, multiplier) in self.scaled_multipliers.iter_mut().zip(&state.multipliers) {
            *scaled = multiplier / acceleration_by_q;
        }
    }

    /// Position, velocity, accelerations, frames and momentum for the current increment.
    fn place(&mut self, system: &System, state: &State, weights: Weights, step: f64) {
        let Weights { alpha_m, alpha_f, beta, gamma } = weights;
        for index in 0..state.q.len() {
            let (increment, velocity) = (self.increment[index], state.velocity[index]);
            let (a, q_tt) = (state.algorithmic_acceleration[index], state.acceleration[index]);
            let a_end = ((increment / step - velocity) / step - (0.5 - beta) * a) / beta;
            self.q[index] = state.q[index] + increment;
            self.velocity[index] = velocity + step * ((1.0 - gamma) * a + gamma * a_end);
            self.acceleration[index] = ((1.0 - alpha_m) * a_end + alpha_m * a - alpha_f * q_tt) / (1.0 - alpha_f);
            self.algorithmic[index] = a_end;
        }
        self.frames.set(system, &self.q, &state.triads);
        let mass = MassAt::new(&self.prescribed.drives, &self.frames);
        system.mass_times(mass, &self.velocity, &mut self.momentum);
        system.mass_times(mass, &self.acceleration, &mut self.momentum_rate);
    }

    /// Forces without those of spins and joints, and gradients of these, at the current positions.
    fn act(&mut self, system: &System, state: &State) {
        let configuration = system.configuration(&self.q, &self.frames, state, &self.prescribed);
        let passage = Passage::with_velocity(&self.velocity);
        system.forces(&configuration, &passage, &self.excitation, &mut self.forces);
        system.constraint_gradients(&configuration, &mut self.gradients);
    }

    /// The step over `span` at given unknowns.
    fn at<'a>(
        &'a mut self,
        system: &'a System,
        state: &'a State,
        weights: Weights,
        span: Span,
        unknowns: &[f64],
    ) -> Step<'a> {
        self.prepare(system, state, span.step, span.end);
        let (increment, multipliers) = unknowns.split_at(self.increment.len());
        self.increment.copy_from_slice(increment);
        self.scaled_multipliers.copy_from_slice(multipliers);
        Step { system, state, weights, step: span.step, end: span.end, scratch: self, purpose: Purpose::Derivatives }
    }

    /// Refuses what the elements cannot bear (MECHANICS 7.4).
    fn check(&self, system: &System, state: &State, end: f64) -> Result<f64, Error> {
        let configuration = system.configuration(&self.q, &self.frames, state, &self.prescribed);
        system.check(&configuration, state, limits::LARGEST_TURN, end)
    }

    /// The account of the energy with this step in it: the power of what acts from outside is taken at both ends.
    fn balance(&mut self, system: &System, state: &State, weights: Weights, step: f64, end: f64) -> EnergyBalance {
        let mut balance = state.balance;
        let [_, acceleration_by_q] = weights.by_q(step);
        let configuration = system.configuration(&self.q, &self.frames, state, &self.prescribed);
        let (energies, [acting, damping]) =
            system.energies_and_power(&configuration, &self.velocity, &self.excitation, &mut self.forces);
        let driving = system.driven_work(&self.gradients, &self.scaled_multipliers, &self.velocity);
        let driving = acceleration_by_q * driving;
        let power = [acting + driving, damping];
        if balance.last.is_none() {
            let (energies, power, shares) = begin_balance(system, state);
            (balance.last, balance.power) = (Some(energies), power);
            let start = FrameCache::default();
            let start = system.configuration(&state.q, &start, state, &state.prescribed);
            let energy = Some(energies.kinetic + energies.elastic + system.gravity_energy(&start));
            balance.account = balance.account.map(|account| EnergyAccount { power: shares, energy, ..account });
        }
        let shares = balance
            .account
            .is_some()
            .then(|| shares(system, &configuration, &self.velocity, &self.excitation, [driving, damping]));
        let given = balance.work_by_power(power[0], step);
        let multipliers = [(&state.multipliers[..], 1.0), (&self.scaled_multipliers, acceleration_by_q)];
        let along = driven_work(system, &self.gradients, multipliers, [&state.q, &self.q], &mut self.forces);
        let before = system.driven_work(&self.gradients, &state.multipliers, &state.velocity);
        balance.add_doubt(0.5 * step * (before + driving) - along);
        // Where a rate changes within a step, the powers at its ends are not those between: the smaller one is surely
        // taken.
        let taken = step * balance.power[1].min(power[1]);
        balance.account(end, given - taken, energies, system.energy_noise(), Losses::NumericalAtInstants);
        if let (Some(account), Some(shares)) = (&mut balance.account, shares) {
            let mut work = Work::default();
            [account.power, shares].iter().for_each(|power| work.add(power, 0.5 * step));
            account.power = shares;
            let energy = energies.kinetic + energies.elastic + system.gravity_energy(&configuration);
            let begin = account.energy.unwrap_or(energy);
            balance.add_work(&work, [begin, energy]);
        }
        balance.power = power;
        balance
    }

    /// Writes the end of the converged step into `state`, references carried on (2.6).
    fn finish(&self, system: &System, state: &mut State, weights: Weights, step: f64, end: f64) {
        let [_, acceleration_by_q] = weights.by_q(step);
        for (multiplier, scaled) in state.multipliers.iter_mut().zip(&self.scaled_multipliers) {
            *multiplier = scaled * acceleration_by_q;
        }
        state.velocity.copy_from_slice(&self.velocity);
        state.momentum.copy_from_slice(&self.momentum);
        state.lists.acceleration.copy_from_slice(&self.acceleration);
        state.lists.algorithmic_acceleration.copy_from_slice(&self.algorithmic);
        system.arrive(state, (&self.q, &self.frames, &self.prescribed), None);
        state.time = end;
        state.statistics.steps += 1;
    }
}

/// One step as Newton sees it.
struct Step<'a> {
    system: &'a System,
    state: &'a State,
    weights: Weights,
    step: f64,
    end: f64,
    scratch: &'a mut Scratch,
    purpose: Purpose,
}

impl Step<'_> {
    /// Minus the residual at the current unknowns, whose forces, positions and gradients are known, into `right`.
    fn balance(&mut self, right: &mut [f64]) {
        let (system, state) = (self.system, self.state);
        let scratch = &mut *self.scratch;
        let scale = 1.0 / self.weights.by_q(self.step)[1];
        let configuration = system.configuration(&scratch.q, &scratch.frames, state, &scratch.prescribed);
        let forces = &mut scratch.forces;
        gyroscopic::add_rate_forces(system, &scratch.frames, &scratch.velocity, &scratch.momentum, forces);
        gyroscopic::add_chart_forces(system, &scratch.frames, &scratch.momentum_rate, forces);
        system.constraint_conditions(&configuration, &mut scratch.conditions);

        let (residual, conditions) = right.split_at_mut(state.q.len());
        for (index, residual) in residual.iter_mut().enumerate() {
            *residual = -scale * (scratch.momentum_rate[index] + scratch.forces[index]);
        }
        system.add_constraint_forces(&scratch.gradients, &scratch.scaled_multipliers, -1.0, residual);
        for (target, condition) in conditions.iter_mut().zip(&scratch.conditions) {
            *target = -condition;
        }
    }
}

impl Problem for Step<'_> {
    fn undefined_law(&self) -> Option<String> {
        let Self { system, state, scratch, .. } = self;
        let configuration = system.configuration(&scratch.q, &scratch.frames, state, &scratch.prescribed);
        system.undefined_law(&configuration, |coordinate, _| coordinate.rate(&configuration, &scratch.velocity))
    }

    fn linearize(&mut self, kkt: &mut Kkt, right: &mut [f64]) -> f64 {
        let (system, state) = (self.system, self.state);
        let scratch = &mut *self.scratch;
        scratch.place(system, state, self.weights, self.step);
        let by_q = self.weights.by_q(self.step);
        let scale = 1.0 / by_q[1];

        let configuration = system.configuration(&scratch.q, &scratch.frames, state, &scratch.prescribed);
        let passage = Passage::with_velocity_by_q(&scratch.velocity, by_q[0], self.purpose);
        let (forces, tangent) = (&mut scratch.forces, &mut kkt.blocks);
        system.forces_and_tangent(&configuration, &passage, &scratch.excitation, scale, forces, tangent);
        let given = (&scratch.velocity[..], &scratch.excitation);
        system.add_damping_matrix(&configuration, given, scale * by_q[0], tangent);
        system.add_mass(MassAt::from(&configuration), 1.0, tangent);
        let motion = [&scratch.velocity[..], &scratch.momentum, &scratch.momentum_rate];
        gyroscopic::add_rate_tangent(
            system,
            (&scratch.frames, &scratch.prescribed.drives),
            motion,
            by_q,
            scale,
            tangent,
        );
        kkt.set_curvatures_and_gradients(
            system,
            &configuration,
            &scratch.scaled_multipliers,
            1.0,
            &mut scratch.gradients,
        );
        self.balance(right);
        kkt.set_constraints(system, &self.scratch.gradients, &self.scratch.gradients, 1.0);
        self.end
    }

    fn correct(&mut self, correction: &[f64]) {
        let (coordinates, multipliers) = correction.split_at(self.scratch.increment.len());
        for (value, correction) in self.scratch.increment.iter_mut().zip(coordinates) {
            *value += correction;
        }
        for (value, correction) in self.scratch.scaled_multipliers.iter_mut().zip(multipliers) {
            *value += correction;
        }
    }
}

impl Linearized for GeneralizedAlpha {
    const MEMORY: bool = true;
    const PROJECTS: bool = false;

    fn unknowns(&self, _after: &State, unknowns: &mut Vec<f64>) {
        unknowns.clear();
        unknowns.extend(self.scratch.increment.iter().chain(&self.scratch.scaled_multipliers));
    }

    fn factorize(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64]) -> Result<(), Error> {
        let Self { scratch, weights, kkt, right, .. } = self;
        let mut problem = scratch.at(system, state, *weights, span, unknowns);
        problem.linearize(kkt, right);
        kkt.factorize(system, span.end)
    }

    fn solve(&mut self, right: &mut [f64]) -> Result<(), Singular> {
        self.kkt.solve_again(right)
    }

    fn balance(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], right: &mut [f64]) {
        let mut problem = self.scratch.at(system, state, self.weights, span, unknowns);
        problem.scratch.place(system, state, self.weights, span.step);
        problem.scratch.act(system, state);
        problem.balance(right);
    }

    fn conclude(&mut self, system: &System, state: &State, span: Span, unknowns: &[f64], next: &mut State) {
        let problem = self.scratch.at(system, state, self.weights, span, unknowns);
        problem.scratch.place(system, state, self.weights, span.step);
        next.clone_from(state);
        problem.scratch.finish(system, next, self.weights, span.step, span.end);
        self.restart_at_break(system, next, span.step);
    }
}
