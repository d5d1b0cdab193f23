//! Rigid bodies.

pub mod in_water;
pub mod kinematics;
pub mod rigid_body;
