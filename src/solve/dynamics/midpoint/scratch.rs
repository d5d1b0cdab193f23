//! What a constrained midpoint step computes on the way: positions, frames, forces and gradients at its start, in its
//! middle and at its end.

use crate::error::Error;
use crate::mechanics::beam::configuration::Dissipation;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::configuration::{Configuration, Passage, TimeStep};
use crate::mechanics::state::energy_account::Work;
use crate::mechanics::state::energy_balance::Energies;
use crate::mechanics::state::lists::Lists;
use crate::mechanics::state::{State, rate_leads, viscous_rates};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::gyroscopic;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::step_starts::StepStarts;
use crate::mechanics::system::work::StepEnergy;
use crate::solve::newton::prediction;
use crate::solve::step::limits;
use crate::solve::step::linearized::Span;

/// The motion that a step starts from.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    pub q: &'a [f64],
    pub velocity: &'a [f64],
    pub strain_rates: &'a [f64],
    /// The memory of forces.
    pub memory: &'a [f64],
    /// Everything else: reference triads, holonomy angles, momenta.
    pub state: &'a State,
}

impl<'a> From<&'a State> for Start<'a> {
    fn from(state: &'a State) -> Self {
        let Lists { q, velocity, strain_rates, memory, .. } = &state.lists;
        Self { q, velocity, strain_rates, memory, state }
    }
}

/// What a step computes on the way.
#[derive(Debug, Default)]
pub struct Scratch {
    pub increment: Vec<f64>,
    pub impulses: Vec<f64>,
    pub q_middle: Vec<f64>,
    pub q_end: Vec<f64>,
    pub forces: Vec<f64>,
    pub start_rates: Vec<f64>,
    /// Rates of strains as the numerical dissipation predicts them with the velocities at the start.
    pub predicted_rates: Vec<f64>,
    pub starts: StepStarts,
    pub mass_increment: Vec<f64>,
    pub conditions: Vec<f64>,
    pub excitation: Excitation,
    pub prescribed_middle: Prescribed,
    pub prescribed_end: Prescribed,
    pub frames_start: FrameCache,
    pub frames_middle: FrameCache,
    pub frames_end: FrameCache,
    pub gradients_middle: Vec<JointGradient>,
    pub gradients_end: Vec<JointGradient>,
    /// Whether the material of a beam is damped.
    pub is_viscous: bool,
}

impl Scratch {
    /// For `system`.
    pub fn new(system: &System) -> Self {
        let (coordinates, conditions) = (system.coordinates(), system.constraints());
        Self {
            increment: vec![0.0; coordinates],
            impulses: vec![0.0; conditions],
            q_middle: vec![0.0; coordinates],
            q_end: vec![0.0; coordinates],
            forces: vec![0.0; coordinates],
            mass_increment: vec![0.0; coordinates],
            conditions: vec![0.0; conditions],
            is_viscous: system.has_material_damping(),
            ..Self::default()
        }
    }

    /// Scratch memory for `system`, without that which [`Self::exchange`] gives it.
    pub fn borrowing(system: &System) -> Self {
        let mut own = Self::new(system);
        own.exchange(&mut Self::default());
        own
    }

