//! Linear systems, Newton, equilibria, natural modes, steps in time and their derivatives.

pub mod dynamics;
pub mod linear;
pub mod modes;
pub mod newton;
pub mod sensitivity;
pub mod statics;
pub mod step;
