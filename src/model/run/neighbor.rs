//! Results of a neighboring state: one that is moved a little along the error that the lengths of the steps have
//! caused, so that differences tell the error of results.

use crate::mechanics::state::State;
use crate::mechanics::state::time_error::TimeError;
use crate::mechanics::system::System;
use crate::mechanics::system::variation;
use crate::model::variables::{Moment, Table};
use crate::solve::step::response::{Responder, Response};
use crate::solve::step::spare::Spare;

/// How far a state is moved along its error, as a share of the system's size or rad: so little that results follow
/// linearly.
const REACH: f64 = 1e-6;
/// Most that a state is moved, in errors.
const LARGEST_MULTIPLE: f64 = 1e3;

/// The results of the neighboring state; scratch memory. The state itself is in memory that the solver lends.
#[derive(Debug, Default)]
pub struct Neighbor {
    /// Errors of the rates of strains; empty without material damping.
    rates: Vec<f64>,
    response: Response,
    values: Vec<f64>,
}

impl Neighbor {
    /// Measures the results that `state` has when it is moved along its error. Returns them, and by how many errors it
    /// is moved; none where that cannot be said. `responder` is there if results ask for a response; `spare` is memory
    /// for the neighboring state.
    pub fn measure(
        &mut self,
        table: &Table,
        (system, state): (&System, &State),
        responder: Option<&mut Responder>,
        mut spare: Spare,
    ) -> Option<(&mut [f64], f64)> {
        if !state.time_error.is_known() {
            return None;
        }
        let multiple = self.move_along(system, state, &mut spare)?;
        let Self { response, values, .. } = self;
        let Spare { state: moved, frames } = spare;
        if responder.is_some_and(|responder| responder.respond(system, moved, response).is_err()) {
            return None;
        }
        table.measure(&Moment { system, state: moved, response, fibers: &[] }, frames, values);
        Some((values, multiple))
    }

    /// Moves a copy of `state` along its error; returns by how many errors, none where it cannot be said.
    fn move_along(&mut self, system: &System, state: &State, spare: &mut Spare) -> Option<f64> {
        let Spare { state: moved, frames } = spare;
        let TimeError { position, velocity, rates, .. } = &state.time_error;
        let (size, _) = system.correction_size(position);
        if !size.is_finite() || velocity.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let multiple = (REACH / size.max(f64::MIN_POSITIVE)).min(LARGEST_MULTIPLE);
        moved.copy_motion_from(state);
        add(multiple, position, &mut moved.q);
        add(multiple, velocity, &mut moved.velocity);
        if !rates.is_empty() {
            // The error of the velocities may turn about with every step as they do.
            self.rates.clear();
            self.rates.resize(state.strain_rates.len(), 0.0);
            system.set_strain_rates(&frames.of(system, state), rates, &mut self.rates);
            add(multiple, &self.rates, &mut moved.lists.viscous_rates);
        }
        variation::follow(system, moved, frames);
        Some(multiple)
    }
}

/// `target += factor change`.
fn add(factor: f64, change: &[f64], target: &mut [f64]) {
    target.iter_mut().zip(change).for_each(|(value, change)| *value += factor * change);
}
