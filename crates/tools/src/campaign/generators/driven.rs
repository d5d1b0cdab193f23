//! What is driven: slider cranks, robots, shaken frames, drives of distances.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, number};
use std::f64::consts::TAU;

pub(super) const KINDS: [Kind; 4] = [
    Kind::new("slider", 6, slider),
    Kind::new("robot", 6, robot),
    Kind::new("frame", 6, frame),
    Kind::new("feed", 6, feed),
];

const STEPS: usize = 600;

/// A slider crank with a flexible rod.
fn slider(choice: &mut Choice) -> String {
    let (speed, length) = (choice.scale(2.0, 100.0), choice.between(0.25, 0.5));
    let mass = choice.scale(0.1, 5.0);
    let mut text = Text::new(choice.pick(&[0.0, 9.81]));
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("bar", 0.012, 0.006);
    text.body("crank", 0.5, [0.05, 0.0, 0.0], [1e-3; 3], "");
    text.beam("rod", "bar", [[0.1, 0.0, 0.0], [0.1 + length, 0.0, 0.0]], choice.whole(2, 6), "");
    text.body("piston", mass, [0.1 + length, 0.0, 0.0], [1e-3 * mass; 3], "");
    text.joint("pivot", "revolute", ["ground", "crank"], "at = [0, 0, 0]\naxis = [0, 1, 0]");
    text.joint("big_end", "revolute", ["crank", "rod.start"], "axis = [0, 1, 0]");
    text.joint("small_end", "spherical", ["piston", "rod.end"], "");
    text.joint("bore", "prismatic", ["ground", "piston"], "axis = [1, 0, 0]");
    text.drive(
        "motor",
        "pivot",
        "angle",
        &format!("rate = \"{}*min(1, {}*t)\"", number(speed), number(round(0.3 * speed))),
    );
    text.watch("stroke", "piston", &["position", "velocity"]);
    text.watch("torque", "motor", &["effort"]);
    text.watch("middle", "rod@0.5", &["position"]);
    text.watch("side_load", "bore", &["distance", "reaction_force"]);
    text.end(round(TAU / speed / choice.scale(100.0, 1000.0)), STEPS, "")
}

/// A robot of two flexible links, whose joints move along smooth laws.
fn robot(choice: &mut Choice) -> String {
    let (time, reach) = (choice.between(0.3, 2.0), choice.between(0.3, 1.0));
    let mut text = Text::new(9.81);
    text.matter(7e10, 2700.0, choice.pick(&[0.0, 1e-5, 1e-4]));
    text.rectangle("link", 0.05 * reach, choice.between(0.01, 0.03) * reach);
    text.beam("upper", "link", [[0.0; 3], [reach, 0.0, 0.0]], choice.whole(2, 5), "");
    text.beam("lower", "link", [[reach, 0.0, 0.0], [1.8 * reach, 0.0, 0.0]], choice.whole(2, 5), "");
    text.body("tool", choice.scale(0.1, 5.0), [1.8 * reach, 0.0, 0.0], [1e-3; 3], "");
    text.joint("shoulder", "revolute", ["ground", "upper.start"], "axis = [0, -1, 0]");
    text.joint("elbow", "revolute", ["upper.end", "lower.start"], "axis = [0, -1, 0]");
    text.joint("flange", "weld", ["lower.end", "tool"], "");
    for (name, joint, angle) in
        [("motor1", "shoulder", choice.between(0.5, 1.5)), ("motor2", "elbow", choice.between(-1.5, 1.5))]
    {
        let law = format!("value = \"{}*0.5*(1 - cos(pi*min(1, t/{})))\"", number(angle), number(time));
        text.drive(name, joint, "angle", &law);
        text.watch(&format!("{name}_torque"), name, &["effort"]);
    }
    text.watch_motion("tool_motion", "tool");
    let initial = choice.pick(&["", "initial = \"equilibrium\""]);
    text.end(round(1.5 * time / STEPS as f64), STEPS, initial)
}

/// A cantilever on a frame that shakes and turns.
fn frame(choice: &mut Choice) -> String {
    let height = choice.between(0.004, 0.01);
    let rate = 3.516 * 5.2e3 * height / 12.0_f64.sqrt() / 0.36;
    let mut text = Text::new(choice.pick(&[0.0, 9.81]));
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", 2.0 * height, height);
    let shake = format!("\"0.01*sin({}*t)\"", number(round(rate * choice.scale(0.1, 2.0))));
    let turn = format!("\"{}*t^2\"", number(choice.between(0.0, 5.0)));
    text.add("frame.hand", &format!("position = [0, {shake}, {shake}]\nrotation = [0, 0, {turn}]"));
    text.beam("arm", "flat", [[0.0; 3], [0.6, 0.0, 0.0]], choice.whole(4, 8), "");
    text.joint("grip", "weld", ["hand", "arm.start"], "");
    text.watch_motion("tip", "arm.end");
    text.watch("hand_load", "hand", &["reaction_force", "reaction_moment"]);
    text.end(round(TAU / rate / choice.scale(40.0, 200.0)), STEPS, "")
}

/// A drive of a distance pushes a carriage in pieces; a flexible mast with a mass stands on it.
fn feed(choice: &mut Choice) -> String {
    let (time, height, mass) = (choice.between(0.2, 1.0), choice.between(0.3, 0.8), choice.scale(0.1, 5.0));
    let mut text = Text::new(9.81);
    text.matter(7e10, 2700.0, choice.pick(&[0.0, 1e-4]));
    text.rectangle("pole", 0.02, 0.02);
    text.body("carriage", 5.0, [0.0; 3], [0.05; 3], "");
    text.beam("mast", "pole", [[0.0; 3], [0.0, 0.0, height]], choice.whole(3, 6), "");
    text.body("top", mass, [0.0, 0.0, height], [1e-2 * mass; 3], "");
    text.joint("rail", "prismatic", ["ground", "carriage"], "axis = [1, 0, 0]");
    text.joint("foot", "weld", ["carriage", "mast.start"], "");
    text.joint("cap", "weld", ["mast.end", "top"], "");
    let (acceleration, until) = (choice.between(0.5, 5.0), round(0.4 * time));
    let speed = number(acceleration * until);
    let law =
        format!("rate = [{{ until = {}, is = \"{}*t\" }}, {{ is = {speed} }}]", number(until), number(acceleration));
    text.drive("screw", "rail", "distance", &law);
    text.watch_motion("top_motion", "top");
    text.watch("push", "screw", &["distance", "effort"]);
    text.watch("foot_load", "foot", &["reaction_force", "reaction_moment"]);
    text.end(round(time / STEPS as f64), STEPS, choice.pick(&["", "initial = \"equilibrium\""]))
}
