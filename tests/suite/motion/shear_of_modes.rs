//! How much does shear, which beams here leave out, lower a frequency? Of a free tube of 30 mm by 300 mm, against the
//! frequencies of Timoshenko's beam, and of a simply supported bar, whose closed form has both waves.

use ancf14::fmi::Model;
use ancf14::model::modes::Mode;
use ancf14_testing::curves::load;
use std::f64::consts::{PI, TAU};

/// The vibrations of a model, with its frequencies in Hz.
fn vibrations(text: &str, count: usize) -> (Vec<(f64, Mode)>, Vec<String>) {
    let mut model = load(text, &[]);
    model.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let found = model.modes(count).unwrap_or_else(|failure| panic!("{}", failure.message));
    let modes = found.modes.into_iter().map(|mode| (mode.angular_frequency() / TAU, mode));
    (modes.filter(|(frequency, _)| *frequency > 0.0).collect(), found.warnings)
}

/// The bending frequencies of a free tube of steel, by Timoshenko's equations: 3, 8 and 15 % below those without shear.
/// The share of shear is told to a fifth of it, and warned of.
#[test]
fn shear_of_a_free_tube_is_told() {
    let text = r#"format = 1
model = { name = "FreeShaft", gravity = [0, 0, 0] }
material.steel = { young = 210e9, poisson = 0.3, density = 7850 }
section.pipe = { shape = "tube", inner = 0.0035, outer = 0.01504 }
beam.shaft = { material = "steel", section = "pipe", from = [0, 0, 0], to = [0.3, 0, 0], elements = 24 }
simulation = { stop = 1e-3 }
"#;
    let (modes, warnings) = vibrations(text, 16);
    for exact in [1535.23, 4028.15, 7415.3] {
        let bent = |own: &&(f64, Mode)| own.1.shear.unwrap() > 1e-3;
        let lowered = |own: &(f64, Mode)| (own.0 * (1.0 - own.1.shear.unwrap()) - exact).abs();
        let (frequency, mode) =
            modes.iter().filter(bent).min_by(|a, b| lowered(a).total_cmp(&lowered(b))).expect("a mode that bends");
        let truth = 1.0 - exact / frequency;
        let told = mode.shear.unwrap();
        println!("{frequency} Hz: {truth} {told}");
        assert!((told / truth - 1.0).abs() < 0.2, "{exact}: {told} {truth}");
    }
    assert!(warnings.iter().any(|warning| warning.contains("lower with the shear of beams")), "{warnings:?}");
}

/// A simply supported rectangle of slenderness 5 to 50: with `k = nπ/L`, Timoshenko's first frequency solves
/// `ρI/(κGA) ρA ω⁴ − (ρA + ρI k² + EI k² ρA/(κGA)) ω² + EI k⁴ = 0`.
#[test]
fn shear_of_supported_bars_is_told() {
    let (young, poisson, density, height): (f64, f64, f64, f64) = (2.1e11, 0.3, 7850.0, 0.02);
    for slenderness in [5.0, 10.0, 20.0, 50.0] {
        let length = slenderness * height;
        let text = format!(
            r#"format = 1
model = {{ name = "Bar", gravity = [0, 0, 0] }}
material.steel = {{ young = {young}, poisson = {poisson}, density = {density} }}
section.bar = {{ shape = "rectangle", width = 0.03, height = {height} }}
beam.bar = {{ material = "steel", section = "bar", from = [0, 0, 0], to = [{length}, 0, 0], elements = 16 }}
joint.left = {{ type = "revolute", a = "ground", b = "bar.start", axis = [0, 1, 0] }}
joint.right = {{ type = "inline", a = "ground", b = "bar.end", axis = [1, 0, 0] }}
simulation = {{ stop = 1 }}
"#
        );
        let (area, inertia) = (0.03 * height, 0.03 * height.powi(3) / 12.0);
        let shear = young / (2.0 * (1.0 + poisson)) * area * 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson);
        let k = PI / length;
        let wave = |shear: f64| {
            let [a, b, c] = [
                density * inertia / shear * density * area,
                density * area + density * inertia * k * k + young * inertia * k * k * density * area / shear,
                young * inertia * k.powi(4),
            ];
            // The smaller root, also where a is nothing.
            (2.0 * c / (b + (b * b - 4.0 * a * c).sqrt())).sqrt() / TAU
        };
        let [exact, rigid] = [wave(shear), wave(1e9 * shear)];
        let (modes, _) = vibrations(&text, 4);
        let nearest = |own: &(f64, Mode)| (own.0 - rigid).abs();
        let (_, mode) = modes.iter().min_by(|a, b| nearest(a).total_cmp(&nearest(b))).unwrap();
        let truth = 1.0 - exact / rigid;
        let told = mode.shear.unwrap();
        println!("{slenderness}: {truth} {told}");
        assert!((told / truth - 1.0).abs() < 0.2, "{slenderness}: {told} {truth}");
    }
}

/// Rigidities say nothing of shear: the share is not known, which is no share of 0.
#[test]
fn shear_of_rigidities_is_not_known() {
    let text = r#"format = 1
model = { name = "Bar", gravity = [0, 0, 0] }
section.bar = { shape = "rigidities", EA = 1e6, EI_y = 100, EI_z = 100, GJ = 80, line_density = 1 }
beam.bar = { section = "bar", from = [0, 0, 0], to = [1, 0, 0], elements = 8 }
joint.root = { type = "weld", a = "ground", b = "bar.start" }
simulation = { stop = 1 }
"#;
    let (modes, warnings) = vibrations(text, 4);
    assert!(modes.iter().all(|(_, mode)| mode.shear.is_none()) && warnings.is_empty(), "{warnings:?}");
}
