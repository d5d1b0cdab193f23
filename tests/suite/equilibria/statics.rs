//! Equilibria with closed forms: elastica, roll-up to a circle, bar in tension.

use crate::support::machines::{clamp, design, hold, load};
use ancf14::math::vectors::vec3;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::solve::statics::Statics;

/// A beam of 1 m so thin (height 1/1000 of the length) that it does not stretch.
fn thin(elements: usize) -> BeamDesign {
    let material = Material { young: 1e11, shear: 4e10, density: 1000.0, damping: 0.0 };
    BeamDesign { section: Section::rectangle(1e-3, 1e-3), material, ..design("beam", elements) }
}

fn cantilever(beam: &BeamDesign, force: Vec3, moment: Vec3) -> (System, State) {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(beam);
    clamp(&mut builder, number);
    load(&mut builder, number, 1.0, force, moment);
    builder.finish(Vec3::zeros())
}

fn tip(state: &State) -> Vec3 {
    vec3(&state.q, state.q.len() - 7)
}

/// A transverse dead force on a cantilever, 15 sizes, against the elliptic-integral solution in
/// tests/references/elastica.csv; 8 elements are off by 3.6e-5 of the length at the load of the table in MECHANICS 5
/// and by less than 1e-4 at all.
#[test]
fn elastica() {
    let rows = include_str!("../../references/elastica.csv")
        .lines()
        .filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let mut count = 0;
    let mut largest = 0.0_f64;
    for row in rows {
        let numbers: Vec<f64> = row.split(',').take(4).map(|number| number.parse().unwrap()).collect();
        let beam = thin(8);
        let force = numbers[0] * beam.material.young * beam.section.second_moment_y;
        let (system, mut state) = cantilever(&beam, Vec3::z() * force, Vec3::zeros());
        Statics::new(&system, 1e-8).find(&system, &mut state, 1.0).unwrap();
        let place = tip(&state);
        let error = f64::max((place[2] - numbers[1]).abs(), (1.0 - place[0] - numbers[2]).abs());
        largest = largest.max(error);
        assert!(error < 1e-4, "P L^2/EI = {}: {error:e}", numbers[0]);
        count += 1;
    }
    println!("largest error {largest:.2e}");
    assert_eq!(count, 15);
}

/// The end moment 2 pi EI/L bends a cantilever to a closed circle: the tip comes back to the root, with order 4 in the
/// element length.
#[test]
fn roll_up_to_a_circle() {
    let error = |elements: usize| {
        let beam = thin(elements);
        let moment = std::f64::consts::TAU * beam.material.young * beam.section.second_moment_y;
        let (system, mut state) = cantilever(&beam, Vec3::zeros(), Vec3::y() * -moment);
        let mut statics = Statics::new(&system, 1e-8);
        for step in 1..=20 {
            statics.find(&system, &mut state, f64::from(step) / 20.0).unwrap();
        }
        tip(&state).norm()
    };
    let errors = [8, 16, 32].map(error);
    println!("tip errors with 8, 16, 32 elements: {errors:?}");
    assert!(errors[1] < 2e-4);
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 4.0).abs() < 0.2, "order {order}");
    }
}

/// A bar in tension is exact with one element; a clamp that also held the size of the slope would be 17 % too stiff.
#[test]
fn bar_in_tension_is_exact() {
    let beam = design("bar", 1);
    let stiffness = beam.material.young * beam.section.area;
    let force = 1e-3 * stiffness;
    let (system, mut state) = cantilever(&beam, Vec3::x() * force, Vec3::zeros());
    Statics::new(&system, 1e-8).find(&system, &mut state, 1.0).unwrap();
    // Rounding of a length of 1 m.
    assert!((tip(&state)[0] - 1.001).abs() < 1e-14, "{}", tip(&state)[0] - 1.001);
}

