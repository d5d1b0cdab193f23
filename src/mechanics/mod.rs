//! Sections, the ANCF14 element, joints and loads: no FMI, no files, no clock, no solver.

pub mod assembly;
pub mod beam;
pub mod joint;
pub mod load;
pub mod marker;
pub mod material;
pub mod section;
pub mod sensor;
pub mod state;
pub mod system;
