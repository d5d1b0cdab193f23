//! Accelerations and multipliers at an instant (MECHANICS 7.5):
//! `[M Gᵀ; G 0][a; λ] = [F − dU/dq − gyro; −(dG/dt) v − g_tt]`.
//!
//! They belong to the very time of the state, unlike what a step computes with. Only outputs ask for them.

use crate::error::Error;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::input::excitation::Excitation;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::gyroscopic;
use crate::mechanics::system::mass::MassAt;
use crate::solve::newton::kkt::Kkt;

/// How a system responds at an instant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Response {
    /// Second derivatives of the coordinates, 1/s² each.
    pub acceleration: Vec<f64>,
    /// Multipliers of the conditions, N or N m.
    pub multipliers: Vec<f64>,
}

impl Response {
    /// Of a state whose integrator keeps both.
    pub fn set_from(&mut self, state: &State) {
        self.acceleration.clone_from(&state.acceleration);
        self.multipliers.clone_from(&state.multipliers);
    }

    /// Of an equilibrium: nothing moves, the multipliers are the state's.
    pub fn set_at_rest(&mut self, state: &State) {
        self.acceleration.clear();
        self.acceleration.resize(state.q.len(), 0.0);
        self.multipliers.clone_from(&state.multipliers);
    }
}

/// Computes responses; scratch memory.
#[derive(Debug)]
pub struct Responder {
    /// Made when it is first needed: equilibria, and integrators that keep accelerations, respond without it.
    kkt: Option<Kkt>,
    right: Vec<f64>,
    momentum: Vec<f64>,
    excitation: Excitation,
    frames: FrameCache,
    gradients: Vec<JointGradient>,
}

impl Responder {
    /// For `system`.
    pub fn new(system: &System) -> Self {
        let size = system.coordinates() + system.constraints();
        Self {
            kkt: None,
            right: vec![0.0; size],
            momentum: vec![0.0; system.coordinates()],
            excitation: Excitation::default(),
            frames: FrameCache::default(),
            gradients: Vec::new(),
        }
    }

    /// Sets `response` to that of `state`, whose velocities the constraints allow.
    ///
    /// # Errors
    /// The constraints are redundant, or the acceleration of a drive or frame is not finite.
    pub fn respond(&mut self, system: &System, state: &State, response: &mut Response) -> Result<(), Error> {
        self.set_right(system, state)?;
        let kkt = self.kkt.get_or_insert_with(|| Kkt::for_projections(system));
        kkt.blocks.clear();
        let mass = MassAt::new(&state.prescribed.drives, &self.frames).wet(&state.q, state.time);
        system.add_mass(mass, 1.0, &mut kkt.blocks);
        kkt.set_constraints(system, &self.gradients, &self.gradients, 1.0);
        kkt.solve(system, &mut self.right, state.time)?;
        let (acceleration, multipliers) = self.right.split_at(state.q.len());
        response.acceleration.clear();
        response.acceleration.extend_from_slice(acceleration);
        response.multipliers.clear();
        response.multipliers.extend_from_slice(multipliers);
        Ok(())
    }

    /// Sets `right` to what `response` lacks to be that of `state`: zero if it is.
    ///
    /// # Errors
    /// The acceleration of a drive or frame is not finite.
    pub fn balance(
        &mut self,
        system: &System,
        state: &State,
        response: &Response,
        right: &mut [f64],
    ) -> Result<(), Error> {
        self.set_right(system, state)?;
        let (forces, conditions) = right.split_at_mut(state.q.len());
        let mass = MassAt::new(&state.prescribed.drives, &self.frames).wet(&state.q, state.time);
        system.mass_times(mass, &response.acceleration, forces);
        system.add_constraint_forces(&self.gradients, &response.multipliers, 1.0, forces);
        conditions.fill(0.0);
        system.add_constraint_rates(&self.gradients, &response.acceleration, conditions);
        for (right, own) in right.iter_mut().zip(&self.right) {
            *right = own - *right;
        }
        Ok(())
    }

    /// Sets the right-hand side, and the gradients of the constraints, of `state`.
    fn set_right(&mut self, system: &System, state: &State) -> Result<(), Error> {
        self.frames.set(system, &state.q, &state.triads);
        let configuration = system.configuration(&state.q, &self.frames, state, &state.prescribed);
        system.excite(state.time, &state.targets, &mut self.excitation);
        let passage = Passage::of(state);

        let (forces, conditions) = self.right.split_at_mut(state.q.len());
        system.forces(&configuration, &passage, &self.excitation, forces);
        let mass = MassAt::new(&state.prescribed.drives, &self.frames);
        system.mass_times(mass, &state.velocity, &mut self.momentum);
        gyroscopic::add_rate_forces(system, &self.frames, &state.velocity, &self.momentum, forces);
        system.constraint_accelerations(&configuration, &state.velocity, conditions);
        self.right.iter_mut().for_each(|value| *value = -*value);

        if self.right.iter().any(|value| !value.is_finite()) {
            let known = system.undefined(state.time);
            let what = known.unwrap_or_else(|| String::from("the acceleration of a drive or frame"));
            return Err(Error::NotFinite { time: state.time, what });
        }
        system.constraint_gradients(&configuration, &mut self.gradients);
        Ok(())
    }
}
