//! A cantilever under a force at its tip, in equilibrium: against the closed form `F L³/(3 E I)` of small deflections.
#![allow(clippy::print_stdout, reason = "an example prints")]

use ancf14::{Error, Simulation};

const MODEL: &str = r#"
format = 1
model = { name = "Cantilever" }
parameters = { F = 1.0 }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
section.rod = { shape = "circle", radius = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.weight = { at = "arm.end", force = [0, 0, "-F"] }
output.tip = { at = "arm.end", quantities = ["displacement"] }
simulation = { analysis = "static", stop = 1, step = 1 }
"#;

fn main() -> Result<(), Error> {
    let mut simulation = Simulation::from_text("cantilever.toml", MODEL)?;
    simulation.initialize()?;
    let sag = -simulation.value("tip.displacement[3]")?;

    let second_moment = std::f64::consts::PI / 4.0 * 0.01_f64.powi(4); // m⁴
    let closed_form = 1.0 / (3.0 * 2.1e11 * second_moment);
    println!("tip: {sag:.5e} m, closed form: {closed_form:.5e} m");
    assert!((sag / closed_form - 1.0).abs() < 1e-5);
    Ok(())
}
