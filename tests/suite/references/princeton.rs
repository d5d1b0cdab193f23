//! The Princeton beam: a thin aluminium cantilever under a dead tip load at 7 angles and 3 sizes, against the exact rod
//! solution in tests/references/princeton_beam.csv. What is left with 8 elements is the discretization error of the
//! linear twist, of order 2.

use crate::support::machines::ancf14;
use crate::support::machines::{clamp, design, load};
use ancf14::math::Vec3;
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::statics::Statics;

const LENGTH: f64 = 0.508;

struct Case {
    load: f64,
    angle: f64,
    weak: f64,
    stiff: f64,
    twist: f64,
    rotation: f64,
}

fn cases() -> Vec<Case> {
    let text = include_str!("../../references/princeton_beam.csv");
    let rows = text.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    rows.map(|line| {
        let n: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        Case { load: n[0], angle: n[1].to_radians(), weak: n[3], stiff: n[4], twist: n[5], rotation: n[6] }
    })
    .collect()
}

pub fn beam(elements: usize, strain: Strain, twist: Twist) -> BeamDesign {
    let young = 71.7e9;
    let section = Section { torsion_constant: 113.3872e-12, ..Section::rectangle(3.2024e-3, 12.377e-3) };
    let material = Material { young, shear: Material::shear_from_poisson(young, 0.31), density: 2700.0, damping: 0.0 };
    BeamDesign {
        line: Centerline::straight(Vec3::zeros(), Vec3::x() * LENGTH, elements),
        section,
        material,
        elements: ancf14(strain, twist),
        ..design("beam", elements)
    }
}

fn machine(elements: usize, (strain, twist): (Strain, Twist), case: &Case) -> (System, State) {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(&beam(elements, strain, twist));
    clamp(&mut builder, number);
    let force = Vec3::new(0.0, case.angle.sin(), case.angle.cos()) * case.load;
    load(&mut builder, number, 1.0, force, Vec3::zeros());
    builder.add_sensor(number, 1.0);
    builder.finish(Vec3::zeros())
}

/// Tip displacement, twist and rotation about x.
fn tip(elements: usize, kind: (Strain, Twist), case: &Case) -> (Vec3, f64, f64) {
    let (system, mut state) = machine(elements, kind, case);
    Statics::new(&system, 1e-8).find(&system, &mut state, 1.0).unwrap();
    let mut snapshot = FrameCache::default();
    let configuration = snapshot.of(&system, &state);
    let sensor = &system.sensors[0];
    let place = sensor.marker.pose(&configuration).place - sensor.drawn.place;
    (place, sensor.twist(&system, &configuration), state.rotations[0][0])
}

fn largest(cases: &[Case], value: fn(&Case) -> f64) -> f64 {
    cases.iter().map(|case| value(case).abs()).fold(0.0, f64::max)
}

/// Largest errors of weak and stiff displacement, twist and rotation, relative to their largest values, over all 21
/// cases.
fn errors(elements: usize, twist: Twist, cases: &[Case]) -> [f64; 4] {
    let values: [fn(&Case) -> f64; 4] = [|c| c.weak, |c| c.stiff, |c| c.twist, |c| c.rotation];
    let scales = values.map(|value| largest(cases, value));
    let mut errors = [0.0_f64; 4];
    for case in cases {
        let (place, twist, rotation) = tip(elements, (Strain::Small, twist), case);
        let differences = [place[1] - case.weak, place[2] - case.stiff, twist - case.twist, rotation - case.rotation];
        for ((error, difference), scale) in errors.iter_mut().zip(differences).zip(scales) {
            *error = error.max(difference.abs() / scale);
        }
    }
    errors
}

#[test]
fn all_cases_with_order_two() {
    let cases = cases();
    assert_eq!(cases.len(), 21);
    let table: Vec<[f64; 4]> = [4, 8, 16, 32].map(|elements| errors(elements, Twist::Linear, &cases)).to_vec();
    for (elements, row) in [4, 8, 16, 32].iter().zip(&table) {
        println!(
            "{elements:2} elements: weak {:.2e}, stiff {:.2e}, twist {:.2e}, rotation {:.2e}",
            row[0], row[1], row[2], row[3]
        );
    }
    let [weak, stiff, twist, _] = table[1];
    assert!(weak < 5e-4 && stiff < 5e-3 && twist < 1e-3);
    for pair in table.windows(2) {
        for (coarse, fine) in pair[0].iter().zip(&pair[1]) {
            let order = (coarse / fine).log2();
            // 1.78 is what the rotation shows between 4 and 8 elements, where the next order still counts; all others
            // are within 0.06 of 2.
            assert!((order - 2.0).abs() < if pair[0] == table[0] { 0.3 } else { 0.1 }, "order {order}");
        }
    }
}

/// With quadratic twist: order 4, and with 8 elements all cases within 2e-5 of the largest displacement.
#[test]
fn all_cases_with_order_four() {
    let cases = cases();
    let table: Vec<[f64; 4]> = [4, 8, 16].map(|elements| errors(elements, Twist::Quadratic, &cases)).to_vec();
    for (elements, row) in [4, 8, 16].iter().zip(&table) {
        println!(
            "{elements:2} elements, quadratic twist: weak {:.2e}, stiff {:.2e}, twist {:.2e}, rotation {:.2e}",
            row[0], row[1], row[2], row[3]
        );
    }
    let stiff_of_weak = largest(&cases, |case| case.stiff) / largest(&cases, |case| case.weak);
    let [weak, stiff, ..] = table[1];
    println!("8 elements, of the largest displacement: {:.1e}", weak.max(stiff * stiff_of_weak));
    assert!(weak < 2e-5 && stiff * stiff_of_weak < 2e-5);
    for pair in table.windows(2) {
        for (coarse, fine) in pair[0].iter().zip(&pair[1]) {
            let order = (coarse / fine).log2();
            assert!((order - 4.0).abs() < 0.1, "order {order}");
        }
    }
}

/// Small strains: the complete energy differs by the strain's own size only.
#[test]
fn large_strain_is_small_strain_here() {
    for case in cases() {
        let difference =
            tip(8, (Strain::Large, Twist::Linear), &case).0 - tip(8, (Strain::Small, Twist::Linear), &case).0;
        assert!(difference.norm() < 1e-5, "{:e}", difference.norm());
    }
}

/// With the exact tangent what is left after an iteration is the square of what was before: halving the change of load
/// divides the first three corrections by 2, 4 and 16 (a wrong term in the Hessian: by 2, 2 and 2).
#[test]
fn newton_converges_quadratically() {
    let case = &cases()[17];
    let corrections = [2e-3, 1e-3].map(|more| {
        let (system, mut state) = machine(8, (Strain::Small, Twist::Linear), case);
        let mut statics = Statics::new(&system, 1e-13);
        statics.find(&system, &mut state, 1.0).unwrap();
        statics.find(&system, &mut state, 1.0 + more).unwrap();
        let convergence = statics.convergence.unwrap();
        println!("corrections after {more} more load: {:?}", &convergence.corrections[..convergence.iterations]);
        convergence
    });
    for (place, expected) in [(0, 2.0), (1, 4.0), (2, 16.0)] {
        let ratio = corrections[0].corrections[place] / corrections[1].corrections[place];
        assert!((ratio / expected - 1.0).abs() < 0.05, "correction {place}: {ratio}");
    }
}
