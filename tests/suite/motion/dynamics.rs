//! Time integration: what physics conserves, the steps that break weaker integrators, and the measured order.

use crate::support::machines::ancf14;
use crate::support::machines::{design, energies, hold, integrate};
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::solve::dynamics::midpoint::Midpoint;
use ancf14::solve::dynamics::start;
use ancf14::solve::step::integrator::Integrator;

/// Without numerical dissipation, and with that of the default.
const RADII: [f64; 2] = [1.0, 0.9];

/// A soft free beam that tumbles and spins about itself, with a spin inertia large enough for the gyroscopic terms to
/// matter.
pub fn spinning() -> (System, State) {
    free(&spinning_design())
}

/// One beam, held by nothing.
pub fn free(design: &BeamDesign) -> (System, State) {
    let mut builder = SystemBuilder::default();
    builder.add_beam(design);
    builder.finish(Vec3::zeros())
}

pub fn spinning_design() -> BeamDesign {
    let section = Section { polar_moment: 4e-4, torsion_constant: 1e-6, ..Section::rectangle(0.02, 0.03) };
    BeamDesign {
        line: Centerline::straight(Vec3::zeros(), Vec3::new(1.2, 0.3, -0.4), 4),
        section,
        material: Material { young: 2e8, shear: 8e7, density: 1000.0, damping: 0.0 },
        velocity: Vec3::new(0.3, -0.2, 0.1),
        angular_velocity: Vec3::new(9.0, 4.0, 3.0),
        ..design("beam", 4)
    }
}

/// A free beam keeps its momenta; by the exact rotational invariance of the element the integrators do so to round-off,
/// but only with both gyroscopic terms: with either of them removed Newton fails within a few steps.
#[test]
fn free_spinning_beam_keeps_momentum_and_energy() {
    for (radius, twist) in RADII.into_iter().flat_map(|r| [Twist::Linear, Twist::Quadratic].map(|twist| (r, twist))) {
        let (system, mut state) = free(&BeamDesign { elements: ancf14(Strain::Small, twist), ..spinning_design() });
        let (mut start, mut start_energy) = (None, f64::NAN);
        let (mut drift, mut low, mut high) = ([0.0_f64; 2], f64::INFINITY, f64::NEG_INFINITY);
        integrate(&system, &mut state, radius, (1e-3, 4000), |state| {
            let (linear, angular) = system.momentum(&state.q, &state.momentum);
            let (linear_0, angular_0) = *start.get_or_insert((linear, angular));
            drift[0] = drift[0].max((linear - linear_0).norm() / linear_0.norm());
            drift[1] = drift[1].max((angular - angular_0).norm() / angular_0.norm());
            let energy: f64 = energies(&system, state).iter().sum();
            start_energy = if state.time == 0.0 { energy } else { start_energy };
            (low, high) = (low.min(energy), high.max(energy));
        })
        .unwrap();
        print!("{radius}, {twist:?} twist: ");
        println!("linear {:.1e}, angular {:.1e}, energy band {:.1e}", drift[0], drift[1], (high - low) / low);
        println!("  {:?}", state.statistics);
        assert!(drift[0] < 1e-10 && drift[1] < 1e-10, "{drift:?}");
        // Of second order in the step without dissipation; with it what the step does not resolve is lost, and nothing
        // gained.
        let gained = high / start_energy - 1.0;
        assert!(if radius == 1.0 { (high - low) / low < 1e-3 } else { gained < 1e-6 && (high - low) / low < 1e-2 });
    }
}

/// A beam that turns keeps its length: a beam of 8 m, hinged at one end and spinning at 4 rad/s, stretches by
/// `rho w^2 L^3 / 3 E` in the mean. The plain midpoint rule adds `(w h)^2 / 8` of false strain, 4e-4 m at h = 5e-3 s,
/// and more than that at 2e-2 s.
#[test]
fn spinning_beam_shows_no_false_extension() {
    let (rate, length) = (4.0, 8.0);
    for (step, count) in [(5e-3, 2000), (2e-2, 500)] {
        let mut builder = SystemBuilder::default();
        let base = design("beam", 4);
        let beam = BeamDesign {
            line: Centerline::straight(Vec3::zeros(), Vec3::x() * length, 4),
            section: Section::rectangle(0.1, 0.1),
            angular_velocity: Vec3::z() * rate,
            ..base.clone()
        };
        let number = builder.add_beam(&beam);
        hold(&mut builder, "hub", number, 0.0, &Mat3::identity(), spherical::PRIMITIVES);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let (mut sum, mut number) = (0.0, 0.0);
        integrate(&system, &mut state, 1.0, (step, count), |state| {
            sum += Vec3::from_column_slice(&state.q[28..31]).norm() - length;
            number += 1.0;
        })
        .unwrap();
        let expected = base.material.density * rate * rate * length.powi(3) / (3.0 * base.material.young);
        let mean = sum / number;
        println!("h = {step}: extension {mean:.4e}, true {expected:.4e}");
        // The start excites axial vibration of the same size, which is not damped: its mean over the run is known to
        // some tenths of a percent.
        assert!((mean / expected - 1.0).abs() < 5e-3, "{mean:e}");
    }
}

