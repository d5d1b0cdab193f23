//! The FMI half: everything a host can see of a unit, on a toy model in [`toy`] and through the C ABI on a real one.

mod c_example;
mod c_header;
mod call_table;
mod derivatives;
pub mod ffi;
mod fmi3;
mod fuzz;
mod guard;
mod handles;
mod header;
mod host;
mod instance;
mod lifecycle;
mod linear;
mod location;
mod log;
mod mischief;
mod sequences;
mod serialized;
mod short_steps;
mod switches;
mod unit;

use ancf14_testing::{library_path, toy};
