//! The front doors for programs: `ancf14::Simulation`, the functions `ancf14_...` of C, and the listings of the page on
//! them.

mod c_functions;
mod door;
mod page;
mod random_calls;

use std::process::Output;

/// What a program printed that succeeded.
fn printed(ran: &Output) -> String {
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    String::from_utf8(ran.stdout.clone()).unwrap()
}
