//! A controller in the loop: a force at the tip of a flexible arm damps its motion and holds it level.
#![allow(clippy::print_stdout, reason = "an example prints")]

use ancf14::{Error, Simulation};

const MODEL: &str = r#"
format = 1
model = { name = "Arm", gravity = [0, 0, -9.81] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 2e-4 }
section.strip = { shape = "rectangle", width = 0.02, height = 0.004 }
beam.arm = { material = "steel", section = "strip", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.actuator = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["position", "velocity"] }
simulation = { stop = 3, output_step = 2e-3 }
"#;

fn main() -> Result<(), Error> {
    let mut simulation = Simulation::from_text("arm.toml", MODEL)?;
    // Variables are found once, outside the loop.
    let force = simulation.find("actuator.force[3]")?;
    let height = simulation.find("tip.position[3]")?;
    let speed = simulation.find("tip.velocity[3]")?;

    let (mut sum, mut last) = (0.0, 0.0);
    simulation.run(|arm| {
        // Proportional, integral, derivative: the force acts until the next call, one output step later.
        last = arm.value_of(height)?;
        sum += last * arm.output_step();
        arm.set_value_of(force, -100.0 * last - 300.0 * sum - 2.0 * arm.value_of(speed)?)
    })?;

    println!("at t = {} s the tip is {:.1e} m from level", simulation.time(), last.abs());
    assert!(last.abs() < 1e-3);
    simulation.take_warnings().iter().for_each(|warning| println!("warning: {warning}"));
    Ok(())
}
