//! ANCF24 in motion. Its strains are products of gradients, which a rigid motion leaves alone to round-off; over a step
//! its force works what the energy increases by, whatever the step (Simo and Tarnow): what physics conserves is
//! conserved to round-off, not in a band.

use crate::elements::ancf24_oracle::{self as oracle, DAMPING, LAWS};
use crate::motion::dynamics::{free, spinning_design};
use crate::random::Random;
use crate::support::machines::{design, energies, integrate, march};
use ancf14::math::rotation::rotation_matrix;
use ancf14::math::vectors::{set_vec3, vec3};
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf24::damping;
use ancf14::mechanics::beam::ancf24::law::Shear;
use ancf14::mechanics::beam::design::{BeamDesign, Elements};
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::dynamics::generalized_alpha::GeneralizedAlpha;
use std::f64::consts::TAU;

const KINDS: [Elements; 2] = [
    Elements::Ancf24 { poisson: false, shear: Shear::Section },
    Elements::Ancf24 { poisson: true, shear: Shear::Continuum },
];

/// All vectors of the element `q` turned, places shifted too.
fn moved(q: &oracle::Coordinates, turn: &Mat3, shift: &Vec3) -> oracle::Coordinates {
    let mut sum = *q;
    for vector in 0..8 {
        let place = if vector % 4 == 0 { *shift } else { Vec3::zeros() };
        let own = turn * q.fixed_rows::<3>(3 * vector) + place;
        sum.fixed_rows_mut::<3>(3 * vector).copy_from(&own);
    }
    sum
}

/// 25 turns about an oblique axis in steps of 0.3 rad: the energy of a deformed element of any law and reference,
/// within the rounding of some 500 products with matrices.
#[test]
fn many_turns_do_not_strain() {
    let mut random = Random(51);
    for law in LAWS {
        for reference in [oracle::straight(), oracle::deformed(&mut random, 0.2)] {
            let element = oracle::element(law, &reference);
            let mut q = oracle::deformed(&mut random, 0.5);
            let before = element.energy(q.as_slice());
            let turn = rotation_matrix(&(random.direction() * 0.3));
            for _ in 0..(25.0 * TAU / 0.3_f64).round() as usize {
                q = moved(&q, &turn, &Vec3::zeros());
            }
            q = moved(&q, &Mat3::identity(), &random.vector());
            let change = (element.energy(q.as_slice()) / before - 1.0).abs();
            println!("{law:?}: {change:.1e} after 25 turns");
            assert!(change < 1e-12, "{change:e}");
        }
    }
}

/// A turn of 1.2 rad and a shift of 1 m within 1 ms are not damped at all: round-off of strains that a strain of 1
/// would drive to 1 here.
#[test]
fn rigid_motion_is_not_damped() {
    let mut random = Random(53);
    let h = 1e-3;
    for law in LAWS {
        let element = oracle::element(law, &oracle::deformed(&mut random, 0.2));
        let start = oracle::deformed(&mut random, 0.5);
        let turn = rotation_matrix(&(random.direction() * 1.2));
        let end = moved(&start, &turn, &random.direction());
        let middle = (start + end) * 0.5;
        let places = [start.as_slice(), middle.as_slice(), end.as_slice()];
        let mut force = oracle::Coordinates::zeros();
        damping::add_force_over_step(&element, places, h, force.as_mut_slice());
        let mut elastic = oracle::Coordinates::zeros();
        element.add_gradient(start.as_slice(), None, elastic.as_mut_slice());
        let ratio = force.amax() / (elastic.amax() * DAMPING / h);
        println!("{law:?}: {ratio:.1e}");
        assert!(ratio < 1e-13, "{ratio:e}");
    }
}

/// Whatever the motion, damping takes power out of it: as a form in all velocities it has no negative direction but for
/// the rounding of its 6 rigid motions, and no more than these are free.
#[test]
fn damping_dissipates() {
    let mut random = Random(55);
    for law in LAWS {
        let element = oracle::element(law, &oracle::deformed(&mut random, 0.2));
        let q = oracle::deformed(&mut random, 0.5);
        let mut matrix = nalgebra::SMatrix::<f64, 24, 24>::zeros();
        damping::add_force_v(&element, q.as_slice(), 1.0, matrix.as_mut_slice());
        let powers = matrix.symmetric_eigenvalues();
        let rounding = 1e-12 * powers.max();
        assert!(powers.min() > -rounding, "{powers:e}");
        assert_eq!(powers.iter().filter(|power| **power < rounding).count(), 6, "{powers:e}");
    }
}

/// What a run changes, each relative to its start.
struct Run {
    /// Most of linear and of angular momentum.
    drift: [f64; 2],
    /// Most of the energy.
    band: f64,
    /// Of the energy, at the end.
    change: f64,
}

