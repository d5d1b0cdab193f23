//! Forces between markers and on them: springs, dampers and loads.

pub mod load;
pub mod spring;
