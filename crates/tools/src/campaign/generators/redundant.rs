//! Linkages that more joints hold than needed: planar ones with hinges, of flexible bars and of rigid ones.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::TAU;

pub(super) const KINDS: [Kind; 5] = [
    Kind::new("four_bar", 6, four_bar),
    Kind::new("parallel", 5, parallel),
    Kind::new("scissor", 5, scissor),
    Kind::new("rigid", 4, rigid),
    Kind::new("bushed", 4, bushed),
];

const STEPS: usize = 600;
/// Hinges of planar linkages.
const HINGE: &str = "axis = [0, 0, 1]";

/// Turns of the crank, and steps a turn.
fn pace(choice: &mut Choice) -> (f64, f64) {
    let speed = choice.scale(0.5, 30.0);
    (speed, round(TAU / speed / choice.scale(100.0, 1000.0)))
}

/// A four-bar linkage with hinges throughout; one hinge may be tilted.
fn four_bar(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice);
    let (thick, tilt) = (choice.between(0.008, 0.016), choice.pick(&[0.0, 0.0, 0.02, 0.08]));
    let mut text = Text::new(choice.pick(&[0.0, 9.81]));
    text.matter(2.07e11, 7800.0, choice.damping());
    text.rectangle("bar", thick, thick);
    let (crank, rocker) = (0.12, choice.between(0.15, 0.25));
    let [a, b, c, d] = [[0.0; 3], [0.0, crank, 0.0], [0.24, rocker, 0.0], [0.24, 0.0, 0.0]];
    text.beam("crank", "bar", [a, b], 2, "y_axis = [0, 0, 1]");
    text.beam("coupler", "bar", [b, c], choice.whole(2, 4), "y_axis = [0, 0, 1]");
    text.beam("rocker", "bar", [c, d], choice.whole(2, 4), "y_axis = [0, 0, 1]");
    text.joint("crank_pivot", "revolute", ["ground", "crank.start"], HINGE);
    text.joint("elbow", "revolute", ["crank.end", "coupler.start"], HINGE);
    text.joint("knee", "revolute", ["coupler.end", "rocker.start"], &format!("axis = {}", list([tilt, 0.0, 1.0])));
    text.joint("rocker_pivot", "revolute", ["ground", "rocker.end"], HINGE);
    text.drive("motor", "crank_pivot", "angle", &format!("value = \"0.5*(1 - cos({}*t))\"", number(speed)));
    text.watch_motion("joint_place", "coupler.end");
    text.watch("torque", "motor", &["angle", "effort"]);
    text.watch("rocker_load", "rocker_pivot", &["angle", "reaction_force", "reaction_moment"]);
    text.end(step, STEPS, "")
}

/// Three parallel cranks under one coupler: one too many.
fn parallel(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice);
    let thick = choice.between(0.006, 0.012);
    let mut text = Text::new(0.0);
    text.matter(2.07e11, 7800.0, choice.damping());
    text.rectangle("bar", thick, thick);
    let length = 0.2;
    text.beam("coupler", "bar", [[0.0, 0.1, 0.0], [2.0 * length, 0.1, 0.0]], 4, "y_axis = [0, 0, 1]");
    for (number, point) in ["coupler.start", "coupler@0.5", "coupler.end"].into_iter().enumerate() {
        let place = length * number as f64;
        let own = format!("crank{number}");
        text.beam(&own, "bar", [[place, 0.0, 0.0], [place, 0.1, 0.0]], 2, "y_axis = [0, 0, 1]");
        text.joint(&format!("foot{number}"), "revolute", ["ground", &format!("{own}.start")], HINGE);
        text.joint(&format!("top{number}"), "revolute", [&format!("{own}.end"), point], HINGE);
    }
    text.drive("motor", "foot0", "angle", &format!("value = \"0.4*(1 - cos({}*t))\"", number(speed)));
    text.watch_motion("end_place", "coupler.end");
    text.watch("torque", "motor", &["effort"]);
    text.watch("middle_load", "top1", &["reaction_force"]);
    text.end(step, STEPS, "")
}

