//! A blade that turns and tapers: its flapping must have the published frequencies. Centrifugal tension, taper and
//! their integrals over elements all enter; without the tension the first frequency at the largest speed would be 43 %
//! lower.
//!
//! Reference: Hodges and Rutkowski, Free-vibration analysis of rotating beams by a variable-order finite-element
//! method, AIAA Journal 19 (1981): a blade whose mass per length falls by half towards its tip and whose bending
//! stiffness falls with its third power, without a hub. Ritz's method with ten polynomials finds the same numbers here,
//! so that they are not misread.

use ancf14_testing::blades::{REPORT, TABLE, at_standstill, flapping};
use nalgebra::{DMatrix, DVector, SymmetricEigen};

/// The two lowest frequencies at the speed `speed` by Ritz's method, both without a unit; the blade has length, mass
/// per length and stiffness 1 at its root.
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

/// Ritz's method finds the numbers of the table to their last digit; the run finds them to 3e-4 in the first mode and
/// 2e-3 in the second, of which steps of 0.08 rad lengthen the period by a twelfth of their square, and the window
/// leaves 1e-4. The blade is a hundredth of its length wide: the element knows the inertia of sections about the
/// tangent, which a turning blade takes up where it is inclined, but not the one of bending, which would cancel it; a
/// width of a twentieth lowers the first frequency by 3e-4.
#[test]
fn flapping_frequencies_are_those_of_the_tables() {
    for [speed, first, second] in TABLE {
        let independent = ritz(speed);
        assert!((independent[0] - first).abs() < 1e-4 && (independent[1] - second).abs() < 1e-3, "{independent:?}");
        let found = flapping([speed, first, second]);
        println!("speed {speed}: {found:?}, table {first} {second}");
        assert!((found[0] / first - 1.0).abs() < 3e-4 && (found[1] / second - 1.0).abs() < 2e-3, "{found:?}");
    }
}

/// The shipped blade at standstill against the frequencies of its turbine (Jonkman, Butterfield, Musial and Scott,
/// Definition of a 5-MW reference wind turbine, NREL/TP-500-38060, 2009, table 9-1, FAST and ADAMS): first collective
/// flapwise, first asymmetric edgewise (yaw), second collective flapwise. In the table tower and shaft move with the
/// blades, which the single blade does not know: 2 %.
#[test]
fn the_reference_blade_has_the_frequencies_of_its_report() {
    let found = at_standstill();
    println!("{found:?}");
    for (found, [fast, adams]) in found.iter().zip(REPORT) {
        assert!((found / fast - 1.0).abs() < 0.025 && (found / adams - 1.0).abs() < 0.025, "{found}: {fast} {adams}");
    }
}
