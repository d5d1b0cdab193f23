//! The natural frequencies of a cantilever, against those of Euler and Bernoulli: `(βL)²/(2π) √(E I/(ρ A L⁴))`.
#![allow(clippy::print_stdout, reason = "an example prints")]

use ancf14::{Error, Simulation};
use std::f64::consts::TAU;

const MODEL: &str = r#"
format = 1
model = { name = "Reed" }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850 }
section.strip = { shape = "rectangle", width = 0.02, height = 0.002 }
beam.reed = { material = "steel", section = "strip", from = [0, 0, 0], to = [0.5, 0, 0], elements = 8 }
joint.root = { type = "weld", a = "ground", b = "reed.start" }
simulation = { stop = 1, step = 1e-3 }
"#;

fn main() -> Result<(), Error> {
    let mut simulation = Simulation::from_text("reed.toml", MODEL)?;
    simulation.initialize()?;
    let modes = simulation.modes(2)?;

    let stiffness_by_mass = 2.1e11 * 0.002_f64.powi(2) / (12.0 * 7850.0); // E I/(ρ A), m⁴/s²
    for (mode, beta) in modes.modes.iter().zip([1.875_104_07, 4.694_091_13]) {
        let closed_form = (beta / 0.5_f64).powi(2) * stiffness_by_mass.sqrt() / TAU;
        let frequency = mode.angular_frequency() / TAU;
        println!("{frequency:.4} Hz, closed form: {closed_form:.4} Hz; moves most: {}", mode.moves);
        assert!((frequency / closed_form - 1.0).abs() < 1e-3);
    }
    Ok(())
}
