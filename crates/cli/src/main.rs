//! The program `ancf14`.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(ancf14_cli::main(std::env::args_os(), None))
}
