//! Inline joint:  b slides along the first axis of a, all turns are free. 2 conditions.

use super::primitive::Primitive;
use crate::mechanics::marker::relative_coordinate::Measure;

/// Conditions of an inline joint along the first axis.
pub const PRIMITIVES: &[Primitive] =
    &[Primitive::Measured(Measure::Distance(1)), Primitive::Measured(Measure::Distance(2))];