/// A scissor lift of one stage: hinges where ball joints would be enough.
fn scissor(choice: &mut Choice) -> String {
    let (angle, length) = (choice.between(0.3, 0.6), choice.between(0.5, 2.0));
    let (width, height) = (length * angle.cos(), length * angle.sin());
    let mass = choice.scale(1.0, 100.0) * length;
    let time = choice.between(1.0, 4.0);
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("arm", 0.01 * length, 0.03 * length);
    let elements = 2 * choice.whole(1, 2);
    text.beam("rising", "arm", [[0.0; 3], [width, 0.0, height]], elements, "");
    text.beam("falling", "arm", [[width, 0.0, 0.0], [0.0, 0.0, height]], elements, "");
    text.body("platform", mass, [0.5 * width, 0.0, height], [0.1 * mass * length * length; 3], "");
    let hinge = "axis = [0, 1, 0]";
    text.joint("foot", "revolute", ["ground", "rising.start"], hinge);
    text.joint("slide", "inline", ["ground", "falling.start"], "axis = [-1, 0, 0]");
    text.joint("cross", "revolute", ["rising@0.5", "falling@0.5"], hinge);
    text.joint("pin", "revolute", ["platform", "falling.end"], hinge);
    text.joint("top_slide", "inline", ["platform", "rising.end"], "axis = [1, 0, 0]");
    let way = choice.between(0.05, 0.2) * length;
    let law = format!("value = \"{}*0.5*(1 - cos(pi*min(1, t/{})))\"", number(way), number(time));
    text.drive("screw", "slide", "distance", &law);
    text.watch_motion("top", "platform");
    text.watch("screw_force", "screw", &["effort"]);
    text.watch("arm_load", "rising@0.25", &["section_force", "section_moment"]);
    text.end(round(1.2 * time / STEPS as f64), STEPS, "initial = \"equilibrium\"")
}

/// A four-bar linkage of rigid bodies and hinges: held more often than round-off can tell.
fn rigid(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice);
    let mut text = Text::new(9.81);
    let (crank, rocker) = (0.1, choice.between(0.15, 0.3));
    let corners = [[0.0; 3], [0.0, crank, 0.0], [0.3, rocker, 0.0], [0.3, 0.0, 0.0]];
    let names = ["crank", "coupler", "rocker"];
    for (number, name) in names.into_iter().enumerate() {
        let middle = [0, 1, 2].map(|axis| 0.5 * (corners[number][axis] + corners[number + 1][axis]));
        text.body(name, 0.5, middle, [1e-3; 3], "");
    }
    // With a ball and a universal joint instead of two hinges the linkage is held once.
    let is_held_once = choice.pick(&[true, false]);
    let kinds = if is_held_once { ["revolute", "spherical", "universal", "revolute"] } else { ["revolute"; 4] };
    let sides = [["ground", "crank"], ["crank", "coupler"], ["coupler", "rocker"], ["ground", "rocker"]];
    for ((number, sides), kind) in sides.into_iter().enumerate().zip(kinds) {
        let second = if kind == "universal" { "\naxis2 = [1, 0, 0]" } else { "" };
        let axis = if kind == "spherical" { String::new() } else { format!("\n{HINGE}{second}") };
        text.joint(&format!("pin{number}"), kind, sides, &format!("at = {}{axis}", list(corners[number])));
    }
    text.drive("motor", "pin0", "angle", &format!("value = \"0.5*(1 - cos({}*t))\"", number(speed)));
    text.watch_motion("coupler_motion", "coupler");
    text.watch("torque", "motor", &["effort"]);
    text.watch("load", "pin3", &["angle", "reaction_force"]);
    text.end(step, STEPS, "")
}

/// The same with a stiff bushing in place of one hinge.
fn bushed(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice);
    let stiffness = choice.scale(1e4, 1e8);
    let mut text = Text::new(9.81);
    let corners = [[0.0; 3], [0.0, 0.1, 0.0], [0.3, 0.1, 0.0], [0.3, 0.0, 0.0]];
    for (number, name) in ["crank", "coupler", "rocker"].into_iter().enumerate() {
        let middle = [0, 1, 2].map(|axis| 0.5 * (corners[number][axis] + corners[number + 1][axis]));
        text.body(name, 0.5, middle, [1e-3; 3], "");
    }
    text.joint("pin0", "revolute", ["ground", "crank"], &format!("at = {}\n{HINGE}", list(corners[0])));
    text.joint("pin1", "revolute", ["crank", "coupler"], &format!("at = {}\n{HINGE}", list(corners[1])));
    text.joint("pin3", "revolute", ["ground", "rocker"], &format!("at = {}\n{HINGE}", list(corners[3])));
    let damping = choice.pick(&[0.0, 1e-4, 1e-2]) * stiffness;
    let more =
        format!("at = {}\nstiffness = {}\ndamping = {}", list(corners[2]), list([stiffness; 3]), list([damping; 3]));
    text.joint("pad", "bushing", ["coupler", "rocker"], &more);
    text.drive("motor", "pin0", "angle", &format!("value = \"0.6*sin({}*t)\"", number(speed)));
    text.watch_motion("coupler_motion", "coupler");
    text.watch("torque", "motor", &["effort"]);
    text.watch("load", "pad", &["reaction_force"]);
    text.end(step, STEPS, "")
}
