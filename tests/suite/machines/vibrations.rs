//! Natural frequencies of machines against closed forms and small eigenproblems.

use super::{check, column, machine, machine_with, results};
use ancf14::Simulation;
use nalgebra::{DMatrix, Matrix3, Matrix6, SymmetricEigen, Vector3};
use std::f64::consts::{PI, TAU};

const BLADE: &str = include_str!("../../machines/helicopter_blade.toml");
const CRANE: &str = include_str!("../../machines/gantry_crane.toml");
const DRILL_STRING: &str = include_str!("../../machines/drill_string.toml");
const ENGINE: &str = include_str!("../../machines/engine_mount.toml");
const GUITAR: &str = include_str!("../../machines/guitar_string.toml");
const RESONATOR: &str = include_str!("../../machines/mems_resonator.toml");

/// The lowest natural frequencies at the start, Hz.
fn frequencies(simulation: &mut Simulation, count: usize) -> Vec<f64> {
    simulation.initialize().unwrap_or_else(|error| panic!("{error}"));
    let modes = simulation.modes(count).unwrap_or_else(|error| panic!("{error}"));
    modes.modes.iter().map(|mode| mode.angular_frequency() / TAU).collect()
}

/// The frequency that is nearest to `wanted`: a mechanism has other modes beside the one of the closed form.
fn nearest(found: &[f64], wanted: f64) -> f64 {
    found.iter().copied().min_by(|a, b| (a - wanted).abs().total_cmp(&(b - wanted).abs())).unwrap()
}

/// `1/(2 L) √(T/μ)` of a string whose mass per length is that of the stretched wire; bending adds `√(EI/T)/L` twice,
/// 2e-4, as the ends are hinges its square only: `π² EI/(2 T L²)`, 7e-6.
#[test]
fn guitar_string_has_the_pitch_of_its_tension() {
    let (scale, tension, diameter): (f64, f64, f64) = (0.648, 72.6, 0.254e-3);
    let area = PI * diameter * diameter / 4.0;
    let drawn = scale / (1.0 + tension / (2e11 * area));
    // Green's strain: the axial force grows a little faster than in the hand calculation of the peg.
    let stretch = scale / drawn;
    let force = 2e11 * area * 0.5 * (stretch * stretch - 1.0) * stretch;
    let per_length = 7850.0 * area * drawn / scale;
    // 20 elements; the error of the mode is of the fourth order.
    let found = frequencies(&mut machine_with(GUITAR, &[("pluck", "0")]), 1)[0];
    check("pitch", found, (force / per_length).sqrt() / (2.0 * scale), 5e-5);
}

/// Six coordinates: mass matrix, and stiffness of three springs at the lever arms of their places.
#[test]
fn engine_has_the_frequencies_of_a_body_on_springs() {
    let spring = Matrix3::from_diagonal(&Vector3::new(1e5, 1e5, 2e5));
    let mut stiffness = Matrix6::zeros();
    for place in [[0.4, 0.25], [0.4, -0.25], [-0.5, 0.0]] {
        let arm = Vector3::new(place[0], place[1], -0.3);
        // A turn moves the place by `turn × arm`.
        let mut moves = nalgebra::Matrix3x6::zeros();
        moves.fixed_columns_mut::<3>(0).copy_from(&Matrix3::identity());
        moves.fixed_columns_mut::<3>(3).copy_from(&-arm.cross_matrix());
        stiffness += moves.transpose() * spring * moves;
    }
    let inverse_root = Matrix6::from_diagonal(&nalgebra::Vector6::from([180.0, 180.0, 180.0, 9.0, 12.0, 10.0]))
        .map_diagonal(|mass: f64| 1.0 / mass.sqrt());
    let scale = Matrix6::from_diagonal(&inverse_root);
    let mut expected: Vec<f64> =
        SymmetricEigen::new(scale * stiffness * scale).eigenvalues.iter().map(|square| square.sqrt() / TAU).collect();
    expected.sort_by(f64::total_cmp);
    for (found, expected) in frequencies(&mut machine(ENGINE), 6).into_iter().zip(expected) {
        check("frequency", found, expected, 1e-7);
    }
}

/// `24 EI/L³` on the mass with `13/35` of each leg; the legs' own shape under inertia changes the mode by the square of
/// their share of the mass, 1e-3.
#[test]
fn resonator_has_the_frequency_of_two_legs() {
    let (length, side): (f64, f64) = (200e-6, 2e-6);
    let stiffness = 24.0 * 169e9 * side.powi(4) / 12.0 / length.powi(3);
    let mass = 5e-11 + 2.0 * 13.0 / 35.0 * 2330.0 * side * side * length;
    let expected = (stiffness / mass).sqrt() / TAU;
    // The legs also stretch and turn the mass a little; both are softer by 1e-4. Out of the plane they are softer
    // still.
    check("frequency", nearest(&frequencies(&mut machine(RESONATOR), 4), expected), expected, 1e-3);
}

