//! The equations of motion about a state, to first order (docs/linearization.md):
//!
//! ```text
//! M da + Gᵀ dλ = R_q dq + R_v dv + R_u du,   G da = R'_q dq + R'_v dv + R'_u du,   G dv = −V_q dq − V_u du
//! ```
//!
//! A change of `theta` is a turn of the section about its tangent, and a change of its velocity one of the spin: the
//! charts go with the motion. `dq/dt = dv + N dq` then has a part where tangents turn.
//!
//! Everything that is stiff has closed derivatives: elements, springs, laws, actuators, loads, the curvature of
//! constraints, gyroscopic forces. Differences are left to what follows the coordinates gently, and only where the
//! state moves: the rotary inertia that follows the sections, and the second derivatives of constraints by time.

pub mod base;
pub mod component_modes;
mod differences;
mod gramian;
pub mod independent;
mod modal;
pub mod poles;
pub mod responses;
pub mod second_order;
pub mod split;
pub mod state_space;
pub mod steady;
pub mod tracking;
pub mod truncation;

use self::base::Base;
use self::independent::{Independent, Selection};
use crate::error::Error;
use crate::math::Mat3;
use crate::math::blocks::Blocks;
use crate::math::vectors::vec3;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::gyroscopic::{self, ChartRate};
use crate::mechanics::system::mass::MassAt;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::response::Response;

/// The inputs of a linear system, as the linearization asks for them.
pub trait Inputs {
    /// Number of inputs.
    fn count(&self) -> usize;
    /// Whether input `number` prescribes a motion: its value, rate and acceleration act.
    fn is_motion(&self, number: usize) -> bool;
    /// Changes input `number` by `by` in `state`: of a motion the derivative of order `order` (0 to 2), else order 0.
    fn change(&self, number: usize, order: usize, by: f64, state: &mut State);
}

/// No inputs.
impl Inputs for () {
    fn count(&self) -> usize {
        0
    }

    fn is_motion(&self, _number: usize) -> bool {
        false
    }

    fn change(&self, _number: usize, _order: usize, _by: f64, _state: &mut State) {}
}

/// The equations about a state, without what is given from outside.
#[derive(Debug)]
pub struct Linearization {
    /// `−∂(forces)/∂q`, the coordinates' own charts being those of the state, and below it `R'_q`.
    by_q: Blocks,
    /// `−∂(forces)/∂v` without inertia, and below it `R'_v`.
    by_v: Blocks,
    /// The part of inertia.
    by_spin: Blocks,
    /// `V_q`.
    rates_by_q: Blocks,
    /// The rows of `N`.
    turning: Vec<ChartRate>,
    /// `[M Gᵀ; G 0]`, factorized.
    kkt: Kkt,
    coordinates: usize,
    time: f64,
}

/// The derivatives of the left-hand side of the equations about a state that have closed forms: of the forces of
/// elements, springs, loads and inertia, and of the constraints.
#[derive(Debug)]
struct Tangents {
    /// Derivatives with respect to the coordinates, their charts being those of the state.
    by_q: Blocks,
    /// Derivatives with respect to the velocities, without inertia.
    by_v: Blocks,
    /// The part of inertia.
    by_spin: Blocks,
    gradients: Vec<JointGradient>,
}

