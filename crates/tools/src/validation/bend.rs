//! The 45-degree bend of Bathe and Bolourchi against the exact rod.

use super::{Section, dots, line, plot, points, study};
use ancf14::math::Vec3;
use ancf14_testing::curves::Curves;

pub const MODEL: &str = include_str!("../../../../models/bend_45.toml");
pub const REFERENCE: &str = include_str!("../../../../tests/references/bend_45_degrees.csv");

fn run(elements: u32, twist: &str, constant: f64) -> Curves {
    let (elements, constant) = (elements.to_string(), constant.to_string());
    Curves::run(MODEL, &[("arc.elements", &elements), ("arc.twist", twist), ("square.torsion_constant", &constant)])
}

/// Place of the end under the load `load`, m.
fn end(curves: &Curves, load: f64) -> Vec3 {
    let largest = curves.last("P");
    let row = curves.time.iter().position(|time| (time * largest - load).abs() < 1e-6 * largest).unwrap();
    Vec3::from_fn(|axis, _| curves.column(&format!("end.position[{}]", axis + 1))[row])
}

pub fn write(section: &mut Section) {
    section.say(
        "Not in the paper, but in most others since Bathe and Bolourchi (1979): an arc of 45 degrees, clamped, under a dead load across its plane \
         (`models/bend_45.toml`, in the numbers of the source). Bending and torsion act together from the first.\n\n\
         Reference: the Euler-Bernoulli rod by shooting (`tests/references/bend_45_degrees.csv`), for the torsion constant of a square and for the polar moment, \
         which other programs take.",
    );
    let reference = Curves::read(REFERENCE);
    let [constants, loads, x, y, z] = ["J", "P", "x", "y", "z"].map(|name| reference.column(name));
    let curves = run(8, "quadratic", constants[0]);
    let force: Vec<f64> = curves.time.iter().map(|time| time * curves.last("P")).collect();
    let own = |k: &usize| constants[*k] == constants[0];
    let rows: Vec<usize> = (0..loads.len()).filter(own).collect();
    let mut lines = Vec::new();
    for (color, (name, exact)) in [("x", &x), ("y", &y), ("z", &z)].into_iter().enumerate() {
        let found = points(&force, &curves.column(&format!("end.position[{}]", color + 1)), 1);
        lines.push(line(&format!("{name}, 8 elements"), color, found));
        lines.push(dots(&format!("{name}, exact"), color, rows.iter().map(|k| (loads[*k], exact[*k])).collect()));
    }
    section.picture("bend_45", plot("45-degree bend: place of the end", ["load", "x, y, z"], lines));
    section.say("Largest distance of the end from where it should be, over three loads and both torsion constants, relative to its distance from the root:");
    let error = |elements: u32, twist: &str| {
        let mut largest = 0.0_f64;
        let mut distinct = constants.clone();
        distinct.dedup();
        for constant in distinct {
            let curves = run(elements, twist, constant);
            for k in (0..loads.len()).filter(|k| constants[*k] == constant) {
                let exact = Vec3::new(x[k], y[k], z[k]);
                largest = largest.max((end(&curves, loads[k]) - exact).norm() / exact.norm());
            }
        }
        largest
    };
    section.say(&study::twists(&[2, 4, 8, 16], error));
    section.say(
        "Largest error of `section_moment` at the clamp under the same loads, of the moment of the load there, `r x P` with the place `r` of the end of the rod. Axial force and shear are those of the load \
         on any mesh:",
    );
    let moment = |elements: u32, twist: &str| {
        let curves = run(elements, twist, constants[0]);
        let largest = curves.last("P");
        let off = rows.iter().map(|k| {
            let row = curves.time.iter().position(|time| (time * largest - loads[*k]).abs() < 1e-6 * largest).unwrap();
            let found = Vec3::from_fn(|axis, _| curves.column(&format!("foot.section_moment[{}]", axis + 1))[row]);
            // The tangent at the clamp is along x; y and z of the section are those of the ground.
            let exact = Vec3::new(x[*k], y[*k], z[*k]).cross(&(Vec3::z() * loads[*k]));
            (found - exact).norm() / exact.norm()
        });
        off.fold(0.0, f64::max)
    };
    section.say(&study::twists(&[2, 4, 8, 16], moment));
}
