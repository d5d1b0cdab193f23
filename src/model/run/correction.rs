//! Takes the time-step error that the state carries along (MECHANICS 7.8) out of positions, angles, velocities, rates
//! and energies: where the motion is smooth for its steps, they then converge with order 3. Strains, forces and
//! accelerations stay as computed: of vibrations that no step resolves the estimate tells the size at best.

use crate::mechanics::state::time_error::TimeError;
use crate::mechanics::system::System;
use serde::{Deserialize, Serialize};

/// Of an error of this share of the range of its results, half is taken out: the estimate is linear, and beyond that
/// does not even tell the size of what it leaves out.
const HALVED: f64 = 0.3;
/// How fast less of larger errors is taken out.
const DECLINE: i32 = 4;
/// The remainder is told as so many times the share by which the error of the velocities changes over a step. With that
/// share alone, a quarter of the true one was told of a cantilever.
const SAFETY: f64 = 1.5;

/// How well the estimate has told the errors of a motion so far, and what its corrections have left in.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Remainder {
    /// Sums over the looks of the squares of the velocities' error, and of its change over the last step, both as
    /// coordinates over that step.
    squares: [f64; 2],
    /// The largest error that has been left in each family of results, in its unit.
    left: Vec<f64>,
}

impl Remainder {
    /// Includes the `error` of a state, which is that of the families of results that range so far, both in their
    /// units.
    pub fn include(&mut self, system: &System, error: &TimeError, families: impl ExactSizeIterator<Item = [f64; 2]>) {
        let TimeError { velocity, acceleration, step, .. } = error;
        let sizes = [step * system.correction_size(velocity).0, step * step * system.correction_size(acceleration).0];
        for (sum, size) in self.squares.iter_mut().zip(sizes) {
            *sum += size * size;
        }
        self.left.resize(families.len(), 0.0);
        for (left, [error, range]) in self.left.iter_mut().zip(families) {
            *left = left.max((1.0 - share(error, range)) * error);
        }
    }

    /// The error that the corrected results of a family may still have, whose largest estimated error is `error`. Where
    /// the error of the velocities changes from step to step by as much as itself, it is that of vibrations which no
    /// step resolves, and says nothing of their phase.
    pub fn of(&self, family: usize, error: f64) -> f64 {
        let [size, change] = self.squares;
        let turning = if change < size { (change / size).sqrt() } else { 1.0 };
        (SAFETY * turning * error + self.left.get(family).copied().unwrap_or_default()).min(error)
    }
}

/// The share of an error that is taken out of results that range so far, both in their unit: 1 but for large errors, 0
/// for those without bound.
pub fn share(error: f64, range: f64) -> f64 {
    let size = error / (HALVED * range);
    if size.is_nan() { 0.0 } else { 1.0 / (1.0 + size.powi(DECLINE)) }
}

/// Makes a corrected quaternion one of a rotation again.
pub fn normalize(quaternion: &mut [f64]) {
    let size = quaternion.iter().map(|part| part * part).sum::<f64>().sqrt();
    if size > 0.0 {
        quaternion.iter_mut().for_each(|part| *part /= size);
    }
}
