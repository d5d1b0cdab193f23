//! Linear systems, Newton, equilibria, natural modes, steps in time and their derivatives.

pub mod constrained_mass;
pub mod generalized_alpha;
pub mod gyroscopic;
pub mod kkt;
pub mod limits;
pub mod linear;
pub mod midpoint;
pub mod mobility;
pub mod modes;
pub mod newton;
pub mod pacing;
pub mod prediction;
pub mod projection;
pub mod response;
pub mod sensitivity;
pub mod stability;
pub mod start;
pub mod statics;
pub mod stepping;
pub mod subspace;
