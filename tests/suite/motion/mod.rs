//! Time integration, natural modes, saved states, and the derivatives of a step.

pub mod breaks;
pub mod chosen_steps;
pub mod constrained_mass;
pub mod direct_solver;
pub mod driven_stiff;
pub mod dynamics;
pub mod energies_of_parts;
pub mod energy_account;
pub mod generalized_alpha;
pub mod generalized_alpha_steps;
mod large_machines;
mod linearization;
pub mod midpoint_steps;
mod mode_damping;
pub mod modes;
pub mod pulses;
pub mod reduction;
pub mod released_motions;
pub mod rigid_rotation;
pub mod rollback;
mod rotary_inertia;
mod slender_derivatives;
pub mod start_derivatives;
pub mod steady_rotation;
pub mod step_derivatives;
pub mod stiff;
pub mod winches;
