//! What the effort of an actuator reads: a coordinate of a joint, or its rate.

use super::joint::Coordinate;
use crate::model::file::reader::readings::KEYS;

/// A coordinate of a joint, or its rate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reading {
    /// Place in the list of joints.
    pub joint: usize,
    /// Which coordinate.
    pub coordinate: Coordinate,
    /// Its rate, not itself.
    pub is_rate: bool,
}

impl Reading {
    /// The reading that a number of an expression means.
    pub fn of(number: usize) -> Self {
        let key = KEYS[number % KEYS.len()];
        let coordinate = if key.starts_with("angle") { Coordinate::Angle } else { Coordinate::Distance };
        Self { joint: number / KEYS.len(), coordinate, is_rate: key.ends_with("_rate") }
    }
}
