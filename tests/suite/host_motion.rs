//! What a host moves, from one communication step to the next, has inertia: the forces that it needs are there.

use crate::curves::load;
use crate::running::value;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

const FRAME: &str = r#"
format = 1
[model]
name = "Mass"
[frame.hand]
input = true
position = [0, 0, 0]
[body.weight]
mass = 2.0
position = [0, 0, 0]
inertia = [1, 1, 1]
[joint.grip]
type = "weld"
a = "hand"
b = "weight"
[output.grasp]
at = "hand"
quantities = ["reaction_force", "reaction_moment", "acceleration"]
[output.centre]
at = "weight"
quantities = ["acceleration"]
[simulation]
stop = 0.5
step = 1e-3
output_step = 1e-3
"#;

const DRIVE: &str = r#"
format = 1
[model]
name = "Slide"
[body.block]
mass = 2.0
position = [0, 0, 0]
inertia = [1, 1, 1]
[joint.rail]
type = "prismatic"
a = "ground"
b = "block"
axis = [1, 0, 0]
[drive.push]
joint = "rail"
coordinate = "distance"
input = "value"
[output.motor]
at = "rail"
quantities = ["effort"]
[simulation]
stop = 0.5
step = 1e-3
output_step = 1e-3
"#;

/// 40 steps of 4 ms, of four internal ones each, with `inputs` set to `values` of the end of each.
fn moved(text: &str, integrator: &str, inputs: &[&str], values: impl Fn(f64) -> Vec<f64>) -> Simulation {
    let ends: Vec<f64> = (1..=40).map(|step| 4e-3 * f64::from(step)).collect();
    moved_to(&ends, text, integrator, inputs, values)
}

/// Steps that end at `ends`, s.
fn moved_to(
    ends: &[f64],
    text: &str,
    integrator: &str,
    inputs: &[&str],
    values: impl Fn(f64) -> Vec<f64>,
) -> Simulation {
    let mut simulation = load(text, &[("simulation.integrator", integrator)]);
    let variables = simulation.variables().iter();
    let names: Vec<&str> = variables.map(|variable| variable.name.as_str()).collect();
    let places: Vec<usize> = inputs.iter().map(|input| names.iter().position(|name| name == input).unwrap()).collect();
    for &end in ends {
        for (place, value) in places.iter().zip(values(end)) {
            simulation.set_value(*place, Value::Real(value)).unwrap();
        }
        simulation.advance(end).unwrap();
    }
    simulation
}

/// A mass of 2 kg along `1.5 t²`: 3 m/s², 6 N; the same mass turned along `t²`: 2 rad/s², 2 N m for 1 kg m².
#[test]
fn frames_bear_the_inertia_of_what_they_move() {
    for integrator in ["conserving", "variational"] {
        let simulation = moved(FRAME, integrator, &["hand.position[1]"], |t| vec![1.5 * t * t]);
        // Round-off of places of 0.04 m, over two steps of 4 ms: 1e-12 m/s².
        for name in ["grasp.acceleration[1]", "centre.acceleration[1]"] {
            assert!((value(&simulation, name) - 3.0).abs() < 1e-10, "{integrator}: {name}");
        }
        assert!((value(&simulation, "grasp.reaction_force[1]") - 6.0).abs() < 1e-9, "{integrator}");
        let quaternion = ["hand.quaternion[1]", "hand.quaternion[4]"];
        let turned = moved(FRAME, integrator, &quaternion, |t| vec![(0.5 * t * t).cos(), (0.5 * t * t).sin()]);
        let moment = value(&turned, "grasp.reaction_moment[3]");
        assert!((moment - 2.0).abs() < 1e-8, "{integrator}: {moment}");
    }
}

/// Steps of any length: the velocities of two steps belong to their middles, that of the start to the start.
#[test]
fn unequal_steps() {
    let ends = [0.01, 0.011, 0.021, 0.02101, 0.03, 0.035, 0.045];
    for count in 1..=ends.len() {
        let frame = moved_to(&ends[..count], FRAME, "conserving", &["hand.position[1]"], |t| vec![1.5 * t * t]);
        let force = value(&frame, "grasp.reaction_force[1]");
        // Round-off of places of 3 mm over 1e-5 s and the half of 1e-2 s: 1e-10 m/s².
        assert!((force - 6.0).abs() < 1e-8, "{count}: {force}");
        let drive = moved_to(&ends[..count], DRIVE, "conserving", &["push.value"], |t| vec![1.5 * t * t]);
        let effort = value(&drive, "motor.effort");
        assert!((effort - 6.0).abs() < 1e-8, "{count}: {effort}");
    }
}

/// The same of a drive whose value a host gives.
#[test]
fn drives_bear_the_inertia_of_what_they_move() {
    for integrator in ["conserving", "variational"] {
        let simulation = moved(DRIVE, integrator, &["push.value"], |t| vec![1.5 * t * t]);
        let effort = value(&simulation, "motor.effort");
        assert!((effort - 6.0).abs() < 1e-9, "{integrator}: {effort}");
    }
}

/// What stands still after it was moved has come to rest by a force, in one step, and bears none from then on.
#[test]
fn motion_that_ends() {
    let simulation = moved(FRAME, "conserving", &["hand.position[1]"], |t| vec![0.5 * t.min(0.156)]);
    // From 0.5 m/s to rest in 4 ms.
    let force = value(&simulation, "grasp.reaction_force[1]");
    assert!((force + 2.0 * 0.5 / 4e-3).abs() < 1e-6, "{force}");
    let simulation = moved(FRAME, "conserving", &["hand.position[1]"], |t| vec![0.5 * t.min(0.148)]);
    let force = value(&simulation, "grasp.reaction_force[1]");
    assert!(force.abs() < 1e-9, "{force}");
}
