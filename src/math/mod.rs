//! Numbers without beams: quadrature rules, Hermite shape functions, rotations, curves and frames along them, numbers
//! with their derivatives.

pub mod bishop;
pub mod blocks;
pub mod bounds;
pub mod catenary;
pub mod curve;
pub mod curve_defect;
pub mod elementary;
pub mod hermite;
pub mod histogram;
pub mod integral;
pub mod jet;
pub mod monotone;
pub mod quadrature;
pub mod range;
pub mod resolution;
pub mod rotation;
pub mod spline;
pub mod switches;
pub mod tight_line;
pub mod vectors;

/// A vector in space.
pub type Vec3 = nalgebra::Vector3<f64>;
/// A 3×3 matrix; as a triad its columns are the axes.
pub type Mat3 = nalgebra::Matrix3<f64>;
