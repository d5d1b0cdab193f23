//! What begins long after t = 0, where times a step apart have few digits that differ.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::TAU;

pub(super) const KINDS: [Kind; 4] = [
    Kind::new("cantilever", 6, cantilever),
    Kind::new("crank", 6, crank),
    Kind::new("table", 6, table),
    Kind::new("top", 6, top),
];

/// When these machines begin, s.
pub(super) const START: f64 = 1e6;

const STEPS: usize = 500;
/// Time since the start, as an expression.
const SINCE: &str = "(t - 1e6)";

/// A cantilever under a load that begins to swing.
fn cantilever(choice: &mut Choice) -> String {
    let height = choice.between(0.004, 0.01);
    let rate = 3.516 * 5.2e3 * height / 12.0_f64.sqrt();
    let mut text = Text::new(choice.pick(&[0.0, 9.81]));
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", 2.0 * height, height);
    text.beam("arm", "flat", [[0.0; 3], [1.0, 0.0, 0.0]], choice.whole(4, 8), "");
    text.joint("root", "weld", ["ground", "arm.start"], "");
    let force = format!(
        "{}*sin({}*{SINCE})",
        number(1e8 * height.powi(4) * 100.0),
        number(round(rate * choice.between(0.2, 0.9)))
    );
    text.load("tip_load", "arm.end", &format!("force = [0, 0, \"{force}\"]"));
    text.watch_motion("tip", "arm.end");
    text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    text.end_from(START, round(TAU / rate / choice.scale(40.0, 200.0)), STEPS, "")
}

/// A crank runs up and swings a flexible rod.
fn crank(choice: &mut Choice) -> String {
    let (speed, length) = (choice.scale(2.0, 30.0), choice.between(0.2, 0.6));
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, choice.pick(&[1e-5, 1e-4]));
    text.rectangle("bar", 0.01, 0.006);
    text.body("crank", 1.0, [0.05, 0.0, 0.0], [1e-3; 3], "");
    text.beam("rod", "bar", [[0.1, 0.0, 0.0], [0.1 + length, 0.0, 0.0]], choice.whole(3, 6), "");
    text.joint("pivot", "revolute", ["ground", "crank"], "at = [0, 0, 0]\naxis = [0, 1, 0]");
    text.joint("pin", "revolute", ["crank", "rod.start"], "axis = [0, 1, 0]");
    text.drive(
        "motor",
        "pivot",
        "angle",
        &format!("rate = \"{}*min(1, {SINCE}*{})\"", number(speed), number(0.3 * speed)),
    );
    text.watch_motion("tip", "rod.end");
    text.watch("torque", "motor", &["angle", "effort"]);
    text.end_from(START, round(TAU / speed / choice.scale(100.0, 1000.0)), STEPS, "")
}

/// A mass on springs stands on a table that shakes.
fn table(choice: &mut Choice) -> String {
    let (mass, rate) = (choice.scale(0.1, 100.0), choice.scale(1.0, 300.0));
    let stiffness = round(mass * rate * rate);
    let shake = format!("\"0.01*sin({}*{SINCE})\"", number(round(rate * choice.between(0.3, 3.0))));
    let mut text = Text::new(9.81);
    text.add("frame.table", &format!("position = [{shake}, 0, {shake}]"));
    text.body("load", mass, [0.0, 0.0, 0.5], [0.1 * mass; 3], "");
    let damping = round(choice.between(0.0, 0.3) * mass * rate);
    let bush = format!("stiffness = {}\ndamping = {}", list([stiffness; 3]), list([damping; 3]));
    let turning = format!("rotational_stiffness = {}", list([stiffness; 3]));
    text.joint("mount", "bushing", ["table", "load"], &format!("at = [0, 0, 0.4]\n{bush}\n{turning}"));
    text.watch("motion", "load", &["displacement", "velocity"]);
    text.watch("foot", "table", &["reaction_force"]);
    text.end_from(START, round(TAU / rate / choice.scale(30.0, 300.0)), STEPS, "")
}

/// A top precesses.
fn top(choice: &mut Choice) -> String {
    let speed = choice.scale(50.0, 300.0);
    let mut text = Text::new(9.81);
    let lean = choice.between(0.1, 0.5);
    let turning = list([speed * lean, 0.0, speed]);
    let axes =
        format!("axes = [[{c}, 0, -{s}], [0, 1, 0], [{s}, 0, {c}]]", c = lean.atan().cos(), s = lean.atan().sin());
    let place = [0.05 * lean.atan().sin(), 0.0, 0.05 * lean.atan().cos()];
    text.body("rotor", 0.2, place, [1e-4, 1e-4, 1.6e-4], &format!("{axes}\nangular_velocity = {turning}"));
    text.joint("tip", "spherical", ["ground", "rotor"], "at = [0, 0, 0]");
    text.watch("motion", "rotor", &["position", "velocity", "angular_velocity"]);
    text.watch("tip_load", "tip", &["reaction_force"]);
    text.end_from(START, round(TAU / speed / choice.scale(20.0, 100.0)), STEPS, "")
}
