//! The beam elements: derivatives, rigid motions, orders, strains, section forces, stresses.

pub mod ancf24_derivatives;
pub mod ancf24_machines;
pub mod ancf24_motion;
pub mod ancf24_oracle;
pub mod ancf24_statics;
pub mod ancf24_unit_element;
pub mod curve_keys;
pub mod curved_beams;
pub mod damping;
pub mod element_derivatives;
pub mod invariance;
pub mod over_step;
pub mod quadratic_twist;
mod rotary_inertia;
pub mod section_balance;
pub mod section_forces;
pub mod strain_outputs;
pub mod stress_derivatives;
mod tension_center;
mod tension_damping;
mod varying_sections;
