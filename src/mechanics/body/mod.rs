//! Rigid bodies.

pub mod kinematics;
pub mod rigid_body;
