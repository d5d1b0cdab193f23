//! A host that gives a frame another first pose than the file draws moves the frame there: joints tie the frame where
//! it is drawn. A code that draws the frame at the host's first value swallows the difference as a rigid arm, and the
//! mechanism stays where it was.

use crate::running::value;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

/// A clamped rod of rigidities, 1 m along x, whose end a hand holds.
fn held(joint: &str, simulation: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Held"
[section.rod]
shape = "rigidities"
EA = 1e6
EI_y = 100
EI_z = 100
GJ = 100
line_density = 1
[beam.rod]
section = "rod"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
[joint.root]
type = "weld"
a = "ground"
b = "rod.start"
[frame.hand]
position = [1, 0, 0]
input = "rotation"
[joint.grip]
a = "hand"
b = "rod.end"
{joint}
[output.grasp]
at = "hand"
quantities = ["displacement", "rotation"]
[output.tip]
at = "rod.end"
quantities = ["position", "rotation"]
[simulation]
stop = 0.1
step = 1e-3
{simulation}
"#
    )
}

const BALL: &str = "type = \"spherical\"";
const WELD: &str = "type = \"weld\"";
const STATIC: &str = "analysis = \"static\"";
const EQUILIBRIUM: &str = "initial = \"equilibrium\"";

/// Loads `text` and initializes it at `time`, s, with these inputs.
fn begun(text: &str, time: f64, inputs: &[(&str, f64)]) -> Result<Simulation, String> {
    let mut simulation = Simulation::load("m.toml", text, &[]).unwrap();
    for (name, value) in inputs {
        let place = simulation.variables().iter().position(|variable| variable.name == *name).unwrap();
        simulation.set_value(place, Value::Real(*value)).unwrap();
    }
    simulation.initialize(time).map(|()| simulation).map_err(|failure| failure.message)
}

/// Equilibria and static analyses begin with the end of the rod in the hand, at the bit where the host has it: lifted,
/// and turned by a rotation vector or by a quaternion.
#[test]
fn equilibria_begin_where_the_host_has_the_frame() {
    let turn = 0.2_f64;
    for simulation in [STATIC, EQUILIBRIUM] {
        for joint in [BALL, WELD] {
            let lifted = begun(&held(joint, simulation), 0.0, &[("hand.position[3]", 0.1)]).unwrap();
            // Constraints hold to Newton's last correction, far below this.
            assert!((value(&lifted, "tip.position[3]") - 0.1).abs() < 1e-9, "{simulation}, {joint}");
            assert!((value(&lifted, "grasp.displacement[3]") - 0.1).abs() < 1e-15);
        }
        let text = held(WELD, simulation);
        let by_vector = begun(&text, 0.0, &[("hand.rotation[2]", turn)]).unwrap();
        let quaternion = text.replace("\"rotation\"\n", "\"quaternion\"\n");
        let parts = [("hand.quaternion[1]", (0.5 * turn).cos()), ("hand.quaternion[3]", (0.5 * turn).sin())];
        for simulation in [by_vector, begun(&quaternion, 0.0, &parts).unwrap()] {
            assert!((value(&simulation, "tip.rotation[2]") - turn).abs() < 1e-9);
            assert!((value(&simulation, "grasp.rotation[2]") - turn).abs() < 1e-15);
        }
    }
}

/// A motion that begins as drawn cannot begin elsewhere: the message has the frame, the joint, how far it is, and the
/// way out.
#[test]
fn motions_begin_where_the_file_draws_the_frame() {
    let lifted = begun(&held(BALL, ""), 0.0, &[("hand.position[3]", 0.1)]).unwrap_err();
    let turned = begun(&held(WELD, ""), 0.0, &[("hand.rotation[2]", 0.2)]).unwrap_err();
    for (message, way) in [(lifted, "0.1 m and 0 rad"), (turned, "0 m and 0.2 rad")] {
        for part in ["the frame hand begins", way, "joint grip does not hold", "initial = \"equilibrium\""] {
            assert!(message.contains(part), "{part}: {message}");
        }
    }
}

/// Motions begin at once where a joint leaves the difference free: a ball does not see the turn of the hand, and a
/// hinge has it as its angle.
#[test]
fn joints_leave_some_starts_free() {
    assert!(begun(&held(BALL, ""), 0.0, &[("hand.rotation[2]", 0.2)]).is_ok());
    let hinge = held("type = \"revolute\"\naxis = [0, 1, 0]", "")
        .replace("[simulation]", "[output.grip]\nat = \"grip\"\nquantities = [\"angle\"]\n[simulation]");
    let turned = begun(&hinge, 0.0, &[("hand.rotation[2]", 0.2)]).unwrap();
    // The angle is that of the rod relative to the hand; of two rotation matrices, to round-off.
    assert!((value(&turned, "grip.angle") + 0.2).abs() < 1e-14);
}

/// A bushing between the rod and a hand that begins 0.1 m higher has the force of this displacement from the start, 200
/// N/m 0.1 m, and a spring that is free as drawn has it too.
#[test]
fn bushings_and_springs_begin_displaced() {
    let bushing = held("type = \"bushing\"\nstiffness = [200, 200, 200]", "")
        .replace("[\"displacement\", \"rotation\"]", "[\"applied_force\"]");
    let lifted = begun(&bushing, 0.0, &[("hand.position[3]", 0.1)]).unwrap();
    // Of lengths of 1 m: round-off times 200 N/m.
    assert!((value(&lifted, "grasp.applied_force[3]") + 20.0).abs() < 1e-12);
    let spring = bushing
        .replace("[joint.grip]", "[spring.grip]")
        .replace("type = \"bushing\"\nstiffness = [200, 200, 200]", "stiffness = 200")
        .replace("position = [1, 0, 0]", "position = [1, 0, 2]")
        .replace("at = \"hand\"\nquantities = [\"applied_force\"]", "at = \"grip\"\nquantities = [\"force\"]");
    let lifted = begun(&spring, 0.0, &[("hand.position[3]", 2.1)]).unwrap();
    assert!((value(&lifted, "grasp.force") - 20.0).abs() < 1e-12);
}

/// Joints tie a frame that a function moves where it is at t = 0, also in a run that begins later: at 2 s the hand of
/// `0.05 t` is 0.1 m higher.
#[test]
fn later_starts_have_the_same_joints() {
    let moving = |simulation| {
        held(BALL, simulation).replace("input = \"rotation\"", "").replace("[1, 0, 0]\n\n[", "[1, 0, \"0.05*t\"]\n\n[")
    };
    assert!(moving(STATIC).contains("0.05*t"));
    for simulation in [STATIC, EQUILIBRIUM] {
        let lifted = begun(&moving(simulation), 2.0, &[]).unwrap();
        assert!((value(&lifted, "tip.position[3]") - 0.1).abs() < 1e-9, "{simulation}");
    }
    let message = begun(&moving(""), 2.0, &[]).unwrap_err();
    assert!(message.contains("the frame hand begins 0.1 m"), "{message}");
}
