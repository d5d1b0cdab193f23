//! ANCF24 at rest: free of stress as drawn, right in the limit of fine meshes, with the orders that a section linear
//! across and a cubic axis have.

use crate::curves::load;
use crate::running::{value, vector};
use crate::support::machines::{clamp, design};
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf24::law::Shear;
use ancf14::mechanics::beam::design::{BeamDesign, Elements};
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::model::modes::Kind;
use ancf14::solve::modes::modes;
use nalgebra::Matrix4;
use std::f64::consts::PI;

/// Natural frequencies of a cantilever, rad/s.
fn frequencies(beam: &BeamDesign, count: usize) -> Vec<f64> {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    clamp(&mut builder, number);
    let (system, state) = builder.finish(Vec3::zeros());
    let found = modes(&system, &state, count).unwrap();
    found.modes.iter().filter(|mode| mode.kind == Kind::Vibration).map(|mode| mode.eigenvalue.sqrt()).collect()
}

/// The first `count` bending frequencies of a Timoshenko cantilever of 1 m, rad/s: zeros of the moment and force at the
/// free end that a moment and a force at the clamp leave, by the exact solution along the beam.
/// `[EI, shear stiffness, rho A, rho I]`.
fn timoshenko([bending, shear, mass, inertia]: [f64; 4], count: usize) -> Vec<f64> {
    let determinant = |omega: f64| {
        let square = omega * omega;
        // Deflection, turn, moment, force along the beam.
        let along = Matrix4::new(
            0.0,
            1.0,
            0.0,
            1.0 / shear, //
            0.0,
            0.0,
            1.0 / bending,
            0.0, //
            0.0,
            -inertia * square,
            0.0,
            -1.0, //
            -mass * square,
            0.0,
            0.0,
            0.0,
        );
        along.exp().fixed_view::<2, 2>(2, 2).determinant()
    };
    let euler = 3.516 * (bending / mass).sqrt();
    let (mut found, mut low) = (Vec::new(), 0.1 * euler);
    while found.len() < count {
        let high = low + 0.01 * euler;
        if determinant(low) * determinant(high) < 0.0 {
            let (mut a, mut b) = (low, high);
            for _ in 0..60 {
                let middle = 0.5 * (a + b);
                if determinant(a) * determinant(middle) <= 0.0 { b = middle } else { a = middle }
            }
            found.push(0.5 * (a + b));
        }
        low = high;
    }
    found
}

/// A thick cantilever whose sections bend by `young` and shear by `modulus`.
fn exact_bending(beam: &BeamDesign, moment: f64, [young, modulus]: [f64; 2]) -> Vec<f64> {
    let (density, area) = (beam.material.density, beam.section.area);
    timoshenko([young * moment, modulus * area, density * area, density * moment], 2)
}

/// The relative error, with its sign, of the frequency nearest to `exact`.
fn error(found: &[f64], exact: f64) -> f64 {
    let errors = found.iter().map(|own| own / exact - 1.0);
    errors.fold(f64::INFINITY, |best, error| if error.abs() < f64::abs(best) { error } else { best })
}

