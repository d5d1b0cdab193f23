//! The page that shows a mechanism move: one HTML file (docs/viewer.md).

mod block;
mod charts;
mod film;
mod format;
mod page;

pub use film::Film;
