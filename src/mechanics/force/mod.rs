//! Forces between markers and on them: springs, dampers, friction, stops, actuators and loads.

pub mod actuator;
pub mod dry_friction;
pub mod effort_law;
pub mod foundation;
pub mod law;
pub mod load;
pub mod rope;
pub mod spring;
pub mod track;