/// Vibrations of a thick cantilever: bending is Timoshenko's, with the law's own shear modulus and no shear factor,
/// twice with each moment of inertia; sections linear across and along make it and torsion of order 2, from above. The
/// error of torsion is `(π h/2)²/24`, that of linear elements; what extrapolation leaves is of order 4: the square of
/// the coarser error.
#[test]
fn cantilever_frequencies_converge() {
    let kinds = [(false, Shear::Section), (false, Shear::Continuum), (true, Shear::Continuum)];
    for (poisson, shear) in kinds {
        let beam = |elements: usize| BeamDesign {
            section: Section::rectangle(0.08, 0.12),
            elements: Elements::Ancf24 { poisson, shear },
            ..design("beam", elements)
        };
        let BeamDesign { material, section, .. } = beam(1);
        let modulus = match shear {
            Shear::Section => {
                material.shear * section.torsion_constant / (section.second_moment_y + section.second_moment_z)
            }
            Shear::Continuum => material.shear,
        };
        // With the full law sections bend by `λ + 2 G`: the disease (MECHANICS 10.3).
        let lame = material.shear * (material.young - 2.0 * material.shear) / (3.0 * material.shear - material.young);
        let young = if poisson { lame + 2.0 * material.shear } else { material.young };
        let moments = [section.second_moment_y, section.second_moment_z];
        let bending = moments.map(|moment| exact_bending(&beam(1), moment, [young, modulus]));
        let found = [8, 16].map(|elements| frequencies(&beam(elements), 10));
        let torsion = 0.5 * PI * (modulus / material.density).sqrt();
        for exact in bending.concat().into_iter().chain([torsion]) {
            let [coarse, fine] = [&found[0], &found[1]].map(|found| error(found, exact));
            let (order, limit) = ((coarse / fine).log2(), (4.0 * fine - coarse) / 3.0);
            println!(
                "{poisson} {shear:?} {exact:.1}: errors {coarse:.3e} {fine:.3e}, order {order:.3}, limit {limit:.1e}"
            );
            assert!(fine > 0.0 && (order - 2.0).abs() < 0.1, "{order}");
            assert!(limit.abs() < coarse * coarse, "{limit:e}");
        }
        let expected = (PI / 32.0).powi(2) / 24.0;
        assert!((error(&found[1], torsion) / expected - 1.0).abs() < 0.01);
        if !poisson {
            // Cubic along, the axis stretches with order 6.
            let axial = 0.5 * PI * (material.young / material.density).sqrt();
            let [coarse, fine] = [2, 4].map(|elements| error(&frequencies(&beam(elements), 15), axial));
            println!("axial: errors {coarse:.1e} {fine:.1e}");
            assert!(fine > 0.0 && fine < 1e-7 && (coarse / fine).log2() > 5.0);
        }
    }
}

const BEND: &str = include_str!("../../../models/bend_45.toml");
const PRINCETON: &str = include_str!("../../../models/princeton_beam.toml");

/// Displacement of the tip along y (weak) and z (stiff), m.
fn tip(elements: usize, overrides: &[(&str, &str)]) -> [f64; 2] {
    let count = elements.to_string();
    let mut list = vec![("arm.element", "ancf24"), ("arm.elements", count.as_str())];
    list.extend(overrides);
    let mut simulation = load(PRINCETON, &list);
    simulation.advance(1.0).unwrap();
    [2, 3].map(|axis| value(&simulation, &format!("tip.displacement[{axis}]")))
}

/// 8.896 N at 45 degrees against MECHANICS 10.8, whose numbers have four digits: with all coordinates of the clamped
/// node held they are the same to 2e-6. The element of 2001 locks: it finds 70 % of the deflection.
#[test]
fn princeton_meets_its_table() {
    let locked = [("arm.ancf24_poisson", "true"), ("arm.ancf24_shear", "continuum")];
    let cases = [
        (8, &locked[..], [76.85, 5.52]),
        (8, &[], [101.79, 8.59]),
        (16, &[], [108.47, 8.86]),
        (32, &[], [109.00, 8.89]),
    ];
    for (elements, overrides, expected) in cases {
        let found = tip(elements, overrides).map(|displacement| 1e3 * displacement);
        println!("{elements} elements, {overrides:?}: {found:?} mm");
        for (found, expected) in found.into_iter().zip(expected) {
            // Half of the last digit printed, and the 2e-6.
            assert!((found - expected).abs() < 0.0052, "{found} {expected}");
        }
    }
}

/// Where the mesh is fine enough the bent cantilever has order 2, as its sections turn linearly: 1 N, differences of
/// successive meshes. The limit at 8.896 N is the rod without shear, within what shear adds, `P L/(G' A)`, 14 µm along
/// z, and the mesh's own 10 µm along y.
#[test]
fn princeton_converges_with_order_two() {
    let tips = [16, 32, 64, 128].map(|elements| tip(elements, &[("P", "1.0")]));
    for axis in 0..2 {
        let changes = [0, 1, 2].map(|mesh| tips[mesh + 1][axis] - tips[mesh][axis]);
        let orders = [0, 1].map(|pair| (changes[pair] / changes[pair + 1]).log2());
        println!("{}: orders {orders:?}", ["weak", "stiff"][axis]);
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.1), "{orders:?}");
    }
    let [weak, stiff] = tip(64, &[]);
    let text = include_str!("../../references/princeton_beam.csv");
    let row: Vec<f64> = text
        .lines()
        .find(|line| line.starts_with("8.896,45,"))
        .unwrap()
        .split(',')
        .map(|n| n.parse().unwrap())
        .collect();
    println!("from the rod: {:.1e} m, {:.1e} m", weak - row[3], stiff - row[4]);
    assert!((weak - row[3]).abs() < 2e-5 && (stiff - row[4]).abs() < 2e-5);
}

