//! From a model file to a simulation: where the two halves meet.

pub mod simulation;
