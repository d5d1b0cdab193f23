//! Packs a model as an FMU: a zip archive of description, picture, libraries, model file, documentation and licences
//! (FMI 2.0, section 2.3; FMI 3.0, section 2.5).
//!
//! All of it is made from [`About`](ancf14::fmi::About) and the variable table of a model, and from
//! [`contents::Contents`]: [`package::fmu`]. Nothing here prints or writes files.

pub mod contents;
pub mod description;
pub mod description_fmi3;
mod documentation;
mod documentation_linear;
mod elements;
pub mod error;
pub mod libraries;
pub mod package;
pub mod small;
pub mod terminals;
