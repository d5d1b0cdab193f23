//! Motions with parts that are far stiffer along their axis than across it, in steps too long for their vibrations. A
//! correction stretches such a part, and a matrix with that tension makes refinements small, however large the error
//! still is. A step must not end there.

use ancf14::mechanics::state::Statistics;
use ancf14_testing::curves::{Curves, largest, load};

const STEP: f64 = 0.05;
const STEPS: u32 = 60;

/// A step may leave 0.3 of the tolerance of a coordinate of these mechanisms, of 1 m. Its velocity has that over the
/// step, which adds up over the steps that follow.
const LARGEST_DIFFERENCE: f64 = 0.5 * 0.3e-8 * (STEPS * STEPS) as f64;

/// Parts, with the results of `seen`.
fn model(parts: &str, seen: &str) -> String {
    format!(
        "format = 1\n[model]\ngravity = [0, 0, -10]\n{parts}[output.seen]\nat = \"{seen}\"\nquantities = [\"position\"]\n\
         [simulation]\nstep = {STEP}\noutput_step = {STEP}\nstop = 3\n"
    )
}

/// Largest difference that the tolerance makes to the position of `seen`, in m: the default one, 1e-8, against 1e-12.
fn difference(parts: &str, stiffness: &str, seen: &str) -> f64 {
    let [default, tight] = ["1e-8", "1e-12"].map(|tolerance| {
        let mut simulation =
            load(&model(parts, seen), &[("stiffness", stiffness), ("simulation.tolerance", tolerance)]);
        let run = Curves::record(&mut simulation);
        assert_eq!(simulation.state().statistics.steps, u64::from(STEPS), "halved steps are not comparable");
        [run.column("seen.position[1]"), run.column("seen.position[3]")].concat()
    });
    let differences: Vec<f64> = default.iter().zip(&tight).map(|(one, other)| one - other).collect();
    largest(&differences)
}

/// A weight of 1 kg that swings on a spring, whose hook is at `x` m.
fn weight(x: f64) -> String {
    let aside = x + 0.6;
    format!(
        r#"
name = "StiffSpring"
[parameters]
stiffness = 1e10
[frame.hook]
position = [{x}, 0, 0]
[body.slider]
mass = 1e-3
position = [{aside}, 0, -0.8]
inertia = [0.1, 0.1, 0.1]
[body.bob]
mass = 1
position = [{aside}, 0, -0.8]
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
stiffness = "stiffness"
"#
    )
}

#[test]
fn stiff_springs_swing_as_with_a_tight_tolerance() {
    for stiffness in ["1e9", "1e10", "1e11", "1e12"] {
        let difference = difference(&weight(0.0), stiffness, "bob");
        println!("{stiffness} N/m: {difference:.1e} m");
        assert!(difference < LARGEST_DIFFERENCE, "{stiffness} N/m: {difference:e} m");
    }
}

/// A thousand kilometers from the origin, round-off of positions is 1e-10 m: refinements of that size do not shrink,
/// and are as good as they get. No step takes more iterations for it.
#[test]
fn stiff_springs_swing_far_from_the_origin() {
    for stiffness in ["1e4", "1e8", "1e12"] {
        let [near, far] = [0.0, 1e6].map(|x| {
            let mut simulation = load(&model(&weight(x), "bob"), &[("stiffness", stiffness)]);
            Curves::record(&mut simulation);
            let Statistics { steps, rejected, iterations, .. } = simulation.state().statistics;
            assert_eq!((steps, rejected), (u64::from(STEPS), 0), "{stiffness} N/m at {x} m");
            iterations
        });
        println!("{stiffness} N/m: {near} iterations, {far} far away");
        assert!(far <= near, "{stiffness} N/m: {near} iterations, {far} far away");
    }
}

/// A bar of 1 kg swings on a hinge. With 1e12 N and the tight tolerance, a step is halved.
#[test]
fn stiff_bars_swing_as_with_a_tight_tolerance() {
    let parts = r#"
name = "StiffBar"
[parameters]
stiffness = 1e10
[section.bar]
shape = "rigidities"
EA = "stiffness"
EI_y = "stiffness"
EI_z = "stiffness"
GJ = "stiffness"
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
    for stiffness in ["1e9", "1e10", "1e11"] {
        let difference = difference(parts, stiffness, "bar.end");
        println!("{stiffness} N: {difference:.1e} m");
        assert!(difference < LARGEST_DIFFERENCE, "{stiffness} N: {difference:e} m");
    }
}
