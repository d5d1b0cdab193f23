//! What a step in time may do, whatever the integrator (MECHANICS 6, 7.4): beyond it the step is refused, and halved.

use crate::error::Error;
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Largest turn of a tangent or a body in a step, rad: beyond it Newton may find a wrong root (MECHANICS 7.4).
pub const LARGEST_TURN: f64 = 0.5;
/// Largest turn of a moving frame in a step, rad: beyond it a joint may find another root (MECHANICS 6).
const LARGEST_FRAME_TURN: f64 = 1.0;
/// Iterations of a step: more than this ended in wrong states (MECHANICS 7.4).
pub const ITERATIONS: usize = 10;

/// Most turns of a drive in an increment of a static analysis: an equilibrium is sought for every rad or two of them.
const MOST_TURNS: f64 = 1000.0;

/// Refuses drives that turn too often over `count` increments from `state` to `end`, s: their equilibria would be
/// sought for hours.
///
/// # Errors
/// One does.
pub fn check_drives(system: &System, state: &State, end: f64, count: u64) -> Result<(), Error> {
    let mut prescribed = Prescribed::default();
    system.prescribe(state, end, &mut prescribed);
    for ((drive, to), from) in system.drives.iter().zip(&prescribed.drives).zip(&state.prescribed.drives) {
        let turns = (to.value - from.value).abs() / std::f64::consts::TAU;
        let measure = drive.coordinate.map(|coordinate| system.relative_coordinates[coordinate].measure);
        if matches!(measure, Some(Measure::Angle(_))) && turns > MOST_TURNS * count as f64 {
            let (drive, from) = (drive.name.clone(), state.time);
            return Err(Error::DriveTooFast { drive, turns, from, to: end, limit: MOST_TURNS });
        }
    }
    Ok(())
}

/// Refuses moving frames that turn too far over the `step` s from `state` to `end`, where they move as `prescribed`:
/// what hangs on them may find another root. Returns the largest turn over what it may be.
///
/// # Errors
/// One does.
pub fn check_frames(
    system: &System,
    state: &State,
    prescribed: &Prescribed,
    step: f64,
    end: f64,
) -> Result<f64, Error> {
    match prescribed.largest_turn(&state.prescribed, step) {
        Some((frame, angle)) if angle > LARGEST_FRAME_TURN => {
            let place = format!("frame {}", system.moving_frames[frame].name);
            Err(Error::Turned { time: end, place, angle, limit: LARGEST_FRAME_TURN })
        }
        Some((_, angle)) => Ok(angle / LARGEST_FRAME_TURN),
        None => Ok(0.0),
    }
}
