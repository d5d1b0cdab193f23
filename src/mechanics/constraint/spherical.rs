//! Spherical joint: positions coincide, all turns are free. 3 conditions.

use super::primitive::Primitive;

/// Conditions of a spherical joint.
pub const PRIMITIVES: &[Primitive] = &[Primitive::Coincident];