/// A free motion that takes a load, and a constraint that is there twice, are errors that name the place. Without a
/// load along it, a free motion is held and told, also where Newton finds an answer by chance: without loads nothing
/// moves, and a load that does no work in the free direction does not stir it.
#[test]
fn free_motions_and_double_holds_are_named() {
    let message = |prepare: &dyn Fn(&mut SystemBuilder, usize)| {
        let mut builder = SystemBuilder::default();
        let number = builder.add_beam(&design("arm", 8));
        prepare(&mut builder, number);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let mut statics = Statics::new(&system, 1e-8);
        let found = statics.find(&system, &mut state, 1.0).map_err(|error| error.to_string());
        found.map(|()| statics.take_remarks().concat())
    };
    let held = |told: &str| told.contains("takes no load") || told.contains("take no load");
    let floating = message(&|_, _| {}).unwrap();
    assert!(floating.contains("arm.") && held(&floating), "{floating}");
    let pushed = message(&|builder, beam| load(builder, beam, 1.0, Vec3::z(), Vec3::zeros())).unwrap_err();
    assert!(pushed.contains("arm.") && pushed.contains("can move freely"), "{pushed}");
    let hinge = |builder: &mut SystemBuilder, beam: usize, force: Vec3, moment: Vec3| {
        hold(builder, "hinge", beam, 0.0, &Mat3::identity(), revolute::PRIMITIVES);
        load(builder, beam, 1.0, force, moment);
    };
    let hinged = message(&|builder, beam| hinge(builder, beam, Vec3::x(), Vec3::zeros())).unwrap();
    assert!(hinged.contains("turning about the beam") && held(&hinged), "{hinged}");
    let turned = message(&|builder, beam| hinge(builder, beam, Vec3::x(), Vec3::x())).unwrap_err();
    assert!(turned.contains("turning about the beam") && turned.contains("can move freely"), "{turned}");
    let twice = message(&|builder, beam| {
        clamp(builder, beam);
        hold(builder, "again", beam, 0.0, &Mat3::identity(), spherical::PRIMITIVES);
        load(builder, beam, 1.0, Vec3::z(), Vec3::zeros());
    })
    .unwrap_err();
    assert!(twice.contains("joint ") && twice.contains("is redundant"), "{twice}");
    // A soft machine is no free one.
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(&thin(3000));
    clamp(&mut builder, number);
    let (system, mut state) = builder.finish(Vec3::zeros());
    Statics::new(&system, 1e-8).find(&system, &mut state, 1.0).unwrap();
}

/// A load that jumps by far more than Newton bears in one go is ramped: the equilibrium is that of slow loading.
#[test]
fn jumps_of_loads_are_bridged() {
    let beam = thin(8);
    let moment = Vec3::y() * (-5.0 * beam.material.young * beam.section.second_moment_y);
    let (system, mut at_once) = cantilever(&beam, Vec3::zeros(), moment);
    let mut slowly = at_once.clone();
    let mut statics = Statics::new(&system, 1e-8);
    statics.find(&system, &mut at_once, 0.01).unwrap();
    statics.find(&system, &mut at_once, 1.0).unwrap();
    assert!(at_once.statistics.rejected > 0, "no jump for Newton");
    for step in 1..=50 {
        statics.find(&system, &mut slowly, f64::from(step) / 50.0).unwrap();
    }
    assert_eq!(slowly.statistics.rejected, 0);
    // Newton's tolerance, and the round-off of an axial stiffness of 1e11 times the bending stiffness over the length
    // cubed.
    assert!((tip(&at_once) - tip(&slowly)).norm() < 1e-9, "{:e}", (tip(&at_once) - tip(&slowly)).norm());
}

/// A reversal is ramped from the loads that act, not from nothing: the beam unrolls and rolls up the other way, a
/// mirror image.
#[test]
fn reversals_start_from_the_loads_that_act() {
    let beam = thin(8);
    let moment = Vec3::y() * (-5.0 * beam.material.young * beam.section.second_moment_y);
    let (system, mut state) = cantilever(&beam, Vec3::zeros(), moment);
    let mut statics = Statics::new(&system, 1e-8);
    for step in 1..=20 {
        statics.find(&system, &mut state, f64::from(step) / 20.0).unwrap();
    }
    let rolled = tip(&state);
    statics.find(&system, &mut state, -1.0).unwrap();
    let mirrored = tip(&state);
    assert!(rolled[2] > 0.1);
    assert!((mirrored - Vec3::new(rolled[0], rolled[1], -rolled[2])).norm() < 1e-9, "{rolled} {mirrored}");
}
