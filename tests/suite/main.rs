//! The integration tests: one binary, a file for each question.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]

mod allocations;
mod command_line;
mod dynamics;
mod element_derivatives;
mod fmi;
mod frequencies;
mod invariance;
mod machines;
mod marker_derivatives;
mod model_file;
mod model_mistakes;
mod oracle;
mod princeton;
mod random;
mod statics;
