//! Derivatives of the largest stress of a section by what a host gives, against differences of repeated steps. The
//! stress has kinks, where another side takes over: a derivative is that of the side that bears it.

use crate::curves::load;
use crate::motion::step_derivatives::{machine, place, set_out};
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

/// On the way, with loads, drives and frames that move.
#[test]
fn stress_by_inputs() {
    let mut simulation = machine("value", &[]);
    let begin = set_out(&mut simulation, 2e-3, 8);
    let start = simulation.snapshot();
    let (stress, push) = (place(&simulation, "middle.stress"), place(&simulation, "push.force[3]"));
    let stress_with = |simulation: &mut Simulation, force: f64| {
        simulation.restore(&start);
        simulation.set_value(push, Value::Real(force)).unwrap();
        simulation.advance(begin + 2e-3).unwrap();
        simulation.value(stress).number()
    };
    let now = simulation.value(push).number();
    let change = 1e-2;
    let [low, middle, high] = [-change, 0.0, change].map(|by| stress_with(&mut simulation, now + by));
    let difference = (high - low) / (2.0 * change);
    let curved = (high - 2.0 * middle + low).abs() / change;
    stress_with(&mut simulation, now);
    let derivative = simulation.partial_derivative(stress, push).unwrap();
    println!("{derivative:e} {difference:e}, changes by {curved:e}; stress {middle:e}");
    assert!(difference.abs() > 1e3 && curved < 1e-3 * difference.abs());
    // Newton's rest, 1e-12 of slopes in a strip whose stress is 2e9 Pa times 2.5 mm times their change over 0.1 m, over
    // the change.
    assert!((derivative - difference).abs() < 1e-4 * difference.abs());
}

/// A cantilever that is bent far more than it is pulled: at its root both sides of the section bear nearly the same
/// stress.
const BENT: &str = r#"
format = 1
[model]
name = "Bent"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.bar]
shape = "rectangle"
width = 0.01
height = 0.02
[beam.arm]
material = "steel"
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.push]
at = "arm.end"
force = [0.5, 0, -50]
input = true
[output.at_root]
at = "arm.start"
quantities = ["stress"]
[simulation]
stop = 1
step = 1e-3
tolerance = 1e-12
"#;

/// The derivative is that of the side that bears more, also where the other one takes over within a small part of the
/// differences' reach: over both of them differences average.
#[test]
fn regression_stress_near_a_tie() {
    for overrides in [&[("simulation.analysis", "static")][..], &[]] {
        let mut simulation = load(BENT, overrides);
        simulation.initialize(0.0).unwrap();
        for step in 1..=50 {
            simulation.advance(1e-3 * f64::from(step)).unwrap();
        }
        let start = simulation.snapshot();
        let stress = place(&simulation, "at_root.stress");
        for (name, change) in [("push.force[1]", 1e-2), ("push.force[3]", 1e-1)] {
            let push = place(&simulation, name);
            let now = simulation.value(push).number();
            let mut with = |force: f64| {
                simulation.restore(&start);
                simulation.set_value(push, Value::Real(force)).unwrap();
                simulation.advance(0.051).unwrap();
                simulation.value(stress).number()
            };
            let [low, middle, high] = [-change, 0.0, change].map(|by| with(now + by));
            let (difference, curved) = ((high - low) / (2.0 * change), (high - 2.0 * middle + low).abs() / change);
            with(now);
            let derivative = simulation.partial_derivative(stress, push).unwrap();
            // Newton's rest of 1e-12 in strains, 0.2 Pa, over the change; and how much the derivative itself changes.
            let tolerance = 0.2 / change + curved + 1e-6 * difference.abs();
            assert!((derivative - difference).abs() < tolerance, "{name}: {derivative:e} {difference:e} {tolerance:e}");
            assert!(tolerance < 0.02 * difference.abs(), "{name}: {difference:e} is known to {tolerance:e}");
        }
    }
}
