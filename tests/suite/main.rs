//! The integration tests: one question a file.

mod model_file;
mod model_mistakes;
