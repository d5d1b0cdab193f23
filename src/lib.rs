//! Flexible beams, cables and shafts as FMUs: the ANCF14 beam element, a constrained multibody solver, FMI 2.0 co-simulation.
//!
//! Two halves that do not know each other meet in [`model`]: `math <- mechanics <- solve <- model` and `fmi <- model`;
//! [`ffi`] (the C ABI) stands on top. ARCHITECTURE.md tells where things live.

pub mod error;
pub mod ffi;
pub mod fmi;
pub mod math;
pub mod mechanics;
pub mod model;
pub mod solve;
