//! The slowest motion by inverse iteration on one vector: `ω²` from above, since the Rayleigh quotient of any motion
//! that the constraints allow is at least the lowest one. It takes one factorization and the memory of one matrix,
//! where [`super::modes`] proves that it misses no mode.

use super::subspace::dot;
use super::{at_rest, set_stiffness};
use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::linear::irregular;
use crate::solve::newton::kkt::Kkt;
use crate::solve::step::response::{Responder, Response};

/// Most sweeps: each multiplies what is left of motions with twice the `ω² + limit` by a quarter.
const MOST_SWEEPS: usize = 30;

/// A change of `ω² + limit` by less than this share ends the sweeps.
const ACCURATE: f64 = 1e-4;

/// An upper bound of the lowest `ω²` about `state`, at rest, 1/s², as [`super::modes`] understands it. Below `limit` it
/// is any bound; else the sweeps have come to an end, and it is near the lowest one.
///
/// # Errors
/// The constraints are redundant, or a number is not finite.
pub fn slowest(system: &System, state: &State, limit: f64) -> Result<f64, Error> {
    let time = state.time;
    let rest = at_rest(state);
    let mut response = Response::default();
    Responder::new(system).respond(system, &rest, &mut response)?;
    let mut kkt = Kkt::for_steps(system);
    let without_friction = system.has_dry_friction().then(|| system.without_dry_friction());
    set_stiffness(without_friction.as_ref().unwrap_or(system), &rest, &response.multipliers, &mut kkt);
    kkt.blocks.symmetrize();
    let mut cache = FrameCache::default();
    cache.set(system, &rest.q, &rest.triads);
    let mass = MassAt::new(&rest.prescribed.drives, &cache).wet(&rest.q, time);
    system.add_mass(mass, limit, &mut kkt.blocks);
    kkt.factorize(system, time)?;

    let coordinates = system.coordinates();
    let pattern: Vec<f64> = (0..coordinates).map(|index| irregular(index) - 1.0).collect();
    let mut momentum = vec![0.0; coordinates];
    system.mass_times(mass, &pattern, &mut momentum);
    let mut motion = vec![0.0; coordinates + system.constraints()];
    let mut last = f64::INFINITY;
    for _ in 0..MOST_SWEEPS {
        motion[..coordinates].copy_from_slice(&momentum);
        motion[coordinates..].fill(0.0);
        kkt.solve_more(system, &mut motion, time)?;
        // `xᵀ (K + μ M) x`, as `x` solves for the last momentum.
        let energy = dot(&motion[..coordinates], &momentum);
        system.mass_times(mass, &motion[..coordinates], &mut momentum);
        let square = dot(&motion[..coordinates], &momentum);
        let shifted = energy / square;
        if shifted.is_nan() || shifted < 2.0 * limit || (last - shifted).abs() <= ACCURATE * shifted {
            return Ok(shifted - limit);
        }
        last = shifted;
        momentum.iter_mut().for_each(|value| *value /= square.sqrt());
    }
    Ok(last - limit)
}
