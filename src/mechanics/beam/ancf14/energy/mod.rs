//! The parts of the strain energy, and the internal coordinate of the twist that is relaxed in them.

pub mod axial;
pub mod bending;
pub mod eccentricity;
pub mod fourth_moments;
pub mod quadratic_twist;
pub mod stretching;
pub mod torsion;
