//! Outputs with `in` are what somebody sees who moves with a part: places, velocities and accelerations along its axes,
//! with the Coriolis and centripetal terms of its motion. What turns with the observer stands still, what is at rest
//! goes round. A term that is missing, or axes that are taken at another instant, shows in full.

use crate::random::Random;
use crate::running::{run, start, try_start, value, vector};
use crate::support::marker_oracle::{All, COUNT, Dual, Machine, ROUNDING, any_marker, deep};
use crate::support::oracle;
use ancf14::math::Vec3;
use ancf14::mechanics::marker::observer::Observer;
use ancf14::mechanics::marker::sensor::Sensor;
use nalgebra::{Rotation3, SVector};

/// Every kind of marker seen from every kind, with arms, in a random motion: the first and second derivative of the
/// place along the observer's axes against automatic differentiation.
#[test]
fn velocities_and_accelerations_are_derivatives_of_the_place() {
    deep(check_derivatives);
}

fn check_derivatives() {
    let mut random = Random(53);
    for kind in 0..10 {
        for from in [1, 3, 4, 5, 8] {
            let machine = Machine::new(&mut random);
            let [marker, own] = [kind, from].map(|kind| any_marker(&mut random, kind));
            let c = machine.configuration();
            let (velocity, acceleration) = (machine.velocity, SVector::<f64, COUNT>::from_fn(|_, _| random.signed()));
            let mut along = All::<f64>::zeros();
            along.fixed_rows_mut::<COUNT>(0).copy_from(&velocity);
            along[COUNT] = 1.0;
            let mut sensor = Sensor::new(&[], &c, marker, None);
            sensor.observer = Some(Observer::new(&c, own));
            let place = sensor.seen_position(&c);
            let (linear, _) = sensor.seen_motion(&c, velocity.as_slice());
            let second = sensor.seen_acceleration(&c, velocity.as_slice(), acceleration.as_slice());
            for axis in 0..3 {
                let component = |q: All<Dual>| {
                    let [place, ..] = machine.pose(&marker, q.as_slice());
                    let seen = machine.pose(&own, q.as_slice());
                    let apart = oracle::sum(&place, &oracle::scale(&seen[0], Dual::from(-1.0)));
                    oracle::dot(&seen[1 + axis], &apart)
                };
                let (value, by_q, by_qq) = num_dual::hessian(component, &machine.all());
                let size = by_qq.amax().max(1.0) * 10.0;
                assert!((place[axis] - value).abs() < ROUNDING * size, "place of {kind} from {from}");
                assert!((linear[axis] - by_q.dot(&along)).abs() < ROUNDING * size, "velocity of {kind} from {from}");
                let expected = by_q.fixed_rows::<COUNT>(0).dot(&acceleration) + along.dot(&(by_qq * along));
                assert!((second[axis] - expected).abs() < ROUNDING * size, "acceleration of {kind} from {from}");
            }
        }
    }
}

/// A free body that turns and moves, seen from a turning frame, from itself, and at rest.
const FREE: &str = r#"
format = 1
[model]
name = "Free"
[body.disk]
mass = 2
position = [0.5, -0.2, 0.3]
inertia = [0.05, 0.05, 0.09]
velocity = [1, 0, 0.5]
angular_velocity = [0, 0, 3]
[point.rim]
on = "disk"
offset = [0.25, 0.1, -0.4]
[frame.table]
position = [0.1, 0, 0]
rotation = [0, 0, "2*t"]
[output.from_table]
at = "disk"
in = "table"
quantities = ["position", "displacement", "velocity", "acceleration", "rotation", "quaternion", "angular_velocity"]
[output.from_disk]
at = "rim"
in = "disk"
quantities = ["position", "displacement", "velocity", "acceleration", "rotation", "angular_velocity"]
[simulation]
stop = 2
step = 1e-3
output_step = 0.01
"#;

