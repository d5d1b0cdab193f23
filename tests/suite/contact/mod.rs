//! Beams that touch surfaces.

mod beams;
mod derivatives;
mod energy;
mod friction;
mod messages;
mod shapes;
mod sheave;
mod states;
mod statics;
