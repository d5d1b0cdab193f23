//! What snaps: shallow arches, buckled strips, two-bar trusses, strips that kick out sideways.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::{PI, TAU};

pub(super) const KINDS: [Kind; 4] = [
    Kind::new("arch", 6, arch),
    Kind::new("strip", 6, strip),
    Kind::new("truss", 6, truss),
    Kind::new("sideways", 6, sideways),
];

const STEPS: usize = 800;

/// A shallow arch between hinges; its middle is pressed down until it snaps through.
fn arch(choice: &mut Choice) -> String {
    let (rise, height) = (choice.between(0.02, 0.06), choice.between(0.002, 0.005));
    let first = PI.powi(2) * (2.1e11 / 7850.0_f64 / 12.0).sqrt() * height;
    let step = round(TAU / first / choice.scale(20.0, 150.0));
    let stiffness = 48.0 * 2.1e11 * 0.02 * height.powi(3) / 12.0;
    let load = round(choice.between(1.0, 6.0) * stiffness * rise);
    let mut text = Text::new(0.0);
    text.matter(2.1e11, 7850.0, choice.damping());
    text.rectangle("flat", 0.02, height);
    let line = format!("curve = {{ x = \"s\", y = 0, z = \"{}*sin(pi*s)\", s = [0, 1] }}", number(rise));
    text.line("arch", "flat", 2 * choice.whole(3, 6), &line);
    text.joint("left", "revolute", ["ground", "arch.start"], "axis = [0, 1, 0]");
    text.joint("right", "revolute", ["ground", "arch.end"], "axis = [0, 1, 0]");
    let law = format!("-{}*min(1, t/{})", number(load), number(0.7 * STEPS as f64 * step));
    text.load("press", "arch@0.5", &format!("force = [0, 0, \"{law}\"]"));
    text.watch_motion("crown", "arch@0.5");
    text.watch("hinge", "left", &["angle", "reaction_force"]);
    text.watch("middle", "arch.start", &["section_force"]);
    text.end(step, STEPS, "")
}

/// A strip is pressed together until it buckles, and a force flips it over.
fn strip(choice: &mut Choice) -> String {
    let height = choice.between(0.001, 0.003);
    let first = 22.4 * (2.1e11 / 7850.0_f64 / 12.0).sqrt() * height;
    let step = round(TAU / first / choice.scale(20.0, 100.0));
    let span = STEPS as f64 * step;
    let mut text = Text::new(0.0);
    text.matter(2.1e11, 7850.0, choice.pick(&[1e-5, 1e-4]));
    text.rectangle("flat", 0.02, height);
    text.beam("strip", "flat", [[0.0; 3], [1.0, 0.0, 0.0]], 2 * choice.whole(3, 5), "");
    text.joint("clamp", "weld", ["ground", "strip.start"], "");
    text.joint("press", "prismatic", ["ground", "strip.end"], "axis = [-1, 0, 0]");
    let way = choice.between(0.002, 0.01);
    let law = format!("value = \"{}*0.5*(1 - cos(pi*min(1, t/{})))\"", number(way), number(0.4 * span));
    text.drive("ram", "press", "distance", &law);
    let stiffness = 192.0 * 2.1e11 * 0.02 * height.powi(3) / 12.0;
    let (small, large) = (number(stiffness * 1e-3), number(choice.between(0.01, 0.06) * stiffness));
    let half = number(0.5 * span);
    let law = format!("[{{ until = {half}, is = {small} }}, {{ is = \"-{large}*(t - {half})/{half}\" }}]");
    text.load("finger", "strip@0.5", &format!("force = [0, 0, {law}]"));
    text.watch_motion("middle", "strip@0.5");
    text.watch("ram_force", "ram", &["effort"]);
    text.watch("clamp_load", "clamp", &["reaction_force", "reaction_moment"]);
    text.end(step, STEPS, "")
}

/// Two springs and a mass snap through and swing on the other side.
fn truss(choice: &mut Choice) -> String {
    let (mass, stiffness, rise) = (choice.scale(0.1, 10.0), choice.scale(1e3, 1e6), choice.between(0.05, 0.4));
    let rate = (2.0 * stiffness * rise * rise / mass).sqrt();
    let step = round(TAU / rate / choice.scale(20.0, 300.0));
    // The largest force that both springs bear, for small rises: k rise^3 2/(3 sqrt(3)).
    let limit = 0.385 * stiffness * rise.powi(3);
    let mut text = Text::new(0.0);
    text.body("mass", mass, [0.0, 0.0, rise], [0.01 * mass; 3], "");
    text.joint("rail", "prismatic", ["ground", "mass"], "axis = [0, 0, 1]");
    for (name, place) in [("left", -1.0), ("right", 1.0)] {
        text.add(&format!("frame.{name}_foot"), &format!("position = {}", list([place, 0.0, 0.0])));
        let foot = format!("{name}_foot");
        let damping = choice.pick(&[0.0, 0.05]) * (stiffness * mass).sqrt();
        text.spring(&format!("{name}_bar"), [&foot, "mass"], [stiffness, damping], "");
    }
    let law = format!("-{}*min(1, t/{})", number(choice.between(0.9, 1.5) * limit), number(200.0 * step));
    text.load("press", "mass", &format!("force = [0, 0, \"{law}\"]"));
    text.watch_motion("motion", "mass");
    text.watch("foot", "left_foot", &["reaction_force"]);
    text.end(step, STEPS, "")
}

/// An upright strip is loaded in its stiff direction until it falls sideways; a small force across is its imperfection.
fn sideways(choice: &mut Choice) -> String {
    let (length, height, width) = (choice.between(0.5, 1.0), choice.between(0.03, 0.06), choice.between(0.002, 0.004));
    let (bending, torsion) = (2.1e11 * height * width.powi(3) / 12.0, 8.1e10 * height * width.powi(3) / 3.0);
    let critical = 4.01 * (bending * torsion).sqrt() / length.powi(2);
    let first = 3.516 * (2.1e11 / 7850.0_f64 / 12.0).sqrt() * width / length.powi(2);
    let step = round(TAU / first / choice.scale(40.0, 300.0));
    let mut text = Text::new(0.0);
    text.matter(2.1e11, 7850.0, choice.pick(&[0.0, 1e-5, 1e-4]));
    text.rectangle("upright", width, height);
    text.beam("strip", "upright", [[0.0; 3], [length, 0.0, 0.0]], choice.whole(4, 8), "");
    text.joint("root", "weld", ["ground", "strip.start"], "");
    let (across, down) = (number(1e-3 * critical), number(choice.between(0.8, 1.3) * critical));
    let ramp = number(400.0 * step);
    text.load("tip_load", "strip.end", &format!("force = [0, {across}, \"-{down}*min(1, t/{ramp})\"]"));
    text.watch_motion("tip", "strip.end");
    text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    text.end(step, STEPS, "")
}
