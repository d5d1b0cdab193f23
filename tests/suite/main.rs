//! The integration tests: one binary, a file for each question.

mod dynamics;
mod element_derivatives;
mod frequencies;
mod machines;
mod oracle;
mod princeton;
mod random;
mod statics;
