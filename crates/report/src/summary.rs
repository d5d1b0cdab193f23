//! What a run came to, for programs: how it went, and the extremes of every column.

use crate::extremes::Extremes;
use serde::Serialize;
use std::collections::BTreeMap;

/// The facts of a run.
#[derive(Clone, Debug, Serialize)]
pub struct Summary {
    /// Name and version of the program.
    pub program: String,
    /// Name and description of the model.
    pub model: String,
    /// One sentence on the model; may be empty.
    pub description: String,
    /// Hash of the model with its settings.
    pub guid: String,
    /// The overrides of `--set`, by key.
    pub settings: BTreeMap<String, String>,
    /// Whether the run came to its end.
    pub complete: bool,
    /// When it should end, s.
    pub stop: f64,
    /// Time of the last row, s.
    pub reached: f64,
    /// Number of rows.
    pub rows: u64,
    /// Accepted steps.
    pub steps: u64,
    /// Newton iterations.
    pub iterations: u64,
    /// Rejected steps.
    pub rejected: u64,
    /// How long it took, s.
    pub wall_time: f64,
    /// The limits of the steps in a sentence, where the program has chosen many.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step_limits: Option<String>,
    /// Estimated errors because of the length of the steps, the largest first; empty: not known.
    pub time_step_errors: Vec<EstimatedError>,
    /// Estimated errors of equilibria because of the mesh, the largest first; empty: not known.
    pub mesh_errors: Vec<EstimatedError>,
    /// The runs that the accuracy has taken, where the program chooses steps or meshes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub accuracy: Option<Accuracy>,
    /// All columns, in the order of results.csv.
    pub columns: Vec<Extremes>,
}

/// The accuracy of a run that is repeated until it is accurate.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Accuracy {
    /// How many runs there were.
    pub runs: u32,
    /// Elements of the last one.
    pub elements: usize,
    /// Whether its results are as accurate as a reader expects.
    pub reached: bool,
    /// The largest error of the last one; none: there is nothing to judge.
    pub worst: Option<EstimatedError>,
}

/// How far a quantity is off.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct EstimatedError {
    /// `tip.velocity`; all energies are `energy`.
    pub quantity: String,
    /// The error as a share of the range of the quantity.
    pub of_range: f64,
}
