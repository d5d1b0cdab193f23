//! `demo`: the double pendulum of the models, built in.

use super::{Stop, output, progress, run, say};
use ancf14::model::simulation::Simulation;
use std::path::Path;

const MODEL: &str = include_str!("../../../models/pendulum.toml");
const DIRECTORY: &str = "ancf14-demo-results";
const FILE: &str = "pendulum.toml";

/// Simulates the pendulum into `./ancf14-demo-results`. A copy of the model that the user has changed there is kept.
pub fn demo() -> Result<(), Stop> {
    let simulation = Simulation::load(FILE, MODEL, &[]).map_err(|failure| Stop::Bad(failure.message))?;
    say(&format!("a flexible double pendulum, released under gravity; the model and its results go to ./{DIRECTORY}"))?;
    let directory = Path::new(DIRECTORY);
    let plan = progress::plan(&simulation, None)?;
    run::run(simulation, directory, run::Order { plan, ..run::Order::default() })?;
    let file = directory.join(FILE);
    match std::fs::read(&file) {
        Ok(there) if there != MODEL.as_bytes() => say(&format!("{} has been changed: it is kept", file.display())),
        Ok(_) => Ok(()),
        Err(_) => output::write(&file, MODEL.as_bytes()),
    }
}
