//! Switches in a motion: at an instant, joints, locks and drives engage or release (MECHANICS 7.10).
//!
//! What is released goes on as it moves. What engages stops its sides relative to each other at once, an impact without
//! rebound: the velocities behind it are those nearest to the ones before it, in the metric of the kinetic energy, that
//! the constraints allow, `M (v⁺ − v⁻) = −Gᵀ ν`. The impact takes the kinetic energy of the change,
//! `½ (v⁺ − v⁻)ᵀ M (v⁺ − v⁻)`; what drives and moving frames hold in motion gives `νᵀ ∂g/∂t` in addition.

use super::projection::Projection;
use crate::error::Error;
use crate::mechanics::state::energy_account::Work;
use crate::mechanics::state::lists::Lists;
use crate::mechanics::state::time_error::TimeError;
use crate::mechanics::state::{State, rate_leads, viscous_rates};
use crate::mechanics::system::System;
use crate::mechanics::system::fluids::FluidAt;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::mass::MassAt;
use crate::solve::newton::kkt::Kkt;

/// How far the neighboring state of an impact is moved, as [`System::motion_size`] measures: so little that it is
/// linear.
const REACH: f64 = 1e-5;
/// Largest multiple of the error that it is moved by: an error this far below [`REACH`] is round-off.
const LARGEST_MULTIPLE: f64 = 1e3;

/// Engages and releases what is to be so at `time`, s, the instant of `state` but for rounding; `kkt` is scratch
/// memory. Returns whether anything changed.
///
/// # Errors
/// What engages is redundant, or whether it engages is not known: the error names it.
pub fn switch(system: &System, kkt: &mut Kkt, state: &mut State, time: f64) -> Result<bool, Error> {
    if let Some(switch) = system.undefined_switch(time) {
        return Err(Error::NotFinite { time, what: format!("`active` of {switch}") });
    }
    if !system.switches_at(state, time) {
        return Ok(false);
    }
    // The momentum that only the earlier constraints knew is no part of the motion.
    system.set_momentum(state);
    state.constraint_momenta.fill(0.0);
    if system.switch(state, time) {
        collide(system, kkt, state, time)?;
    }
    state.velocity_lead.clear();
    state.balance.skip_jump();
    viscous_rates::jump(state);
    rate_leads::clear(&mut state.lists);
    state.time_error.known = 0;
    Ok(true)
}

/// The state that lies a small multiple of the time-step error from `state`, before an impact; and the multiple. None:
/// there is no error, or it has no bound.
fn neighbor(system: &System, state: &State) -> Option<(State, f64)> {
    if !state.time_error.is_known() {
        return None;
    }
    let TimeError { position, velocity, .. } = &state.time_error;
    let time = state.pace.wanted.max(state.time_error.step);
    let size = system.motion_size(position).max(time * system.motion_size(velocity));
    if !size.is_finite() {
        return None;
    }
    let multiple = (REACH / size.max(f64::MIN_POSITIVE)).min(LARGEST_MULTIPLE);
    let mut neighbor = state.clone();
    let Lists { q, velocity: moving, .. } = &mut neighbor.lists;
    for (list, change) in [(q, position), (moving, velocity)] {
        list.iter_mut().zip(change).for_each(|(value, change)| *value += multiple * change);
    }
    system.set_momentum(&mut neighbor);
    Some((neighbor, multiple))
}

/// Brings the velocities of `state` to what the constraints allow, and its energies.
fn collide(system: &System, kkt: &mut Kkt, state: &mut State, time: f64) -> Result<(), Error> {
    let before = state.velocity.clone();
    let kinetic_before = system.kinetic_energy(&FrameCache::default().of(system, state), &before);
    let (mut projection, mut frames) = (Projection::of_impact(system), FrameCache::default());
    let neighbor = neighbor(system, state);
    projection.set_velocity(system, kkt, &mut frames, state)?;
    kkt.check_unique(system, state.time)?;
    if let Some((mut neighbor, multiple)) = neighbor {
        projection.set_velocity(system, kkt, &mut frames, &mut neighbor)?;
        let velocities = neighbor.velocity.iter().zip(&state.lists.velocity);
        for (error, (moved, own)) in state.time_error.velocity.iter_mut().zip(velocities) {
            *error = (moved - own) / multiple;
        }
    } else {
        state.time_error.velocity.fill(0.0);
    }
    system.set_momentum(state);
    let change: Vec<f64> = state.velocity.iter().zip(&before).map(|(after, before)| after - before).collect();
    let configuration = frames.of(system, state);
    let mut of_water = vec![0.0; change.len()];
    let at = FluidAt { q: &state.q, time, seen: &[] };
    let dissipated = system.kinetic_energy_of_mesh(MassAt::from(&configuration), &change)
        + 0.5 * system.add_added_mass_times(at, &change, &mut of_water);
    let means = state.velocity.iter().zip(&before).map(|(after, before)| 0.5 * (after + before));
    let water: f64 = 0.0 - means.zip(&of_water).map(|(mean, own)| mean * own).sum::<f64>();
    let gained = system.kinetic_energy(&configuration, &state.velocity) - kinetic_before;
    if let Some(last) = &mut state.balance.last {
        last.kinetic += gained;
    }
    if let Some(account) = &mut state.balance.account {
        account
            .work
            .add(&Work { drives: gained + dissipated - water, dissipated, fluids: water, ..Work::default() }, 1.0);
        account.energy = account.energy.map(|energy| energy + gained);
    }
    Ok(())
}
