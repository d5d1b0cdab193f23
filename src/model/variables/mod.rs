//! The variable table of a model: its parameters, the inputs of a host and the results.

mod dependencies;
pub mod inputs;
mod table;

pub use table::{Measure, Moment, Source, Table};
