//! What is given from outside: functions of time, loads at an instant, drives and moving frames, switches, and the
//! motion that a host asks for.

pub mod excitation;
pub mod guide;
pub mod heat;
pub mod heat_guide;
pub mod host_motion;
pub mod prescribed;
pub mod signal;
pub mod switch;
