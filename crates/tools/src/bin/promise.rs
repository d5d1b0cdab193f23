//! Measures what runs promise that choose their steps and meshes: `cargo run --release --bin promise -- models/*.toml`.
#![allow(clippy::print_stdout, reason = "its rows are what it is for")]

use ancf14_tools::promise;
use clap::Parser;
use std::path::PathBuf;
use std::time::Duration;

/// Runs model files without their steps, elements and twists, and compares each with a finer run.
#[derive(Debug, Parser)]
struct Arguments {
    /// Model files
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// Cost of all repetitions, over that of the first run
    #[arg(long)]
    budget: Option<f64>,
    /// Processor time of a file at most, s; the reference may take as much again
    #[arg(long, default_value_t = 60)]
    limit: u64,
}

fn main() {
    let Arguments { files, budget, limit } = Arguments::parse();
    println!("| file | verdict | error | claim | runs | elements | first run, s | times that | warning |");
    println!("|---|---|---|---|---|---|---|---|---|");
    for file in files {
        let name = file.display();
        match promise::measure(&file, budget, Duration::from_secs(limit)) {
            Ok(kept) => println!("| {name} {kept}"),
            Err(reason) => println!("| {name} | refused | | | | | | | {} |", reason.lines().next().unwrap_or_default()),
        }
    }
}