    /// Exchanges the memory that a finished step no longer needs with that of `other`. `other` reads the predicted
    /// rates and overwrites the rest.
    /// [`super::time_error::Estimator::borrow_from`] gives it back.
    pub fn exchange(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.q_middle, &mut other.q_middle);
        std::mem::swap(&mut self.q_end, &mut other.q_end);
        std::mem::swap(&mut self.forces, &mut other.forces);
        std::mem::swap(&mut self.mass_increment, &mut other.mass_increment);
        std::mem::swap(&mut self.predicted_rates, &mut other.predicted_rates);
        std::mem::swap(&mut self.starts, &mut other.starts);
        std::mem::swap(&mut self.frames_start, &mut other.frames_start);
        std::mem::swap(&mut self.frames_middle, &mut other.frames_middle);
        std::mem::swap(&mut self.frames_end, &mut other.frames_end);
    }

    /// What does not change in the iteration.
    pub fn prepare(&mut self, system: &System, state: &State, step: f64, end: f64) {
        let middle = state.time + 0.5 * step;
        system.excite(middle, &state.targets, &mut self.excitation);
        if system.has_waves() {
            // Once a step, where the beams are expected in its middle: the iteration moves them by far less than a
            // wave.
            prediction::predict(state, step, &mut self.increment);
            for ((q, start), increment) in self.q_middle.iter_mut().zip(&state.q).zip(&self.increment) {
                *q = start + 0.5 * increment;
            }
            system.look_at_waves(&self.q_middle, middle, &mut self.excitation);
        }
        system.prescribe(state, middle, &mut self.prescribed_middle);
        system.prescribe(state, end, &mut self.prescribed_end);
        self.start_rates.resize(state.strain_rates.len(), 0.0);
        let start = self.frames_start.of(system, state);
        let middle = &self.prescribed_middle.drives;
        system.begin_step(&start, middle, &state.velocity, &mut self.starts, Some(&mut self.start_rates));
        rate_leads::predict(&state.lists, &self.start_rates, &mut self.predicted_rates);
    }

    /// Start of the iteration: the predicted increment, and the impulses of the last step.
    pub fn predict(&mut self, state: &State, step: f64) {
        prediction::predict(state, step, &mut self.increment);
        for (impulse, multiplier) in self.impulses.iter_mut().zip(&state.multipliers) {
            *impulse = 0.5 * step * multiplier;
        }
    }

    /// Adds a correction to the unknowns.
    pub fn correct(&mut self, correction: &[f64]) {
        let (coordinates, impulses) = correction.split_at(self.increment.len());
        self.increment.iter_mut().zip(coordinates).for_each(|(value, correction)| *value += correction);
        self.impulses.iter_mut().zip(impulses).for_each(|(value, correction)| *value += correction);
    }

    /// Positions and frames in the middle and at the end, for the current increment.
    pub fn place(&mut self, system: &System, start: Start) {
        let (places, state) = (self.q_middle.iter_mut().zip(&mut self.q_end), start.state);
        for ((q, increment), (middle, end)) in start.q.iter().zip(&self.increment).zip(places) {
            *middle = q + 0.5 * increment;
            *end = q + increment;
        }
        self.frames_middle.set(system, &self.q_middle, &state.triads);
        self.frames_end.set(system, &self.q_end, &state.triads);
        let mass = MassAt::new(&self.prescribed_middle.drives, &self.frames_middle);
        system.mass_times(mass, &self.increment, &mut self.mass_increment);
    }

    /// Sets the forces without those of the joints, at the current positions.
    pub fn act(&mut self, system: &System, from: Start, dissipation: Dissipation, step: f64) {
        let [start, middle, end] = configurations(
            system,
            from,
            [&self.q_middle, &self.q_end],
            [&self.frames_start, &self.frames_middle, &self.frames_end],
            [&self.prescribed_middle, &self.prescribed_end],
        );
        let passage = Passage::Step(time_step(
            from,
            [&start, &end],
            &self.increment,
            (&self.predicted_rates, &self.starts),
            step,
            dissipation,
        ));
        system.forces(&middle, &passage, &self.excitation, &mut self.forces);
    }

    /// Continues the rates of strains to the end of the step from `state` that `next` has those over.
    pub fn continue_rates(&self, state: &State, step: f64, next: &mut State) {
        rate_leads::advance(&mut next.lists, &state.strain_rates, &self.start_rates);
        if self.is_viscous {
            viscous_rates::advance(next, step, &state.strain_rates, &self.start_rates);
        }
    }

    /// Sets the velocities at the end of a step of `step` s that begins with the velocities `before` and that nothing
    /// strikes.
    pub fn expect(&self, before: &[f64], step: f64, velocity: &mut [f64]) {
        for ((velocity, increment), before) in velocity.iter_mut().zip(&self.increment).zip(before) {
            *velocity = 2.0 * increment / step - before;
        }
    }

    /// Sets the momentum of `next`, whose velocities have changed at once, to that of these; returns the kinetic
    /// energy, J.
    pub fn strike(&self, system: &System, next: &mut State) -> f64 {
        system.set_momentum(next);
        next.constraint_momenta.fill(0.0);
        next.velocity_lead.clear();
        0.5 * next.velocity.iter().zip(&next.momentum).map(|(v, p)| v * p).sum::<f64>()
    }

    /// Sets by how much the velocities of `next`, that the accelerations of added mass in the next step are counted
    /// from, exceed the projected ones: the mean velocity over the step of `step` s from `state` less that of its ends.
    /// Added mass then sees the motion as the mass of the beams does, whose momentum has that part (MECHANICS 11).
    pub fn lead(&self, system: &System, state: &State, step: f64, next: &mut State) {
        if !system.is_in_fluid() {
            return;
        }
        let Lists { velocity, velocity_lead, .. } = &mut next.lists;
        velocity_lead.resize(velocity.len(), 0.0);
        let ends = state.velocity.iter().zip(&*velocity);
        for (lead, (increment, (before, after))) in velocity_lead.iter_mut().zip(self.increment.iter().zip(ends)) {
            *lead = increment / step - 0.5 * (before + after);
        }
    }

    /// The energies of `state`, J.
    pub fn energies(&self, system: &System, state: &State) -> Energies {
        let start = system.configuration(&state.q, &self.frames_start, state, &state.prescribed);
        state.balance.last.unwrap_or_else(|| system.energies(&start, &state.velocity))
    }

    /// The work over the step from `state` to `next` by its origin, J, with the solution as it has been refined.
    pub fn work(&self, system: &System, state: &State, dissipation: Dissipation, span: Span, next: &State) -> Work {
        let [start, middle, end] = configurations(
            system,
            state.into(),
            [&self.q_middle, &self.q_end],
            [&self.frames_start, &self.frames_middle, &self.frames_end],
            [&self.prescribed_middle, &self.prescribed_end],
        );
        let starts = (&self.predicted_rates[..], &self.starts);
        let over = time_step(state.into(), [&start, &end], &self.increment, starts, span.step, dissipation);
        // Not into the memory of the step: its results do not depend on who asks for the work.
        let (mut forces, mut rates, mut gradients) = (self.forces.clone(), next.strain_rates.clone(), Vec::new());
        let found = system.finish_step(&middle, &over, &self.excitation, &mut forces, &mut rates);
        system.constraint_gradients(&middle, &mut gradients);
        let driven = system.driven_work(&gradients, &next.multipliers, &self.increment);
        let [loads, actuators] =
            system.loads_and_actuators(&middle, &Passage::Step(over), &self.excitation, &self.increment);
        let drives = driven + found.by_frames + found.by_winches;
        Work { loads: loads + found.by_heat, actuators, drives, dissipated: found.dissipated, fluids: found.by_fluids }
    }

    /// Kinetic, elastic and gravity energy at the start of the step from `state`, J.
    pub fn whole_energy(&self, system: &System, state: &State) -> f64 {
        let start = system.configuration(&state.q, &self.frames_start, state, &state.prescribed);
        system.whole_energy(&start, &state.velocity)
    }

    /// The same at the end, `next`.
    pub fn whole_energy_of_end(&self, system: &System, state: &State, next: &State) -> f64 {
        let end = system.configuration(&next.q, &self.frames_end, state, &self.prescribed_end);
        system.whole_energy(&end, &next.velocity)
    }

    /// Kinetic energy of the beams that winches pay out, beyond that of the mesh, at the start of the step from `state`
    /// and at its end, `next`, J.
    pub fn transport_energies(&mut self, system: &System, state: &State, next: &State) -> [f64; 2] {
        if system.winches.is_empty() {
            return [0.0; 2];
        }
        // Others may have written where they were ([`Self::exchange`]).
        let start = self.frames_start.of(system, state);
        let end = system.configuration(&next.q, &self.frames_end, state, &self.prescribed_end);
        [system.transport_energy(&start, &state.velocity), system.transport_energy(&end, &next.velocity)]
    }

    /// Gradients of the conditions in the middle, at the current positions.
    pub fn differentiate(&mut self, system: &System, state: &State) {
        let middle = system.configuration(&self.q_middle, &self.frames_middle, state, &self.prescribed_middle);
        system.constraint_gradients(&middle, &mut self.gradients_middle);
    }

    /// Refuses what the elements cannot bear (MECHANICS 7.4); returns the largest turn over what it may be.
    pub fn check(&self, system: &System, state: &State, end: f64) -> Result<f64, Error> {
        let configuration = system.configuration(&self.q_end, &self.frames_end, state, &self.prescribed_end);
        system.check(&configuration, state, limits::LARGEST_TURN, end)
    }

    /// Sets the forces of the step from `state` at the current positions, without those of the joints, their gradients,
    /// and the rates of strains over the step in `next`. Returns what the step does to the energies.
    pub fn evaluate(
        &mut self,
        system: &System,
        state: &State,
        dissipation: Dissipation,
        span: Span,
        next: &mut State,
    ) -> StepEnergy {
        let [start, middle, end] = configurations(
            system,
            state.into(),
            [&self.q_middle, &self.q_end],
            [&self.frames_start, &self.frames_middle, &self.frames_end],
            [&self.prescribed_middle, &self.prescribed_end],
        );
        let over = time_step(
            state.into(),
            [&start, &end],
            &self.increment,
            (&self.predicted_rates, &self.starts),
            span.step,
            dissipation,
        );
        let found = system.finish_step(&middle, &over, &self.excitation, &mut self.forces, &mut next.strain_rates);
        self.differentiate(system, state);
        found
    }

    /// Moves `next`, a copy of `state` at the start of the converged step of `step` s, to its end.
    fn arrive(&self, system: &System, state: &State, next: &mut State, step: f64) {
        let end = (&*self.q_end, &self.frames_end, &self.prescribed_end);
        if !system.has_contact_friction() {
            return system.arrive(next, end, None);
        }
        let [from, middle, to] = configurations(
            system,
            state.into(),
            [&self.q_middle, &self.q_end],
            [&self.frames_start, &self.frames_middle, &self.frames_end],
            [&self.prescribed_middle, &self.prescribed_end],
        );
        let known = (&*self.predicted_rates, &self.starts);
        let over = time_step(state.into(), [&from, &to], &self.increment, known, step, Dissipation::default());
        system.arrive(next, end, Some((&middle, &Passage::Step(over))));
    }

    /// Writes the end of the converged step, whose forces are known, into `next`, a copy of `state`
    /// at its start:
    /// momentum (7.4), change of charts (7.5), references (2.6). Returns the work of drives and moving frames over the
    /// step, J.
    pub fn finish(&mut self, system: &System, state: &State, next: &mut State, Span { step, end }: Span) -> f64 {
        // P⁻ = M Dq/h − h/2 f (7.4) with f taken from (7.1): round-off of the stiff f, h²K/M times that of Dq, stays
        // out of it, and so does h²K/M times what Newton leaves.
        for (momentum, mass_increment) in next.momentum.iter_mut().zip(&self.mass_increment) {
            *momentum = 2.0 * mass_increment / step - *momentum;
        }
        let frames = [&self.frames_start, &self.frames_middle, &self.frames_end];
        gyroscopic::add_forces(system, frames, &self.mass_increment, &self.forces, step, -1.0, &mut next.momentum);
        gyroscopic::change_charts(system, &self.frames_end, &mut next.momentum);
        for (multiplier, impulse) in next.multipliers.iter_mut().zip(&self.impulses) {
            *multiplier = 2.0 * impulse / step;
        }
        self.arrive(system, state, next, step);
        next.time = end;
        next.statistics.steps += 1;
        system.driven_work(&self.gradients_middle, &next.multipliers, &self.increment)
    }
}

