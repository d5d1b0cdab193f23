//! The extremes of the results from row to row: a blow that begins and ends between two rows has its peak in none.

use crate::error::Error;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use crate::model::variables::{Moment, Table};
use crate::solve::step::response::Response;

/// The lowest and the highest value of a result, each with its time, s.
pub type LowAndHigh = [[f64; 2]; 2];

/// A mean acceleration or multiplier of a step is a new extreme if it lies beyond those before by this share of its own
/// range, and of the largest of all: round-off of what stands still is none.
const FURTHER: [f64; 2] = [1e-4, 1e-6];

/// The extremes of all results since the last row, at ends of steps.
#[derive(Debug, Default)]
pub struct Between {
    extremes: Vec<LowAndHigh>,
    eyes: Eyes,
    /// The instant that is looked at; scratch memory.
    response: Response,
    frames: FrameCache,
    results: Vec<f64>,
}

impl Between {
    /// A row has been told: what follows belongs to the next one.
    pub fn begin_row(&mut self) {
        self.extremes.clear();
    }

    /// Whether results may have extremes at `state`, where a step has ended.
    pub fn is_due(&mut self, state: &State) -> bool {
        self.eyes.are_caught(state)
    }

    /// Velocities may have jumped: those of `state` are where the next step begins.
    pub fn begin_step(&mut self, state: &State) {
        self.eyes.velocity.clone_from(&state.velocity);
        self.eyes.time = state.time;
    }

    /// Includes the instant of `state`; `respond` finds its accelerations and multipliers. An instant that has none is
    /// left out.
    pub fn include(
        &mut self,
        table: &Table,
        (system, state): (&System, &State),
        respond: impl FnOnce(&mut Response) -> Result<(), Error>,
    ) {
        let Self { extremes, response, frames, results, .. } = self;
        if respond(response).is_err() {
            return;
        }
        table.measure(&Moment { system, state, response, fibers: &[] }, frames, results);
        include(extremes, state.time, results);
    }

    /// Includes `results` that are known, at `time`, s.
    pub fn include_results(&mut self, time: f64, results: &[f64]) {
        include(&mut self.extremes, time, results);
    }

    /// The extremes of all results; empty: nothing has been seen since the last row.
    pub fn extremes(&self) -> &[LowAndHigh] {
        &self.extremes
    }
}

fn include(extremes: &mut Vec<LowAndHigh>, time: f64, results: &[f64]) {
    extremes.resize(results.len(), [[f64::INFINITY, 0.0], [f64::NEG_INFINITY, 0.0]]);
    for ([low, high], value) in extremes.iter_mut().zip(results) {
        if !value.is_finite() {
            continue;
        }
        if *value < low[0] {
            *low = [*value, time];
        }
        if *value > high[0] {
            *high = [*value, time];
        }
    }
}

/// Sees from steps alone, which costs next to nothing, when results may be larger or smaller than ever: the mean
/// accelerations of all coordinates and the multipliers of all joints, of which one is further out then.
#[derive(Debug, Default)]
struct Eyes {
    /// Where the step began.
    velocity: Vec<f64>,
    time: f64,
    /// The lowest and the highest mean accelerations and multipliers so far.
    accelerations: Vec<[f64; 2]>,
    multipliers: Vec<[f64; 2]>,
    /// The largest of each kind, without its sign.
    largest: [f64; 2],
}

impl Eyes {
    /// Whether anything is further out than before, in the step that ended at `state`.
    fn are_caught(&mut self, state: &State) -> bool {
        let Self { velocity, time, accelerations, multipliers, largest } = self;
        if velocity.len() != state.velocity.len() {
            velocity.clone_from(&state.velocity);
            *time = state.time;
            return true;
        }
        let step = state.time - *time;
        let means = state.velocity.iter().zip(&*velocity).map(|(end, begin)| (end - begin) / step);
        let by_acceleration = extend(accelerations, means, &mut largest[0]);
        let by_multiplier = extend(multipliers, state.multipliers.iter().copied(), &mut largest[1]);
        velocity.clone_from(&state.velocity);
        *time = state.time;
        by_acceleration || by_multiplier
    }
}

/// Extends `ranges` to `values`; returns whether one lies clearly beyond its range. Joints that engage or release
/// change how many there are, and all begin again.
fn extend(ranges: &mut Vec<[f64; 2]>, values: impl ExactSizeIterator<Item = f64>, largest: &mut f64) -> bool {
    let anew = ranges.len() != values.len();
    if anew {
        ranges.clear();
        ranges.resize(values.len(), [f64::INFINITY, f64::NEG_INFINITY]);
    }
    let mut is_further = anew;
    for (range, value) in ranges.iter_mut().zip(values) {
        let [low, high] = *range;
        *largest = largest.max(value.abs());
        let margin = f64::max(FURTHER[0] * (high - low), FURTHER[1] * *largest);
        is_further |= value > high + margin || value < low - margin;
        *range = [low.min(value), high.max(value)];
    }
    is_further
}
