//! A rope that runs over a sheave, which turns with it by friction.

use crate::running::{run, start, value};

/// Two masses on a heavy rope: after the brake has let go, they move by the closed form
/// `M x'' = (m₁ − m₂) g + 2 ρA g x` with the mass of the rope and of the sheave in `M`. Half a percent, as elements of a
/// quarter of the radius lose 0.2 % where they run onto the sheave, and the rope stretches.
#[test]
fn two_masses_on_a_heavy_rope() {
    let file = ancf14_testing::root().join("examples/contact/pulley.toml");
    let mut simulation = start(&std::fs::read_to_string(file).unwrap());
    let mut at_release = 0.0;
    run(&mut simulation, 0.02, 0.6, |own| {
        if (own.state().time - 0.1).abs() < 1e-9 {
            at_release = value(own, "mass.displacement[3]");
        }
    });
    let [steps, iterations] = ["steps", "iterations"].map(|name| value(&simulation, &format!("statistics.{name}")));
    // Forces that jump where a part of an element lifts off between two samples took 3,800 steps; a tangent without the
    // pressure's part of friction takes 404 steps and 6 iterations in each.
    assert!(steps < 400.0 && iterations < 4.5 * steps, "{steps} {iterations}");
    let fallen = at_release - value(&simulation, "mass.displacement[3]");
    let (gravity, line_density) = (9.81, 0.3);
    let mass = 1.5 + 1.0 + line_density * 4.0 + 0.01 / (0.15 * 0.15);
    let growth = f64::sqrt(2.0 * line_density * gravity / mass);
    let exact = 0.5 * gravity / (2.0 * line_density * gravity) * ((growth * 0.5).cosh() - 1.0);
    assert!((fallen / exact - 1.0).abs() < 5e-3, "{fallen} {exact}");
    // Nothing slides, and what the rope moves by turns the sheave.
    assert!(value(&simulation, "touch.sliding") < 0.1);
    assert!((0.15 * value(&simulation, "turn.angle") / fallen - 1.0).abs() < 2e-2);
}
