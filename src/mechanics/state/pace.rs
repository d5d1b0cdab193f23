//! How long the next step of a motion is, where the solver chooses it, as plain data (MECHANICS 7.9).

use serde::{Deserialize, Serialize};

/// Lengths of steps, and the motion so far that their errors are compared with.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Pace {
    /// Length of the next step, unless it ends earlier, s; 0: nothing is known yet.
    pub wanted: f64,
    /// The length that the numerical dissipation is for, s: it follows the steps slowly, so that both of its terms work
    /// as nearly constant inertias.
    pub damping_step: f64,
    /// Error of the last step over that allowed; 0: not known.
    pub ratio: f64,
    /// How many times more than its share the error of a step may be, less one: the results are far more exact than
    /// asked for.
    pub ease: f64,
    /// When that was judged last, s.
    pub judged: f64,
    /// Largest turn in the last step over what it may be.
    pub turned: f64,
    /// Start of the motion, s.
    pub since: f64,
    /// Changes of all coordinates since the start; empty before the first step.
    pub travel: Vec<f64>,
    /// The largest of them so far: of positions over the system's size, and of slopes and angles.
    pub range: [f64; 2],
}

impl Pace {
    /// Whether it may be one of a system with `coordinates` coordinates.
    pub fn is_possible(&self, coordinates: usize) -> bool {
        let Self { wanted, damping_step, ratio, ease, judged, turned, since, travel, range } = self;
        let sizes = [wanted, damping_step, ratio, ease, turned, &range[0], &range[1]];
        let are_possible = sizes.iter().all(|size| size.is_finite() && **size >= 0.0);
        are_possible && since.is_finite() && judged.is_finite() && (travel.is_empty() || travel.len() == coordinates)
    }

    /// Takes the values of another one, keeping its own memory.
    pub fn copy_from(&mut self, other: &Self) {
        let mut travel = std::mem::take(&mut self.travel);
        travel.clone_from(&other.travel);
        *self = Self { travel, ..*other };
    }
}
