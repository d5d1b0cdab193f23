//! The ANCF14 beam: coordinates, frames, kinematics inside the element, energies, inertia (Ebrahimi, Butscher, Cheong
//! 2020).
//!
//! `#[inline]` stands on what every evaluation of an element calls: its many numbers are then made where they are used,
//! not copied there.

pub mod along;
mod at_instant;
mod balance;
mod beam_element;
mod bending_strains;
pub mod coordinates;
pub mod damping;
pub mod element;
pub mod energy;
pub mod fluid_load;
pub mod frame;
pub mod inertia;
pub mod kinematics;
mod line_load;
pub mod natural;
pub mod over_step;
pub mod paid_out;
mod passing;
pub mod payout;
pub mod relief;
pub mod rotary_inertia;
pub mod section;
mod sections_along;
mod shared;
pub mod strain;
mod stress_free;
mod tension;
mod transport;
