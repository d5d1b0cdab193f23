//! Michell's ring: the twist at which a closed ring leaves its plane.

use super::{Section, critical, line, plot, study};
use ancf14::fmi::Model;
use ancf14_testing::curves::load;
use std::f64::consts::{PI, TAU};

pub const MODEL: &str = include_str!("../../../../models/ring.toml");

pub fn write(section: &mut Section) {
    section.say(
        "A straight, round rod is bent to a closed ring and twisted (`models/ring.toml`). At a total twist of 2 pi sqrt(3) EI/GJ the ring leaves its plane \
         (Michell 1889, Zajac 1962). The run itself warns of the buckling; here the twist at which the lowest eigenvalue of the tangent stiffness passes zero:",
    );
    let error = |elements: u32, twist: &str| {
        let elements = elements.to_string();
        let (time, poisson, turns) = {
            let overrides = [("rod.elements", elements.as_str()), ("rod.twist", twist)];
            let simulation = load(MODEL, &overrides);
            let value = |name: &str| {
                let place = simulation.variables().iter().position(|variable| variable.name == name).unwrap();
                simulation.value(place).number()
            };
            (critical::time(MODEL, &overrides, [1.5, 2.0]), value("steel.poisson"), value("turns"))
        };
        // EI/GJ of a circle is 1 + poisson.
        let exact = TAU * 3.0_f64.sqrt() * (1.0 + poisson);
        (2.0 * PI * turns * (time - 1.0) / exact - 1.0).abs()
    };
    section.say(&study::twists(&[6, 8, 12, 16, 24], error));
    let mut simulation = load(MODEL, &[("rod.elements", "12")]);
    let (mut twists, mut lowest) = (Vec::new(), Vec::new());
    for step in 1..=100 {
        let time = 0.02 * f64::from(step);
        simulation.advance(time).unwrap_or_else(|failure| panic!("{}", failure.message));
        if time >= 1.0 {
            let modes = simulation.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
            twists.push(2.5 * (time - 1.0));
            lowest.push([0, 1, 2].map(|k| modes[k].eigenvalue));
        }
    }
    let curve = |k: usize| twists.iter().copied().zip(lowest.iter().map(|own| own[k])).collect();
    let lines = (0..3).map(|k| line(&format!("mode {}", k + 1), k, curve(k))).collect();
    let axes = ["turns of the end", "square of the angular frequency (1/s2)"];
    section.picture("ring", plot("Twisted ring: lowest modes, 12 elements", axes, lines));
}
