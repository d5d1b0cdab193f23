//! Results of a neighboring state: one that is moved a little along the error that the lengths of the steps have caused, so that differences tell the error of results.

use crate::mechanics::state::State;
use crate::mechanics::state::time_error::TimeError;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::mechanics::system::variation::Variation;
use crate::model::variables::{Moment, Table};
use crate::solve::step::response::{Responder, Response};

/// How far a state is moved along its error, as a share of the system's size or rad: so little that results follow linearly.
const REACH: f64 = 1e-6;
/// Most that a state is moved, in errors.
const LARGEST_MULTIPLE: f64 = 1e3;

/// The neighboring state and its results; scratch memory.
#[derive(Debug, Default)]
pub struct Neighbor {
    moved: Option<State>,
    variation: Variation,
    frames: FrameCache,
    response: Response,
    snapshot: FrameCache,
    values: Vec<f64>,
}

impl Neighbor {
    /// Measures the results that `state` has when it is moved along its error. Returns them, and by how many errors it is moved; none where that cannot be said.
    /// `responder` is there if results ask for a response.
    pub fn measure(
        &mut self,
        table: &Table,
        (system, state): (&System, &State),
        responder: Option<&mut Responder>,
    ) -> Option<(&[f64], f64)> {
        if !state.time_error.is_known() {
            return None;
        }
        let multiple = self.move_along(system, state)?;
        let Self { moved: Some(moved), response, snapshot, values, .. } = self else { return None };
        if responder.is_some_and(|responder| responder.respond(system, moved, response).is_err()) {
            return None;
        }
        table.measure(&Moment { system, state: moved, response, fibers: &[] }, snapshot, values);
        Some((values, multiple))
    }

    /// Moves a copy of `state` along its error; returns by how many errors, none where it cannot be said.
    fn move_along(&mut self, system: &System, state: &State) -> Option<f64> {
        let Self { moved, variation, frames, snapshot, .. } = self;
        let TimeError { position, velocity, rates, .. } = &state.time_error;
        let (size, _) = system.correction_size(position);
        if !size.is_finite() || velocity.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let multiple = (REACH / size.max(f64::MIN_POSITIVE)).min(LARGEST_MULTIPLE);
        let moved = moved.get_or_insert_default();
        moved.copy_motion_from(state);
        variation.q.clone_from(position);
        variation.velocity.clone_from(velocity);
        let [viscous, _] = &mut variation.viscous;
        viscous.clear();
        if !rates.is_empty() {
            // The error of the velocities may turn about with every step as they do.
            viscous.resize(state.strain_rates.len(), 0.0);
            system.set_strain_rates(&snapshot.of(system, state), rates, viscous);
        }
        variation.apply(system, multiple, moved, frames);
        Some(multiple)
    }
}
