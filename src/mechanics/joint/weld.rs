//! Weld: places coincide, axes are parallel. 6 conditions.

use super::primitive::Primitive;

/// Conditions of a weld.
pub const PRIMITIVES: &[Primitive] = &[
    Primitive::Coincident,
    Primitive::Perpendicular(0, 1),
    Primitive::Perpendicular(0, 2),
    Primitive::Perpendicular(1, 2),
];
