//! Equilibria of parts that are far stiffer along than across. A correction stretches them, and a matrix with that tension makes the next corrections small, however large the error still is: neither a small correction nor a
//! small solution with the same factors may pass for convergence.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::{Curves, largest, load};

/// The end of a run: static, in ten steps.
const RUN: &str = r#"
[output.seen]
at = "END"
quantities = ["position"]
[simulation]
analysis = "static"
step = 0.1
output_step = 0.1
stop = 1
"#;

/// How far the weight at `end` is from where it hangs 1 m below the hinge, pulled aside by up to `side` times its weight, m.
fn largest_error(model: &str, end: &str, side: f64) -> f64 {
    let places = Curves::record(&mut load(&format!("{model}{}", RUN.replace("END", end)), &[]));
    let places = places.column("seen.position[1]");
    assert_eq!(places.len(), 11);
    let exact = |row: usize| (0.1 * side * row as f64).atan().sin();
    let errors: Vec<f64> = places.iter().enumerate().map(|(row, place)| place - exact(row)).collect();
    largest(&errors)
}

/// A weight of 10 N hangs from a rod of 1e11 N/m.
#[test]
fn stiff_springs_hang_where_their_load_pulls() {
    let model = r#"
format = 1
[model]
name = "StiffSpring"
gravity = [0, 0, 0]
[frame.hook]
position = [0, 0, 0]
[body.slider]
mass = 1
position = [0, 0, -1]
inertia = [0.1, 0.1, 0.1]
[body.bob]
mass = 1
position = [0, 0, -1]
inertia = [0.1, 0.1, 0.1]
[joint.along]
type = "prismatic"
a = "ground"
b = "slider"
axis = [1, 0, 0]
[joint.up]
type = "prismatic"
a = "slider"
b = "bob"
axis = [0, 0, 1]
[spring.rod]
a = "hook"
b = "bob"
stiffness = 1e11
[load.weight]
at = "bob"
force = ["0.5*t", 0, -10]
"#;
    // The rod is 1e-10 longer than its length; round-off is 1e10 times that of places, times the angle.
    let error = largest_error(model, "bob", 0.05);
    assert!(error < 1e-10, "{error:e} m");
}

/// A weight of 1 N hangs from a hinged link of 1e12 N/m, and is pulled aside by as much.
#[test]
fn stiff_links_hang_where_their_load_pulls() {
    let model = r#"
format = 1
[model]
name = "StiffLink"
gravity = [0, 0, 0]
[section.bar]
shape = "rigidities"
EA = 1e12
EI_y = 1e12
EI_z = 1e12
GJ = 1e12
line_density = 1
[beam.link]
section = "bar"
from = [0, 0, 0]
to = [0, 0, -1]
elements = 1
[joint.hinge]
type = "revolute"
a = "ground"
b = "link.start"
axis = [0, 1, 0]
[load.weight]
at = "link.end"
force = ["t", 0, -1]
"#;
    // Round-off of a place, 1e-16 m, stretches the link by 1e-4 N, and bends and turns it likewise.
    let error = largest_error(model, "link.end", 1.0);
    assert!(error < 1e-8, "{error:e} m");
}

/// A beam that heat has bent is free to turn about its hinge. On the way there, stresses hold it.
#[test]
fn hot_beams_that_nothing_holds_are_told() {
    let model = r#"
format = 1
[model]
name = "HotBeam"
gravity = [0, 0, 0]
[material.steel]
young = 2e11
poisson = 0.3
density = 7850
expansion = 12e-6
[section.bar]
shape = "rectangle"
width = 0.01
height = 0.01
[beam.arm]
material = "steel"
section = "bar"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
temperature_gradient = [3000, 0]
[joint.hinge]
type = "revolute"
a = "ground"
b = "arm.start"
axis = [0, 0, 1]
[simulation]
analysis = "static"
step = 1
output_step = 1
stop = 1
"#;
    let mut simulation =
        Simulation::load("model.toml", model, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    let failure = simulation.initialize(0.0).expect_err("a beam that is free to turn");
    assert!(failure.message.contains("can move freely"), "{}", failure.message);
}