/// The box keeps its direction between two ropes: it swings as a point mass on a string of 16 m; the ropes weigh 1.5 %
/// of it, as a string with a mass on it swings: `1 + (rope's share)/...` is left out. At rest the trolley is held by
/// its drive.
#[test]
fn crane_swings_as_a_pendulum() {
    let mut crane = machine_with(CRANE, &[("wire.density", "1")]);
    let found = frequencies(&mut crane, 3);
    // Stretched by the weight, less than 1 mm.
    let pendulum = (9.81 / 16.0_f64).sqrt() / TAU;
    check("pendulum", nearest(&found, pendulum), pendulum, 1e-3);
    check("tension of a rope", crane.value("tension.section_force[1]").unwrap(), 20000.0 * 9.81 / 2.0, 1e-4);
}

/// A bar in torsion with a disk at its end: `tan β = (J_bar/J_disk)/β`.
#[test]
fn drill_string_twists_as_a_bar_with_a_disk() {
    let polar: f64 = PI / 2.0 * (0.0635_f64.powi(4) - 0.0543_f64.powi(4));
    let ratio = 7850.0 * polar * 1000.0 / 374.0;
    let mut root: f64 = 0.5;
    for _ in 0..100 {
        root -= (root * root.tan() - ratio) / (root.tan() + root / root.cos().powi(2));
    }
    let speed = (206e9_f64 / 2.6 / 7850.0).sqrt();
    let expected = root * speed / 1000.0 / TAU;
    // Without the law of the rock, whose damping the modes leave out anyway.
    let found = frequencies(&mut machine(DRILL_STRING), 12);
    // Linear twist on 40 elements: (β/40)²/24 is 1e-6; damping of the rock at rest holds the bit in no mode.
    check("torsion", nearest(&found, expected), expected, 1e-4);
}

/// Flapping of a blade by Ritz functions `x²…x⁸`: bending, and the tension `m W² (L² − x²)/2` of the turning.
#[test]
fn blade_flaps_as_ritz_functions_say() {
    let (length, speed): (f64, f64) = (6.0, 30.0);
    let (per_length, bending): (f64, f64) = (2700.0 * 0.3 * 0.03, 70e9 * 0.3 * 0.03_f64.powi(3) / 12.0);
    let powers = [2, 3, 4, 5, 6, 7, 8];
    let (mut stiffness, mut mass) = (DMatrix::zeros(7, 7), DMatrix::zeros(7, 7));
    // In x/L, exactly.
    for (i, a) in powers.into_iter().enumerate() {
        for (j, b) in powers.into_iter().enumerate() {
            let [a, b] = [f64::from(a), f64::from(b)];
            let curved = a * (a - 1.0) * b * (b - 1.0) / (a + b - 3.0) * bending / length.powi(3);
            let tight = a * b * (1.0 / (a + b - 1.0) - 1.0 / (a + b + 1.0)) * 0.5 * per_length * speed * speed * length;
            stiffness[(i, j)] = curved + tight;
            mass[(i, j)] = per_length * length / (a + b + 1.0);
        }
    }
    let lower = mass.cholesky().unwrap().l();
    let half = lower.solve_lower_triangular(&stiffness).unwrap();
    let standard = lower.solve_lower_triangular(&half.transpose()).unwrap();
    let squares = SymmetricEigen::new((&standard + standard.transpose()) * 0.5).eigenvalues;
    let expected = squares.min().sqrt() / TAU;
    let results = results(BLADE, &[]);
    // After the gust, times at which the tip crosses its place of rest upwards.
    let (time, tip) = (results.time(), column(&results, "tip.displacement[3]"));
    let ups: Vec<f64> = (1..tip.len())
        .filter(|k| time[*k] > 0.25 && tip[k - 1] < 0.0 && tip[*k] >= 0.0)
        .map(|k| time[k] - (time[k] - time[k - 1]) * tip[k] / (tip[k] - tip[k - 1]))
        .collect();
    let found = (ups.len() - 1) as f64 / (ups.last().unwrap() - ups[0]);
    // The gust excites higher modes too, which move a crossing by a share of a period; several periods.
    check("flapping", found, expected, 0.01);
    let tension = column(&results, "root_load.section_force[1]");
    let mean = tension[tension.len() / 2..].iter().sum::<f64>() / (tension.len() - tension.len() / 2) as f64;
    // Large strain: the blade is longer by 3e-4.
    check("tension at the root", mean, per_length * speed * speed * length * length / 2.0, 2e-3);
}
