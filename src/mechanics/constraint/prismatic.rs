//! Prismatic joint:  b slides along the first axis of a and does not turn against it. 5 conditions.

use super::primitive::Primitive;
use crate::mechanics::marker::relative_coordinate::Measure;

/// Conditions of a prismatic joint along the first axis.
pub const PRIMITIVES: &[Primitive] = &[
    Primitive::Parallel(0),
    Primitive::Unturned(0),
    Primitive::Measured(Measure::Distance(1)),
    Primitive::Measured(Measure::Distance(2)),
];
