//! Where a path of equilibria is that is followed by its arc length.

use serde::{Deserialize, Serialize};

/// A point of such a path.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PathPoint {
    /// The parameter of the path: the `t` that loads, drives, frames and temperatures are functions of.
    pub parameter: f64,
    /// The direction of the path: changes of the coordinates, then of the parameter, by arc length.
    pub tangent: Vec<f64>,
    /// Motions that release energy.
    pub unstable: u64,
    /// Sign of the determinant of the equations: it changes at limit points and where a path crosses. 0: not known.
    pub sign: i8,
    /// How far the point is behind its arc length: it waits at a branch point, from which the next step begins.
    pub lag: f64,
    /// Branch points that have been passed since the start.
    pub branch_points: u64,
}

impl PathPoint {
    /// How fast the parameter grows by arc length.
    pub fn growth(&self) -> f64 {
        self.tangent.last().copied().unwrap_or(0.0)
    }
}
