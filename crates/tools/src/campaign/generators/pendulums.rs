//! Pendulums and chains of joints: rigid, flexible, on springs, on every kind of joint.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::TAU;

pub(super) const KINDS: [Kind; 4] = [
    Kind::new("rigid", 6, rigid),
    Kind::new("flexible", 6, flexible),
    Kind::new("elastic", 6, elastic),
    Kind::new("joints", 6, joints),
];

const STEPS: usize = 600;

/// A step for a pendulum of this length, s.
fn step(choice: &mut Choice, length: f64) -> f64 {
    round(TAU * (length / 9.81).sqrt() / choice.scale(40.0, 400.0))
}

/// One to three rigid links on hinges, let go from the side: chaotic in the long run where there are several.
fn rigid(choice: &mut Choice) -> String {
    let (count, length) = (choice.whole(1, 3), choice.between(0.2, 2.0));
    let mut text = Text::new(9.81);
    let mut before = String::from("ground");
    for number in 0..count {
        let (own, mass) = (format!("link{number}"), choice.scale(0.1, 10.0));
        let place = length * number as f64;
        text.body(&own, mass, [place + 0.5 * length, 0.0, 0.0], [mass * length * length / 12.0; 3].map(round), "");
        let more = format!("at = {}\naxis = [0, 1, 0]", list([place, 0.0, 0.0]));
        text.joint(&format!("hinge{number}"), "revolute", [&before, &own], &more);
        before = own;
    }
    text.watch_motion("last", &before);
    text.watch("pull", "hinge0", &["angle", "reaction_force"]);
    let step = step(choice, length);
    text.end(step, STEPS, "")
}

/// A flexible pendulum, let go from the side, in the plane or out of it.
fn flexible(choice: &mut Choice) -> String {
    let length = choice.between(0.5, 2.0);
    let mut text = Text::new(9.81);
    text.matter(choice.scale(1e7, 2e11), choice.pick(&[1000.0, 7850.0]), choice.pick(&[0.0, 1e-4, 1e-3]));
    text.circle("rod", choice.between(0.005, 0.01) * length);
    let speed = format!("angular_velocity = {}", list([0.0, 0.0, choice.pick(&[0.0, 1.0])]));
    text.beam("rod_beam", "rod", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(3, 8), &speed);
    let kind = choice.pick(&["universal", "spherical", "revolute"]);
    let axes = match kind {
        "universal" => "axis = [0, 1, 0]\naxis2 = [0, 0, 1]",
        "revolute" => "axis = [0, 1, 0]",
        _ => "",
    };
    text.joint("pivot", kind, ["ground", "rod_beam.start"], axes);
    text.watch_motion("tip", "rod_beam.end");
    text.watch("pull", "pivot", &["reaction_force"]);
    let step = step(choice, length);
    text.end(step, STEPS, "")
}

/// A mass on a spring swings and bounces.
fn elastic(choice: &mut Choice) -> String {
    let (mass, length) = (choice.scale(0.1, 10.0), choice.between(0.5, 2.0));
    // From three times to a thousand times the pendulum's own stiffness.
    let stiffness = round(mass * 9.81 / length * choice.scale(3.0, 1000.0));
    let mut text = Text::new(9.81);
    text.add("frame.nail", "position = [0, 0, 0]");
    let speed = format!("velocity = {}", list([0.0, choice.pick(&[0.0, 1.0]), 0.0]));
    text.body("bob", mass, [length, 0.0, 0.0], [0.01 * mass; 3], &speed);
    text.spring("thread", ["nail", "bob"], [stiffness, choice.pick(&[0.0, 0.01]) * stiffness], "");
    text.watch_motion("motion", "bob");
    text.watch("pull", "nail", &["reaction_force"]);
    let step = step(choice, length);
    text.end(step, STEPS, "")
}

/// A chain of two bodies and a beam on joints of every kind, with springs and dampers in them.
fn joints(choice: &mut Choice) -> String {
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", 0.02, 0.006);
    let stiffness = choice.scale(1.0, 1e3);
    let sprung =
        format!("stiffness = {}\ndamping = {}", number(stiffness), number(choice.pick(&[0.0, 0.01]) * stiffness));
    text.body("first", 2.0, [0.2, 0.0, 0.0], [0.02; 3], "");
    text.body("second", 1.0, [0.6, 0.1, 0.0], [0.01; 3], "");
    let one = choice.pick(&["revolute", "cylindrical"]);
    text.joint("upper", one, ["ground", "first"], &format!("at = [0, 0, 0]\naxis = [0, 1, 0]\n{sprung}"));
    let (two, axes) = choice.pick(&[
        ("universal", "axis = [0, 1, 0]\naxis2 = [0, 0, 1]"),
        ("prismatic", "axis = [1, 0, 0]\nstiffness = 2e3\ndamping = 5"),
        ("inline", "axis = [1, 0, 0]\nstiffness = 2e3\ndamping = 5"),
        ("spherical", ""),
    ]);
    text.joint("middle", two, ["first", "second"], &format!("at = [0.4, 0, 0]\n{axes}"));
    text.beam("tail", "flat", [[0.8, 0.1, 0.0], [1.2, 0.1, 0.0]], choice.whole(2, 4), "");
    let three = choice.pick(&[
        ("weld", ""),
        ("revolute", "axis = [0, 1, 0]"),
        ("universal", "axis = [0, 1, 0]\naxis2 = [0, 0, 1]"),
    ]);
    text.joint("lower", three.0, ["second", "tail.start"], three.1);
    text.watch_motion("tip", "tail.end");
    text.watch_motion("second_motion", "second");
    text.watch("load", "upper", &["reaction_force", "reaction_moment"]);
    let step = step(choice, 0.8);
    text.end(step, STEPS, "")
}
