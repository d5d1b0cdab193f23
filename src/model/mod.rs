//! From a model file to a simulation: where the two halves meet.
//!
//! [`document::Document::parse`] reads a file into typed data, [`expression`] gives every number of it a value and
//! exact derivatives, [`text`] says what is wrong and where, [`simulation::Simulation`] runs it.

pub mod builder;
pub mod expression;
pub mod file;
mod flat;
pub mod refinement;
pub mod run;
pub mod shape;
pub mod text;
pub mod validate;
pub mod variables;
pub mod verification;
pub mod view;

pub use file::{document, entries, quantity};
pub use run::simulation::{campbell, linear, reduced, steady};
pub use run::{accuracy, derived, effort, missed_damping, ranges, rows, simulation, step_length};
pub use text::names;
pub use validate::notes;
pub use view::{drawing, modes};
