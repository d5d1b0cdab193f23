//! The state at the start: joints hold as drawn, velocities are what the joints allow.

use super::midpoint::Midpoint;
use crate::error::Error;
use crate::mechanics::sensor::Snapshot;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Largest gap of a joint as drawn, relative to the machine's size (or in radians): rounding of the model file's numbers.
const DRAWN_GAP: f64 = 1e-9;
/// Velocities that change by less than this share of the largest are taken as given.
const CHANGED: f64 = 1e-9;

/// Checks that the joints hold as drawn.
///
/// # Errors
/// A joint's sides are apart: names the worst.
pub fn check_assembled(system: &System, state: &State) -> Result<(), Error> {
    let mut snapshot = Snapshot::default();
    let configuration = snapshot.of(system, state);
    for joint in &system.joints {
        let mut phi = vec![0.0; joint.rows()];
        joint.phi(&configuration, &mut phi);
        let gap = phi.iter().fold(0.0_f64, |gap, value| gap.max(value.abs()));
        // A gap that is not a number counts as one.
        if gap.is_nan() || gap > DRAWN_GAP * system.size.max(1.0) {
            return Err(Error::NotAssembled { joint: joint.name.clone(), gap });
        }
    }
    Ok(())
}

/// Sets momenta and velocities at the start: the velocities nearest to the given ones, in the metric of the kinetic energy,
/// that the constraints allow (MECHANICS 6). Returns by how much they changed, relative to the largest; 0 when they did not.
///
/// # Errors
/// The constraints are redundant.
pub fn set_motion(system: &System, midpoint: &mut Midpoint, state: &mut State) -> Result<f64, Error> {
    let given = state.velocity.clone();
    system.mass_times(&given, &mut state.momentum);
    midpoint.set_velocity(system, state)?;
    let (velocity, momentum) = (&state.velocity, &mut state.momentum);
    system.mass_times(velocity, momentum);
    let largest = given.iter().fold(0.0_f64, |largest, value| largest.max(value.abs()));
    let change = given.iter().zip(velocity).fold(0.0_f64, |change, (a, b)| change.max((a - b).abs()));
    Ok(if change > CHANGED * largest { change / largest } else { 0.0 })
}
