//! Forces between markers and on them: springs, dampers, actuators and loads.

pub mod actuator;
pub mod load;
pub mod spring;
