//! Quadratic twist (MECHANICS 5.3): the internal coordinate of an element must stand where the energy has no slope by
//! it, and gradient and Hessian must be those of the energy with it condensed, both by automatic differentiation of the
//! oracle with 15 coordinates. A dropped or wrong term shows at 1e-3 or more; the bound is rounding.

use crate::elements::element_derivatives::{curved, random_element_state, stiffness, straight};
use crate::random::Random;
use crate::support::machines::ancf14;
use crate::support::machines::{clamp, design, load};
use crate::support::oracle;
use crate::support::sections::loaded_section;
use ancf14::math::{Vec3, rotation};
use ancf14::mechanics::beam::ancf14::element::{Element, Evaluation};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::natural::Natural;
use ancf14::mechanics::beam::ancf14::strain::{Stiffness, Strain};
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::geometry::triad::Triad;
use ancf14::mechanics::input::excitation::Excitation;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::statics::Statics;
use nalgebra::SVector;
use num_dual::Dual2SVec64;

const STRAINS: [Strain; 3] = [Strain::Small, Strain::Large, Strain::LargeTruncated];
/// Rounding of a second derivative, relative to its largest entry.
const ROUNDING: f64 = 1e-9;

type Coordinates = SVector<f64, 14>;

fn quadratic(strain: Strain) -> Stiffness {
    Stiffness { twist: Twist::Quadratic, ..stiffness(strain) }
}

/// An element in a random state: coordinates, reference triads, last accepted holonomy angle.
struct Case {
    element: Element,
    q: Coordinates,
    triads: [Triad; 2],
    previous: f64,
}

impl Case {
    /// Bent and twisted by half a radian, where every element still has one relaxed state.
    fn random(random: &mut Random, element: Element) -> Self {
        let (q, triads, previous) = random_element_state(random, 0.7, 0.5, 0.8);
        Self { element, q, triads, previous }
    }

    fn at<T>(&self, q: &Coordinates, use_it: impl FnOnce(&Evaluation) -> T) -> T {
        let q = q.as_slice();
        let frames = [NodeFrame::new(&q[..7], &self.triads[0]), NodeFrame::new(&q[7..], &self.triads[1])];
        use_it(&Evaluation::new(&self.element, q, [&frames[0], &frames[1]], self.previous, &Natural::default()))
    }
}

/// Straight and curved elements of every strain.
fn cases(seed: u64) -> Vec<Case> {
    let mut random = Random(seed);
    let mut cases = Vec::new();
    for strain in STRAINS {
        for _ in 0..20 {
            let element = straight(0.7, quadratic(strain));
            cases.push(Case::random(&mut random, element));
            let element = curved(&mut random, 0.7, quadratic(strain));
            cases.push(Case::random(&mut random, element));
        }
    }
    cases
}

#[test]
fn condensed_derivatives() {
    let mut largest = 0.0_f64;
    for case in cases(11) {
        let (bubble, bubble_q, energy, gradient, hessian) = case.at(&case.q, |own| {
            let (gradient, hessian) = own.gradient_and_hessian();
            (own.bubble, own.bubble_q(), own.energy(), gradient, hessian)
        });
        largest = largest.max(bubble.abs());
        let all = case.q.push(bubble);
        let of_oracle = |q: SVector<Dual2SVec64<15>, 15>| {
            oracle::energy(&case.element, &q.as_slice()[..14], q[14], &case.triads, case.previous)
        };
        let (energy_ad, gradient_ad, hessian_ad) = num_dual::hessian(of_oracle, &all);
        assert!((energy - energy_ad).abs() < ROUNDING * energy_ad.abs().max(1e-6), "{energy} {energy_ad}");
        assert!(hessian_ad[(14, 14)] > 0.0, "not a minimum");
        let scale = gradient_ad.amax();
        assert!(gradient_ad[14].abs() < ROUNDING * scale, "slope by b: {:e} of {scale:e}", gradient_ad[14]);
        let error = (gradient - gradient_ad.fixed_rows::<14>(0)).amax() / scale;
        assert!(error < ROUNDING, "gradient: {error:e}");
        let (by_q, by_b) = (hessian_ad.fixed_view::<14, 1>(0, 14), hessian_ad[(14, 14)]);
        let condensed = hessian_ad.fixed_view::<14, 14>(0, 0) - by_q * by_q.transpose() / by_b;
        let error = (hessian - condensed).amax() / condensed.amax();
        assert!(error < ROUNDING, "Hessian: {error:e} in {:?}", case.element.stiffness.strain);
        let error = (bubble_q + by_q / by_b).amax() / (by_q / by_b).amax();
        assert!(error < ROUNDING, "b by q: {error:e}");
    }
    // Otherwise nothing was tried.
    assert!(largest > 0.05, "{largest}");
}

