//! Whether the elements at clamped ends of taut beams are short enough for the bend there.

use crate::error::decimal;
use crate::mechanics::output::clamped_end::CoarseEnd;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::file::entries::simulation::Analysis;
use serde::{Deserialize, Serialize};

/// In dynamics one communication point of so many is looked at, and so many in a row must show a coarse end: a blow
/// pulls for a moment only.
const STRIDE: u64 = 4;
const SIGHTINGS: u32 = 3;
/// More elements than this are not recommended: a short beam at the end costs less.
const MANY: f64 = 200.0;

/// What has been seen of clamped ends.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EndWatch {
    is_static: bool,
    points: u64,
    count: u32,
    warned: bool,
}

impl EndWatch {
    /// Of a run of this analysis.
    pub fn new(analysis: Analysis) -> Self {
        Self { is_static: analysis == Analysis::Static, ..Self::default() }
    }

    /// Looks at a new state, and warns of a clamped end that its element does not resolve.
    pub fn look(&mut self, system: &System, state: &State, frames: &mut FrameCache) -> Option<String> {
        let point = self.points;
        self.points = point.wrapping_add(1);
        if self.warned || (!self.is_static && !point.is_multiple_of(STRIDE)) {
            return None;
        }
        let Some(end) = system.coarse_end(&frames.of(system, state)) else {
            self.count = 0;
            return None;
        };
        self.count += 1;
        self.warned = self.is_static || self.count >= SIGHTINGS;
        self.warned.then(|| warning(system, state, &end))
    }
}

fn warning(system: &System, state: &State, end: &CoarseEnd) -> String {
    let CoarseEnd { node, element, tension, bending_length, length } = *end;
    let (beam, _) = system.beam_of(element);
    let count = (beam.elements() as f64 * length / bending_length).ceil();
    let finer = if count <= MANY {
        format!("take elements = {count} or more for this beam, or weld")
    } else {
        String::from("weld")
    };
    format!(
        "the mesh is too coarse at the clamped end {}: at t = {} s the tension there is {tension:.3e} N, and beam {} bends within sqrt(EI/T) = {bending_length:.2e} m of \
         the end, but its element is {length:.2e} m long; bending moments and stresses there are wrong, and natural frequencies are too high; {finer} a short beam with fine \
         elements in between; if the bending there does not matter, a spherical joint does without it",
        system.describe_node(node),
        decimal(state.instant()),
        beam.name
    )
}
