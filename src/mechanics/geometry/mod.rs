//! Places and axes, their derivatives, and how they are carried.

pub mod marker_jacobian;
pub mod pose;
pub mod pose_pair;
pub mod triad;
