//! Equilibria at every time while frames and drives move: what is read off a state belongs to its very time, and whole
//! turns of a frame between two results are gone through, not cut short. A state that is carried on before its frame is
//! shows angles of the step before.

use crate::curves::Curves;

const TURNING: &str = r#"
format = 1
[model]
name = "Turning"
gravity = [0, 0, -9.81]
[body.bob]
mass = 2
position = [0, 0, -1]
inertia = [0.1, 0.1, 0.1]
[frame.table]
position = [0, 0, 0]
rotation = [0, "t", 0]
[joint.hinge]
type = "revolute"
a = "table"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[drive.motor]
joint = "hinge"
coordinate = "angle"
value = "2*t"
[output.at_hinge]
at = "hinge"
quantities = ["angle"]
[output.at_table]
at = "table"
quantities = ["rotation"]
[output.at_bob]
at = "bob"
quantities = ["rotation", "position"]
[simulation]
analysis = "static"
stop = 1.0
step = 0.1
"#;

#[test]
fn what_is_read_belongs_to_its_time() {
    let curves = Curves::run(TURNING, &[]);
    for (row, time) in curves.time.iter().enumerate() {
        let read = |name: &str| curves.column(name)[row];
        assert!((read("at_hinge.angle") - 2.0 * time).abs() < 1e-9, "angle at {time}");
        assert!((read("at_table.rotation[2]") - time).abs() < 1e-12, "frame at {time}");
        assert!((read("at_bob.rotation[2]") - 3.0 * time).abs() < 1e-9, "body at {time}");
        assert!((read("at_bob.position[1]") + (3.0 * time).sin()).abs() < 1e-9);
    }
}

/// A rod whose end a frame turns by 7 rad: the torque is that of 7 rad, whether the results are one second apart or ten
/// to a second.
#[test]
fn whole_turns_of_a_frame_count() {
    let text = r#"
format = 1
[model]
name = "Twisted"
[material.steel]
young = 2e11
shear = 8e10
density = 7850
[section.rod]
shape = "circle"
radius = 0.005
[beam.shaft]
material = "steel"
section = "rod"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 8
strain = "small"
[frame.chuck]
position = [1, 0, 0]
rotation = ["7*t", 0, 0]
[joint.left]
type = "weld"
a = "ground"
b = "shaft.start"
[joint.right]
type = "weld"
a = "chuck"
b = "shaft.end"
[output.middle]
at = "shaft@0.5"
quantities = ["section_moment"]
[simulation]
analysis = "static"
stop = 1.0
step = 1.0
"#;
    let torque = 7.0 * 8e10 * 0.5 * std::f64::consts::PI * 0.005_f64.powi(4);
    for step in ["1.0", "0.5", "0.1"] {
        let found = Curves::run(text, &[("simulation.step", step)]).last("middle.section_moment[1]");
        println!("step {step}: {found} N m, by hand {torque} N m");
        assert!((found / torque - 1.0).abs() < 1e-9);
    }
}
