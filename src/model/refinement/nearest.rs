//! Paths of equilibria by arc length: every row is compared with the nearest point of the path of a finer mesh.
//!
//! The same arc length is another equilibrium on every mesh, so that rows of two runs differ by more than the paths do,
//! and near limit points the same load has no equilibrium. The distance across the path is the error.

use crate::model::run::accuracy::Differences;
use crate::model::run::finer::Finer;
use crate::model::run::simulation::Simulation;

/// The comparison of a run with the path of a mesh twice as fine.
#[derive(Debug, Default)]
pub struct Nearest {
    /// None: no row has been looked at.
    finer: Option<Finer>,
    /// A row has no such point, or the mechanism no such mesh.
    is_lost: bool,
    /// Rows that are stable on one of both meshes alone.
    unlike: u32,
    /// Rows that have been compared.
    pub rows: u64,
}

impl Nearest {
    /// Compares the row that `simulation` has reached.
    pub fn look(&mut self, simulation: &Simulation, differences: &mut Differences) {
        if self.finer.is_none() && !self.is_lost {
            self.finer = simulation.twice_as_fine();
        }
        self.rows += 1;
        match self.finer.as_mut().and_then(|finer| simulation.compare_nearest(finer, differences)) {
            Some(is_alike) => self.unlike += u32::from(!is_alike),
            None => self.is_lost = true,
        }
    }

    /// Whether the path of the finer mesh becomes unstable elsewhere: one row may be between both points.
    pub fn hides_instability(&self) -> bool {
        self.unlike > 1
    }

    /// Whether all rows have been compared.
    pub fn is_complete(&self) -> bool {
        !self.is_lost
    }
}
