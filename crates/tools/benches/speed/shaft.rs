//! The rotating shaft of the paper, 2.5 s through resonance: what y of the middle costs at the error of the peer.

use crate::peer::Peer;
use crate::runs;
use crate::table::{Amount, Row};
use ancf14_testing::curves::Curves;

const MODEL: &str = include_str!("../../../../models/rotating_shaft.toml");
const REFERENCE: &str = include_str!("../../../../models/rotating_shaft.csv");
const OUTPUT: &str = "[output.middle]\nat = \"shaft@0.5\"\nquantities = [\"displacement\"]\n";

/// Elements and step of the peer, s.
const PEER: [&str; 2] = ["24", "1e-3"];
/// Ours: the largest step tried whose error is not above the peer's and that divides the 2 ms between two values of the reference, with the defaults of all else. 2 elements are
/// never below 39 mm; 4 are at 2.4 mm with 1.25 ms and at 3.2 mm with 1.56 ms.
pub const OWN: [(&str, &str); 2] = [("shaft.elements", "4"), ("simulation.step", "1e-3")];
/// Ours: the cheapest setting tried with the peer's integrator, of 2, 4, 6 elements, steps from 0.25 to 2 ms, tolerances from 1e-8 to 1e-3, which change nothing but the time.
const TUNED: [(&str, &str); 4] = [
    ("shaft.elements", "4"),
    ("simulation.integrator", "generalized_alpha"),
    ("simulation.step", "6.67e-4"),
    ("simulation.tolerance", "1e-3"),
];

/// Steps from one output to the next.
pub const STEPS_AN_OUTPUT: usize = 2;

/// Largest error of `name`, y of the middle, in words.
fn error(curves: &Curves, name: &str) -> String {
    let reference = Curves::read(REFERENCE);
    let error = curves.difference(&curves.column(name), &reference.column("y"), f64::INFINITY);
    format!("{:.2} mm", 1e3 * error)
}

/// The model with only what the error needs.
pub fn model() -> String {
    runs::watching(MODEL, OUTPUT)
}

pub fn rows(peer: Option<&Peer>) -> Vec<Row> {
    let model = model();
    let found = peer.map(|peer| peer.run("shaft", &PEER));
    let other = found.as_ref().map_or_else(String::new, |found| error(&found.curves, "y"));
    let row = |settings: &[(&str, &str)], words: &str, goal: &'static str| Row {
        what: format!("rotating shaft, 2.5 s, 4 elements, {words}: largest error of y"),
        ours: Amount::Time(runs::stepping(&model, settings)),
        peer: found.as_ref().map(|found| (Amount::Time(found.seconds), String::from("24 elements, 2,500 steps"))),
        errors: [error(&Curves::run(&model, settings), "middle.displacement[2]"), other.clone()],
        goal,
    };
    vec![
        row(&OWN, "2,500 steps, defaults of all else", "10 times"),
        row(&TUNED, "3,750 steps, generalized_alpha, tolerance 1e-3", "20 times"),
    ]
}
