//! Velocities that the constraints allow (MECHANICS 7.1): `[M Gᵀ; G 0][v; ν] = [P; −∂g/∂t]`.

use super::constrained_mass::ConstrainedMass;
use crate::error::Error;
use crate::mechanics::constraint::joint::JointGradient;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::fluids::FluidAt;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::Singular;
use crate::solve::newton::kkt::Kkt;

/// Corrections of velocities at which their iteration ends, as a share: near round-off.
const ACCURATE: f64 = 1e-13;
/// Most corrections in a step: one takes a third of the instructions of the first solution. Slender elements need no
/// more; what is left in others falls by the same factor in the steps that follow.
const MOST_CORRECTIONS: usize = 2;

/// Scratch memory of the projection; the general linear system is whose it is.
#[derive(Debug)]
pub struct Projection {
    /// The way that takes less work, where there is one.
    fast: Option<ConstrainedMass>,
    /// The last call took it.
    was_fast: bool,
    /// The iteration of the fast way where the mass matrix follows the sections.
    following: Option<Following>,
    right: Vec<f64>,
    gradients: Vec<JointGradient>,
    /// Whether the mass of water that moves with beams counts: the velocities change at once, not over a step.
    is_wet: bool,
    /// The frames that joints and the mass matrix depend on.
    needed_frames: Vec<usize>,
}

/// The mass matrix `M` follows the sections: velocities by iteration with its constant bound `N`,
/// `[N Gᵀ; G 0][v; ν] = [P + (N − M) v; −∂g/∂t]`, from the velocities that the step lets expect. A correction is
/// smaller than the one before by the share of the rotary inertia in the mass, which is 1e-3 in the slow motions of
/// slender beams, and always below 1. The momentum does not depend on it.
#[derive(Debug)]
struct Following {
    /// `[P; −∂g/∂t]`.
    given: Vec<f64>,
    last: Vec<f64>,
    change: Vec<f64>,
}

impl Following {
    fn new(system: &System) -> Self {
        let coordinates = system.coordinates();
        Self {
            given: Vec::with_capacity(coordinates + system.constraints()),
            last: vec![0.0; coordinates],
            change: vec![0.0; coordinates],
        }
    }

    /// Turns `right` into the solution and returns whether it could; else `right` is as it was. `velocity` has the
    /// expected velocities, and is scratch memory.
    fn solve(
        &mut self,
        system: &System,
        (fast, gradients): (&mut ConstrainedMass, &[JointGradient]),
        mass: MassAt,
        right: &mut [f64],
        velocity: &mut [f64],
    ) -> bool {
        let Self { given, last, change } = self;
        given.clear();
        given.extend_from_slice(right);
        last.copy_from_slice(velocity);
        system.mass_below_bound_times(mass, velocity, change);
        right.iter_mut().zip(&*change).for_each(|(force, change)| *force += change);
        if fast.solve(system, gradients, right, velocity).is_err() {
            right.copy_from_slice(given);
            return false;
        }
        let (found, multipliers) = right.split_at_mut(last.len());
        for ((last, found), change) in last.iter().zip(&*found).zip(&mut *change) {
            *change = found - last;
        }
        for _ in 0..MOST_CORRECTIONS {
            if system.motion_size(change) <= ACCURATE * system.motion_size(found) {
                break;
            }
            last.copy_from_slice(change);
            system.mass_below_bound_times(mass, last, change);
            fast.solve_change(system, gradients, change, multipliers, velocity);
            found.iter_mut().zip(&*change).for_each(|(found, change)| *found += change);
        }
        true
    }
}

impl Projection {
    /// For one state of `system`.
    pub fn once(system: &System) -> Self {
        let size = system.coordinates() + system.constraints();
        let mut needed_frames = system.joint_frames();
        needed_frames.extend(system.mass_frames());
        needed_frames.sort_unstable();
        needed_frames.dedup();
        Self {
            fast: None,
            was_fast: false,
            following: None,
            is_wet: false,
            right: vec![0.0; size],
            gradients: Vec::new(),
            needed_frames,
        }
    }

    /// One for a change of velocities at once, from those of the state: the water around beams takes part in it.
    pub fn of_impact(system: &System) -> Self {
        Self { is_wet: system.is_in_fluid(), ..Self::once(system) }
    }

    /// For many states of `system`; the matrix of `kkt` is scratch memory.
    pub fn new(system: &System, kkt: &mut Kkt) -> Self {
        if !system.winches.is_empty() {
            // Their mass matrix is not the same in every state.
            return Self::once(system);
        }
        kkt.blocks.clear();
        system.add_mass_bound(&mut kkt.blocks);
        let fast = ConstrainedMass::new(system, &kkt.blocks);
        kkt.blocks.clear();
        let following = system.has_following_inertia().then(|| Following::new(system));
        Self { fast, following, ..Self::once(system) }
    }

    /// Sets the velocities that a step of `step` s lets expect, where [`Self::set_velocity`] begins with them: twice
    /// the mean ones less those of the start, `before`.
    pub fn expect(&self, increment: &[f64], step: f64, before: &[f64], velocity: &mut [f64]) {
        if self.following.is_some() {
            for ((velocity, increment), before) in velocity.iter_mut().zip(increment).zip(before) {
                *velocity = 2.0 * increment / step - before;
            }
        }
    }

    /// Whether the water around beams takes part in the next change of velocities, which are then those that the state
    /// has before it.
    pub fn wet(&mut self, is_wet: bool) {
        self.is_wet = is_wet;
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
        let configuration = frames.at_frames(system, &self.needed_frames, &state.q, state, &state.prescribed);
        system.constraint_gradients(&configuration, &mut self.gradients);
        let (momentum, rates) = self.right.split_at_mut(state.q.len());
        momentum.copy_from_slice(&state.momentum);
        if self.is_wet {
            system.add_added_mass_times(
                FluidAt { q: &state.q, time: state.time, seen: &[] },
                &state.velocity,
                momentum,
            );
        }
        system.constraint_rates(&configuration, rates);
        rates.iter_mut().for_each(|rate| *rate = -*rate);
        if rates.iter().any(|rate| !rate.is_finite()) {
            return Err(Error::NotFinite { time: state.time, what: system.describe_not_finite(state.time) });
        }
        let Self { fast, following, right, gradients, .. } = self;
        let velocity = &mut state.lists.velocity;
        let solved = match (fast, following) {
            _ if self.is_wet => false,
            (Some(fast), None) => fast.solve(system, gradients, right, velocity).is_ok(),
            (Some(fast), Some(following)) => {
                let mass = MassAt::new(&state.prescribed.drives, frames);
                following.solve(system, (fast, gradients), mass, right, velocity)
            }
            (None, _) => false,
        };
        self.was_fast = solved;
        let Self { right, gradients, .. } = self;
        if !solved {
            let dry = MassAt::new(&state.prescribed.drives, frames);
            let mass = if self.is_wet { dry.wet(&state.q, state.time) } else { dry };
            kkt.blocks.clear();
            system.add_mass(mass, 1.0, &mut kkt.blocks);
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
