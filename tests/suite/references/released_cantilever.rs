//! A cantilever drawn straight and released under weak gravity (sag L/1000) must follow the modal series of the linear
//! beam: mass, stiffness, gravity, clamp and time integration at once, against a closed form.

use crate::support::machines::{clamp, design, integrate};
use ancf14::math::Vec3;
use ancf14::mechanics::system::builder::SystemBuilder;
use std::f64::consts::PI;

/// Roots of cos x cosh x = −1; from the fourth on they are odd multiples of pi/2 to 1e-4.
const ROOTS: [f64; 5] = [1.875_104_068_711_961, 4.694_091_132_974_175, 7.854_757_438_237_613, 3.5 * PI, 4.5 * PI];

/// `w(L, t) = g/L Σ φ_n(L) ∫φ_n dx (1 − cos ω_n t)/ω_n²`, `φ_n(L) = 2 (−1)^(n+1)`, `∫φ_n dx = 2 σ_n L/x_n`.
fn modal_series(gravity: f64, frequency: impl Fn(f64) -> f64, time: f64) -> f64 {
    let terms = ROOTS.iter().enumerate().map(|(n, root)| {
        let sigma = (root.sinh() - root.sin()) / (root.cosh() + root.cos());
        let tip = if n % 2 == 0 { 2.0 } else { -2.0 };
        let omega = frequency(*root);
        gravity * tip * 2.0 * sigma / root * (1.0 - (omega * time).cos()) / (omega * omega)
    });
    terms.sum()
}

#[test]
fn tip_follows_the_modal_series() {
    let beam = design("beam", 8);
    let (material, section) = (&beam.material, &beam.section);
    let line_density = material.density * section.area;
    let bending = material.young * section.second_moment_y;
    let gravity = 8.0 * bending / line_density * 1e-3;
    let frequency = |root: f64| root * root * (bending / line_density).sqrt();
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(&beam);
    clamp(&mut builder, number);
    let (system, mut state) = builder.finish(Vec3::z() * -gravity);
    let period = 2.0 * PI / frequency(ROOTS[0]);
    let (mut largest, mut amplitude) = (0.0_f64, 0.0_f64);
    // 400 steps a period: the phase of the first mode errs by (2 pi/400)^2/12 of its angle, 4e-4 rad after 3 periods.
    integrate(&system, &mut state, 1.0, (period / 400.0, 1200), |state| {
        let tip = state.q[state.q.len() - 5];
        let expected = -modal_series(gravity, frequency, state.time);
        largest = largest.max((tip - expected).abs());
        amplitude = amplitude.max(expected.abs());
    })
    .unwrap();
    println!("largest difference {largest:.2e} m of {amplitude:.2e} m: {:.2e}", largest / amplitude);
    assert!(largest < 5e-3 * amplitude);
}
