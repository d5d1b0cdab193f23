//! The paper's helical spring, `models/helical_spring.toml`, against the exact rod:
//! `tests/references/helical_spring.csv`, a shooting solution of the rod's differential equation, and the linear
//! stiffness of the very curve, 1749.56 N/m (Castigliano). The wire twists along all its length, so that an error in
//! the reference torsion, the carried frame or the arc lengths shows at once.

use crate::curves::Curves;

const MODEL: &str = include_str!("../../../models/helical_spring.toml");
const REFERENCE: &str = include_str!("../../references/helical_spring.csv");

/// Force over a pull that is small, N/m: the second order of half of it and of it taken off.
fn stiffness(overrides: &[(&str, &str)]) -> f64 {
    let secant = |pull: &str| {
        let small = [("pull", pull), ("simulation.step", "1"), ("simulation.output_step", "1")];
        let curves = Curves::run(MODEL, &[&small[..], overrides].concat());
        curves.last("puller_force.effort") / curves.last("puller_force.distance")
    };
    2.0 * secant("5e-5") - secant("1e-4")
}

/// Linear twist, equal steps of s: what two other writings of the element give with so many elements (1763.3, 1752.7,
/// 1750.3 N/m), and order 2.
#[test]
fn stiffness_converges_as_expected() {
    let exact = 1749.5637;
    let mut errors = Vec::new();
    for (elements, expected) in [("20", 1763.3), ("40", 1752.7), ("80", 1750.3)] {
        let found = stiffness(&[("coil.elements", elements)]);
        println!("spring with {elements} elements: {found:.2} N/m, expected {expected}");
        // The expected values are printed with five digits.
        assert!((found / expected - 1.0).abs() < 1e-4, "{elements}: {found}");
        errors.push(found / exact - 1.0);
    }
    let order = (errors[0] / errors[2]).log2() / 2.0;
    println!("errors {errors:?}, order {order:.2}");
    assert!((order - 2.0).abs() < 0.2);
}

/// With quadratic twist the torque may change along an element, as it does along this wire: order 4.
#[test]
fn stiffness_with_quadratic_twist() {
    let errors = ["20", "40", "80"].map(|elements| {
        let found = stiffness(&[("coil.elements", elements), ("coil.twist", "quadratic")]);
        println!("spring with {elements} elements, quadratic twist: {found:.3} N/m");
        found / 1749.5637 - 1.0
    });
    println!("errors {errors:?}");
    assert!(errors[0].abs() < 3.5e-3 && errors[1].abs() < 4e-4, "{errors:?}");
    let order = (errors[1] / errors[2]).log2();
    assert!((order - 4.0).abs() < 0.3, "order {order}");
}

/// The whole curve to twice the spring's own length, 40 elements: what is off is the linear twist's error of the
/// stiffness, 0.18 %.
#[test]
fn force_follows_the_pull() {
    let curves = Curves::run(MODEL, &[("simulation.output_step", "0.025"), ("simulation.step", "0.025")]);
    let (pulls, forces) = (curves.column("puller_force.distance"), curves.column("puller_force.effort"));
    let mut compared = 0;
    let mut worst = 0.0_f64;
    for line in REFERENCE.lines().filter(|line| line.starts_with(|first: char| first.is_ascii_digit())) {
        let (pull, force) = line.split_once(',').unwrap();
        let (pull, force): (f64, f64) = (pull.parse().unwrap(), force.parse().unwrap());
        let Some(row) = pulls.iter().position(|own| (own - pull).abs() < 1e-12) else { continue };
        compared += 1;
        worst = worst.max((forces[row] / force - 1.0).abs());
    }
    println!("spring pulled to 40 mm, {compared} points: largest difference {:.3} %", 100.0 * worst);
    assert!(compared >= 10 && worst < 2e-3, "{worst}");
    // Nothing holds the ends against turning: no moment but that of the force, which vanishes on the axis.
    assert!(curves.last("middle.section_force[1]").abs() < curves.last("puller_force.effort"));
}

/// Equal arcs do as well, but need more elements: those at the ends, where the wire bends sharply, must not turn too
/// far. A polyline of 20 straight pieces is an inscribed polygon, 11 % too stiff (MECHANICS 5.5), and converges too.
#[test]
fn other_meshes_are_springs_too() {
    let arcs = stiffness(&[("coil.spacing", "arc"), ("coil.elements", "60")]);
    println!("spring with 60 elements of equal arc length: {arcs:.2} N/m");
    assert!((arcs / 1749.56 - 1.0).abs() < 2e-3, "{arcs}");
    let polygon = MODEL.replace("s = [0.0, 0.5]", "s = [0.0, 0.5]\npolyline = true");
    let errors = ["20", "40"].map(|elements| {
        let small = [("pull", "1e-4"), ("simulation.step", "1"), ("simulation.output_step", "1")];
        let curves = Curves::run(&polygon, &[&small[..], &[("coil.elements", elements)]].concat());
        curves.last("puller_force.effort") / curves.last("puller_force.distance") / 1749.56 - 1.0
    });
    println!("spring of straight pieces, 20 and 40: {errors:?}");
    assert!((errors[0] - 0.115).abs() < 0.01 && errors[1] < 0.3 * errors[0], "{errors:?}");
}

/// The parameters inside the curve are parameters of the model: another radius, another spring, stiffer by the cube or
/// so.
#[test]
fn parameters_shape_the_curve() {
    let [plain, wide] = ["0.02", "0.022"].map(|radius| stiffness(&[("radius", radius), ("coil.elements", "20")]));
    assert!((plain / wide / 1.1_f64.powi(3) - 1.0).abs() < 0.03, "{plain} {wide}");
}
