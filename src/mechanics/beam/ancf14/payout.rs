//! How much of a beam is paid out.

use crate::math::jet::Jet;

/// The smallest free length, over the one as drawn.
pub const SMALLEST_EXTENT: f64 = 0.02;

/// By what a beam is paid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Payout {
    /// Number of the drive whose value is the length that has been paid out, m.
    pub drive: usize,
    /// Length of the beam as drawn, m.
    pub length: f64,
    /// Where the end that is not at the winch is, along the beam as drawn, m.
    pub far_end: f64,
}

/// How long a beam is without load, over its length as drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Extent {
    /// `lambda`, 1.
    pub ratio: f64,
    /// `lambda'/lambda`, 1/s.
    pub rate: f64,
    /// `lambda''/lambda`, 1/s².
    pub acceleration: f64,
}

impl Payout {
    /// With the values `drives` of the drives; none of them: as drawn. Where less than [`SMALLEST_EXTENT`] would be
    /// left, that much is: the check of a state refuses it.
    pub fn extent(&self, drives: &[Jet]) -> Extent {
        let paid = drives.get(self.drive).copied().unwrap_or_default();
        let ratio = (1.0 + paid.value / self.length).max(SMALLEST_EXTENT);
        let scale = 1.0 / (ratio * self.length);
        Extent { ratio, rate: paid.first * scale, acceleration: paid.second * scale }
    }
}
