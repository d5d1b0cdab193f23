//! The integration tests: one binary, a file for each question.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]
#![allow(clippy::print_stdout, reason = "a test shows its measured figures with --nocapture")]

mod architecture;
mod contact;
mod elements;
mod equilibria;
mod fmi;
mod forces;
mod front;
mod fuzz;
mod joints;
mod language;
mod machines;
mod motion;
mod references;
mod support;
mod trust;
mod water;
mod words;

use ancf14_testing::{curves, golden, integrators, pages, paths, planar_rod, random, running};
