//! Sections, the ANCF14 element, joints and loads: no FMI, no files, no clock, no solver.
pub mod beam;
pub mod material;
pub mod section;
