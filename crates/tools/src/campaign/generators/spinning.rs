//! What spins: free strips, shafts, blades, rotors with disks, rigid bodies; 20 to 2000 steps a turn.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::TAU;

/// Spinning flat beams gain energy with the midpoint rules the sooner the finer the mesh is, so that refinement does
/// not find the truth; generalized-alpha keeps the energy of all of them (`machines/conserving_flat_shaft.toml`,
/// `machines/conserving_spinning_strip.toml`).
const JUDGE: Option<&str> = Some("generalized_alpha");

pub(super) const KINDS: [Kind; 5] = [
    Kind { judge: JUDGE, ..Kind::new("strip", 6, strip) },
    Kind { judge: JUDGE, ..Kind::new("shaft", 6, shaft) },
    Kind { judge: JUDGE, ..Kind::new("blade", 6, blade) },
    Kind::new("rotor", 5, rotor),
    Kind::new("body", 5, body),
];

/// Steps of all runs of this group: an instability needs time to show.
const STEPS: usize = 1200;

/// A speed, rad/s, and a step, s.
fn pace(choice: &mut Choice, slowest: f64, fastest: f64) -> (f64, f64) {
    let (speed, turn) = (choice.scale(slowest, fastest), choice.scale(20.0, 2000.0));
    (speed, round(TAU / (speed * turn)))
}

/// The law of a motor that runs up in the first quarter of the run.
fn run_up(speed: f64, step: f64) -> String {
    format!("rate = \"{}*min(1, t/{})\"", number(speed), number(0.25 * STEPS as f64 * step))
}

/// A free strip spins about its axis and tumbles slowly.
fn strip(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice, 20.0, 300.0);
    let (length, height) = (choice.between(0.4, 1.0), choice.between(0.002, 0.006));
    let mut text = Text::new(0.0);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", choice.between(1.0, 6.0) * height, height);
    let spin = format!("angular_velocity = {}", list([speed, 0.0, choice.between(0.01, 0.1) * speed]));
    text.beam("strip", "flat", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(4, 10), &spin);
    text.watch("middle", "strip@0.5", &["position", "velocity", "angular_velocity", "section_moment"]);
    text.watch_motion("tip", "strip.end");
    text.end(step, STEPS, "")
}

/// A shaft between two bearings runs up under its weight and goes on at a speed below its first critical speed.
fn shaft(choice: &mut Choice) -> String {
    let (length, height) = (choice.between(0.5, 2.0), choice.between(0.01, 0.03));
    let critical = (std::f64::consts::PI / length).powi(2) * (2.1e11 / 7850.0_f64 / 12.0).sqrt() * height;
    let (speed, step) = pace(choice, 0.05 * critical, 0.6 * critical);
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", choice.pick(&[1.0, 2.0, 3.0]) * height, height);
    text.beam("shaft", "flat", [[0.0; 3], [length, 0.0, 0.0]], 2 * choice.whole(2, 5), "");
    text.joint("motor", "revolute", ["ground", "shaft.start"], "axis = [1, 0, 0]");
    text.joint("bearing", "cylindrical", ["ground", "shaft.end"], "axis = [1, 0, 0]");
    text.drive("run", "motor", "angle", &run_up(speed, step));
    text.watch("middle", "shaft@0.5", &["displacement", "velocity", "section_moment"]);
    text.watch("effort", "run", &["effort"]);
    text.watch("bearing_load", "bearing", &["reaction_force"]);
    text.end(step, STEPS, "initial = \"equilibrium\"")
}

/// A blade turns about a mast at constant speed; a gust along the mast bends it.
fn blade(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice, 5.0, 60.0);
    let length = choice.between(1.0, 8.0);
    let mut text = Text::new(0.0);
    text.matter(7e10, 2700.0, choice.damping());
    text.rectangle("spar", 0.05 * length, choice.between(0.004, 0.008) * length);
    let more =
        format!("angular_velocity = {}\npretwist = {}", list([0.0, 0.0, speed]), choice.pick(&["0", "0", "0.2"]));
    text.beam("blade", "spar", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(4, 10), &more);
    text.joint("mast", "revolute", ["ground", "blade.start"], "axis = [0, 0, 1]");
    text.drive("engine", "mast", "angle", &format!("rate = {}", number(speed)));
    let gust = choice.between(1.0, 20.0) * length * length;
    text.load(
        "gust",
        "blade.end",
        &format!("force = [0, 0, \"{}*sin({}*t)\"]", number(gust), number(choice.between(0.5, 3.0) * speed)),
    );
    text.watch_motion("tip", "blade.end");
    text.watch("root", "blade.start", &["section_force", "section_moment"]);
    text.end(step, STEPS, "")
}

/// A disk off its axis on a flexible round shaft.
fn rotor(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice, 30.0, 300.0);
    let (radius, mass) = (choice.between(0.01, 0.02), choice.between(2.0, 20.0));
    let off = choice.scale(1e-5, 1e-3);
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.circle("round", radius);
    text.beam("shaft", "round", [[0.0; 3], [1.0, 0.0, 0.0]], 2 * choice.whole(2, 4), "");
    text.body("disk", mass, [0.5, 0.0, off], [0.02 * mass, 0.01 * mass, 0.01 * mass], "");
    text.joint("bearing", "revolute", ["ground", "shaft.start"], "axis = [1, 0, 0]");
    text.joint("slide", "cylindrical", ["ground", "shaft.end"], "axis = [1, 0, 0]");
    text.joint("hub", "weld", ["shaft@0.5", "disk"], "at = [0.5, 0, 0]");
    text.drive("motor", "bearing", "angle", &run_up(speed, step));
    text.watch("wheel", "disk", &["position", "velocity", "angular_velocity"]);
    text.watch("torque", "motor", &["effort"]);
    text.watch("slide_load", "slide", &["reaction_force"]);
    text.end(step, STEPS, "initial = \"equilibrium\"")
}

/// A free rigid body tumbles, or a top precesses.
fn body(choice: &mut Choice) -> String {
    let (speed, step) = pace(choice, 5.0, 200.0);
    let is_top = choice.pick(&[false, true]);
    let moments =
        [choice.between(1.0, 1.4), choice.between(1.0, 1.4), choice.between(1.5, 2.0)].map(|moment| 1e-3 * moment);
    let mut text = Text::new(if is_top { 9.81 } else { 0.0 });
    let turning =
        list([choice.between(0.02, 0.2) * speed, choice.between(0.0, 1.0) * speed, choice.between(0.2, 1.0) * speed]);
    text.body("rotor", 0.5, [0.0, 0.0, 0.1], moments, &format!("angular_velocity = {turning}"));
    if is_top {
        text.joint("tip", "spherical", ["ground", "rotor"], "at = [0, 0, 0]");
        text.watch("tip_load", "tip", &["reaction_force"]);
    }
    text.watch("rotor_motion", "rotor", &["position", "quaternion", "velocity", "angular_velocity"]);
    text.end(step, STEPS, "")
}
