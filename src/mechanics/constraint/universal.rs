//! Universal joint: places coincide, the first axis of a and the second axis of b stay perpendicular; b turns about
//! both. 4 conditions.

use super::primitive::Primitive;

/// Conditions of a universal joint.
pub const PRIMITIVES: &[Primitive] = &[Primitive::Coincident, Primitive::Perpendicular(0, 1)];
