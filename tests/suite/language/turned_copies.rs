//! Is a turned copy the turned original? Two parts of one file, of which the second is the first one turned about an
//! arbitrary axis through an arbitrary point and then moved, must move alike: every position of the copy is the turned
//! position of the original, every rotation vector the turned rotation vector. A key whose vector does not turn with
//! the copy breaks this.
//!
//! Tolerance: both are computed in the same run, and an element's equations in other axes differ by round-off only.
//! Newton stops at 1e-8 of the size by default; with 1e-12 what is left is far below 1e-7 of the motion, while a vector
//! that is not turned gives errors of order 1.

use ancf14::math::rotation::rotation_matrix;
use ancf14::math::{Mat3, Vec3};
use ancf14::model::document::Document;
use ancf14::model::notes::notes;
use ancf14::model::simulation::Simulation;
use ancf14_testing::running::{run, start, value, vector};

/// The axis of the turn (not of length 1), its angle, center and the move.
const AXIS: [f64; 3] = [0.3, -0.5, 0.8];
const ANGLE: f64 = 1.1;
const CENTER: [f64; 3] = [0.2, -0.4, 0.1];
const MOVE: [f64; 3] = [1.5, 0.7, -2.0];

/// A machine with every key that has a vector; nothing in it is along an axis. `[copy.both]` has it twice.
const PARTS: &str = r#"
[copy.both.beam.arm]
material = "steel"
section = "strip"
from = [0.1, 0.2, 0.3]
to = [0.7, 0.4, 0.1]
elements = 3
velocity = [0.1, 0.2, -0.1]
angular_velocity = [0.0, 0.1, 0.05]
[copy.both.beam.bow]
material = "steel"
section = "strip"
curve = { x = "0.7 + 0.3*s", y = "0.4 + 0.1*s^2", z = 0.1, s = [0, 1] }
y_axis = [0.1, 0.2, 1]
elements = 2
[copy.both.beam.spline]
material = "steel"
section = "strip"
curve = { points = [[0.1, 0.2, 0.3], [0.0, 0.3, 0.5], [0.1, 0.5, 0.6]] }
y_axis = [1, 0.1, 0.3]
elements = 2
[copy.both.body.block]
mass = 0.4
position = [1.1, 0.5, 0.1]
inertia = [0.001, 0.002, 0.0025]
angular_velocity = [0.4, 0.1, -0.3]
velocity = [0.1, 0, 0.1]
[copy.both.body.nut]
mass = 0.1
position = [0.1, 0.6, 0.7]
inertia = [0.0001, 0.0002, 0.00025]
axes = [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
[copy.both.body.pad]
mass = 0.2
position = [0.2, 0.5, 0.7]
inertia = [0.0001, 0.0002, 0.00025]
[copy.both.frame.hand]
position = ["0.1 + 0.01*sin(3*t)", 0.2, [{ until = 0.05, is = "0.3" }, { is = "0.3 + 0.1*(t - 0.05)^3" }]]
rotation = [0, "0.1*sin(2*t)", "0.2*t^2"]
[copy.both.joint.root]
type = "revolute"
a = "hand"
b = "arm.start"
axis = [0.2, 1, 0.1]
stiffness = 2
damping = 0.01
[copy.both.drive.crank]
joint = "root"
coordinate = "angle"
value = "0.2*t^2"
[copy.both.joint.corner]
type = "universal"
a = "arm.end"
b = "bow.start"
axis = [0, 1, 0]
axis2 = [0, 0, 1]
at = [0.72, 0.41, 0.12]
[copy.both.joint.tip]
type = "weld"
a = "bow.end"
b = "block"
[copy.both.joint.other]
type = "weld"
a = "hand"
b = "spline.start"
[copy.both.joint.slider]
type = "inline"
a = "spline.end"
b = "nut"
axis = [0, 0.1, 1]
[copy.both.joint.cushion]
type = "bushing"
a = "nut"
b = "pad"
stiffness = [50, 50, 50]
damping = [0.1, 0.1, 0.1]
rotational_stiffness = [1, 1, 1]
rotational_damping = [0.01, 0.01, 0.01]
[copy.both.spring.tie]
a = "block"
b = "nut"
stiffness = 5
[copy.both.spring.stay]
a = "ground"
b = "pad"
stiffness = 3
length = 0.4
[copy.both.actuator.pusher]
a = "nut"
b = "ground"
effort = 0.5
[copy.both.point.knob]
on = "hand"
offset = [0.1, 0.05, -0.2]
[copy.both.spring.string]
a = "knob"
b = "pad"
stiffness = 4
length = 0.1
[copy.both.load.pull]
at = "block"
force = ["2*t", 0.3, -0.1]
moment = [0, "0.01*t", 0.01]
[copy.both.load.push]
at = "block"
force = [0.1, "0.4*t", 0.2]
follower = true
[copy.both.load.wind]
on = "arm"
force = [[{ until = 0.04, is = "t" }, { is = 0.04 }], 0.2, 0.1]
[copy.both.load.twist]
at = "bow@0.3"
moment = [0.01, 0.02, "0.1*t"]
follower = true
[copy.both.point.post]
offset = [0.3, -0.2, 0.5]
[copy.both.point.hook]
on = "block"
offset = [0.05, 0.02, -0.03]
[copy.both.point.eye]
on = "pad"
offset = [0.01, 0.02, 0]
axes = [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]
[copy.both.actuator.winch]
a = "post"
b = "hook"
effort = "5*cos(20*t)"
[copy.both.load.breeze]
at = "eye"
force = [0.3, 0.2, 0.1]
follower = true
[copy.both.output.seen_knob]
at = "knob"
quantities = ["position"]
[copy.both.output.seen_eye]
at = "eye"
quantities = ["position", "rotation"]
[copy.both.output.seen_block]
at = "block"
quantities = ["position", "velocity", "rotation"]
[copy.both.output.seen_nut]
at = "nut"
quantities = ["position", "rotation"]
[copy.both.output.seen_pad]
at = "pad"
quantities = ["position", "rotation"]
[copy.both.output.middle]
at = "bow@0.5"
quantities = ["position", "rotation"]
[copy.both.output.foot]
at = "root"
quantities = ["reaction_force", "reaction_moment"]
"#;

const HEAD: &str = r#"
format = 1
[model]
name = "Both"
[material.steel]
young = 1e8
poisson = 0.3
density = 2000
damping = 1e-4
[section.strip]
shape = "rectangle"
width = 0.03
height = 0.01
[simulation]
stop = 0.1
step = 0.005
tolerance = 1e-12
"#;

/// Where the original and the copy are; angles, centers and moves are 0 for the first one.
fn copies(angle: &str, parameters: &str) -> String {
    let [x, y, z] = MOVE.map(|part| format!("\"(k - 1)*({part})\""));
    format!(
        "{HEAD}{parameters}\n[copy.both]\ncount = 2\nturn = {{ axis = {AXIS:?}, angle = \"(k - 1)*{angle}\", center = {CENTER:?} }}\n\
         move = [{x}, {y}, {z}]\n{PARTS}"
    )
}

/// The largest distance between a result of the copy and the turned result of the original, and the size of what is
/// compared.
fn distance(simulation: &Simulation) -> f64 {
    let turn: Mat3 = rotation_matrix(&(Vec3::from(AXIS).normalize() * ANGLE));
    let (center, shift) = (Vec3::from(CENTER), Vec3::from(MOVE));
    let mut largest: f64 = 0.0;
    for (name, is_position) in [
        ("seen_knob_K.position", true),
        ("seen_eye_K.position", true),
        ("seen_eye_K.rotation", false),
        ("seen_block_K.position", true),
        ("seen_block_K.velocity", false),
        ("seen_block_K.rotation", false),
        ("seen_nut_K.position", true),
        ("seen_nut_K.rotation", false),
        ("seen_pad_K.position", true),
        ("seen_pad_K.rotation", false),
        ("middle_K.position", true),
        ("middle_K.rotation", false),
        ("foot_K.reaction_force", false),
        ("foot_K.reaction_moment", false),
    ] {
        let [original, copy] = ["1", "2"].map(|k| vector(simulation, &name.replace('K', k)));
        let expected = if is_position { turn * (original - center) + center + shift } else { turn * original };
        largest = largest.max((copy - expected).norm());
    }
    largest
}

fn check(text: &str) {
    let mut simulation = start(text);
    let mut largest = distance(&simulation);
    run(&mut simulation, 0.005, 0.1, |simulation| largest = largest.max(distance(simulation)));
    println!("the copy is off by {largest:.1e}");
    assert!(largest < 1e-7, "the copy is off by {largest:e}");
    // It moves at all.
    assert!(vector(&simulation, "seen_block_1.rotation").norm() > 0.01);
}

#[test]
fn a_turned_copy_moves_as_its_original_does() {
    check(&copies(&ANGLE.to_string(), ""));
}

/// An angle that is a parameter of the FMU stays one: the copy's vectors are expressions of it.
#[test]
fn a_copy_turned_by_a_parameter_moves_as_its_original_does() {
    check(&copies("phi", &format!("[parameters]\nphi = {ANGLE}")));
}

/// Three bodies on springs, in copies with this `turn`.
fn turned(turn: &str) -> String {
    format!(
        "format = 1\nmodel.name = \"M\"\n[copy.arms]\ncount = 3\nturn = {{ {turn} }}\n[copy.arms.body.arm]\nmass = 1\nposition = [1, 2, 3]\n\
         inertia = [1, 1, 1]\n[copy.arms.spring.tie]\na = \"ground\"\nb = \"arm\"\nstiffness = 1\n[simulation]\nstop = 1\nstep = 0.01\n"
    )
}

/// Without an angle the copies stand where the angle of an even share puts them, in every bit.
#[test]
fn copies_without_an_angle_share_a_whole_turn() {
    let text = |turn: &str| Document::parse("m.toml", &turned(turn), &[]).unwrap().text().to_owned();
    let shared = text("axis = [1, 2, 2], center = [0, 1, 0]");
    assert_eq!(shared, text("axis = [1, 2, 2], angle = \"2*pi*(k - 1)/3\", center = [0, 1, 0]"));
    assert_ne!(shared, text("axis = [1, 2, 2], angle = \"2*pi*(k - 1)/4\", center = [0, 1, 0]"));
}

/// Angles of copies in degrees are told once with the number to write; those in radians, and a star of more than a
/// whole turn in all, are not.
#[test]
fn angles_of_copies_in_degrees_are_told() {
    let remedy = "; without `angle`, the copies are spread evenly over a whole turn";
    let many = |angle: &str, turns: &str| {
        format!(
            "m.toml, line 5: [copy.arms] turns from copy to copy by {angle} rad, {turns} turns. Angles are in radians: {angle} degrees are \
             \"{angle}*pi/180\"{remedy}"
        )
    };
    for (angle, expected) in [
        ("\"2*pi*(k - 1)/3\"", None),
        ("\"2*pi*2*(k - 1)/3\"", None),
        ("\"-10 - pi*k\"", None),
        ("\"120*(k - 1)\"", Some(many("120", "19.1"))),
        ("\"90 - 10*k\"", Some(many("10", "1.6"))),
    ] {
        let text = turned(&format!("axis = [0, 0, 1], angle = {angle}"));
        let found = notes(&Document::parse("m.toml", &text, &[]).unwrap());
        assert_eq!(found, Vec::from_iter(expected), "{angle}");
    }
    // An angle below a whole turn, of which all copies together make 360.
    let text = turned("axis = [0, 0, 1], angle = \"5*k\"").replace("count = 3", "count = 72");
    assert_eq!(notes(&Document::parse("m.toml", &text, &[]).unwrap()), [many("5", "0.8")]);
}

/// A bob on a rope of 0.9 m and 100 N/m from the ground, drawn 1 m away from it.
const BOB: &str = "[copy.both.body.bob]\nmass = 1\nposition = [1, 0, 0]\ninertia = [1, 1, 1]\n[copy.both.spring.rope]\na = \"ground\"\nb = \"bob\"\n\
                   stiffness = 100\nlength = 0.9\n[copy.both.output.rope]\nat = \"rope\"\nquantities = [\"force\"]\n";

/// The ground of a copy is its own origin: both ropes pull with 10 N, one of them 10 m away, where a rope from the
/// origin of the model would pull with 1,010 N. The new end has a name that nothing else has, and where the origin
/// stays, the ground does too. What the file calls ground in a row of the copies is its own.
#[test]
fn regression_the_ground_moves_with_its_copy() {
    let text = |copy: &str| {
        format!("format = 1\nmodel.name = \"M\"\n[copy.both]\n{copy}\n{BOB}[simulation]\nstop = 1\nstep = 0.01\n")
    };
    let both = text("count = 2\nmove = [\"10*(k - 1)\", 0, 0]");
    let taken = both.replace("[simulation]", "[copy.both.point.rope_ground]\n[simulation]");
    for (text, end) in [(&both, "rope_ground_2"), (&taken, "rope_ground__2")] {
        let simulation = start(text);
        for name in ["rope_1.force", "rope_2.force"] {
            // Of a length of 1 m, at 10 m: round-off of 2e-15 m times 100 N/m.
            assert!((value(&simulation, name) - 10.0).abs() < 1e-11, "{name}: {}", value(&simulation, name));
        }
        let flat = simulation.document().text();
        assert!(flat.contains("a = \"ground\"") && flat.contains(&format!("a = \"{end}\"")), "{flat}");
    }
    let turned = start(&text("count = 2\nturn = { axis = [0, 0, 1] }"));
    assert!(turned.document().points.is_empty());
    let outside = text("over = [{ base = \"ground\" }, { base = \"ground\" }]\nmove = [\"10*(k - 1)\", 0, 0]");
    let outside = start(&outside.replace("a = \"ground\"", "a = \"base\""));
    assert!((value(&outside, "rope_2.force") - 1010.0).abs() < 1e-9);
}
