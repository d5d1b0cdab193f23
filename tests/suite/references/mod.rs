//! Machines whose numbers are known: from closed forms, the exact rod, other codes, the paper.

pub mod bend_45;
pub mod damped_vibration;
pub mod four_bar;
pub mod frequencies;
mod heat_along;
pub mod helical_spring;
pub mod helix;
pub mod lateral_buckling;
pub mod polylines;
pub mod princeton;
mod range_graphs;
pub mod released_cantilever;
mod rigidities;
mod rotating_blade;
pub mod rotating_shaft;
pub mod shaken_cantilever;
mod stress_as_drawn;
