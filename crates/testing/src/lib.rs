//! What tests, benchmarks and the generated pages share: runs of model files, a toy model, golden files, random
//! numbers.
#![allow(missing_docs, reason = "only tests and programs of this repository use it")]
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]

pub mod blades;
pub mod capstan;
pub mod curves;
pub mod golden;
pub mod integrate;
pub mod integrators;
pub mod large;
pub mod pages;
pub mod paths;
pub mod planar_rod;
pub mod random;
pub mod running;
pub mod spatial_rod;
pub mod thick_rods;
pub mod toy;

use ancf14::fmi::location::CARGO_LIBRARY;
use std::path::{Path, PathBuf};

/// The root of the repository.
pub fn root() -> &'static Path {
    let own = Path::new(env!("CARGO_MANIFEST_DIR"));
    own.ancestors().nth(2).expect("this package is two folders below the root")
}

/// The library as cargo built it for a test: beside the test's executable.
pub fn library_path() -> PathBuf {
    let path = std::env::current_exe().unwrap().parent().unwrap().join(CARGO_LIBRARY);
    assert!(path.is_file(), "{} was not built", path.display());
    path
}
