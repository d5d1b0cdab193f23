//! A blade that turns and tapers: its flapping must have the published frequencies. Centrifugal tension, taper and their integrals over elements all enter; without the tension the first frequency at the largest
//! speed would be 43 % lower.
//!
//! Reference: Hodges and Rutkowski, Free-vibration analysis of rotating beams by a variable-order finite-element method, AIAA Journal 19 (1981): a blade whose mass per length falls by half towards its tip and
//! whose bending stiffness falls with its third power, without a hub. Ritz's method with ten polynomials finds the same numbers here, so that they are not misread.

use crate::curves::{Curves, load};
use nalgebra::{DMatrix, DVector, SymmetricEigen};
use std::f64::consts::TAU;

/// Speed, first and second frequency, all multiplied by `√(m₀ L⁴/EI₀)`.
const TABLE: [[f64; 3]; 4] =
    [[0.0, 3.8238, 18.3173], [2.0, 4.4368, 18.9366], [4.0, 5.8788, 20.6852], [5.0, 6.7434, 21.9053]];

const LENGTH: f64 = 2.0;
const WIDTH: f64 = 0.02;
const HEIGHT: f64 = 0.01;
const YOUNG: f64 = 2.1e11;
const DENSITY: f64 = 7800.0;

/// `√(m₀ L⁴/EI₀)`, s.
fn time_scale() -> f64 {
    let (mass, stiffness) = (DENSITY * WIDTH * HEIGHT, YOUNG * WIDTH * HEIGHT.powi(3) / 12.0);
    (mass * LENGTH.powi(4) / stiffness).sqrt()
}

/// The two lowest frequencies at the speed `speed` by Ritz's method, both without a unit; the blade has length, mass per length and stiffness 1 at its root.
fn ritz(speed: f64) -> [f64; 2] {
    const TERMS: usize = 10;
    let cells = 400;
    let (mut stiffness, mut mass) = (DMatrix::zeros(TERMS, TERMS), DMatrix::zeros(TERMS, TERMS));
    // m = 1 − u/2: the tension is ∫ m v dv from u to 1, times the square of the speed.
    let tension = |u: f64| 0.5 * (1.0 - u * u) - (1.0 - u.powi(3)) / 6.0;
    for cell in 0..cells {
        for (point, weight) in
            [(0.5 - 0.6_f64.sqrt() / 2.0, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + 0.6_f64.sqrt() / 2.0, 5.0 / 18.0)]
        {
            let u = (f64::from(cell) + point) / f64::from(cells);
            let v = 2.0 * u - 1.0;
            let power = |k: usize, less: usize| if k < less { 0.0 } else { v.powi((k - less) as i32) };
            let shape = DVector::from_fn(TERMS, |k, _| u * u * power(k, 0));
            let slope = DVector::from_fn(TERMS, |k, _| 2.0 * u * power(k, 0) + 2.0 * k as f64 * u * u * power(k, 1));
            let second = DVector::from_fn(TERMS, |k, _| {
                let n = k as f64;
                2.0 * power(k, 0) + 8.0 * n * u * power(k, 1) + 4.0 * n * (n - 1.0) * u * u * power(k, 2)
            });
            let (taper, share) = (1.0 - 0.5 * u, weight / f64::from(cells));
            stiffness += &second * second.transpose() * (taper.powi(3) * share)
                + &slope * slope.transpose() * (speed * speed * tension(u) * share);
            mass += &shape * shape.transpose() * (taper * share);
        }
    }
    let factor = mass.cholesky().unwrap().l();
    let left = factor.solve_lower_triangular(&stiffness).unwrap();
    let standard = factor.solve_lower_triangular(&left.transpose()).unwrap();
    let mut all: Vec<f64> =
        SymmetricEigen::new((&standard + standard.transpose()) / 2.0).eigenvalues.iter().map(|v| v.sqrt()).collect();
    all.sort_by(f64::total_cmp);
    [all[0], all[1]]
}