/// A rigid turn changes neither the energy nor the internal coordinate.
#[test]
fn rigid_rotation() {
    let mut random = Random(14);
    for case in cases(15) {
        let found = |case: &Case| case.at(&case.q, |own| (own.energy(), own.bubble));
        let (energy, bubble) = found(&case);
        let turn = rotation::rotation_matrix(&(random.vector() * 2.0));
        let mut turned =
            Case { q: case.q, triads: case.triads, element: case.element.clone(), previous: case.previous };
        for place in [0, 3, 7, 10] {
            let vector = turn * turned.q.fixed_rows::<3>(place);
            turned.q.fixed_rows_mut::<3>(place).copy_from(&vector);
        }
        for triad in &mut turned.triads {
            *triad = Triad { t: turn * triad.t, u: turn * triad.u };
        }
        let (energy_turned, bubble_turned) = found(&turned);
        // Rounding of strains of the order of 1.
        assert!((energy_turned - energy).abs() < 1e-12 * energy, "{energy_turned} {energy}");
        assert!((bubble_turned - bubble).abs() < 1e-12, "{bubble_turned} {bubble}");
    }
}

/// A strip bent in both directions carries a torque that changes along it: it is the torque at every section, and the
/// twist between two sections is its integral. With linear twist the torsion is constant in an element, and both fail
/// by far.
#[test]
fn twist_and_torsion_inside_the_elements() {
    let force = Vec3::new(0.0, 2.0, 12.0);
    let measure = |twist: Twist, elements: usize, fraction: f64| {
        let mut builder = SystemBuilder::default();
        let section = ancf14::mechanics::beam::section::Section::rectangle(0.004, 0.012);
        let beam = builder.add_beam(&BeamDesign {
            elements: ancf14(Strain::Small, twist),
            section,
            ..design("beam", elements)
        });
        clamp(&mut builder, beam);
        load(&mut builder, beam, 1.0, force, Vec3::zeros());
        builder.add_sensor(beam, fraction);
        let (system, mut state) = builder.finish(Vec3::zeros());
        Statics::new(&system, 1e-10).find(&system, &mut state, 1.0).unwrap();
        let mut snapshot = FrameCache::default();
        let configuration = snapshot.of(&system, &state);
        let sensor = &system.sensors[0];
        (loaded_section(&system, &state, 0).1.torsion, sensor.twist(&system, &configuration), state.rotations[0])
    };
    // Torsion is largest at the root, twist and turn at the tip.
    let (scales, tip) = (measure(Twist::Quadratic, 64, 0.0).0, measure(Twist::Quadratic, 64, 1.0));
    for fraction in [0.1, 0.3, 0.55, 0.9] {
        // With 64 elements the errors are 64 times (torsion) and 4096 times smaller than with 8.
        let (torsion, twist, rotation) = measure(Twist::Quadratic, 64, fraction);
        let errors = |kind| {
            let (own_torsion, own_twist, own_rotation) = measure(kind, 8, fraction);
            let turn = (own_rotation - rotation).norm() / tip.2.norm();
            [(own_torsion - torsion).abs() / scales.abs(), (own_twist - twist).abs() / tip.1.abs(), turn]
        };
        let (linear, quadratic) = (errors(Twist::Linear), errors(Twist::Quadratic));
        println!("at {fraction}: torsion, twist, turn {linear:?} (linear), {quadratic:?} (quadratic)");
        // Torsion is linear in an element, of order 2: h²/4; twist and turn are of order 4: h⁴ of the tip's.
        let h = 1.0 / 8.0_f64;
        assert!(quadratic[0] < 0.25 * h.powi(2), "{quadratic:?}");
        assert!(quadratic[1] < 0.1 * linear[1] && quadratic[1] < 2.0 * h.powi(4), "{linear:?} {quadratic:?}");
        assert!(quadratic[2] < 0.1 * linear[2] && quadratic[2] < h.powi(4), "{linear:?} {quadratic:?}");
    }
}

