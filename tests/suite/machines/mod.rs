//! Machines as engineers draw them, each in the shortest words of the model file, against numbers that one computes by
//! hand. Their files are in `tests/machines/`; the net and the wind turbine are checked in
//! `tests/suite/language/copies.rs`.

mod motions;
mod statics;
mod vibrations;

use ancf14::{Results, Simulation};

/// The machine of a file.
fn machine(text: &str) -> Simulation {
    machine_with(text, &[])
}

/// The machine of a file with some numbers of its own.
fn machine_with(text: &str, overrides: &[(&str, &str)]) -> Simulation {
    Simulation::from_text_with("machine.toml", text, overrides).unwrap_or_else(|error| panic!("{error}"))
}

/// All outputs of a run to the end.
fn results(text: &str, overrides: &[(&str, &str)]) -> Results {
    machine_with(text, overrides).record(&[]).unwrap_or_else(|error| panic!("{error}"))
}

/// The values of a column.
fn column<'a>(results: &'a Results, name: &str) -> &'a [f64] {
    results.column(name).unwrap_or_else(|| panic!("no column {name}"))
}

/// The last value of a column.
fn last(results: &Results, name: &str) -> f64 {
    *column(results, name).last().unwrap()
}

/// Checks that `found` is `expected`, but for the share `tolerance` of it.
fn check(what: &str, found: f64, expected: f64, tolerance: f64) {
    println!("{what}: {found:.6}, reference {expected:.6}, {:.2e} of it apart", (found / expected - 1.0).abs());
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found}, not {expected}");
}
