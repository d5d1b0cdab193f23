//! What hits: masses on stiff springs and on beams, short pulses, springs that harden.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::{PI, TAU};

pub(super) const KINDS: [Kind; 4] = [
    Kind::new("spring", 6, spring),
    Kind::new("beam", 6, beam),
    Kind::new("pulse", 6, pulse),
    Kind::new("hardening", 6, hardening),
];

const STEPS: usize = 600;

/// A mass lands on a spring and stays on it.
fn spring(choice: &mut Choice) -> String {
    let (mass, stiffness) = (choice.scale(0.1, 100.0), choice.scale(1e3, 1e8));
    let rate = (stiffness / mass).sqrt();
    let step = round(TAU / rate / choice.scale(20.0, 200.0));
    let damping = choice.pick(&[0.0, 0.02, 0.2, 2.0]) * mass * rate;
    let mut text = Text::new(9.81);
    let speed = format!("velocity = {}", list([0.0, 0.0, -choice.between(0.5, 5.0)]));
    text.body("mass", mass, [0.0, 0.0, 1.0], [0.1 * mass; 3], &speed);
    text.joint("rail", "prismatic", ["ground", "mass"], "axis = [0, 0, 1]");
    text.spring("stop", ["ground", "mass"], [stiffness, damping], "");
    text.watch("motion", "mass", &["displacement", "velocity", "acceleration"]);
    text.watch("rail_load", "rail", &["reaction_moment", "distance"]);
    text.end(step, STEPS, "")
}

/// A mass lands on the tip of a cantilever.
fn beam(choice: &mut Choice) -> String {
    let (length, height) = (choice.between(0.3, 1.0), choice.between(0.004, 0.012));
    let own = 7850.0 * 2.0 * height * height * length;
    let mass = choice.scale(0.1, 10.0) * own;
    let stiffness = 3.0 * 2.1e11 * 2.0 * height.powi(4) / 12.0 / length.powi(3);
    let period = TAU * ((mass + 0.24 * own) / stiffness).sqrt();
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", 2.0 * height, height);
    text.beam("arm", "flat", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(4, 8), "");
    text.joint("root", "weld", ["ground", "arm.start"], "");
    let speed = format!("velocity = {}", list([0.0, 0.0, -choice.between(0.2, 3.0)]));
    text.body("mass", mass, [length, 0.0, 0.0], [1e-3 * mass * length * length; 3], &speed);
    text.joint("glue", "weld", ["arm.end", "mass"], "");
    text.watch("tip", "mass", &["displacement", "velocity"]);
    text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    text.end(round(period / choice.scale(40.0, 400.0)), STEPS, "")
}

/// A short half-sine of force strikes a beam, free or clamped; its length is some steps, or a part of one.
fn pulse(choice: &mut Choice) -> String {
    let (length, height) = (choice.between(0.3, 1.0), choice.between(0.004, 0.012));
    let first = 3.516 * (2.1e11 / 7850.0_f64 / 12.0).sqrt() * height / length.powi(2);
    let step = round(TAU / first / choice.scale(50.0, 300.0));
    let (begin, width) = (round(7.3 * step), round(choice.scale(0.3, 20.0) * step));
    let own = 7850.0 * 3.0 * height * height * length;
    let force = round(choice.between(0.005, 0.05) * own * length * first / width);
    let mut text = Text::new(0.0);
    text.matter(2.1e11, 7850.0, choice.pick(&[1e-4, 1e-3]));
    text.rectangle("flat", 3.0 * height, height);
    text.beam("bar", "flat", [[0.0; 3], [length, 0.0, 0.0]], 2 * choice.whole(2, 5), "");
    if choice.pick(&[true, false]) {
        text.joint("root", "weld", ["ground", "bar.start"], "");
        text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    }
    let blow = format!("{}*sin({}*(t - {}))", number(force), number(PI / width), number(begin));
    let (begin, end) = (number(begin), number(begin + width));
    let pieces = format!("[{{ until = {begin}, is = 0 }}, {{ until = {end}, is = \"{blow}\" }}, {{ is = 0 }}]");
    text.load("hammer", "bar.end", &format!("force = [0, 0, {pieces}]"));
    text.watch_motion("tip", "bar.end");
    text.watch("middle", "bar@0.5", &["position", "section_moment"]);
    text.end(step, STEPS, "")
}

/// A mass shoots across a tight or slack wire, which hardens as it is pulled aside.
fn hardening(choice: &mut Choice) -> String {
    let (mass, stiffness) = (choice.scale(0.1, 10.0), choice.scale(1e4, 1e7));
    let (speed, length) = (choice.between(0.5, 5.0), choice.pick(&[0.999, 1.0]));
    // Where all of its energy is in the wires: 2 k/8 x^4 = m v^2/2.
    let reach = (2.0 * mass * speed * speed / stiffness).powf(0.25);
    let step = round(4.0 * reach / speed / choice.scale(20.0, 200.0));
    let mut text = Text::new(0.0);
    text.body("mass", mass, [0.0; 3], [0.01 * mass; 3], &format!("velocity = {}", list([0.0, 0.1 * speed, speed])));
    for (name, place) in [("left", -1.0), ("right", 1.0)] {
        text.add(&format!("frame.{name}_pole"), &format!("position = {}", list([place, 0.0, 0.0])));
        let pole = format!("{name}_pole");
        text.spring(
            &format!("{name}_wire"),
            [&pole, "mass"],
            [stiffness, 0.0],
            &format!("length = {}", number(length)),
        );
    }
    text.watch_motion("motion", "mass");
    text.watch("pull", "left_pole", &["reaction_force"]);
    text.end(step, STEPS, "")
}
