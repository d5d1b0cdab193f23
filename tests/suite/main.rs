//! The integration tests: one binary, a file for each question.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]

mod allocations;
mod dynamics;
mod element_derivatives;
mod fmi;
mod frequencies;
mod invariance;
mod machines;
mod marker_derivatives;
mod oracle;
mod model_file;
mod model_mistakes;
mod princeton;
mod random;
mod statics;
