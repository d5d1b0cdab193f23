//! Whether lines without bending stiffness push: a real one folds, while a straight one of the mesh stands up.

use crate::error::decimal;
use crate::mechanics::state::State;
use crate::mechanics::system::System;
use crate::mechanics::system::frame_cache::FrameCache;
use serde::{Deserialize, Serialize};

/// Compression that is worth a word, as a share of the largest tension of the same line.
const NOTABLE: f64 = 0.1;

/// The axial forces that lines without bending stiffness have had.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct LimpWatch {
    /// Of each beam of the system; those with bending stiffness keep zeros.
    extremes: Vec<Extremes>,
}

/// The largest means of the axial force over an element of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Extremes {
    /// N, at least 0.
    tension: f64,
    /// N, at least 0.
    compression: f64,
    /// Instant of the largest compression, s.
    time: f64,
}

impl LimpWatch {
    /// Looks at a new state.
    pub fn look(&mut self, system: &System, state: &State, snapshot: &mut FrameCache) {
        if !system.beams.iter().any(|beam| beam.section.limp.bending) {
            return;
        }
        self.extremes.resize(system.beams.len(), Extremes::default());
        let c = snapshot.of(system, state);
        for (number, (beam, own)) in system.beams.iter().zip(&mut self.extremes).enumerate() {
            if beam.section.limp.bending {
                own.include(system.axial_forces(number, &c), state.instant());
            }
        }
    }

    /// Names the lines that have pushed.
    pub fn conclude(&self, system: &System) -> Vec<String> {
        let lines = system.beams.iter().zip(&self.extremes);
        let pushed = lines.filter(|(_, own)| own.compression > NOTABLE * own.tension && own.compression > 0.0);
        pushed
            .map(|(beam, own)| {
                format!(
                    "beam {} has no bending stiffness and pushed with {:.3e} N at t = {} s, where a real line folds \
                     or buckles (its largest tension was {:.3e} N): give its section a bending stiffness, draw it \
                     slack with `lay`, or model a line that only pulls as a spring with only = \"tension\"",
                    beam.name,
                    own.compression,
                    decimal(own.time),
                    own.tension
                )
            })
            .collect()
    }
}

impl Extremes {
    /// Includes the smallest and the largest force of the state at `time`.
    fn include(&mut self, [smallest, largest]: [f64; 2], time: f64) {
        self.tension = self.tension.max(largest);
        if -smallest > self.compression {
            (self.compression, self.time) = (-smallest, time);
        }
    }
}
