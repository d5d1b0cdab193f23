//! Natural frequencies of a cantilever against the formulas for bending, torsion and stretching.

use super::{Section, study};
use ancf14::fmi::Model;
use ancf14::model::modes::Motion;
use ancf14_testing::curves::load;
use std::f64::consts::PI;

const MODEL: &str = include_str!("swinging_cantilever.toml");

/// Roots of `cos x cosh x = −1`.
const ROOTS: [f64; 3] = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613];

/// Kinds of modes, by what they move at the end.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Stretching,
    SoftBending,
    StiffBending,
    Torsion,
}

/// Angular frequencies of each kind by rising size, and those of the formulas, rad/s.
struct Frequencies {
    found: Vec<(Kind, f64)>,
    bending: f64,
    torsion: f64,
    stretching: f64,
}

fn frequencies(elements: u32, twist: &str) -> Frequencies {
    let simulation = load(MODEL, &[("bar.elements", &elements.to_string()), ("bar.twist", twist)]);
    let value = |name: &str| {
        let place = simulation.variables().iter().position(|variable| variable.name == name).unwrap();
        simulation.value(place).number()
    };
    let (width, height) = (value("flat.width"), value("flat.height"));
    let polar = width * height * (width * width + height * height) / 12.0;
    let wave = PI / (2.0 * value("bar.to[1]"));
    let kind = |end: &Motion| {
        let sizes = [end.displacement[0], end.displacement[1], end.displacement[2], end.turn[0]].map(f64::abs);
        let largest = (0..4).max_by(|a, b| sizes[*a].total_cmp(&sizes[*b])).unwrap();
        [Kind::Stretching, Kind::SoftBending, Kind::StiffBending, Kind::Torsion][largest]
    };
    let modes = simulation.modes(7 * elements as usize).unwrap_or_else(|failure| panic!("{}", failure.message)).modes;
    Frequencies {
        found: modes.iter().map(|mode| (kind(&mode.motions[elements as usize]), mode.eigenvalue.sqrt())).collect(),
        bending: (value("metal.young") * width * width / (12.0 * value("metal.density"))).sqrt()
            / value("bar.to[1]").powi(2),
        torsion: wave
            * (value("metal.shear") * value("flat.torsion_constant") / (value("metal.density") * polar)).sqrt(),
        stretching: wave * (value("metal.young") / value("metal.density")).sqrt(),
    }
}

pub fn write(section: &mut Section) {
    section.say(
        "A cantilever of rectangular section (`crates/tools/src/validation/swinging_cantilever.toml`) without rotary inertia, modes about its drawn state. References: bending x_k^2 sqrt(EI/(m L^4)) with \
         cos x cosh x = -1, here in the soft direction; torsion pi/(2L) sqrt(G Jt/(rho Ip)); stretching pi/(2L) sqrt(E/rho). Relative errors. The internal coordinate of the \
         quadratic twist has no inertia: torsional frequencies keep order 2, and all others are the same with both.",
    );
    let counts = [2, 4, 8, 16];
    for twist in study::TWISTS {
        section.say(&format!("*{twist} twist*"));
        let all = counts.map(|elements| frequencies(elements, twist));
        let error = |kind: Kind, number: usize, exact: fn(&Frequencies) -> f64| {
            let errors = all.iter().map(|own| {
                let mut of_kind = own.found.iter().filter(|found| found.0 == kind);
                (of_kind.nth(number).unwrap().1 / exact(own) - 1.0).abs()
            });
            errors.collect::<Vec<_>>()
        };
        let columns = [
            (String::from("first bending"), error(Kind::SoftBending, 0, |own| ROOTS[0].powi(2) * own.bending)),
            (String::from("second"), error(Kind::SoftBending, 1, |own| ROOTS[1].powi(2) * own.bending)),
            (String::from("third"), error(Kind::SoftBending, 2, |own| ROOTS[2].powi(2) * own.bending)),
            (String::from("torsion"), error(Kind::Torsion, 0, |own| own.torsion)),
            (String::from("stretching"), error(Kind::Stretching, 0, |own| own.stretching)),
        ];
        section.say(&study::table("elements", &counts.map(f64::from), &columns));
    }
}
