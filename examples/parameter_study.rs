//! A parameter study: one model, loaded once, run with several radii of its section.
#![allow(clippy::print_stdout, reason = "an example prints")]

use ancf14::{Error, Simulation};

const MODEL: &str = r#"
format = 1
model = { name = "Hose", gravity = [0, 0, -9.81] }
material.rubber = { young = 5e6, poisson = 0.45, density = 1100 }
section.rod = { shape = "circle", radius = 0.01 }
beam.arm = { material = "rubber", section = "rod", from = [0, 0, 0], to = [0.5, 0, 0], elements = 6 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
output.tip = { at = "arm.end", quantities = ["position"] }
simulation = { stop = 1, step = 1e-3, output_step = 1e-2 }
"#;

fn main() -> Result<(), Error> {
    let mut simulation = Simulation::from_text("hose.toml", MODEL)?;
    let mut lowest_points = Vec::new();
    for radius in [0.01, 0.02, 0.04] {
        simulation.reset()?;
        simulation.set("rod.radius", radius)?;
        let results = simulation.record(&["tip.position[3]"])?;
        let heights = results.columns().next().map_or(&[][..], |(_, values)| values);
        let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
        println!("radius {radius} m: the tip falls to {lowest:.4} m, {} rows", results.time().len());
        lowest_points.push(lowest);
    }
    assert!(lowest_points.is_sorted(), "a thinner arm falls deeper");
    Ok(())
}
