//! The elastica against elliptic integrals.

use super::{Section, dots, line, plot, points, shapes, study};
use ancf14_testing::curves::Curves;

pub const MODEL: &str = include_str!("../../../../models/elastica.toml");
pub const REFERENCE: &str = include_str!("../../../../tests/references/elastica.csv");

fn run(elements: u32, twist: &str) -> Curves {
    Curves::run(MODEL, &[("strip.elements", &elements.to_string()), ("strip.twist", twist)])
}

/// The row of the run at the load `load`.
fn row(curves: &Curves, load: f64) -> usize {
    curves.time.iter().position(|time| (time - load).abs() < 1e-9).unwrap()
}

pub fn write(section: &mut Section) {
    section.say(
        "A thin cantilever under a dead force across its drawn direction (`models/elastica.toml`): 15 loads up to P L^2 = 10 EI. It is bent in a \
         plane, so that the twist does not matter.\n\n\
         Reference: elliptic integrals (Bisshopp and Drucker 1945), for a strip that does not stretch (`tests/references/elastica.csv`); this one, \
         of a thickness of 1/1000 of its length, stretches by less than 1e-6.",
    );
    let reference = Curves::read(REFERENCE);
    let (sunk, back) = (reference.column("w_over_L"), reference.column("u_over_L"));
    let curves = run(8, "linear");
    let negative: Vec<f64> = curves.column("tip.displacement[1]").iter().map(|x| -x).collect();
    let lines = vec![
        line("across, 8 elements", 0, points(&curves.time, &curves.column("tip.displacement[2]"), 1)),
        dots("across, exact", 0, points(&reference.time, &sunk, 1)),
        line("along, 8 elements", 1, points(&curves.time, &negative, 1)),
        dots("along, exact", 1, points(&reference.time, &back, 1)),
    ];
    section.picture("elastica", plot("Elastica: displacement of the tip", ["P L^2 / EI", "displacement / L"], lines));
    let shape = |load: f64| -> Vec<(f64, f64)> {
        let row = row(&curves, load);
        let place = |k: usize, axis: usize| curves.column(&format!("shape.position[{k},{axis}]"))[row];
        (1..=33).map(|k| (place(k, 1), place(k, 2))).collect()
    };
    let lines = [0.0, 1.0, 2.0, 5.0, 10.0].into_iter().enumerate();
    let lines = lines.map(|(color, load)| line(&format!("P L^2 / EI = {load}"), color, shape(load))).collect();
    section.picture("elastica_shapes", shapes("Elastica: 8 elements", ["x (m)", "y (m)"], lines));
    section.say("Largest distance of the tip from where it should be, over 15 loads, relative to the length:");
    let error = |elements: u32, twist: &str| {
        let curves = run(elements, twist);
        let [x, y] = ["tip.displacement[1]", "tip.displacement[2]"].map(|name| curves.column(name));
        let distance = |k: usize| {
            let row = row(&curves, reference.time[k]);
            (x[row] + back[k]).hypot(y[row] - sunk[k])
        };
        (0..reference.time.len()).map(distance).fold(0.0, f64::max)
    };
    // The reference has eight decimals: 16 elements are the last that it can tell.
    section.say(&study::twists(&[2, 4, 8, 16], error));
}
