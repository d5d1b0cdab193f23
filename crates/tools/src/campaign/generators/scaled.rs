//! What is tiny (micrometers) and huge (kilometers): the same kinds of machines with all lengths scaled, and the times
//! that go with them.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::TAU;

pub(super) const TINY: [Kind; 4] = [
    Kind::new("cantilever", 6, |choice| cantilever(choice, TINY_LENGTHS)),
    Kind::new("linkage", 6, |choice| linkage(choice, TINY_LENGTHS)),
    Kind::new("resonator", 6, |choice| resonator(choice, TINY_LENGTHS)),
    Kind::new("whirl", 6, |choice| whirl(choice, TINY_LENGTHS)),
];

pub(super) const HUGE: [Kind; 4] = [
    Kind::new("cantilever", 6, |choice| cantilever(choice, HUGE_LENGTHS)),
    Kind::new("linkage", 6, |choice| linkage(choice, HUGE_LENGTHS)),
    Kind::new("resonator", 6, |choice| resonator(choice, HUGE_LENGTHS)),
    Kind::new("whirl", 6, |choice| whirl(choice, HUGE_LENGTHS)),
];

/// Lengths of parts, m.
const TINY_LENGTHS: [f64; 2] = [1e-6, 3e-4];
const HUGE_LENGTHS: [f64; 2] = [5e2, 1e4];

const STEPS: usize = 600;
/// Of silicon and of steel alike, m/s.
const SPEED_OF_SOUND: f64 = 5.2e3;
const YOUNG: f64 = 2.1e11;
const DENSITY: f64 = 7850.0;

/// First circular frequency of a cantilever of square section, 1/s.
fn first(length: f64, height: f64) -> f64 {
    3.516 * SPEED_OF_SOUND * height / 12.0_f64.sqrt() / length.powi(2)
}

/// Length and thickness, m.
fn proportions(choice: &mut Choice, [low, high]: [f64; 2]) -> (f64, f64) {
    let length = choice.scale(low, high);
    (length, round(length * choice.between(0.01, 0.03)))
}

/// A cantilever under a load that swings near its first frequency.
fn cantilever(choice: &mut Choice, lengths: [f64; 2]) -> String {
    let (length, height) = proportions(choice, lengths);
    let rate = first(length, height);
    let force = round(3.0 * YOUNG * height.powi(4) / 12.0 / length.powi(2) * choice.between(0.01, 0.1));
    let mut text = Text::new(0.0);
    text.matter(YOUNG, DENSITY, 0.0);
    text.rectangle("bar", height, height);
    text.beam("arm", "bar", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(2, 8), "");
    text.joint("root", "weld", ["ground", "arm.start"], "");
    let law = |share: f64| format!("\"{}*sin({}*t)\"", number(force), number(round(share * rate)));
    text.load(
        "tip_load",
        "arm.end",
        &format!("force = [0, {}, {}]", law(choice.between(0.2, 0.8)), law(choice.between(0.2, 0.8))),
    );
    text.watch_motion("tip", "arm.end");
    text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    text.end(round(TAU / rate / choice.scale(40.0, 200.0)), STEPS, "")
}

/// A four-bar linkage with a tilted hinge.
fn linkage(choice: &mut Choice, lengths: [f64; 2]) -> String {
    let (length, height) = proportions(choice, lengths);
    // Slow beside the sway of its bars, fast enough that inertia is felt.
    let speed = round(first(length, height) * choice.scale(0.003, 0.03));
    let mut text = Text::new(0.0);
    text.matter(YOUNG, DENSITY, choice.pick(&[0.0, 0.01]) / first(length, height));
    text.rectangle("bar", height, height);
    let [a, b, c, d] = [[0.0; 3], [0.0, 0.5 * length, 0.0], [length, 0.5 * length, 0.0], [length, 0.0, 0.0]];
    text.beam("crank", "bar", [a, b], 2, "y_axis = [0, 0, 1]");
    text.beam("coupler", "bar", [b, c], 4, "y_axis = [0, 0, 1]");
    text.beam("rocker", "bar", [c, d], 2, "y_axis = [0, 0, 1]");
    let hinge = "axis = [0, 0, 1]";
    text.joint("crank_pivot", "revolute", ["ground", "crank.start"], hinge);
    text.joint("elbow", "revolute", ["crank.end", "coupler.start"], hinge);
    text.joint("knee", "revolute", ["coupler.end", "rocker.start"], &format!("axis = {}", list([0.05, 0.0, 1.0])));
    text.joint("rocker_pivot", "revolute", ["ground", "rocker.end"], hinge);
    text.drive("motor", "crank_pivot", "angle", &format!("value = \"0.4*(1 - cos({}*t))\"", number(speed)));
    text.watch_motion("joint_place", "coupler.end");
    text.watch("torque", "motor", &["effort"]);
    text.watch("load", "rocker_pivot", &["reaction_force", "reaction_moment"]);
    text.end(round(TAU / speed / choice.scale(200.0, 1000.0)), STEPS, "")
}

/// A mass on two beams, driven near its resonance.
fn resonator(choice: &mut Choice, lengths: [f64; 2]) -> String {
    let (length, height) = proportions(choice, lengths);
    let own = DENSITY * height * height * length;
    let mass = round(own * choice.scale(1.0, 100.0));
    let rate = (24.0 * YOUNG * height.powi(4) / 12.0 / length.powi(3) / (mass + 0.8 * own)).sqrt();
    let mut text = Text::new(0.0);
    text.matter(YOUNG, DENSITY, 0.0);
    text.rectangle("leaf", height, height);
    for (name, place) in [("left", 0.0), ("right", 0.5 * length)] {
        text.beam(name, "leaf", [[place, 0.0, 0.0], [place, length, 0.0]], 4, "y_axis = [1, 0, 0]");
        text.joint(&format!("{name}_foot"), "weld", ["ground", &format!("{name}.start")], "");
        text.joint(&format!("{name}_top"), "weld", ["stage", &format!("{name}.end")], "");
    }
    let moment = mass * length * length * 0.05;
    text.body("stage", mass, [0.25 * length, length, 0.0], [moment; 3].map(round), "");
    let force = round(0.01 * length * mass * rate * rate * choice.between(0.2, 1.0));
    text.load("comb", "stage", &format!("force = [\"{}*sin({}*t)\", 0, 0]", number(force), number(round(0.7 * rate))));
    text.watch("motion", "stage", &["displacement", "velocity"]);
    text.watch("foot_load", "left_foot", &["reaction_force", "reaction_moment"]);
    text.end(round(TAU / rate / choice.scale(40.0, 200.0)), STEPS, "")
}

/// A beam thrown into space, turning.
fn whirl(choice: &mut Choice, lengths: [f64; 2]) -> String {
    let (length, height) = proportions(choice, lengths);
    let speed = round(first(length, height) * choice.scale(0.02, 0.3));
    let mut text = Text::new(0.0);
    text.matter(YOUNG, DENSITY, 0.0);
    text.rectangle("bar", height, height);
    let velocity = list([0.0, 0.1 * speed * length, 0.0]);
    let more = format!("velocity = {velocity}\nangular_velocity = {}", list([0.0, 0.1 * speed, speed]));
    text.beam("rod", "bar", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(2, 8), &more);
    text.watch_motion("tip", "rod.end");
    text.watch("middle", "rod@0.5", &["section_force", "section_moment"]);
    text.end(round(TAU / speed / choice.scale(40.0, 400.0)), STEPS, "")
}
