//! A simulation as files of VTK (docs/command-line.md, Export): for each kind of part a file of each instant, `beams_0042.vtp`, and their list, `beams.pvd`.
//!
//! Nothing here prints or writes files.

mod export;
mod parts;
mod polydata;
mod solids;

pub use export::{Export, File};
