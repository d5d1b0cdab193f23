//! Linear systems, Newton, equilibria, natural modes, steps in time and their derivatives.
//!
//! The rooms are a stack, the lowest first: `linear`, `newton`, `step`, `modes` and `sensitivity`, `linearization`,
//! `statics`, `dynamics`.

pub mod dynamics;
pub mod linear;
pub mod linearization;
pub mod modes;
pub mod newton;
pub mod sensitivity;
pub mod statics;
pub mod step;
