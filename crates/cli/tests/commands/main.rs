//! Tests of the program `ancf14`: one binary, a file for each question.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]
#![allow(clippy::print_stdout, reason = "a test shows its measured figures with --nocapture")]

mod campbell_command;
mod command_line;
mod drawing_views;
mod export_command;
mod first_state;
mod index_page;
mod inputs_command;
mod linearize_command;
mod modes_command;
mod new_command;
mod output_files;
mod programs;
mod refined_runs;
mod same_results;
mod shells;
mod small_fmu;
mod stages;
mod summary;
mod tune_command;
mod view_command;
mod view_comparison;

use std::process::Output;

/// What a program printed that succeeded.
fn printed(ran: &Output) -> String {
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout.clone()).unwrap()
}
