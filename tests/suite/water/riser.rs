//! Does a riser move as it must? The flexible riser of Lowe and Langley (2006) is moved by 10 m in 27 s, along itself,
//! and upwards through the surface; references have 40 elements and steps of 25 ms, and an error of 0.005 kN.

use super::lay::jumper;
use crate::running::{run, start, value, vector};
use ancf14::fmi::{Model, Value};

/// The tension at the top every 2 s of the motion, from 2 s on, kN: along itself, and upwards.
const ALONG: [f64; 39] = [
    46.193, 42.682, 41.538, 42.526, 44.459, 46.525, 47.071, 46.444, 46.593, 48.340, 50.759, 52.230, 51.514, 48.393,
    44.316, 41.833, 41.893, 43.412, 45.614, 47.053, 46.772, 46.317, 47.284, 49.564, 51.712, 52.219, 50.200, 46.315,
    42.765, 41.593, 42.562, 44.478, 46.533, 47.069, 46.438, 46.588, 48.339, 50.758, 52.237,
];
const UPWARDS: [f64; 39] = [
    50.629, 47.070, 44.338, 43.107, 39.304, 36.917, 40.358, 46.276, 52.221, 55.387, 55.918, 57.421, 57.372, 53.781,
    48.757, 45.464, 43.842, 41.483, 37.005, 38.232, 43.128, 49.435, 54.277, 55.640, 56.647, 57.754, 56.070, 50.653,
    47.079, 44.343, 43.101, 39.302, 36.914, 40.355, 46.273, 52.219, 55.387, 55.917, 57.421,
];

/// The largest difference from a `reference`, kN, with ten elements and steps of 0.2 s.
fn difference(top: &str, reference: &[f64]) -> f64 {
    let simulation = "[simulation]\ninitial = \"equilibrium\"\nstop = 107\nstep = 0.2\ntotals = [\"work\", \"energy\", \"statistics\"]\n";
    let mut simulation = start(&jumper(10, top, "", simulation));
    let mut found = Vec::new();
    run(&mut simulation, 1.0, 105.0, |simulation| {
        found.push(vector(simulation, "top.reaction_force").norm() / 1e3);
    });
    // The motion begins behind a ramp of 27 s.
    let pairs = found.iter().skip(28).step_by(2).zip(reference);
    let largest = pairs.map(|(found, own)| (found - own).abs()).fold(0.0, f64::max);
    let [iterations, steps] = ["iterations", "steps"].map(|own| value(&simulation, &format!("statistics.{own}")));
    let [drift, water] = ["drift", "water"].map(|own| value(&simulation, &format!("work.{own}")));
    println!("{largest} kN; {iterations} iterations in {steps} steps; drift {drift} J of {water} J");
    assert!(iterations < 2.0 * steps && value(&simulation, "statistics.rejected") == 0.0);
    assert!(drift.abs() < 1e-5 * water.abs());
    largest
}

const MOTION: &str = "if(t < 27, (t/27)^3*(6*(t/27)^2 - 15*t/27 + 10), 1)*10*sin(2*pi*t/27)";

/// The range is 10.8 kN; ten elements miss 0.03 kN of it, and the steps as much.
#[test]
fn a_riser_that_is_moved_along_itself() {
    assert!(difference(&format!("[\"{MOTION}\", 0, -5]"), &ALONG) < 0.06);
}

/// The top leaves the water by 5 m: the range is 21 kN, and quadrature with points at fixed places misses 1.8 kN.
#[test]
fn a_riser_that_leaves_the_water() {
    assert!(difference(&format!("[0, 0, \"{MOTION} - 5\"]"), &UPWARDS) < 0.06);
}

/// A host sets the place of the top every 0.1 s, the end of each communication step: the tension stays within 0.1 kN of
/// that of the motion as an expression.
#[test]
fn a_riser_that_a_host_moves() {
    const EVERY: f64 = 0.1;
    let simulation = "[simulation]\ninitial = \"equilibrium\"\nstop = 60\nstep = 0.1\n";
    let mut of_expression = start(&jumper(10, &format!("[\"{MOTION}\", 0, -5]"), "", simulation));
    let mut of_host = start(&jumper(10, "[0, 0, -5]\ninput = true", "", simulation));
    let own = of_host.variables().iter().position(|variable| variable.name == "vessel.position[1]").unwrap();
    let motion = |t: f64| {
        let share = (t / 27.0).min(1.0);
        let ramp = share.powi(3) * (6.0 * share * share - 15.0 * share + 10.0);
        ramp * 10.0 * (std::f64::consts::TAU * t / 27.0).sin()
    };
    let mut largest = 0.0_f64;
    for number in 1..=(60.0 / EVERY) as u32 {
        let end = f64::from(number) * EVERY;
        of_host.set_value(own, Value::Real(motion(end))).unwrap();
        for simulation in [&mut of_host, &mut of_expression] {
            simulation.advance(end).unwrap_or_else(|failure| panic!("at {end} s: {}", failure.message));
        }
        let [host, expression] =
            [&of_host, &of_expression].map(|simulation| vector(simulation, "top.reaction_force").norm() / 1e3);
        largest = largest.max((host - expression).abs());
    }
    println!("{largest} kN");
    assert!(largest < 0.1);
}
