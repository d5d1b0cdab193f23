//! `demo`: the double pendulum of the models, built in.

use super::{Stop, run, say};
use ancf14::model::simulation::Simulation;
use std::path::Path;

const MODEL: &str = include_str!("../../models/pendulum.toml");
const DIRECTORY: &str = "ancf14-demo-results";

/// Simulates the pendulum into `./ancf14-demo-results`.
pub fn demo() -> Result<(), Stop> {
    let simulation = Simulation::load("pendulum.toml", MODEL, &[]).map_err(|failure| Stop::Bad(failure.message))?;
    say(&format!("a flexible double pendulum, released under gravity; the model and its results go to ./{DIRECTORY}"));
    run::run(simulation, Path::new(DIRECTORY))?;
    super::write(&Path::new(DIRECTORY).join("pendulum.toml"), MODEL)
}
