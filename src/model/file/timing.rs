//! When the run of a model file begins and ends, and how far its steps and its rows of results are apart.

use super::document::Document;
use super::entries::simulation::{Analysis, Follow, SimulationSpec, Steps};

/// Rows of results of a file that says neither how far they are apart nor a step: of a motion, and of a row of
/// equilibria.
const ROWS_OF_MOTION: f64 = 500.0;
const ROWS_OF_EQUILIBRIA: f64 = 50.0;

impl Document {
    /// The instant at which the mechanism is as drawn, s, in a run that begins at `start`, s: the beginning of its
    /// preload.
    pub fn drawn_at(&self, start: f64) -> f64 {
        self.simulation.preload.map_or(start, |preload| start - self.value(preload))
    }

    /// First and last instant of a run that begins at 0, its preload included, s.
    pub fn span(&self) -> [f64; 2] {
        [self.drawn_at(0.0), self.value(self.simulation.stop)]
    }

    /// Whether equilibria are followed by the arc length of their path, which then stands where a run has its time.
    pub fn follows_arc_length(&self) -> bool {
        self.simulation.follow != Follow::Time
    }

    /// What the rows of results are at, for headings: an instant, or the arc length of a path.
    pub fn row_heading(&self) -> &'static str {
        if self.follows_arc_length() { "at arc length" } else { "at t (s)" }
    }

    /// Time between two rows of results, s.
    pub fn output_step(&self) -> f64 {
        let SimulationSpec { analysis, stop, steps, output_step, .. } = &self.simulation;
        match (output_step, steps, analysis) {
            (Some(number), ..) | (None, Steps::Fixed(number), _) => self.value(*number),
            (None, Steps::ForAccuracy(_), Analysis::Dynamic) => self.value(*stop) / ROWS_OF_MOTION,
            (None, Steps::ForAccuracy(_), Analysis::Static) => self.value(*stop) / ROWS_OF_EQUILIBRIA,
        }
    }

    /// The largest internal step, s; where the solver chooses the steps of a motion, one that does not depend on the
    /// rows.
    pub fn largest_step(&self) -> f64 {
        let SimulationSpec { analysis, stop, steps, .. } = &self.simulation;
        match (steps, analysis) {
            (Steps::Fixed(step), _) => self.value(*step),
            (Steps::ForAccuracy(_), Analysis::Dynamic) => self.value(*stop) / ROWS_OF_MOTION,
            (Steps::ForAccuracy(_), Analysis::Static) => self.output_step(),
        }
    }
}
