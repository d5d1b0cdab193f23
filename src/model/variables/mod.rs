//! The variable table of a model: its parameters, the inputs of a host and the results.

mod dependencies;
pub mod inputs;
mod reading;
mod table;

pub use reading::Moment;
pub use table::{Measure, Source, Table, is_of_account};
