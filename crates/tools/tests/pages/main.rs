//! Tests of the pages that this package writes, against the pages as they are in docs/.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]
#![allow(clippy::print_stdout, reason = "a test shows its measured figures with --nocapture")]

mod campaign;
mod how_do_i;
mod model_file;
mod trust;
mod validation;
mod words;