/// The start, the middle and the end of a step that starts from `from`.
pub fn configurations<'a>(
    system: &'a System,
    Start { q, memory, state, .. }: Start<'a>,
    [q_middle, q_end]: [&'a [f64]; 2],
    [frames_start, frames_middle, frames_end]: [&'a FrameCache; 3],
    [prescribed_middle, prescribed_end]: [&'a Prescribed; 2],
) -> [Configuration<'a>; 3] {
    [
        system.configuration(q, frames_start, state, &state.prescribed),
        system.configuration(q_middle, frames_middle, state, prescribed_middle),
        system.configuration(q_end, frames_end, state, prescribed_end),
    ]
    .map(|own| Configuration { memory, ..own })
}

/// The step between the two ends that starts from `from`, of `duration` s.
pub fn time_step<'a>(
    from: Start<'a>,
    [start, end]: [&'a Configuration<'a>; 2],
    increment: &'a [f64],
    (predicted_rates, starts): (&'a [f64], &'a StepStarts),
    duration: f64,
    dissipation: Dissipation,
) -> TimeStep<'a> {
    let Start { velocity, strain_rates, state, .. } = from;
    let (starts, velocity_lead) = (starts.list(), &state.lists.velocity_lead[..]);
    TimeStep {
        start,
        end,
        increment,
        duration,
        velocity,
        dissipation,
        strain_rates,
        predicted_rates,
        starts,
        velocity_lead,
    }
}
