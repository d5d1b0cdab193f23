//! `view --live`: finds the solver that a page can bring.

use super::Stop;
use ancf14_view::{SOLVER_MARK, is_solver};
use std::path::{Path, PathBuf};

/// The solver as messages call it.
pub const SOLVER: &str = "the solver of the page";
/// Name of its file.
const FILE: &str = "ancf14.wasm";

/// The solver as WebAssembly, with its path: the file that is given, or the one next to `program` (none: the running
/// program) or in `../lib`.
pub fn solver(given: Option<&Path>, program: Option<&Path>) -> Result<(PathBuf, Vec<u8>), Stop> {
    let executable = match program {
        Some(program) => program.to_owned(),
        None => std::env::current_exe()
            .map_err(|reason| Stop::Failed(format!("error: this program cannot find itself: {reason}")))?,
    };
    let beside = executable.parent().unwrap_or(Path::new("."));
    let places = match given {
        Some(path) => vec![path.to_owned()],
        None => vec![beside.join(FILE), beside.join("../lib").join(FILE)],
    };
    let Some(path) = places.iter().find(|place| place.is_file()) else {
        let looked: Vec<String> = places.iter().map(|place| place.display().to_string()).collect();
        let looked = looked.join(", ");
        return Err(Stop::Bad(format!(
            "error: {SOLVER}, {FILE}, is not at {looked}; the Python package and the archive of a release bring it, sh scripts/build-wasm.sh builds it, \
             and --live=FILE.wasm names another place"
        )));
    };
    let bytes =
        std::fs::read(path).map_err(|reason| Stop::Bad(format!("error: cannot read {}: {reason}", path.display())))?;
    match is_solver(&bytes) {
        true => Ok((path.clone(), bytes)),
        false => Err(Stop::Bad(format!(
            "error: {} is not {SOLVER_MARK}; build it anew with sh scripts/build-wasm.sh, or install program and solver from one release",
            path.display()
        ))),
    }
}
