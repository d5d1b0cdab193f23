//! Blades whose frequencies are published: one that turns and tapers, and that of a reference turbine.

use crate::curves::{Curves, load};
use std::f64::consts::TAU;

/// Speed, first and second frequency, all multiplied by `√(m₀ L⁴/EI₀)`.
pub const TABLE: [[f64; 3]; 4] =
    [[0.0, 3.8238, 18.3173], [2.0, 4.4368, 18.9366], [4.0, 5.8788, 20.6852], [5.0, 6.7434, 21.9053]];

/// First collective flapwise, first asymmetric edgewise (yaw), second collective flapwise of the reference turbine, Hz:
/// FAST and ADAMS.
pub const REPORT: [[f64; 2]; 3] = [[0.6993, 0.7019], [1.0898, 1.0877], [2.0205, 2.0175]];

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

/// The angular frequency near `expected`, rad/s, at which the spectrum of `signal` is largest, seen through a Hann
/// window: several periods away from any other frequency its error is far below a period in the record.
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

/// The two flapping frequencies that the spectrum of a run has near those of a row of [`TABLE`], in its units.
pub fn flapping([speed, first, second]: [f64; 3]) -> [f64; 2] {
    let curves = Curves::run(&blade(speed / time_scale()), &[]);
    let (time, tip) = (&curves.time[20..], &curves.column("tip.displacement[3]")[20..]);
    [first, second].map(|expected| peak(time, tip, expected / time_scale()) * time_scale())
}

/// The three lowest frequencies of the shipped blade without weight, Hz.
pub fn at_standstill() -> Vec<f64> {
    let model = load(include_str!("../../../models/blade.toml"), &[("gravity[3]", "0")]);
    let found = model.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message));
    found.modes.iter().map(|mode| mode.eigenvalue.sqrt() / TAU).collect()
}
