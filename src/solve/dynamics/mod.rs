//! Integrators of motion and the state that they start from.

pub mod generalized_alpha;
pub mod midpoint;
mod power;
pub mod start;
pub mod turning;
