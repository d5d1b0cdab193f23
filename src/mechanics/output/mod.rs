//! What is read off a system: reactions, stress, section forces, mode shapes, and signs of a mesh that is too coarse or
//! too fine.

pub mod axial_jump;
pub mod beam_scale;
pub mod clamped_end;
pub mod fiber_strain;
pub mod joint_loads;
pub mod mesh_error;
pub mod mode_shape;
mod proportions;
mod section_stress;
pub mod smooth_forces;
mod strain_fit;
