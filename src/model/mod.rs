//! From a model file to a simulation: where the two halves meet.
//!
//! [`document::Document::parse`] reads a file into typed data, [`expression`] gives every number of it a value and exact
//! derivatives, [`diagnostic`] says what is wrong and where.

pub mod accuracy;
pub mod build;
mod dependencies;
pub mod diagnostic;
pub mod document;
pub mod drawing;
pub mod effort;
pub mod entries;
pub mod expression;
pub mod file;
pub mod function;
pub mod geometry;
pub mod inputs;
pub mod modes;
pub mod names;
pub mod notes;
pub mod number;
mod overrides;
pub mod parameter;
pub mod quantity;
mod reader;
pub mod rows;
mod schema;
pub mod simulation;
mod syntax;
mod tree;
pub mod unit;
pub mod variables;
pub mod verification;
pub mod view;
pub mod watch;
