//! The rotation vector of what spins and tilts has any direction near each whole turn, and any number of turns behind
//! it: those of two runs that differ by a thousandth of a radian may be hundreds of radians apart. Errors of rotations
//! are therefore the turn between the two, and `tilt` tells where the axis of a spinning part is.

use crate::running::{run, start, value};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// A disk overhung on a flexible shaft that spins at 300 rad/s, and is tapped once.
const ROTOR: &str = r#"
format = 1
[model]
name = "Rotor"
[material.light]
young = 210e9
poisson = 0.3
density = 100
[section.shaft]
shape = "circle"
radius = 0.01
[beam.shaft]
material = "light"
section = "shaft"
from = [0, 0, 0]
to = [0.5, 0, 0]
elements = 4
angular_velocity = [300, 0, 0]
[body.disk]
mass = 10
position = [0.5, 0, 0]
inertia = [0.2, 0.1, 0.1]
angular_velocity = [300, 0, 0]
[joint.bearing]
type = "revolute"
a = "ground"
b = "shaft.start"
axis = [1, 0, 0]
[drive.motor]
joint = "bearing"
coordinate = "angle"
rate = 300
[joint.fit]
type = "weld"
a = "shaft.end"
b = "disk"
[load.tap]
at = "disk"
force = [0, [{ until = 0.001, is = 100 }, { is = 0 }], 0]
[output.motion]
at = "disk"
quantities = ["rotation", "tilt", "quaternion"]
[simulation]
stop = 0.5
output_step = 2e-3
"#;

/// By half a second the rotation vector has lost half of its 24 turns, in each run others. The turns of both meshes are
/// apart by 7e-4 rad at most, of the 1e2 rad that the components range.
#[test]
fn the_error_of_a_rotation_is_a_turn() {
    let mut simulation = Simulation::load("m.toml", ROTOR, &[]).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    simulation.initialize(0.0).unwrap();
    let mut lost = false;
    run(&mut simulation, 2e-3, 0.5, |simulation| {
        // The axis of the disk by the quaternion: R x·x = 1 - 2 (y² + z²).
        let [y, z] = [3, 4].map(|k| value(simulation, &format!("motion.quaternion[{k}]")));
        let tilt = 2.0 * y.hypot(z).asin();
        assert!((value(simulation, "motion.tilt") - tilt).abs() < 1e-12 && tilt < 2e-3);
        lost |= (value(simulation, "motion.rotation[1]") - 300.0 * simulation.time()).abs() > 3.0;
    });
    assert!(lost, "the rotation vector has counted all turns: this is no test");
    simulation.conclude();
    let error = |name: &str| simulation.mesh_errors().iter().find(|error| error.name == name).unwrap().error;
    assert!(error("motion.rotation") < 1e-4, "{}", error("motion.rotation"));
    let of_tilt = error("motion.tilt");
    assert!(of_tilt > 1e-4 && of_tilt < 0.05, "{of_tilt}");
}

/// The tilt of a frame is the angle that its x axis has turned by, up to half a turn and back, and none where it spins
/// about that axis.
#[test]
fn a_tilt_is_the_angle_of_the_x_axis() {
    let text = |rotation: &str| {
        format!(
            "format = 1\n[model]\nname = \"Frame\"\n[frame.hand]\nposition = [0, 0, 0]\nrotation = {rotation}\n\
             [body.held]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
             [joint.grip]\ntype = \"weld\"\na = \"hand\"\nb = \"held\"\n\
             [output.seen]\nat = \"held\"\nquantities = [\"tilt\"]\n[simulation]\nanalysis = \"static\"\nstop = 4\nstep = 0.5\n"
        )
    };
    let tau = std::f64::consts::TAU;
    for (rotation, at_two, at_four) in
        [("[0, \"t\", 0]", 2.0, tau - 4.0), ("[0, 0, \"t\"]", 2.0, tau - 4.0), ("[\"t\", 0, 0]", 0.0, 0.0)]
    {
        let mut simulation = start(&text(rotation));
        for (time, exact) in [(2.0, at_two), (4.0, at_four)] {
            simulation.advance(time).unwrap();
            let tilt = value(&simulation, "seen.tilt");
            assert!((tilt - exact).abs() < 1e-9, "{rotation} at {time}: {tilt} for {exact}");
        }
    }
}
