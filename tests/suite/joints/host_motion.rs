//! What a host moves, from one communication step to the next, has inertia: the forces that it needs are there.

use crate::curves::load;
use crate::integrators::setting;
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
[output.center]
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
    let mut simulation = load(text, &[setting(integrator)]);
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
    for integrator in ["conserving", "undamped"] {
        let simulation = moved(FRAME, integrator, &["hand.position[1]"], |t| vec![1.5 * t * t]);
        // Round-off of places of 0.04 m, over two steps of 4 ms: 1e-12 m/s².
        for name in ["grasp.acceleration[1]", "center.acceleration[1]"] {
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

/// A step that is shorter than the rounding of time leaves everything as it was: the next one does not begin anew.
#[test]
fn steps_of_no_length() {
    let ends = [0.004, 0.008, 0.008 + 1e-14, 0.012];
    for text in [FRAME, DRIVE] {
        let (input, force) = if text == FRAME {
            ("hand.position[1]", "grasp.reaction_force[1]")
        } else {
            ("push.value", "motor.effort")
        };
        let mut simulation = moved_to(&ends, text, "conserving", &[input], |t| vec![1.5 * t * t]);
        assert!((value(&simulation, force) - 6.0).abs() < 1e-8, "{input}: {}", value(&simulation, force));
        let place = simulation.variables().iter().position(|variable| variable.name == force).unwrap();
        let before = simulation.output_derivative(place).unwrap();
        simulation.advance(0.012 + 1e-14).unwrap();
        assert_eq!(simulation.output_derivative(place).unwrap(), before);
        assert!(before.is_finite());
    }
}

/// The same of a drive whose value a host gives.
#[test]
fn drives_bear_the_inertia_of_what_they_move() {
    for integrator in ["conserving", "undamped"] {
        let simulation = moved(DRIVE, integrator, &["push.value"], |t| vec![1.5 * t * t]);
        let effort = value(&simulation, "motor.effort");
        assert!((effort - 6.0).abs() < 1e-9, "{integrator}: {effort}");
    }
}

/// What stands still after it was moved comes to rest by a force within two steps, and bears none from then on.
#[test]
fn motion_that_ends() {
    let simulation = moved(FRAME, "conserving", &["hand.position[1]"], |t| vec![0.5 * t.min(0.156)]);
    // From 0.5 m/s to rest over 4 ms, from the middle of the last moving step to that of the first one at rest.
    let force = value(&simulation, "grasp.reaction_force[1]");
    assert!((force + 2.0 * 0.5 / 4e-3).abs() < 1e-6, "{force}");
    let simulation = moved(FRAME, "conserving", &["hand.position[1]"], |t| vec![0.5 * t.min(0.148)]);
    let force = value(&simulation, "grasp.reaction_force[1]");
    assert!(force.abs() < 1e-9, "{force}");
}

/// A stiff rod of 20 kg (its first axial vibration takes 1.6 ms, a third of an internal step); where its grip is, by an
/// expression or by a host.
fn rod(damping: f64, grip: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Rod\"\n[material.steel]\nyoung = 2e11\npoisson = 0.3\ndensity = 7850\ndamping = {damping:?}\n\
         [section.bar]\nshape = \"circle\"\nradius = 0.02\n[frame.hand]\n{grip}\n\
         [beam.rod]\nmaterial = \"steel\"\nsection = \"bar\"\nfrom = [0, 0, 0]\nto = [2, 0, 0]\nelements = 4\n\
         [joint.grip]\ntype = \"weld\"\na = \"hand\"\nb = \"rod.start\"\n\
         [output.grasp]\nat = \"hand\"\nquantities = [\"reaction_force\"]\n[output.foot]\nat = \"rod@0.05\"\nquantities = [\"section_force\"]\n\
         [simulation]\nstop = 1\nstep = 5e-3\noutput_step = 5e-3\n"
    )
}

/// Pulled along `t²/2` it feels no communication points, whatever the number of internal steps between them. Forces of
/// a rod without damping swing for ever about mass times 1 m/s²; with damping they are that.
#[test]
fn stiff_rods_do_not_ring() {
    let watched = ["grasp.reaction_force[1]", "foot.section_force[1]"];
    let mass = 7850.0 * std::f64::consts::PI * 4e-4 * 2.0;
    for integrator in ["conserving", "undamped", "generalized_alpha"] {
        for (damping, parts) in [(0.0, 1), (0.0, 2), (0.0, 3), (0.0, 4), (1e-4, 1), (1e-4, 2), (1e-4, 3), (1e-4, 4)] {
            let ends: Vec<f64> = (1..=120 / parts).map(|k| 5e-3 * f64::from(parts * k)).collect();
            let own = rod(damping, "position = [\"0.5*t^2\", 0, 0]");
            let own = moved_to(&ends, &own, integrator, &[], |_| Vec::new());
            let hosted = rod(damping, "position = [0, 0, 0]\ninput = true");
            let hosted = moved_to(&ends, &hosted, integrator, &["hand.position[1]"], |t| vec![0.5 * t * t]);
            for name in watched {
                let [own, hosted] = [&own, &hosted].map(|simulation| value(simulation, name));
                // Round-off of places, 1e-17 m where it begins to move, over the compliance of an element, 2e-9 m/N, in
                // each of 120 steps; `generalized_alpha` begins with the acceleration of the start, which a host does
                // not say: what its numerical damping leaves.
                let tolerance = if integrator == "generalized_alpha" { 1e-3 } else { 1e-5 };
                assert!(
                    (own - hosted).abs() < tolerance,
                    "{integrator}, {damping}, {parts}: {name} is {hosted}, not {own}"
                );
                // The damped rod: what the section at 5 % bears, and what damping leaves of the vibrations.
                assert!(damping == 0.0 || (hosted.abs() / mass - 1.0).abs() < 0.06, "{integrator}, {parts}: {hosted}");
            }
        }
    }
}

/// The crane, its foot moved by a host as the expression of its comment moves it.
#[test]
fn cranes_feel_no_communication_points() {
    let crane = include_str!("../../../models/crane.toml");
    let watched = ["drive_load.reaction_force[1]", "drive_load.reaction_force[3]", "boom_foot.stress"];
    for integrator in ["conserving", "undamped", "generalized_alpha"] {
        let settings = [setting(integrator), ("foot.input", "false")];
        let path = [settings[0], settings[1], ("foot.position[1]", "0.5*(1 - cos(pi*min(t, 2)/2))")];
        for parts in [1, 2, 3, 4] {
            let (mut own, mut hosted) = (load(crane, &path), load(crane, &settings[..1]));
            let place = hosted.variables().iter().position(|variable| variable.name == "foot.position[1]").unwrap();
            let (mut worst, mut peak) = ([0.0_f64; 3], [0.0_f64; 3]);
            // Up to where the foot stops, by a jump of its acceleration.
            for k in 1..=400 / parts {
                let end = 5e-3 * f64::from(parts * k);
                let path = 0.5 * (1.0 - (0.5 * std::f64::consts::PI * end).cos());
                hosted.set_value(place, Value::Real(path)).unwrap();
                own.advance(end).unwrap();
                hosted.advance(end).unwrap();
                for (i, name) in watched.iter().enumerate() {
                    let [own, hosted] = [value(&own, name), value(&hosted, name)];
                    worst[i] = worst[i].max((own - hosted).abs());
                    peak[i] = peak[i].max(own.abs());
                }
            }
            println!("{integrator}, {parts} internal steps: differences {worst:?} of {peak:?}");
            // The acceleration is known a communication step late: 20 ms at most times the jerk, 0.5 (pi/2)³ m/s³, of
            // 570 kg; twice that, for the vibration that it starts.
            let late = 2.0 * 570.0 * 0.5 * (0.5 * std::f64::consts::PI).powi(3) * 0.02;
            assert!(worst[0] < late && worst[1] < late, "{integrator}, {parts}: {worst:?}");
            // Between the points the path is off by some H³/20 of the jerk, 1e-6 m, of the 0.1 m that the boom bends.
            assert!(worst[2] < 1e-4 * peak[2], "{integrator}, {parts}: {worst:?} of {peak:?}");
        }
    }
}
