//! The integration tests: one binary, a file for each question.

mod dynamics;
mod element_derivatives;
mod frequencies;
mod invariance;
mod machines;
mod marker_derivatives;
mod oracle;
mod princeton;
mod random;
mod statics;
