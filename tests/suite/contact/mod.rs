//! Beams that touch surfaces.

mod derivatives;
mod energy;
mod friction;
mod states;
mod statics;
