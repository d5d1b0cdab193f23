//! Steps as all integrators share them: their halving, their length, their limits, and the velocities and accelerations
//! at their ends.

pub mod constrained_mass;
pub mod course;
pub mod integrator;
pub mod limits;
pub mod linearized;
pub mod mobility;
pub mod pacing;
pub mod projection;
pub mod response;
pub mod spare;
pub mod switching;
pub mod tally;