/// The angular velocity of a section inside an element is the rate of its turn, the internal coordinate's share
/// included.
#[test]
fn angular_velocity_inside_the_elements() {
    let mut builder = SystemBuilder::default();
    let beam = builder.add_beam(&BeamDesign {
        elements: ancf14(Strain::Small, Twist::Quadratic),
        pretwist: 0.7,
        ..design("beam", 1)
    });
    builder.add_sensor(beam, 0.3);
    let (system, mut state) = builder.finish(Vec3::zeros());
    let mut random = Random(16);
    // Bent by half a radian in both directions.
    (state.q[4], state.q[5], state.q[11], state.q[12]) = (0.3, -0.2, -0.4, 0.5);
    let drawn = state.q.clone();
    let velocity: Vec<f64> = drawn.iter().map(|_| random.signed()).collect();
    let turn = |time: f64| {
        let q: Vec<f64> = drawn.iter().zip(&velocity).map(|(q, v)| q + time * v).collect();
        let mut moved = state.clone();
        moved.q = q;
        let mut snapshot = FrameCache::default();
        rotation::rotation_matrix(&system.sensors[0].rotation(&snapshot.of(&system, &moved), &Vec3::zeros()))
    };
    let mut snapshot = FrameCache::default();
    let (_, angular) = system.sensors[0].motion(&snapshot.of(&system, &state), &velocity);
    let width = 1e-5; // of central differences: 1e-10 of error, 1e-11 of round-off
    let rate = (turn(width) - turn(-width)) / (2.0 * width) * turn(0.0).transpose();
    let difference = Vec3::new(rate[(2, 1)], rate[(0, 2)], rate[(1, 0)]) - angular;
    assert!(difference.norm() < 1e-8, "{difference}");
    let linear = BeamDesign { elements: ancf14(Strain::Small, Twist::Linear), pretwist: 0.7, ..design("beam", 1) };
    let mut builder = SystemBuilder::default();
    let beam = builder.add_beam(&linear);
    builder.add_sensor(beam, 0.3);
    let (system, _) = builder.finish(Vec3::zeros());
    let (_, without) = system.sensors[0].motion(&snapshot.of(&system, &state), &velocity);
    assert!((without - angular).norm() > 1e-3, "the internal coordinate's share is too small to be seen");
}

/// Damping sees the strains of the linear twist, whose rates are all there are (MECHANICS 5.3): at an instant and over
/// a step.
#[test]
fn damping_is_that_of_the_linear_twist() {
    let mut random = Random(17);
    let material = Material { damping: 1e-3, ..design("beam", 1).material };
    let machine = |twist| {
        let mut builder = SystemBuilder::default();
        builder.add_beam(&BeamDesign {
            elements: ancf14(Strain::Small, twist),
            material,
            pretwist: 0.7,
            ..design("beam", 1)
        });
        builder.finish(Vec3::zeros())
    };
    let (_, mut state) = machine(Twist::Linear);
    // Bent by half a radian in both directions.
    (state.q[4], state.q[5], state.q[11], state.q[12]) = (0.3, -0.2, -0.4, 0.5);
    let velocity: Vec<f64> = state.q.iter().map(|_| random.signed()).collect();
    let viscous = |twist| {
        let (system, _) = machine(twist);
        let mut here = FrameCache::default();
        let start = here.of(&system, &state);
        let excitation = Excitation::default();
        let forces = |passage: Passage| {
            let mut forces = vec![0.0; 14];
            system.forces(&start, &passage, &excitation, &mut forces);
            Coordinates::from_vec(forces)
        };
        let rest = forces(Passage::Rest);
        [forces(Passage::with_velocity(&velocity)) - rest, rest]
    };
    let (linear, quadratic) = (viscous(Twist::Linear), viscous(Twist::Quadratic));
    for (linear, quadratic) in linear[..1].iter().zip(&quadratic) {
        // What is left of the elastic forces by the subtraction.
        assert!((linear - quadratic).amax() < 1e-12 * (linear.amax() + quadratic.amax()), "{linear} {quadratic}");
        assert!(linear.amax() > 1.0, "not damped");
    }
    assert!((linear[1] - quadratic[1]).amax() > 1.0, "the elastic forces are those of the linear twist");
}
