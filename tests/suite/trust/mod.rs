//! Wrong results are told, and results do not depend on units, directions or the run beside them.

pub mod alternating_forces;
pub mod claims;
pub mod coarse_ends;
pub mod coarse_meshes;
pub mod correction;
pub mod end_of_runs;
pub mod energy_watch;
pub mod fine_meshes;
pub mod finer_meshes;
pub mod limits_of_models;
pub mod mesh_error_of_units;
pub mod mesh_truth;
pub mod meshes_of_modes;
pub mod motion_meshes;
pub mod refinement;
pub mod relieved_strains;
pub mod rescue;
pub mod scales;
pub mod shipped_models;
pub mod time_error;
mod time_error_of_forces;
pub mod turned_models;
pub mod turning_parts;
pub mod verification;
