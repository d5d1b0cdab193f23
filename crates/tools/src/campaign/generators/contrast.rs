//! What is stiff beside what is soft: Young's moduli, springs and dampers over ten powers of ten in one machine.

use super::Kind;
use super::choice::{Choice, round};
use super::text::{Text, list, number};
use std::f64::consts::TAU;

pub(super) const KINDS: [Kind; 4] = [
    Kind::new("beams", 6, beams),
    Kind::new("springs", 6, springs),
    Kind::new("dampers", 6, dampers),
    Kind::new("bushing", 6, bushing),
];

const STEPS: usize = 500;

/// A soft beam carries a stiff one, or the other way round.
fn beams(choice: &mut Choice) -> String {
    let (soft, stiff) = (choice.scale(1e6, 1e8), choice.scale(1e9, 1e12));
    let order = choice.pick(&[[soft, stiff], [stiff, soft]]);
    let mut text = Text::new(9.81);
    for (name, young) in ["inner", "outer"].into_iter().zip(order) {
        text.material(&format!("{name}_matter"), young, 1500.0, choice.pick(&[0.0, 1e-3]));
    }
    text.rectangle("bar", 0.03, 0.03);
    for (name, place) in [("inner", 0.0), ("outer", 0.2)] {
        let ends = format!("from = {}\nto = {}", list([place, 0.0, 0.0]), list([place + 0.2, 0.0, 0.0]));
        let entries = format!("material = \"{name}_matter\"\nsection = \"bar\"\n{ends}\nelements = 4");
        text.add(&format!("beam.{name}"), &entries);
    }
    text.joint("root", "weld", ["ground", "inner.start"], "");
    text.joint("seam", "weld", ["inner.end", "outer.start"], "");
    text.watch_motion("tip", "outer.end");
    text.watch("seam_load", "seam", &["reaction_force", "reaction_moment"]);
    text.watch("root_load", "root", &["reaction_force", "reaction_moment"]);
    let rate = (soft / 1500.0).sqrt() * 0.03 / 12.0_f64.sqrt() / 0.16 * 3.516;
    text.end(round(TAU / rate / choice.scale(50.0, 300.0)), STEPS, "")
}

/// Three masses in a row on springs from soft to stiff.
fn springs(choice: &mut Choice) -> String {
    let softest = choice.scale(1.0, 1e3);
    let ratio = choice.scale(1e2, 1e5);
    let mut text = Text::new(0.0);
    let mut before = String::from("wall");
    text.add("frame.wall", "position = [0, 0, 0]");
    for (number, stiffness) in [ratio * ratio, 1.0, ratio].map(|factor| round(factor * softest)).into_iter().enumerate()
    {
        let own = format!("mass{number}");
        let place = 1.0 + number as f64;
        let speed = if number == 2 { "velocity = [0.3, 0, 0]" } else { "" };
        text.body(&own, 1.0, [place, 0.0, 0.0], [0.1; 3], speed);
        text.joint(&format!("rail{number}"), "prismatic", ["ground", &own], "axis = [1, 0, 0]");
        text.spring(&format!("spring{number}"), [&before, &own], [stiffness, 0.0], "");
        before = own;
    }
    text.load(
        "push",
        "mass1",
        &format!("force = [\"{}*sin({}*t)\", 0, 0]", number(0.1 * softest), number(round(0.6 * softest.sqrt()))),
    );
    for name in ["mass0", "mass2"] {
        text.watch(&format!("{name}_motion"), name, &["displacement", "velocity"]);
    }
    text.watch("wall_load", "wall", &["reaction_force"]);
    text.end(round(TAU / softest.sqrt() / choice.scale(50.0, 300.0)), STEPS, "")
}

/// A mass between a spring and a damper, from nearly free to nearly stuck.
fn dampers(choice: &mut Choice) -> String {
    let (mass, stiffness) = (choice.scale(0.1, 10.0), choice.scale(10.0, 1e5));
    let rate = (stiffness / mass).sqrt();
    let damping = round(mass * rate * choice.scale(1e-3, 1e7));
    let mut text = Text::new(0.0);
    text.body("mass", mass, [1.0, 0.0, 0.0], [0.1 * mass; 3], &format!("velocity = {}", list([rate * 0.1, 0.0, 0.0])));
    text.joint("rail", "prismatic", ["ground", "mass"], "axis = [1, 0, 0]");
    text.spring("pull", ["ground", "mass"], [stiffness, damping], "length = 0.8");
    text.watch("motion", "mass", &["displacement", "velocity"]);
    text.end(round(TAU / rate / choice.scale(30.0, 300.0)), STEPS, "")
}

/// A beam on a bushing, from as soft as rubber to as stiff as a weld, with a damper.
fn bushing(choice: &mut Choice) -> String {
    let stiffness = choice.scale(1e3, 1e12);
    let mut text = Text::new(9.81);
    text.matter(2.1e11, 7850.0, 0.0);
    text.rectangle("flat", 0.02, 0.008);
    text.beam("arm", "flat", [[0.0; 3], [0.6, 0.0, 0.0]], choice.whole(4, 8), "");
    let damping = round(stiffness * choice.scale(1e-7, 1e-2));
    let translation = format!("stiffness = {}\ndamping = {}", list([stiffness; 3]), list([damping; 3]));
    let turning = [stiffness, damping].map(|value| list([round(1e-3 * value); 3]));
    let rotation = format!("rotational_stiffness = {}\nrotational_damping = {}", turning[0], turning[1]);
    text.joint("mount", "bushing", ["ground", "arm.start"], &format!("{translation}\n{rotation}"));
    text.watch_motion("tip", "arm.end");
    text.watch("mount_load", "mount", &["reaction_force", "reaction_moment"]);
    text.end(round(1e-3 * choice.scale(0.2, 2.0)), STEPS, "")
}
