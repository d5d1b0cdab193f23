//! The first program: how far the cantilever of a model file sags, for two heights of its section.
#![allow(clippy::print_stdout, reason = "an example prints")]

use ancf14::{Error, Simulation};

fn main() -> Result<(), Error> {
    let mut simulation = Simulation::open("models/cantilever.toml")?;
    for height in [0.005, 0.010] {
        simulation.reset()?;
        simulation.set("strip.height", height)?;
        let results = simulation.record(&["tip.displacement[3]"])?;
        let lowest = results.columns().flat_map(|(_, values)| values).copied().fold(0.0, f64::min);
        println!("height {height} m: the tip falls to {lowest:.4} m");
    }
    Ok(())
}
