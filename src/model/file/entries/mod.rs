//! The sections of a file, one module each: the typed data, and how it is read.

pub mod actuator;
pub mod beam;
pub mod body;
pub mod curve;
pub mod damping;
pub mod drive;
pub mod frame;
pub mod friction;
pub mod function;
pub mod gear;
pub mod joint;
pub mod load;
pub mod lock;
pub mod material;
mod namesakes;
pub mod output;
pub mod overview;
pub mod parameters;
pub mod point;
pub mod reading;
pub mod section;
pub mod simulation;
pub mod spring;
pub mod stop;
pub mod switch;
pub mod winch;

pub use super::reader::anchor;
