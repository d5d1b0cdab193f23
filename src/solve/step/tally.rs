//! Why the steps of a motion are as short as they are, counted: a run of many steps names the reason.

use crate::mechanics::state::pace::Pace;

/// Error over that allowed from which on it sets the length of a step.
const NEAR: f64 = 0.2;
/// One step of so many is looked at for the coordinate with the largest error.
const LOOK: u64 = 8;

/// Where a step ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// Where it wants to.
    Own,
    /// Where a load, a drive, a joint or a contact changes, or within a pulse.
    Change,
    /// Where a row of results stands.
    Row,
}

/// A reason why a step is not longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// Its error is about as large as the accuracy allows.
    Accuracy,
    /// A change of loads, drives, joints or contacts at its end, or one behind which steps still grow.
    Change,
    /// Another one: a row of results, the start, or a longer step that turned too far.
    Other,
}

/// Counts of accepted steps by their limits.
#[derive(Clone, Debug, Default)]
pub struct Tally {
    counts: [u64; 3],
    /// Steps still grow behind a change.
    grows: bool,
    /// How often the error of each coordinate was the largest one, of the steps that were looked at.
    largest: Vec<u32>,
}

impl Tally {
    /// Counts an accepted step that ended at `end`, after which the pace is `pace`.
    pub fn count(&mut self, pace: &Pace, end: End) {
        let is_inexact = pace.ratio > NEAR;
        self.grows = match end {
            End::Change => true,
            End::Row => false,
            End::Own => self.grows && !is_inexact,
        };
        let limit = match end {
            _ if self.grows => Limit::Change,
            End::Own | End::Row if is_inexact => Limit::Accuracy,
            _ => Limit::Other,
        };
        self.counts[limit as usize] += 1;
    }

    /// Whether [`Self::look`] is to be called in this step.
    pub fn is_due(&self) -> bool {
        self.counts.iter().sum::<u64>().is_multiple_of(LOOK)
    }

    /// Counts the coordinate with the largest error of a step, of `coordinates`.
    pub fn look(&mut self, largest: usize, coordinates: usize) {
        self.largest.resize(coordinates, 0);
        // A system may have none.
        if let Some(count) = self.largest.get_mut(largest) {
            *count += 1;
        }
    }

    /// The share of the steps that this limit holds.
    pub fn share(&self, limit: Limit) -> f64 {
        let all: u64 = self.counts.iter().sum();
        if all == 0 { 0.0 } else { self.counts[limit as usize] as f64 / all as f64 }
    }

    /// The coordinate whose error was the largest one most often.
    pub fn coordinate(&self) -> Option<usize> {
        let most = self.largest.iter().enumerate().max_by_key(|(_, count)| **count)?;
        Some(most.0)
    }
}
