//! Weld: positions coincide, axes are parallel. 6 conditions.

use super::primitive::Primitive;

/// Conditions of a weld.
pub const PRIMITIVES: &[Primitive] = &[Primitive::Coincident, Primitive::Parallel(0), Primitive::Unturned(0)];
