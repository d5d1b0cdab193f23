//! Joints, drives and frames: conditions, freedoms, reactions.

pub mod cams;
pub mod closed_loops;
pub mod drives;
pub mod gears;
pub mod host_motion;
mod host_starts;
pub mod joint_derivatives;
pub mod joint_freedoms;
pub mod joint_rates;
pub mod joints_do_no_work;
pub mod joints_in_motion;
pub mod moving_frames;
pub mod reactions;
mod slides;
mod switched_states;
mod switches;