impl Tangents {
    /// Those about `state`, which moves on as `response` says; the blocks of `kkt` are scratch memory.
    fn new(system: &System, state: &State, response: &Response, kkt: &mut Kkt) -> Self {
        let (mut cache, mut excitation) = (FrameCache::default(), Excitation::default());
        let configuration = cache.of(system, state);
        system.excite(state.time, &state.targets, &mut excitation);
        let (mut forces, mut gradients) = (vec![0.0; system.coordinates()], Vec::new());

        let passage = Passage::with_velocity(&state.velocity);
        system.forces_and_tangent(&configuration, &passage, &excitation, 1.0, &mut forces, &mut kkt.blocks);
        kkt.set_curvatures_and_gradients(system, &configuration, &response.multipliers, 1.0, &mut gradients);
        let mut by_q = kkt.blocks.leading(forces.len());
        kkt.blocks.clear();
        system.set_damping(&configuration, &state.velocity, &excitation, &mut kkt.blocks);
        let by_v = kkt.blocks.leading(forces.len());
        kkt.blocks.clear();

        cache.set(system, &state.q, &state.triads);
        let drives = &state.prescribed.drives;
        let mass = MassAt::new(drives, &cache);
        let [mut momentum, mut momentum_rate] = [vec![0.0; forces.len()], vec![0.0; forces.len()]];
        system.mass_times(mass, &state.velocity, &mut momentum);
        system.mass_times(mass, &response.acceleration, &mut momentum_rate);
        let motion = [&state.velocity[..], &momentum, &momentum_rate];
        gyroscopic::add_rate_tangent(system, (&cache, drives), motion, [0.0; 2], 1.0, &mut by_q);
        let mut by_spin = kkt.blocks.leading(forces.len());
        gyroscopic::add_rate_damping(system, (&cache, drives), [motion[0], motion[1]], &mut by_spin);
        Self { by_q, by_v, by_spin, gradients }
    }
}

impl Linearization {
    /// Differentiates the equations about `base`.
    ///
    /// # Errors
    /// The constraints are redundant.
    pub fn new(system: &System, base: &Base) -> Result<Self, Error> {
        let (state, response) = (&base.state, &base.response);
        let mut kkt = Kkt::for_equilibria(system);
        let Tangents { mut by_q, mut by_v, mut by_spin, gradients } = Tangents::new(system, state, response, &mut kkt);
        [&mut by_q, &mut by_v, &mut by_spin].into_iter().for_each(Blocks::negate);

        let mut rates_by_q = Blocks::default();
        if !base.is_still {
            differences::push(system, base, [&mut by_q, &mut by_spin, &mut rates_by_q]);
        }
        let mut cache = FrameCache::default();
        cache.set(system, &state.q, &state.triads);
        let mass = MassAt::new(&state.prescribed.drives, &cache);
        let mut kkt = Kkt::for_projections(system);
        // Water moves with beams that are accelerated.
        system.add_mass(mass.wet(&state.q, state.time), 1.0, &mut kkt.blocks);
        kkt.set_constraints(system, &gradients, &gradients, 1.0);
        kkt.factorize(system, state.time)?;
        let turning = gyroscopic::chart_rates(system, &cache, &state.velocity);
        let (coordinates, time) = (state.q.len(), state.time);
        Ok(Self { by_q, by_v, by_spin, rates_by_q, turning, kkt, coordinates, time })
    }

    /// The independent coordinates about `base`; none where nothing can move.
    pub fn select(&self, system: &System, base: &Base) -> Option<Selection> {
        self.select_along(system, base, &Mat3::identity(), None)
    }

    /// Those along the axes `axes`: the coordinates `known` where they are given. None where these cannot be
    /// independent.
    pub fn select_along(
        &self,
        system: &System,
        base: &Base,
        axes: &Mat3,
        known: Option<&[Independent]>,
    ) -> Option<Selection> {
        let released = system.released_constraints(&base.state.prescribed);
        Selection::new(system, &self.kkt.blocks, &base.state.q, (axes, known), released)
    }

    /// Adds `R_q dq + R_v dv` to `right`.
    fn add_forces(&self, q: &[f64], velocity: &[f64], right: &mut [f64]) {
        self.by_q.multiply_add(q, right);
        self.by_v.multiply_add(velocity, right);
        self.by_spin.multiply_add(velocity, right);
        if !self.turning.is_empty() {
            // Half of `N` changes, in the chart of the state, the velocity that belongs to an unchanged spin.
            let mut spins = vec![0.0; self.coordinates];
            self.add_turning(q, 0.5, &mut spins);
            self.by_v.multiply_add(&spins, right);
        }
    }

    /// `target += factor N q`.
    fn add_turning(&self, q: &[f64], factor: f64, target: &mut [f64]) {
        for ChartRate { angle, slope, row } in &self.turning {
            target[*angle] += factor * row.dot(&vec3(q, *slope));
        }
    }

    /// Sets `right` to the accelerations and multipliers that belong to it.
    fn respond(&mut self, system: &System, right: &mut [f64]) -> Result<(), Error> {
        self.kkt.solve_more(system, right, self.time)
    }
}
