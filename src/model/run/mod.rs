//! Runs a model: [`simulation::Simulation`] is what a host, a program and the command line step through time.

pub mod accuracy;
pub mod between;
pub mod correction;
pub mod derived;
pub mod effort;
pub mod finer;
pub mod levels;
pub mod missed_damping;
pub mod neighbor;
pub mod ranges;
pub mod rows;
pub(super) mod scale;
pub mod simulation;
mod spell;
pub mod step_length;
pub mod step_setting;
pub mod watch;
