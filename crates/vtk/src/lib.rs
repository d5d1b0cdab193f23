//! Writes a simulation as files of VTK (docs/command-line.md, ParaView): one file per kind of part and instant,
//! `beams_0042.vtp`, and a list of them, `beams.pvd`.
//!
//! The files are bytes here; the caller writes them to the disk.

mod export;
mod parts;
mod polydata;
mod solids;

pub use export::{Export, File};
