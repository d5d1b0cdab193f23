//! Flexible beams, cables and shafts as FMUs: the ANCF14 beam element, a constrained multibody solver, FMI 2.0
//! co-simulation.
//!
//! Two halves that do not know each other meet in [`model`]: `math <- mechanics <- solve <- model` and `fmi <- model`;
//! [`Simulation`] and [`ffi`] (the C ABI) stand on top. ARCHITECTURE.md tells where things live, docs/model-file.md
//! what a model file holds.
//!
//! [`Simulation`] is the front door: a model file, or its text, that runs.
//!
//! ```
//! use ancf14::{Error, Simulation};
//!
//! let text = r#"
//! format = 1
//! model = { name = "Cantilever", gravity = [0, 0, -9.81] }
//! material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
//! section.rod = { shape = "circle", radius = 0.01 }
//! beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
//! joint.root = { type = "weld", a = "ground", b = "arm.start" }
//! output.tip = { at = "arm.end", quantities = ["displacement"] }
//! simulation = { analysis = "static", stop = 1, step = 1 }
//! "#;
//! let mut simulation = Simulation::from_text("cantilever.toml", text)?;
//! simulation.set("steel.density", 8000.0)?;
//! simulation.initialize()?;
//! let sag = simulation.value("tip.displacement[3]")?;
//! let closed_form = -8000.0 * 9.81 / (2.0 * 2.1e11 * 0.01_f64.powi(2)); // ρ A g L⁴/(8 E I), I = A r²/4
//! assert!((sag / closed_form - 1.0).abs() < 1e-4);
//! # Ok::<(), Error>(())
//! ```
//!
//! docs/programming.md has more, in C and C++ too; `examples/` has whole programs.

#![cfg_attr(not(test), deny(clippy::disallowed_methods))]

pub mod error;
#[cfg(not(target_family = "wasm"))]
pub mod ffi;
pub mod fmi;
pub mod linear;
pub mod math;
pub mod mechanics;
pub mod model;
pub mod packed;
mod simulation;
pub mod solve;

pub use model::file::Reach;
pub use simulation::{Error, Kind, Results, SavedState, Simulation, Variable, VariableId};
