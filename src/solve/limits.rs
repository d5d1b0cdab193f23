//! What a step in time may do, whatever the integrator (MECHANICS 6, 7.4): beyond it the step is refused, and halved.

use crate::error::Error;
use crate::mechanics::prescribed::Prescribed;
use crate::mechanics::state::State;
use crate::mechanics::system::System;

/// Largest turn of a tangent or a body in a step, rad: beyond it Newton may find a wrong root (MECHANICS 7.4).
pub const LARGEST_TURN: f64 = 0.5;
/// Largest turn of a moving frame in a step, rad: beyond it a joint may find another root (MECHANICS 6).
const LARGEST_FRAME_TURN: f64 = 1.0;
/// Iterations of a step: more than this ended in wrong states (MECHANICS 7.4).
pub const ITERATIONS: usize = 10;

/// Refuses moving frames that turn too far over the `step` s from `state` to `end`, where they move as `prescribed`: what
/// hangs on them may find another root.
///
/// # Errors
/// One does.
pub fn check_frames(system: &System, state: &State, prescribed: &Prescribed, step: f64, end: f64) -> Result<(), Error> {
    match prescribed.largest_turn(&state.prescribed, step) {
        Some((frame, angle)) if angle > LARGEST_FRAME_TURN => {
            let place = format!("frame {}", system.moving_frames[frame].name);
            Err(Error::Turned { time: end, place, angle, limit: LARGEST_FRAME_TURN })
        }
        _ => Ok(()),
    }
}
