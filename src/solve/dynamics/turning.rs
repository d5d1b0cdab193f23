//! Motions that begin as the steady rotation that a drive makes: in the shape that the rotation gives, with its
//! velocities, so that nothing vibrates because of the start.

use super::start::find_equilibrium;
use crate::error::Error;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::{State, Statistics};
use crate::mechanics::system::System;
use crate::solve::linearization::steady;

/// Takes `state`, as drawn, to the steady rotation of the drive that turns at its time; returns what the user should
/// know of it.
///
/// # Errors
/// Not exactly one drive turns the mechanism about a fixed axis, or Newton has not found the rotation.
pub fn find_steady_rotation(system: &System, state: &mut State, tolerance: f64) -> Result<Vec<String>, Error> {
    let refused = |reason: String| Error::NoSteadyStart { reason };
    let motion = system.prescribe_start(state.time, &state.prescribed, &state.targets);
    let turning = system.drives.iter().zip(&motion.drives).enumerate().filter(|(_, (drive, jet))| {
        let coordinate = drive.coordinate.map(|number| &system.relative_coordinates[number]);
        jet.first != 0.0 && coordinate.is_some_and(|own| matches!(own.measure, Measure::Angle(_)))
    });
    let turning: Vec<(usize, &str, f64)> =
        turning.map(|(number, (drive, jet))| (number, drive.name.as_str(), jet.first)).collect();
    let (number, name, speed) = match *turning.as_slice() {
        [own] => own,
        [] => {
            let remedy = "give a drive a rate, or take initial = \"equilibrium\"";
            return Err(refused(format!("no drive of an angle turns at the start; {remedy}")));
        }
        [(_, one, _), (_, other, _), ..] => {
            return Err(refused(format!(
                "the drives {one} and {other} both turn at the start; take initial = \"as_drawn\""
            )));
        }
    };
    if let Some(what) = system.part_against_steady_rotation() {
        return Err(refused(format!(
            "a mechanism with {what} does not turn steadily here; take initial = \"as_drawn\""
        )));
    }
    state.stop();
    let rotation = system.rotation(state, number, speed).map_err(|reason| refused(reason.of_drive(name)))?;
    let mut at_rest = state.clone();
    // A mechanism that only the rotation holds has no equilibrium at rest.
    if find_equilibrium(system, &mut at_rest, state.time, tolerance).is_ok() {
        *state = at_rest;
    }
    steady::find(system, &rotation, 0.0, state)
        .map_err(|error| refused(format!("drive {name} turns with {speed} rad/s, and {error}")))?;
    state.statistics = Statistics::default();
    let warning = system.gravity_across(&rotation).map(|across| {
        format!(
            "{across:.3} m/s2 of gravity are across the axis of drive {name} and turn with respect to the mechanism: \
             the motion begins in the shape that gravity gives it at the start, and vibrates from there. Damping of \
             the material ends that"
        )
    });
    Ok(warning.into_iter().collect())
}
