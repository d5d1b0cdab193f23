//! The ANCF14 beam: coordinates, frames, kinematics inside the element, energies, inertia (Ebrahimi, Butscher, Cheong 2020).
//!
//! `#[inline]` stands on what every evaluation of an element calls: its many numbers are then made where they are used, not copied there.

pub mod axial;
pub mod bending;
pub mod coordinates;
pub mod curve_point;
pub mod damping;
pub mod element;
mod formulation;
pub mod fourth_moments;
pub mod frame;
pub mod inertia;
pub mod kinematics;
pub mod over_step;
pub mod points;
pub mod pullback;
pub mod quadratic_twist;
pub mod relative;
pub mod section;
mod section_point;
pub mod strain;
pub mod stretching;
pub mod torsion;