/// The angular frequency near `expected`, rad/s, at which the spectrum of `signal` is largest, seen through a Hann window: several periods away from any other frequency its error is far below a
/// period in the record.
fn peak(time: &[f64], signal: &[f64], expected: f64) -> f64 {
    let (begin, duration) = (time[0], time[time.len() - 1] - time[0]);
    let power = |frequency: f64| {
        let (mut real, mut imaginary) = (0.0, 0.0);
        for (t, value) in time.iter().zip(signal) {
            let window = 0.5 - 0.5 * (TAU * (t - begin) / duration).cos();
            let (sin, cos) = (frequency * t).sin_cos();
            (real, imaginary) = (real + window * value * cos, imaginary + window * value * sin);
        }
        real.hypot(imaginary)
    };
    let (mut best, mut width) = (expected, 0.02 * expected);
    while width > 1e-6 * expected {
        let around = (-4..=4).map(|k| best + 0.25 * width * f64::from(k));
        best = around.max_by(|a, b| power(*a).total_cmp(&power(*b))).unwrap();
        width *= 0.5;
    }
    best
}

fn blade(speed: f64) -> String {
    format!(
        "format = 1
        [model]
        name = \"Blade\"
        [parameters]
        speed = {speed}
        [material.steel]
        young = {YOUNG}
        poisson = 0.3
        density = {DENSITY}
        [section.blade]
        shape = \"rectangle\"
        width = {WIDTH}
        height = \"{HEIGHT}*(1 - s/{})\"
        [frame.hub]
        position = [0, 0, 0]
        rotation = [0, 0, \"speed*t\"]
        [beam.blade]
        material = \"steel\"
        section = \"blade\"
        from = [0, 0, 0]
        to = [{LENGTH}, 0, 0]
        elements = 6
        angular_velocity = [0, 0, \"speed\"]
        [joint.root]
        type = \"weld\"
        a = \"hub\"
        b = \"blade.start\"
        [load.gust]
        at = \"blade.end\"
        force = [0, 0, [{{ until = 0.03, is = \"0.4*sin(pi*t/0.03)\" }}, {{ is = 0 }}]]
        [output.tip]
        at = \"blade.end\"
        quantities = [\"displacement\"]
        [simulation]
        stop = 8
        step = 1e-3
        output_step = 5e-3
        totals = []",
        2.0 * LENGTH
    )
}

/// Ritz's method finds the numbers of the table to their last digit; the run finds them to 3e-4 in the first mode and 2e-3 in the second, of which steps of 0.08 rad lengthen the period by a twelfth of their square,
/// and the window leaves 1e-4. The blade is a hundredth of its length wide: the element knows the inertia of sections about the tangent, which a turning blade takes up where it is inclined, but not the one of
/// bending, which would cancel it; a width of a twentieth lowers the first frequency by 3e-4.
#[test]
fn flapping_frequencies_are_those_of_the_tables() {
    for [speed, first, second] in TABLE {
        let independent = ritz(speed);
        assert!((independent[0] - first).abs() < 1e-4 && (independent[1] - second).abs() < 1e-3, "{independent:?}");
        let curves = Curves::run(&blade(speed / time_scale()), &[]);
        let (time, tip) = (&curves.time[20..], &curves.column("tip.displacement[3]")[20..]);
        let found = [first, second].map(|expected| peak(time, tip, expected / time_scale()) * time_scale());
        println!("speed {speed}: {found:?}, table {first} {second}");
        assert!((found[0] / first - 1.0).abs() < 3e-4 && (found[1] / second - 1.0).abs() < 2e-3, "{found:?}");
    }
}

/// The shipped blade at standstill against the frequencies of its turbine (Jonkman, Butterfield, Musial and Scott, Definition of a 5-MW reference wind turbine, NREL/TP-500-38060, 2009, table 9-1, FAST and
/// ADAMS): first collective flapwise, first asymmetric edgewise (yaw), second collective flapwise. In the table tower and shaft move with the blades, which the single blade does not know: 2 %.
#[test]
fn the_reference_blade_has_the_frequencies_of_its_report() {
    let model = load(include_str!("../../../models/blade.toml"), &[("gravity[3]", "0")]);
    let found = model.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message));
    let found: Vec<f64> = found.modes.iter().map(|mode| mode.eigenvalue.sqrt() / TAU).collect();
    println!("{found:?}");
    for (found, [fast, adams]) in found.iter().zip([[0.6993, 0.7019], [1.0898, 1.0877], [2.0205, 2.0175]]) {
        assert!((found / fast - 1.0).abs() < 0.025 && (found / adams - 1.0).abs() < 0.025, "{found}: {fast} {adams}");
    }
}
