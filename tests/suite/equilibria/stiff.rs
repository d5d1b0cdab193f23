//! Equilibria of parts that are far stiffer along their axis than across it. A correction stretches them, and a matrix
//! with that tension makes the next corrections small, however large the error still is. Newton must not stop there,
//! nor take a stressed iterate for an equilibrium that holds.

use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::{Curves, largest, load};

/// Without gravity; the name and the parts follow.
const HEAD: &str = "format = 1\n[model]\ngravity = [0, 0, 0]\n";

/// Largest distance of the weight at `end` from where it hangs 1 m from the hinge, in ten steps to a pull aside of
/// `side` times its weight, m.
fn largest_error(parts: &str, end: &str, side: f64) -> f64 {
    let run = format!(
        "[output.seen]\nat = \"{end}\"\nquantities = [\"position\"]\n[simulation]\nanalysis = \"static\"\nstep = 0.1\noutput_step = 0.1\nstop = 1\n"
    );
    let places = Curves::record(&mut load(&format!("{HEAD}{parts}{run}"), &[]));
    let places = places.column("seen.position[1]");
    assert_eq!(places.len(), 11);
    let exact = |row: usize| (0.1 * side * row as f64).atan().sin();
    let errors: Vec<f64> = places.iter().enumerate().map(|(row, place)| place - exact(row)).collect();
    largest(&errors)
}

/// A weight of 10 N hangs from a rod of 1e11 N/m.
#[test]
fn stiff_springs_hang_where_their_load_pulls() {
    let parts = r#"
name = "StiffSpring"
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
    // The weight stretches the rod by 1e-10 m, which the exact place leaves out.
    let error = largest_error(parts, "bob", 0.05);
    assert!(error < 1e-10, "{error:e} m");
}

/// A weight of 1 N hangs from a hinged link of 1e12 N/m, and is pulled aside by as much.
#[test]
fn stiff_links_hang_where_their_load_pulls() {
    let parts = r#"
name = "StiffLink"
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
    // The default tolerance, times the length of the link.
    let error = largest_error(parts, "link.end", 1.0);
    assert!(error < 1e-8, "{error:e} m");
}

/// A beam that heat has bent is free to turn about its hinge. The stresses of Newton's iterates hold it; the run must
/// still tell that it can turn.
#[test]
fn hot_beams_that_can_turn_are_reported() {
    let parts = r#"
name = "HotBeam"
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
    let mut simulation = Simulation::load("model.toml", &format!("{HEAD}{parts}"), &[])
        .unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let told = simulation.take_warnings().concat();
    assert!(told.contains("a free motion takes no load") && told.contains("arm."), "{told}");
}
