//! Are frequencies right by themselves, and those of a given mesh warned of where they are not? A clamped string has
//! layers at its ends that are thinner than its elements, so that the error falls by the first order only; a cantilever
//! has modes that need twice the elements of the first one.

use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::load;
use std::f64::consts::{PI, TAU};

/// A guitar's low E, clamped at both ends: half the diameter, the tension, the length.
const STRING: [f64; 3] = [2.5e-4, 80.0, 0.648];
const DENSITY: f64 = 7850.0;
const YOUNG: f64 = 2e11;

fn string(more: &str) -> Simulation {
    let [radius, tension, length] = STRING;
    let text = format!(
        r#"format = 1
model = {{ name = "String", gravity = [0, 0, 0] }}
material.steel = {{ young = {YOUNG}, poisson = 0.3, density = {DENSITY} }}
section.wire = {{ shape = "circle", radius = {radius} }}
beam.string = {{ material = "steel", section = "wire", from = [0, 0, 0], to = [{length}, 0, 0], pretension = {tension}{more} }}
joint.nut = {{ type = "weld", a = "ground", b = "string.start" }}
joint.bridge = {{ type = "weld", a = "ground", b = "string.end" }}
simulation = {{ stop = 1 }}
"#
    );
    let mut model = load(&text, &[]);
    ancf14::fmi::Model::initialize(&mut model, 0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    model
}

/// Frequency `number` of the clamped string with bending, Hz: `tan αL = 2αβ/(β² − α²)`, `β² − α² = T/EI`,
/// `αβ = ω √(μ/EI)`.
fn exact(number: f64) -> f64 {
    let [radius, tension, length] = STRING;
    let area = PI * radius * radius;
    let rigidity = YOUNG * area * radius * radius / 4.0;
    let beta = |alpha: f64| (tension / rigidity + alpha * alpha).sqrt();
    let mut alpha = number * PI / length;
    for _ in 0..50 {
        alpha = (number * PI + f64::atan(2.0 * alpha * beta(alpha) / (tension / rigidity))) / length;
    }
    alpha * beta(alpha) * (rigidity / (DENSITY * area)).sqrt() / TAU
}

/// The errors of the frequencies of a string, by the truth and by what the modes tell; the pairs of both planes.
fn errors(modes: &ancf14::model::modes::Modes) -> Vec<[f64; 2]> {
    let error = |(number, mode): (usize, &ancf14::model::modes::Mode)| {
        let exact = exact((number / 2 + 1) as f64);
        [mode.angular_frequency() / TAU / exact - 1.0, mode.mesh_error.unwrap()]
    };
    modes.modes.iter().enumerate().map(error).collect()
}

/// With a mesh of the program's choice all frequencies are right to 0.5 %; true and told errors are alike.
#[test]
fn chosen_meshes_make_frequencies_right() {
    let found = string("").refined_modes(10).unwrap();
    assert!(found.modes.warnings.is_empty() && found.simulation.is_some(), "{:?}", found.modes.warnings);
    for [truth, told] in errors(&found.modes) {
        assert!(truth.abs() < 0.005 && (1.0 / 3.0..3.0).contains(&(truth / told)), "{truth} {told}");
    }
}

/// A given mesh stays, and its modes say by how much they are off.
#[test]
fn given_meshes_are_warned_of() {
    let found = string(", elements = 8").refined_modes(10).unwrap();
    assert!(found.simulation.is_none() && found.elements == 8);
    assert!(found.modes.warnings[0].contains("because of the mesh, as one twice as fine shows"), "{:?}", found.modes);
    for [truth, told] in errors(&found.modes) {
        assert!(truth > 0.01 && (1.0 / 3.0..3.0).contains(&(truth / told)), "{truth} {told}");
    }
    let fine = string(", elements = 64").refined_modes(4).unwrap();
    assert!(fine.modes.warnings.is_empty(), "{:?}", fine.modes.warnings);
}
