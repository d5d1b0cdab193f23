//! Cylindrical joint:  first axes are one line; b turns about it and slides along it relative to a. 4 conditions.

use super::primitive::Primitive;
use crate::mechanics::marker::relative_coordinate::Measure;

/// Conditions of a cylindrical joint along the first axis.
pub const PRIMITIVES: &[Primitive] =
    &[Primitive::Parallel(0), Primitive::Measured(Measure::Distance(1)), Primitive::Measured(Measure::Distance(2))];
