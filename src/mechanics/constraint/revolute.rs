//! Revolute joint: places coincide, first axes are parallel; b turns about the axis relative to a. 5 conditions.

use super::primitive::Primitive;

/// Conditions of a revolute joint about the first axis.
pub const PRIMITIVES: &[Primitive] = &[Primitive::Coincident, Primitive::Parallel(0)];
