//! Whether ropes are where their models hold: on their sheaves, and taut at some time.

use crate::error::decimal;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use serde::{Deserialize, Serialize};

/// Wrap angle below which a rope has left its sheave, rad: less is round-off of a rope that just touches it.
const LEFT: f64 = -1e-9;

/// Ropes that have been seen and warned of.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct RopeWatch {
    warned: bool,
    /// Whether each rope has been taut.
    taut: Vec<bool>,
}

impl RopeWatch {
    /// Looks at a new state, and warns of a rope that has left a sheave.
    pub fn look(&mut self, system: &System, state: &State, snapshot: &mut FrameCache) -> Option<String> {
        if system.ropes.is_empty() {
            return None;
        }
        self.taut.resize(system.ropes.len(), false);
        let c = snapshot.of(system, state);
        let mut told = None;
        for (rope, taut) in system.ropes.iter().zip(&mut self.taut) {
            let Some(pull) = rope.pull(&c, &Passage::Rest) else { continue };
            *taut |= pull.pulls[..rope.stretches()].iter().any(|own| own.value > 0.0);
            let left = (1..rope.spans()).find(|seat| rope.wrap(*seat, &pull.laid) < LEFT);
            if let Some(seat) = left.filter(|_| !self.warned) {
                self.warned = true;
                told = Some(format!(
                    "rope {} has left sheave {} at t = {} s, and is computed as if it still ran over it: its \
                     wrap angle is {:.3} rad; \
                     end the run before, take the sheave out of `over`, or model a rope that lifts off as a beam \
                     with a contact",
                    rope.name,
                    rope.seats[seat].name,
                    decimal(state.instant()),
                    rope.wrap(seat, &pull.laid)
                ));
            }
        }
        told
    }

    /// Names the ropes that never were taut.
    pub fn conclude(&self, system: &System) -> Vec<String> {
        let slack = system.ropes.iter().zip(&self.taut).filter(|(_, taut)| !**taut);
        slack
            .map(|(rope, _)| {
                format!("rope {} was slack all the time: give it a smaller `length`, or a pretension", rope.name)
            })
            .collect()
    }
}