/// Watches a run of `march` or `integrate`.
fn watched(system: &System, run: impl FnOnce(&mut dyn FnMut(&State))) -> Run {
    let mut start = None;
    let mut found = Run { drift: [0.0; 2], band: 0.0, change: 0.0 };
    run(&mut |state: &State| {
        let (linear, angular) = system.momentum(&state.q, &state.momentum);
        let energy: f64 = energies(system, state).iter().sum();
        let (linear_0, angular_0, energy_0) = *start.get_or_insert((linear, angular, energy));
        found.drift[0] = found.drift[0].max((linear - linear_0).norm() / linear_0.norm());
        found.drift[1] = found.drift[1].max((angular - angular_0).norm() / angular_0.norm());
        found.change = energy / energy_0 - 1.0;
        found.band = found.band.max(found.change.abs());
    });
    found
}

/// The free beam of dynamics.rs with ANCF24's elements.
fn spinning(elements: Elements) -> (System, State) {
    free(&BeamDesign { elements, ..spinning_design() })
}

/// The conserving rule: momenta and energy to the round-off of 1000 steps, 1e-13 each at most (ANCF14 keeps its axial
/// energy alone so, all of it to 1e-3). The elastic energy swings by some thousandths of the whole: it is not for want
/// of exchange that the sum stays.
#[test]
fn free_spinning_beam_keeps_momenta_and_energy() {
    for elements in KINDS {
        let (system, mut state) = spinning(elements);
        let mut swing = [f64::INFINITY, 0.0_f64];
        let Run { drift, band, .. } = watched(&system, |watch| {
            let watch = |state: &State| {
                let [kinetic, elastic, _] = energies(&system, state);
                swing = [swing[0].min(elastic / kinetic), swing[1].max(elastic / kinetic)];
                watch(state);
            };
            integrate(&system, &mut state, 1.0, (1e-3, 1000), watch).unwrap();
        });
        println!("{elements:?}: momenta {drift:?}, energy {band:.1e}, swing {swing:?}, {:?}", state.statistics);
        assert!(drift[0] < 1e-10 && drift[1] < 1e-10 && band < 1e-10, "{elements:?}: {drift:?} {band:e}");
        assert!(swing[1] - swing[0] > 1e-3, "{swing:?}");
    }
}

/// Generalized-alpha: linear momentum to round-off, angular momentum and energy lost by second order, the energy's
/// bound that of ANCF14 in generalized_alpha.rs; the ratio as above.
#[test]
fn generalized_alpha_loses_little() {
    for radius in [0.8, 1.0] {
        let found = [(1e-3, 1000), (5e-4, 2000)].map(|steps| {
            let (system, mut state) = spinning(KINDS[0]);
            let mut method = GeneralizedAlpha::new(&system, radius, 1e-8);
            let Run { drift, band, change } = watched(&system, |watch| {
                march(&system, &mut state, &mut method, steps, watch).unwrap();
            });
            println!("{radius}, {steps:?}: momenta {drift:?}, energy band {band:.1e}, at the end {change:.1e}");
            assert!(drift[0] < 1e-12 && band < 1.5e-4, "{drift:?} {band:e}");
            // What is damped is lost.
            assert!(radius == 1.0 || change < 0.0, "{change:e}");
            [drift[1], band]
        });
        for (coarse, fine) in found[0].into_iter().zip(found[1]) {
            assert!((2.0..6.0).contains(&(coarse / fine)), "{found:?}");
        }
    }
}

/// A section that is turned by more than 143 degrees, `1 + cos = 0.2`, against the other end of its element is told,
/// before what is linear between them vanishes in the middle: bent or twisted, whichever it is.
#[test]
fn too_much_turning_in_an_element_is_told() {
    let (system, drawn) = free(&BeamDesign { elements: KINDS[0], ..design("beam", 1) });
    let told = |turn: &Vec3| {
        let mut state = drawn.clone();
        for place in [15, 18, 21] {
            let turned = rotation_matrix(turn) * vec3(&state.q, place);
            set_vec3(&mut state.q, place, &turned);
        }
        system.mesh.elements[0].distortion(&FrameCache::default().of(&system, &state).beams)
    };
    let limit = (-0.8_f64).acos();
    for (axis, word) in [(Vec3::x(), "twisted"), (Vec3::y(), "bent"), (Vec3::z(), "bent")] {
        for sign in [1.0, -1.0] {
            assert_eq!(told(&(axis * sign * (limit - 0.01))), None);
            assert_eq!(told(&(axis * sign * (limit + 0.01))), Some(word));
        }
    }
}
