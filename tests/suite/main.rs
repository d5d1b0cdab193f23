//! The integration tests: one binary, a file for each question.

mod command_line;
mod dynamics;
mod element_derivatives;
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
