//! From a model file to a simulation: where the two halves meet.
//!
//! [`expression`] gives every number of a model file a value and exact derivatives.

pub mod expression;
pub mod function;
