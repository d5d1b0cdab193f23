//! Loads, springs, dampers and actuators, and the points that they hold on to.

pub mod actuators;
pub mod bodies_on_springs;
mod controllers;
mod elastic_contacts;
mod foundations;
pub mod friction_and_stops;
pub mod law_derivatives;
pub mod laws;
pub mod load_derivatives;
pub mod loads;
mod moving_loads;
pub mod observers;
pub mod points;
mod ropes;
pub mod spring_derivatives;
mod sticking;
mod units_without_parts;