/// A body that no force acts on moves straight, to round-off; from a turntable it is seen with centrifugal and Coriolis
/// accelerations. A point of the body is at rest as seen from the body.
#[test]
fn a_straight_path_is_bent_on_a_turntable() {
    let mut simulation = start(FREE);
    let (rate, velocity) = (2.0, Vec3::new(1.0, 0.0, 0.5));
    run(&mut simulation, 0.01, 2.0, |simulation| {
        let time = ancf14::fmi::Model::time(simulation);
        let back = Rotation3::from_axis_angle(&Vec3::z_axis(), -rate * time);
        let drawn = Vec3::new(0.4, -0.2, 0.3);
        let seen = back * (drawn + velocity * time);
        let omega = Vec3::z() * rate;
        let apparent = back * velocity - omega.cross(&seen);
        let acceleration = -omega.cross(&omega.cross(&seen)) - omega.cross(&apparent) * 2.0;
        // Round-off of 2000 steps.
        for (quantity, expected, bound) in [
            ("position", seen, 1e-11),
            ("displacement", seen - drawn, 1e-11),
            ("velocity", apparent, 1e-11),
            ("acceleration", acceleration, 1e-10),
            ("angular_velocity", Vec3::z() * (3.0 - rate), 1e-9),
            // The phase of the midpoint rule at 3e-3 rad a step.
            ("rotation", Vec3::z() * (3.0 - rate) * time, 1e-5),
        ] {
            let found = vector(simulation, &format!("from_table.{quantity}"));
            assert!((found - expected).norm() < bound, "{quantity} at {time} s: {found} {expected}");
        }
        let half = 0.5 * (3.0 - rate) * time;
        assert!((value(simulation, "from_table.quaternion[1]") - half.cos()).abs() < 1e-5);
        assert!((value(simulation, "from_table.quaternion[4]") - half.sin()).abs() < 1e-5);
        let position = vector(simulation, "from_disk.position");
        assert!((position - Vec3::new(0.25, 0.1, -0.4)).norm() < 1e-12, "{position}");
        for quantity in ["displacement", "velocity", "acceleration", "rotation", "angular_velocity"] {
            let found = vector(simulation, &format!("from_disk.{quantity}"));
            assert!(found.norm() < 1e-11, "{quantity}: {found}");
        }
    });
}

/// The reaction of a pendulum in the axes of its bob is the reaction in global axes, turned back by the orientation of
/// the bob; what a moving frame must supply likewise.
#[test]
fn reactions_are_turned_into_the_axes() {
    let text = "format = 1\n[model]\nname = \"Pendulum\"\ngravity = [0, 0, -9.81]\n\
        [body.bob]\nmass = 2\nposition = [1, 0, 0]\ninertia = [0.05, 0.06, 0.07]\n\
        [frame.hook]\nposition = [0, \"0.1*t^2\", 0]\n\
        [joint.pin]\ntype = \"revolute\"\na = \"hook\"\nb = \"bob\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n\
        [output.turn]\nat = \"bob\"\nquantities = [\"rotation\"]\n\
        [output.global]\nat = \"pin\"\nquantities = [\"reaction_force\", \"reaction_moment\", \"applied_force\"]\n\
        [output.local]\nat = \"pin\"\nin = \"bob\"\nquantities = [\"reaction_force\", \"reaction_moment\", \"applied_force\"]\n\
        [output.hook_global]\nat = \"hook\"\nquantities = [\"reaction_force\", \"position\"]\n\
        [output.hook_local]\nat = \"hook\"\nin = \"bob\"\nquantities = [\"reaction_force\", \"position\"]\n\
        [simulation]\nstop = 0.5\nstep = 1e-3\noutput_step = 0.05\n";
    let mut simulation = start(text);
    run(&mut simulation, 0.05, 0.5, |simulation| {
        let back = Rotation3::new(-vector(simulation, "turn.rotation"));
        for (global, local) in [
            ("global.reaction_force", "local.reaction_force"),
            ("global.reaction_moment", "local.reaction_moment"),
            ("global.applied_force", "local.applied_force"),
            ("hook_global.reaction_force", "hook_local.reaction_force"),
        ] {
            let (expected, found) = (back * vector(simulation, global), vector(simulation, local));
            assert!((found - expected).norm() < 1e-9 * expected.norm().max(1.0), "{local}: {found} {expected}");
        }
        // The hook as seen from the bob is where the joint holds the bob.
        assert!((vector(simulation, "hook_local.position") - -Vec3::x()).norm() < 1e-9);
    });
    assert!(vector(&simulation, "turn.rotation").norm() > 0.5, "it swings");
}

