//! The 45-degree bend, `models/bend_45.toml`, against the exact rod: `tests/references/bend_45_degrees.csv`, for two
//! torsion constants and three loads. The error is that of the linear twist, of order 2; the arc as a spline through
//! points on it must come to the same.

use crate::curves::Curves;
use ancf14::math::Vec3;

const MODEL: &str = include_str!("../../../models/bend_45.toml");
const REFERENCE: &str = include_str!("../../references/bend_45_degrees.csv");

/// Where the tip ends.
fn tip(text: &str, overrides: &[(&str, &str)]) -> Vec3 {
    let once = [("simulation.output_step", "1")];
    let curves = Curves::run(text, &[&once[..], overrides].concat());
    Vec3::from_fn(|i, _| curves.last(&format!("end.position[{}]", i + 1)))
}

/// Largest distance from the six reference tips, m.
fn error(elements: &str, twist: &str) -> f64 {
    let lines = REFERENCE.lines().filter(|line| line.starts_with('0'));
    lines.fold(0.0, |worst: f64, line| {
        let words: Vec<&str> = line.split(',').collect();
        let expected = Vec3::from_fn(|i, _| words[2 + i].parse().unwrap());
        let mesh = [("arc.elements", elements), ("arc.twist", twist)];
        let found = tip(MODEL, &[&mesh[..], &[("square.torsion_constant", words[0]), ("P", words[1])]].concat());
        worst.max((found - expected).norm())
    })
}

#[test]
fn tip_is_where_the_rod_bends_to() {
    let errors = ["4", "8", "16"].map(|elements| error(elements, "linear"));
    let order = (errors[0] / errors[2]).log2() / 2.0;
    println!("45-degree bend, 4, 8, 16 elements: errors {errors:?} of a length of 78.5, order {order:.2}");
    assert!(errors[1] < ERROR_OF_8 && (order - 2.0).abs() < 0.1, "{errors:?}, order {order}");
}

/// Of quadratic twist: 8 elements are good to a ten-thousandth of the tip's place.
#[test]
fn quadratic_twist_has_order_four() {
    let errors = ["4", "8", "16"].map(|elements| error(elements, "quadratic"));
    let order = (errors[0] / errors[2]).log2() / 2.0;
    println!("45-degree bend, quadratic twist, 4, 8, 16 elements: errors {errors:?}, order {order:.2}");
    assert!(errors[1] < 1e-4 * 70.0, "{errors:?}");
    assert!((order - 4.0).abs() < 0.2, "order {order}");
}

/// Measured 2.36e-2 m with 8 elements, 3.0e-4 of the length: half the elements make it four times larger.
const ERROR_OF_8: f64 = 2.5e-2;

/// A natural spline is straight at its ends, where the arc is not: that is felt over a point's distance, and goes with
/// it. Measured 2.8e-3, 1.0e-3, 4.9e-4 m of 71 m that the tip moves through 9, 17, 33 points.
#[test]
fn points_on_the_arc_are_the_arc() {
    let through = |count: u32| {
        let points: Vec<String> = (0..=count)
            .map(|k| {
                let angle = std::f64::consts::FRAC_PI_4 * f64::from(k) / f64::from(count);
                format!("[\"R*{:e}\", \"R*{:e}\", 0]", angle.sin(), 1.0 - angle.cos())
            })
            .collect();
        let begin = MODEL.find("curve = ").unwrap();
        let end = begin + MODEL[begin..].find('\n').unwrap();
        format!("{}curve = {{ points = [{}] }}{}", &MODEL[..begin], points.join(", "), &MODEL[end..])
    };
    let arc = tip(MODEL, &[]);
    let errors = [8, 16, 32].map(|count| (tip(&through(count), &[]) - arc).norm());
    println!("45-degree bend through 9, 17, 33 points: {errors:?}");
    assert!(errors[0] < 4e-3 && errors[1] < 0.6 * errors[0] && errors[2] < 0.6 * errors[1], "{errors:?}");
}
