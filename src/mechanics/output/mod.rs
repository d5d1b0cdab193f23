//! What is read off a system: reactions, stress, section forces, mode shapes, and signs of a mesh that is too coarse or
//! too fine.

pub mod axial_forces;
pub mod beam_scale;
pub mod clamped_end;
pub mod contact_loads;
pub mod fiber_strain;
pub mod joint_loads;
pub mod laid;
pub mod mesh_error;
pub mod mode_shape;
mod proportions;
pub mod section_loads;
pub mod section_stress;
mod shear;
pub mod straight_thrust;
mod strain_fit;
