//! What a run is watched for: signs that its numbers should not be trusted. Each is warned of once.

use super::document::Document;
use super::entries::simulation::Integrator;
use crate::error::decimal;
use crate::mechanics::sensor::Snapshot;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use serde::{Deserialize, Serialize};

/// Share of the largest kinetic and strain energy by which the total energy of a machine without loads may change. The midpoint
/// rules keep it within some thousandths where the step resolves the motion.
const ENERGY_BAND: f64 = 0.02;

/// Share of the energies themselves that is round-off: of a machine at rest nothing else is left.
const ROUND_OFF: f64 = 1e-9;

/// Energy that a molecule has by its warmth, J: what machines have below it is the round-off of nothing.
const THERMAL: f64 = 4e-21;

/// What has been seen and warned of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Watch {
    twist_warned: bool,
    energy_warned: bool,
    /// The integrator damps by itself: the energy may fall.
    damps: bool,
    /// Total energy at the start, J.
    start: Option<f64>,
    /// Largest kinetic and strain energy so far, J.
    largest: f64,
}

impl Watch {
    /// Of a run of `document`.
    pub fn new(document: &Document) -> Self {
        let damps = matches!(document.simulation.integrator, Integrator::GeneralizedAlpha { .. });
        Self { damps, ..Self::default() }
    }

    /// Looks at a new state with its kinetic, elastic, gravity and total `energies`, J, and says what is odd.
    pub fn look(&mut self, system: &System, state: &State, energies: [f64; 4], frames: &mut Snapshot) -> Vec<String> {
        let twist = self.twist(system, state, frames);
        twist.into_iter().chain(self.energy(system, state, energies)).collect()
    }

    /// Warns of a beam that is twisted beyond half the rate above which its energy has no lower bound (MECHANICS 3.7).
    fn twist(&mut self, system: &System, state: &State, frames: &mut Snapshot) -> Option<String> {
        if self.twist_warned {
            return None;
        }
        let (beam, rate, limit) = system.twist_near_limit(state, frames)?;
        self.twist_warned = true;
        Some(format!(
            "beam {beam} is twisted by {rate:.3} rad/m at t = {} s: its torsion softens and fails above {limit:.3} rad/m, because \
             strain = \"large_truncated\" or the section's fourth_moments leave the stiffening by twist out; use strain = \"large\" with the \
             section's true fourth_moments",
            decimal(state.time)
        ))
    }

    /// A machine that nothing drives and whose energy changes all the same (MECHANICS 7.4: accuracy is the step's).
    fn energy(
        &mut self,
        system: &System,
        state: &State,
        [kinetic, elastic, gravity, total]: [f64; 4],
    ) -> Option<String> {
        let start = *self.start.get_or_insert(total);
        self.largest = self.largest.max(kinetic + elastic);
        // A machine at equilibrium, or one that is driven or damped, has no reason to keep its energy.
        if self.energy_warned || kinetic == 0.0 || !system.is_conservative() {
            return None;
        }
        let change = total - start;
        if self.damps && change < 0.0
            || change.abs() <= ENERGY_BAND * self.largest + ROUND_OFF * (gravity.abs() + total.abs()) + THERMAL
        {
            return None;
        }
        self.energy_warned = true;
        Some(format!(
            "the total energy has changed from {start:.4e} J to {total:.4e} J by t = {} s, though nothing drives or damps it: the steps are \
             too large for this motion; take a smaller simulation.step",
            decimal(state.time)
        ))
    }
}
