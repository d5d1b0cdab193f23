//! The front doors for programs: `ancf14::Simulation`, the functions `ancf14_...` of C, the examples, and what is installed for them.

mod c_functions;
mod door;
mod page;
mod programs;
mod random_calls;

use std::path::{Path, PathBuf};
use std::process::Output;

/// The root of the repository.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The program as cargo built it for these tests.
fn program() -> PathBuf {
    PathBuf::from(env!("CARGO_BIN_EXE_ancf14"))
}

/// What a program printed that succeeded.
fn printed(ran: &Output) -> String {
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout.clone()).unwrap()
}
