//! The integration tests: one binary, a file for each question.

mod element_derivatives;
mod machines;
mod oracle;
mod princeton;
mod random;
