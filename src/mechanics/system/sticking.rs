//! Dry friction in a system: what it remembers, and how far it gives before it slides.

use super::System;
use super::frame_cache::FrameCache;
use crate::mechanics::force::law::Law;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::State;

/// Share of the elastic way of dry friction within which its force is taken for linear.
const SMOOTH_SHARE: f64 = 1e-3;

impl System {
    /// Ends a step or an increment at the coordinates and the prescribed motion in `state`: forces remember what has
    /// changed, and references follow. `frames` belong to `state.q`.
    pub fn arrive(&self, state: &mut State, frames: &FrameCache) {
        if !state.memory.is_empty() {
            // Out of the state while the configuration looks at the rest of it.
            let mut memory = std::mem::take(&mut state.lists.memory);
            let configuration = self.configuration(&state.q, frames, state, &state.prescribed);
            for spring in &self.springs {
                if let (Some(place), Some(dry)) = (spring.memory, spring.law.as_ref().and_then(Law::dry)) {
                    let way = spring.way(&self.relative_coordinates[spring.coordinate], &configuration);
                    memory[place] = dry.displaced(memory[place], way);
                }
            }
            state.lists.memory = memory;
        }
        self.carry_references(state, frames);
    }

    /// The names of the forces that remember, in the order of the memory of a state.
    pub fn memories(&self) -> impl Iterator<Item = &str> {
        self.springs.iter().filter(|spring| spring.memory.is_some()).map(|spring| spring.name.as_str())
    }

    /// Whether there is dry friction.
    pub fn has_dry_friction(&self) -> bool {
        self.springs.iter().filter_map(|spring| spring.law.as_ref()).any(|law| law.coulomb() != 0.0)
    }

    /// Changes of coordinates up to `largest`, over the system's size or rad, of which forces are smooth functions: dry
    /// friction turns from sticking to sliding within its elastic way.
    pub fn smooth_reach(&self, largest: f64) -> f64 {
        let ways = self.springs.iter().filter_map(|spring| {
            let dry = spring.law.as_ref()?.dry().filter(|dry| dry.limit > 0.0)?;
            let measure = self.relative_coordinates[spring.coordinate].measure;
            let is_angle = matches!(measure, Measure::Angle(_) | Measure::Rotation(_));
            Some(if is_angle { dry.largest } else { dry.largest / self.size })
        });
        ways.fold(largest, |reach, way| reach.min(SMOOTH_SHARE * way))
    }

    /// The system with the dry part of its friction taken off.
    #[must_use]
    pub fn without_dry_friction(&self) -> Self {
        let mut own = self.clone();
        own.springs.iter_mut().filter_map(|spring| spring.law.as_mut()).for_each(Law::take_dry_friction_off);
        own
    }
}
