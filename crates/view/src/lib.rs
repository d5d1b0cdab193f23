//! The page that shows a mechanism move: one HTML file (docs/viewer.md). It may bring the solver, which simulates the
//! model anew in the page, or ask the program that serves it for the data of each new run.
//!
//! Nothing here prints or writes files.

mod block;
mod charts;
mod film;
mod format;
mod live;
mod page;
mod second;

pub use block::Effort;
pub use film::{Film, ended_early};
pub use live::{Live, SOLVER_MARK, is_solver};
pub use page::{html, watching};
pub use second::{Second, Shown};
