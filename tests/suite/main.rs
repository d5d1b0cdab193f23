//! The integration tests: one binary, a file for each question.
#![allow(clippy::unwrap_used, reason = "an unmet expectation is a failed test")]
#![allow(clippy::print_stdout, reason = "a test shows its measured figures with --nocapture")]

mod allocations;
mod architecture;
mod closed_loops;
mod command_line;
mod curves;
mod damping;
mod descriptions;
mod dynamics;
mod element_derivatives;
mod fmi;
mod four_bar;
mod frequencies;
mod generalized_alpha;
mod generalized_alpha_steps;
mod golden;
mod hanging;
mod invariance;
mod joint_derivatives;
mod joint_freedoms;
mod joints_do_no_work;
mod joints_in_motion;
mod lateral_buckling;
mod load_derivatives;
mod loads;
mod machines;
mod marker_oracle;
mod model_file;
mod model_mistakes;
mod model_parts;
mod oracle;
mod parts;
mod princeton;
mod random;
mod reactions;
mod released_cantilever;
mod rollback;
mod rotating_shaft;
mod running;
mod section_forces;
mod shaken_cantilever;
mod spring_derivatives;
mod statics;
mod strain_outputs;
mod turned_models;
