//! Velocities that the constraints allow (MECHANICS 7.1): `[M Gᵀ; G 0][v; ν] = [P; −∂g/∂t]`.

use super::constrained_mass::ConstrainedMass;
use crate::error::Error;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;

/// Scratch memory of the projection; the general linear system is whose it is.
#[derive(Debug)]
pub struct Projection {
    /// The way that takes less work, where there is one.
    fast: Option<ConstrainedMass>,
    /// The last call took it.
    was_fast: bool,
    right: Vec<f64>,
    gradients: Vec<JointGradient>,
}

impl Projection {
    /// For one state of `system`.
    pub fn once(system: &System) -> Self {
        let size = system.coordinates() + system.constraints();
        Self { fast: None, was_fast: false, right: vec![0.0; size], gradients: Vec::new() }
    }

    /// For many states of `system`; the matrix of `kkt` is scratch memory.
    pub fn new(system: &System, kkt: &mut Kkt) -> Self {
        if !system.winches.is_empty() {
            // Their mass matrix is not the same in every state.
            return Self::once(system);
        }
        kkt.blocks.clear();
        system.add_mass(&[], 1.0, &mut kkt.blocks);
        let fast = ConstrainedMass::new(system, &kkt.blocks);
        kkt.blocks.clear();
        Self { fast, ..Self::once(system) }
    }

    /// Of the last call: the momentum beside that of the velocities, `Gᵀ ν` with the gradients and `ν`.
    pub fn constraint_momenta(&self, system: &System) -> (&[JointGradient], &[f64]) {
        (&self.gradients, &self.right[system.coordinates()..])
    }

    /// Sets the velocities of `state` to those that belong to its momentum and that the constraints allow, and `frames` to those of its nodes.
    ///
    /// # Errors
    /// The constraints are redundant.
    pub fn set_velocity(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        frames: &mut FrameCache,
        state: &mut State,
    ) -> Result<(), Error> {
        let configuration = frames.of(system, state);
        system.constraint_gradients(&configuration, &mut self.gradients);
        let (momentum, rates) = self.right.split_at_mut(state.q.len());
        momentum.copy_from_slice(&state.momentum);
        system.constraint_rates(&configuration, rates);
        rates.iter_mut().for_each(|rate| *rate = -*rate);
        if rates.iter().any(|rate| !rate.is_finite()) {
            return Err(Error::NotFinite { time: state.time, what: system.describe_not_finite(state.time) });
        }
        let Self { fast, right, gradients, .. } = self;
        let solved =
            fast.as_mut().is_some_and(|fast| fast.solve(system, gradients, right, &mut state.velocity).is_ok());
        self.was_fast = solved;
        let Self { right, gradients, .. } = self;
        if !solved {
            kkt.blocks.clear();
            system.add_mass(&state.prescribed.drives, 1.0, &mut kkt.blocks);
            kkt.set_constraints(system, gradients, gradients, 1.0);
            kkt.solve(system, right, state.time)?;
        }
        state.velocity.copy_from_slice(&self.right[..state.q.len()]);
        Ok(())
    }

    /// Solves with the matrix of the last call, in place, but for the last digits; `vector` is scratch memory, as long as the coordinates.
    ///
    /// # Errors
    /// The matrix gives no solution.
    pub fn solve_roughly(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        right: &mut [f64],
        vector: &mut [f64],
    ) -> Result<(), Singular> {
        match &mut self.fast {
            Some(fast) if self.was_fast => fast.solve_roughly(system, &self.gradients, right, vector),
            _ => kkt.solve_roughly(right),
        }
    }
}
