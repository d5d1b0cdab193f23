//! What takes the steps of a run, as the model file asks for.

use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::model::file::document::Document;
use crate::model::file::entries::simulation::{Analysis, Follow, IntegratorSpec};
use crate::solve::dynamics::generalized_alpha::GeneralizedAlpha;
use crate::solve::dynamics::midpoint::Midpoint;
use crate::solve::statics::Statics;
use crate::solve::step::pacing::Pacing;
use crate::solve::step::response::{Responder, Response};
use crate::solve::step::spare::Spare;

/// What takes a step.
#[derive(Debug)]
pub(super) enum Solver {
    /// Not initialized yet.
    None,
    Midpoint(Box<Midpoint>),
    GeneralizedAlpha(Box<GeneralizedAlpha>),
    Statics(Box<Statics>),
}

impl Solver {
    /// For `system`; `pacing` is there if the solver chooses its steps.
    pub(super) fn new(document: &Document, system: &System, pacing: Option<Pacing>) -> Result<Self, Error> {
        let simulation = &document.simulation;
        let tolerance = document.value(simulation.tolerance);
        Ok(match (simulation.analysis, simulation.integrator) {
            (Analysis::Static, _) => {
                let statics = Statics::new(system, tolerance);
                Self::Statics(Box::new(match &simulation.follow {
                    Follow::Time => statics,
                    Follow::ArcLength { branches } => statics.follow_path(branches.clone()),
                }))
            }
            (Analysis::Dynamic, IntegratorSpec::Conserving { spectral_radius }) => {
                let spectral_radius = document.value(spectral_radius);
                let midpoint = Midpoint::new(system, spectral_radius, document.largest_step(), tolerance);
                if simulation.correction && !midpoint.knows_error() {
                    return Err(Error::ErrorNotKnown);
                }
                Self::Midpoint(Box::new(match (pacing, simulation.iterations) {
                    (Some(pacing), _) => midpoint.paced(pacing)?,
                    (None, Some(most)) => midpoint.bounded(most),
                    (None, None) => midpoint,
                }))
            }
            (Analysis::Dynamic, IntegratorSpec::GeneralizedAlpha { spectral_radius }) => {
                let spectral_radius = document.value(spectral_radius);
                Self::GeneralizedAlpha(Box::new(GeneralizedAlpha::new(system, spectral_radius, tolerance)))
            }
        })
    }

    /// Sets `response` to that of `state`.
    pub(super) fn respond(
        &self,
        responder: &mut Responder,
        system: &System,
        state: &State,
        response: &mut Response,
    ) -> Result<(), Error> {
        match self {
            Self::Midpoint(_) => responder.respond(system, state, response)?,
            // It computes accelerations and multipliers at the ends of steps.
            Self::GeneralizedAlpha(_) => response.set_from(state),
            Self::None | Self::Statics(_) => response.set_at_rest(state),
        }
        Ok(())
    }

    /// Memory that it does not need between two steps, if it has such for states.
    pub(super) fn spare(&mut self) -> Option<Spare<'_>> {
        match self {
            Self::Midpoint(midpoint) => Some(midpoint.spare()),
            Self::None | Self::GeneralizedAlpha(_) | Self::Statics(_) => None,
        }
    }
}
