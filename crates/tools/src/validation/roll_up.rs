//! A cantilever rolled up to a circle by an end moment: the end must meet the start.

use super::{Section, line, shapes, study};
use ancf14_testing::curves::Curves;
use std::f64::consts::TAU;

pub const MODEL: &str = include_str!("../../../../models/roll_up.toml");

fn run(elements: u32, twist: &str) -> Curves {
    Curves::run(MODEL, &[("strip.elements", &elements.to_string()), ("strip.twist", twist)])
}

pub fn write(section: &mut Section) {
    section.say(
        "A cantilever under an end moment is an arc of a circle; M = 2 pi EI / L closes it exactly (`models/roll_up.toml`). The formula is its own \
         reference: the distance between end and start is the error.",
    );
    let curves = run(16, "linear");
    let mut lines = Vec::new();
    for (color, share) in [0.25, 0.5, 0.75, 1.0].into_iter().enumerate() {
        let row = curves.time.iter().position(|time| (time - share).abs() < 1e-9).unwrap();
        let place = |k: usize, axis: usize| curves.column(&format!("shape.position[{k},{axis}]"))[row];
        let own = (1..=33).map(|k| (place(k, 1), place(k, 2))).collect();
        lines.push(super::dots(&format!("{share} turns, 16 elements"), color, own));
        let arc = |s: f64| {
            let turn = TAU * share;
            ((turn * s).sin() / turn, (1.0 - (turn * s).cos()) / turn)
        };
        lines.push(line(
            &format!("{share} turns, exact"),
            color,
            (0..=100).map(|k| arc(f64::from(k) / 100.0)).collect(),
        ));
    }
    section.picture("roll_up", shapes("Cantilever rolled up", ["x (m)", "y (m)"], lines));
    section.say("Distance of the end from the start at a full turn, relative to the length:");
    let error = |elements: u32, twist: &str| {
        let curves = run(elements, twist);
        curves.last("tip.position[1]").hypot(curves.last("tip.position[2]"))
    };
    section.say(&study::twists(&[4, 8, 16, 32], error));
}
