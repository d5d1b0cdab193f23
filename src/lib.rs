//! Flexible beams, cables and shafts as FMUs: the ANCF14 beam element, a constrained multibody solver, FMI 2.0 co-simulation.
//!
//! Two halves that do not know each other meet in [`model`]: `math <- mechanics <- solve <- model` and `fmi <- model`;
//! [`ffi`] (the C ABI) stands on top. ARCHITECTURE.md tells where things live, docs/model-file.md what a model file holds.
//!
//! A model is a text; a simulation of it is driven as a host drives the FMU:
//!
//! ```
//! use ancf14::fmi::{Failure, Model};
//! use ancf14::model::simulation::Simulation;
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
//! let mut simulation = Simulation::load("cantilever.toml", text, &[])?;
//! simulation.initialize(0.0)?;
//! let sag = simulation.variables().iter().position(|variable| variable.name == "tip.displacement[3]").expect("it is there");
//! let closed_form = -7850.0 * 9.81 / (2.0 * 2.1e11 * 0.01_f64.powi(2)); // ρ A g L⁴/(8 E I), I = A r²/4
//! assert!((simulation.value(sag).number() / closed_form - 1.0).abs() < 1e-4);
//! # Ok::<(), Failure>(())
//! ```

pub mod error;
pub mod ffi;
pub mod fmi;
pub mod math;
pub mod mechanics;
pub mod model;
pub mod solve;
