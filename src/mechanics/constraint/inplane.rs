//! Inplane joint:  b stays in the plane of a that is normal to its first axis, all turns are free. 1 condition.

use super::primitive::Primitive;
use crate::mechanics::marker::relative_coordinate::Measure;

/// Conditions of an inplane joint normal to the first axis.
pub const PRIMITIVES: &[Primitive] = &[Primitive::Measured(Measure::Distance(0))];
