//! A driven coordinate: angle or distance of b against a, about or along the first axis, is what a drive prescribes. 1
//! condition.

use super::primitive::Primitive;
use crate::mechanics::marker::relative_coordinate::Measure;

/// Which coordinate a drive prescribes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Driven {
    /// The angle, rad.
    Angle,
    /// The distance, m.
    Distance,
}

impl Driven {
    /// What it measures.
    pub fn measure(self) -> Measure {
        match self {
            Self::Angle => Measure::Angle(0),
            Self::Distance => Measure::Distance(0),
        }
    }

    /// Its condition.
    pub fn primitives(self) -> &'static [Primitive] {
        match self {
            Self::Angle => &[Primitive::Measured(Measure::Angle(0))],
            Self::Distance => &[Primitive::Measured(Measure::Distance(0))],
        }
    }
}