/// The tip of a turning blade as its hub sees it: a station list too. A quantity without axes is refused.
#[test]
fn blades_are_seen_from_their_hub() {
    let text = |quantities: &str| {
        format!(
            "format = 1\n[model]\nname = \"Rotor\"\n\
             [material.m]\nyoung = 2e9\npoisson = 0.3\ndensity = 1000\n\
             [section.s]\nshape = \"rectangle\"\nwidth = 0.02\nheight = 0.05\n\
             [beam.blade]\nmaterial = \"m\"\nsection = \"s\"\nfrom = [0.1, 0, 0]\nto = [1, 0, 0]\nelements = 2\n\
             [frame.hub]\nposition = [0, 0, 0]\nrotation = [0, 0, \"0.5*pi*t\"]\n\
             [joint.root]\ntype = \"weld\"\na = \"hub\"\nb = \"blade.start\"\n\
             [output.shape]\non = \"blade\"\nin = \"hub\"\nstations = 3\nquantities = [{quantities}]\n\
             [simulation]\nstop = 2\nstep = 0.1\nanalysis = \"static\"\n"
        )
    };
    let mut simulation = start(&text("\"position\", \"displacement\""));
    run(&mut simulation, 1.0, 2.0, |simulation| {
        // Nothing acts: the blade is straight in the hub, wherever that is.
        for (station, x) in [(1, 0.1), (2, 0.55), (3, 1.0)] {
            for (component, expected) in [(1, x), (2, 0.0), (3, 0.0)] {
                let found = value(simulation, &format!("shape.position[{station},{component}]"));
                assert!((found - expected).abs() < 1e-9, "station {station}: {found} {expected}");
                assert!(value(simulation, &format!("shape.displacement[{station},{component}]")).abs() < 1e-9);
            }
        }
    });
    let Err(refused) = try_start(&text("\"position\", \"stress\"")) else { panic!("a stress has no axes") };
    assert!(refused.contains("\"stress\" does not depend on `in`"), "{refused}");
}

/// The example of the page runs as it says: the tip goes round, and as seen from the hub it moves by millimeters.
#[test]
fn the_example_of_the_page_runs() {
    let page = include_str!("../../../docs/language/outputs.md");
    let (_, rest) = page.split_once("### Outputs as seen from a moving part\n").expect("the section");
    let example = rest.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the example");
    let mut simulation = start(example);
    let mut largest = 0.0_f64;
    run(&mut simulation, 0.01, 1.0, |simulation| {
        largest = largest.max(vector(simulation, "tip.displacement").norm());
    });
    assert!((1e-4..2e-2).contains(&largest), "{largest} m");
    assert!((vector(&simulation, "tip.position").x - 1.0).abs() < 1e-2);
    // The hub pulls the blade inwards with m omega^2 r, within what is left of the vibration.
    let pull = 1900.0 * 0.05 * 0.1 * 0.9 * (2.0 * std::f64::consts::PI).powi(2) * 0.55;
    let found = vector(&simulation, "root_load.reaction_force").x;
    assert!((found / -pull - 1.0).abs() < 0.2, "{found} N, not {}", -pull);
}
