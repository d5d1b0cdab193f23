//! The state that the equations are linearized about.

use crate::error::Error;
use crate::mechanics::state::{State, viscous_rates};
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::mechanics::system::variation::follow;
use crate::solve::modes::{first_shift, imbalance, linearize, positive_shift};
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::response::{Responder, Response};

/// Distance from the equilibrium, as [`Base::imbalance`], up to which a state at rest is one: what Newton leaves.
pub const BALANCED: f64 = 1e-6;

/// A state with what the linearization needs of it.
#[derive(Clone, Debug)]
pub struct Base {
    /// The state, with charts centered at its own tangents.
    pub state: State,
    /// Its accelerations and multipliers.
    pub response: Response,
    /// Nothing moves.
    pub is_at_rest: bool,
    /// Nothing moves, and all forces balance: accelerations are taken as 0.
    pub is_still: bool,
    /// How far from a state at rest the nearest equilibrium is by its stiffness: lengths over the system's size,
    /// slopes, rad. 0 where the state moves.
    pub imbalance: f64,
}

impl Base {
    /// Prepares `state`.
    ///
    /// # Errors
    /// The constraints are redundant, or a number is not finite.
    pub fn new(system: &System, state: &State) -> Result<Self, Error> {
        let (mut state, mut frames) = (state.clone(), FrameCache::default());
        // The strains have the rates of the velocities.
        viscous_rates::clear(&mut state);
        follow(system, &mut state, &mut frames);
        let mut response = Response::default();
        Responder::new(system).respond(system, &state, &mut response)?;
        let moves = |values: &[f64]| values.iter().any(|value| *value != 0.0);
        let mut standing = state.prescribed.clone();
        standing.stop();
        let is_at_rest = !moves(&state.velocity) && standing == state.prescribed;
        let imbalance = if is_at_rest { imbalance_of(system, &state, &response)? } else { 0.0 };
        let is_still = is_at_rest && imbalance <= BALANCED;
        if is_still {
            // Newton leaves a little of the forces; over the masses of the stiffest motions that is much.
            response.acceleration.fill(0.0);
        }
        Ok(Self { state, response, is_at_rest, is_still, imbalance })
    }
}

/// How far the nearest equilibrium is by the stiffness of `state` where it has the accelerations of `response`, see
/// [`Base::imbalance`].
///
/// # Errors
/// The constraints are redundant.
pub(super) fn imbalance_of(system: &System, state: &State, response: &Response) -> Result<f64, Error> {
    let mut kkt = Kkt::for_equilibria(system);
    let stiffness = linearize(system, state, &response.multipliers, &mut kkt).symmetric_part();
    let mut cache = FrameCache::default();
    cache.set(system, &state.q, &state.triads);
    let mass = MassAt::new(&state.prescribed.drives, &cache).wet(&state.q, state.time);
    let shift = first_shift(system, mass, &stiffness);
    let shift = if shift > 0.0 { shift } else { 1.0 };
    positive_shift(system, mass, &mut kkt, &stiffness, shift, state.time)?;
    Ok(imbalance(system, mass, &response.acceleration, &mut kkt))
}
