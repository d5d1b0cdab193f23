//! Tests of FMU files: the description, the archive and what is in it.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]

mod archive;
mod description;
mod description_fmi3;
mod exchange;
mod models;
