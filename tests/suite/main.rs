//! The one integration binary: a module per question.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]

mod allocations;
mod fmi;
