//! Motions with parts that are far stiffer along their axis than across it, which steps do not resolve. A correction stretches such a part, and a matrix with that tension makes refinements small, however large the error
//! still is. A step must not end there.

use ancf14_testing::curves::{Curves, largest};

const STEP: f64 = 0.05;
const STEPS: usize = 60;

/// Largest difference that the tolerance makes to a place of `seen`, in m: the default one, 1e-8, against 1e-12.
fn difference(parts: &str, seen: &str) -> f64 {
    let model = format!(
        "format = 1\n[model]\ngravity = [0, 0, -10]\n{parts}[output.seen]\nat = \"{seen}\"\nquantities = [\"position\"]\n\
         [simulation]\nstep = {STEP}\noutput_step = {STEP}\nstop = 3\n"
    );
    let runs = [&[][..], &[("simulation.tolerance", "1e-12")]].map(|settings| Curves::run(&model, settings));
    let [default, tight] = runs.map(|run| [run.column("seen.position[1]"), run.column("seen.position[3]")].concat());
    let differences: Vec<f64> = default.iter().zip(&tight).map(|(one, other)| one - other).collect();
    assert_eq!(differences.len(), 2 * (STEPS + 1));
    largest(&differences)
}

/// A step may leave 0.3 of the tolerance of the place of a mechanism of 1 m. Its velocity has that over the step, which adds up over the steps that follow.
const LARGEST_DIFFERENCE: f64 = 0.5 * 0.3e-8 * (STEPS * STEPS) as f64;

/// A weight of 1 kg swings on a rod of 1e10 N/m.
#[test]
fn stiff_springs_swing_as_with_a_tight_tolerance() {
    let parts = r#"
name = "StiffSpring"
[frame.hook]
position = [0, 0, 0]
[body.slider]
mass = 1e-3
position = [0.6, 0, -0.8]
inertia = [0.1, 0.1, 0.1]
[body.bob]
mass = 1
position = [0.6, 0, -0.8]
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
stiffness = 1e10
"#;
    let difference = difference(parts, "bob");
    assert!(difference < LARGEST_DIFFERENCE, "{difference:e} m");
}

/// A bar of 1 kg and 1e10 N swings on a hinge.
#[test]
fn stiff_bars_swing_as_with_a_tight_tolerance() {
    let parts = r#"
name = "StiffBar"
[section.bar]
shape = "rigidities"
EA = 1e10
EI_y = 1e10
EI_z = 1e10
GJ = 1e10
line_density = 1
[beam.bar]
section = "bar"
from = [0, 0, 0]
to = [0.6, 0, -0.8]
elements = 1
[joint.hinge]
type = "revolute"
a = "ground"
b = "bar.start"
axis = [0, 1, 0]
"#;
    let difference = difference(parts, "bar.end");
    assert!(difference < LARGEST_DIFFERENCE, "{difference:e} m");
}
