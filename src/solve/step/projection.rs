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
    /// The frames that joints depend on.
    joint_frames: Vec<usize>,
}

impl Projection {
    /// For one state of `system`.
    pub fn once(system: &System) -> Self {
        let size = system.coordinates() + system.constraints();
        let joint_frames = system.joint_frames();
        Self { fast: None, was_fast: false, right: vec![0.0; size], gradients: Vec::new(), joint_frames }
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

    /// Sets the velocities of `state` to those that belong to its momentum and that the constraints allow; `frames` is
    /// scratch memory.
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
        let configuration = frames.at_frames(system, &self.joint_frames, &state.q, state, &state.prescribed);
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
        let velocity = &mut state.lists.velocity;
        let coordinates = velocity.len();
        velocity.copy_from_slice(&self.right[..coordinates]);
        Ok(())
    }

    /// Changes `velocity` to the nearest one, in the kinetic energy, of which the conditions of the last call make
    /// `rates`, but for the last digits; `right` is scratch memory, as long as coordinates and conditions.
    ///
    /// # Errors
    /// The matrix of the last call gives no solution.
    pub fn correct_velocity(
        &mut self,
        system: &System,
        kkt: &mut Kkt,
        rates: &[f64],
        velocity: &mut [f64],
        right: &mut [f64],
    ) -> Result<(), Singular> {
        let (change, lacking) = right.split_at_mut(velocity.len());
        match &mut self.fast {
            Some(fast) if self.was_fast => fast.correct_velocity(system, &self.gradients, rates, velocity, change)?,
            _ => {
                lacking.fill(0.0);
                system.add_constraint_rates(&self.gradients, velocity, lacking);
                lacking.iter_mut().zip(rates).for_each(|(lacking, rate)| *lacking = rate - *lacking);
                change.fill(0.0);
                kkt.solve_roughly(right)?;
            }
        }
        velocity.iter_mut().zip(&*right).for_each(|(velocity, change)| *velocity += change);
        Ok(())
    }
}
