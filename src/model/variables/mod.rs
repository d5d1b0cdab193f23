//! The variable table of a model: its parameters, the inputs of a host and the results.

mod dependencies;
pub mod inputs;
mod measure;
mod nominal;
mod reading;
mod table;

pub use measure::{Measure, is_of_account};
pub use reading::Moment;
pub use table::{Source, Table};