const HELIX: &str = r#"format = 1
[model]
name = "Helix"
[material.steel]
young = 2e11
poisson = 0.3
density = 7800
[section.wire]
shape = "rectangle"
width = 0.01
height = 0.02
[beam.coil]
material = "steel"
section = "wire"
element = "ancf24"
elements = 9
y_axis = [0, 0, 1]
pretwist = 1.5
curve = { x = "0.3*cos(s)", y = "0.3*sin(s)", z = "0.05*s", s = [0, "2*pi"] }
[joint.root]
type = "weld"
a = "ground"
b = "coil.start"
[output.inside]
at = "coil@0.37"
quantities = ["axial_strain", "curvature", "torsion", "twist", "section_force", "section_moment", "stress", "displacement"]
[output.end]
at = "coil.end"
quantities = ["axial_strain", "curvature", "torsion", "twist", "section_force", "section_moment", "stress", "displacement", "rotation"]
[simulation]
analysis = "static"
stop = 1.0
step = 1.0
output_step = 1.0
"#;

/// A helix with pretwist, as drawn: all strains, forces and stresses are exactly 0, for they are differences of the
/// same sums of the same numbers; so nothing moves either.
#[test]
fn curved_and_twisted_beams_are_free_of_stress() {
    for overrides in [vec![], vec![("coil.ancf24_poisson", "true"), ("coil.ancf24_shear", "continuum")]] {
        let mut simulation = load(HELIX, &overrides);
        for time in [0.0, 1.0] {
            if time > 0.0 {
                simulation.advance(time).unwrap();
            }
            let mut compared = 0;
            for (number, variable) in simulation.variables().iter().enumerate() {
                if variable.name.starts_with("inside.") || variable.name.starts_with("end.") {
                    assert_eq!(simulation.value(number).number(), 0.0, "{} at {time} s", variable.name);
                    compared += 1;
                }
            }
            assert_eq!(compared, 33);
        }
    }
}

/// As drawn, sections of a bent and pretwisted beam lie at its nodes as those of ANCF14, to round-off of some turns;
/// and move alike.
#[test]
fn sections_lie_as_those_of_ancf14() {
    let moving = HELIX
        .replace("pretwist = 1.5", "pretwist = 1.5\nvelocity = [1, 2, 3]\nangular_velocity = [3, -2, 1]")
        .replace("[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"coil.start\"\n", "")
        .replace("analysis = \"static\"", "")
        .replace("coil@0.37", "coil.node[4]");
    let quantities = "quantities = [\"quaternion\", \"position\", \"velocity\", \"angular_velocity\"]";
    let lines = moving.lines().map(|line| if line.starts_with("quantities") { quantities } else { line });
    let text = lines.collect::<Vec<_>>().join("\n");
    let simulations = ["ancf14", "ancf24"].map(|element| load(&text, &[("coil.element", element)]));
    let mut compared = 0;
    for name in ["inside", "end"] {
        for quantity in ["quaternion", "position", "velocity", "angular_velocity"] {
            for i in 1..=if quantity == "quaternion" { 4 } else { 3 } {
                let [a, b] = simulations.each_ref().map(|own| value(own, &format!("{name}.{quantity}[{i}]")));
                assert!((a - b).abs() < 1e-12, "{name}.{quantity}[{i}]: {a} {b}");
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 26);
}

/// The 45-degree bend, moved out of its plane by more than half its length: curved references and large turns. From
/// mesh to mesh it comes to the rod by order 2 at least, a quarter of what was missing; what shear adds, `P L/(G' A)`,
/// 1 cm of 54 m, is far below.
#[test]
fn the_bend_comes_to_the_rod() {
    let text = include_str!("../../references/bend_45_degrees.csv");
    let row = text.lines().find(|line| line.starts_with("0.1405770,600,")).unwrap();
    let row: Vec<f64> = row.split(',').map(|number| number.parse().unwrap()).collect();
    let errors = [8, 16, 32].map(|elements| {
        let mut simulation = load(BEND, &[("arc.element", "ancf24"), ("arc.elements", &elements.to_string())]);
        simulation.advance(1.0).unwrap();
        (vector(&simulation, "end.position") - Vec3::new(row[2], row[3], row[4])).norm()
    });
    println!("45-degree bend: errors {errors:?} m");
    assert!(errors[1] < errors[0] / 4.0 && errors[2] < errors[1] / 4.0, "{errors:?}");
}