/// The tumbling beam of MECHANICS 7.6: 60 rad/s, EA = 1e7 N, h = 2e-3 s. The plain midpoint rule fails within 0.1 s;
/// with the mean strains of both ends the energy stays.
#[test]
fn tumbling_beam_keeps_its_energy() {
    let section = Section::rectangle(0.01, 0.01);
    let material = Material { young: 1e11, shear: 4e10, density: 5000.0, damping: 0.0 };
    let beam = BeamDesign { section, material, angular_velocity: Vec3::new(0.0, 20.0, 56.0), ..design("beam", 4) };
    let (system, mut state) = free(&beam);
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    integrate(&system, &mut state, 1.0, (2e-3, 500), |state| {
        let energy: f64 = energies(&system, state).iter().sum();
        (low, high) = (low.min(energy), high.max(energy));
    })
    .unwrap();
    println!("energy band {:.1e}", (high - low) / low);
    assert!((high - low) / low < 1e-5);
}

/// The taut string of MECHANICS 7.6: 4 elements stretched by 1e-2, plucked, h = 1e-2 s. An axial rule whose geometric
/// stiffness acts explicitly blows up here within some periods.
#[test]
fn taut_string_stays_bounded() {
    let section = Section::circle(1e-3);
    let material = Material { young: 1e9, shear: 4e8, density: 1000.0, damping: 0.0 };
    let stretch = 1e-2;
    let mut builder = SystemBuilder::default();
    let line = Centerline::straight(Vec3::zeros(), Vec3::x() * 2.0, 4);
    let number = builder.add_beam(&BeamDesign { section, material, line, ..design("string", 4) });
    for (name, fraction) in [("left", 0.0), ("right", 1.0)] {
        hold(&mut builder, name, number, fraction, &Mat3::identity(), weld::PRIMITIVES);
    }
    let (mut system, mut state) = builder.finish(Vec3::zeros());
    // Stretch: the right end's ground point and all nodes move out in proportion.
    for node in state.q.chunks_exact_mut(7) {
        node[0] *= 1.0 + stretch;
        node[3] *= 1.0 + stretch;
    }
    if let ancf14::mechanics::marker::Marker::Ground(pose) = &mut system.joints[1].a {
        pose.place *= 1.0 + stretch;
    }
    for node in 1..4 {
        state.velocity[7 * node + 1] = 0.5;
        state.velocity[7 * node + 2] = -0.2;
    }
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    integrate(&system, &mut state, 1.0, (1e-2, 2000), |state| {
        let energy: f64 = energies(&system, state).iter().sum();
        (low, high) = (low.min(energy), high.max(energy));
    })
    .unwrap();
    println!("energy band {:.1e}", (high - low) / low);
    assert!((high - low) / low < 2e-2);
}

/// Halving the step divides the error by four, with numerical dissipation and without.
#[test]
fn order_two_in_the_step() {
    for radius in RADII {
        let end = |step: f64| {
            let (system, mut state) = spinning();
            integrate(&system, &mut state, radius, (step, (0.2 / step).round() as u32), |_| {}).unwrap();
            state.lists.q
        };
        let reference = end(6.25e-5);
        let error = |step| {
            let q = end(step);
            q.iter()
                .zip(&reference)
                .enumerate()
                .filter(|(i, _)| i % 7 < 3)
                .fold(0.0_f64, |e, (_, (a, b))| e.max((a - b).abs()))
        };
        let (coarse, fine) = (error(1e-3), error(5e-4));
        let order = (coarse / fine).log2();
        println!("{radius}: errors {coarse:.2e}, {fine:.2e}, order {order:.3}");
        // Against a reference of 8 times the finer step the ratio is (256 - 1)/(64 - 1) = 4.05, and the next order, of
        // which the numerical dissipation is, counts a little.
        assert!((order - 2.0).abs() < 0.15);
    }
}

/// Long steps and short ones in turn, down to a hundredth, as hosts and pieces of loads make them: what is far too fast
/// for the long ones must not be fed by the jump of the step's length. Dissipation that takes the changes of the last
/// step in proportion to the step's length multiplies it with every pair of steps.
#[test]
fn steps_of_different_lengths_feed_nothing() {
    let (system, drawn) = spinning();
    let long = 2e-3;
    for short in [0.3 * long, 0.1 * long, 0.01 * long] {
        let mut state = drawn.clone();
        let mut integrator = Midpoint::new(&system, 0.9, long, 1e-12);
        start::set_motion(&system, &mut integrator, &mut state).unwrap();
        let begin: f64 = energies(&system, &state).iter().sum();
        let mut largest = begin;
        for number in 1..=1000 {
            let step = if number % 2 == 0 { long } else { short };
            let end = state.time + step;
            integrator.step(&system, &mut state, step, end).unwrap();
            largest = largest.max(energies(&system, &state).iter().sum());
        }
        println!("{short}: energy up by {:.1e}", largest / begin - 1.0);
        assert!(largest < begin * (1.0 + 1e-6), "{short}: {largest} of {begin}");
    }
}
