//! What several tests use: machines built without a file, the oracles, quadrature, counters.

pub mod allocations;
pub mod gauss;
pub mod machines;
pub mod marker_oracle;
pub mod oracle;
pub mod oscillation;
pub mod parts;
pub mod sections;
pub mod tangent;
