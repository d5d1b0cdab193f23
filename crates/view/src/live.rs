//! The solver in the page: its WebAssembly module, and the model that it simulates there.

use serde::Serialize;

/// Words that the module of this very version has in it.
pub const SOLVER_MARK: &str = concat!("the solver of ancf14 ", env!("CARGO_PKG_VERSION"), " for the page");

/// Whether bytes are the module of this very version.
pub fn is_solver(bytes: &[u8]) -> bool {
    let mark = SOLVER_MARK.as_bytes();
    bytes.starts_with(b"\0asm") && bytes.windows(mark.len()).any(|window| window == mark)
}

/// What a page with the solver has more than one without.
#[derive(Clone, Debug, Serialize)]
pub struct Live {
    /// The module of crates/live.
    #[serde(skip)]
    pub solver: Vec<u8>,
    /// The model file as messages call it.
    pub file: String,
    /// Its text, without copies and includes.
    pub text: String,
    /// Keys and values of `--set`.
    pub overrides: Vec<(String, String)>,
    /// How many natural modes the page shows.
    pub modes: Option<u16>,
}
