//! The command line of ancf14.

mod cli;

fn main() -> std::process::ExitCode {
    cli::main()
}
