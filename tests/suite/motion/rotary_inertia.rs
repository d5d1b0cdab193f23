//! Rotary inertia of sections: beams vibrate like Rayleigh's, and a beam so stiff that it is rigid moves like a block
//! with the inertia `(b² + L²)/12` per mass, also where it tips over. What a wrong axis, a wrong share of either moment
//! or a lost velocity term would give: other frequencies in one of the two planes, a bar that spins up by itself.

use crate::support::machines::{ancf14_elements, design, energies, hold, integrate};
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::inertia::Inertia;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::body::kinematics;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::mechanics::system::mass::MassAt;
use ancf14::model::modes::Kind;
use ancf14::solve::dynamics::start;
use ancf14::solve::modes::modes;
use std::f64::consts::PI;

/// A beam of 1 m along x, `width` along y and `height` along z.
fn bar([width, height]: [f64; 2], elements: usize) -> BeamDesign {
    BeamDesign { rotary_inertia: true, section: Section::rectangle(width, height), ..design("bar", elements) }
}

/// The frequencies, rad/s, of the modes about `state` that vibrate along `axis`.
fn frequencies(system: &System, state: &State, count: usize, axis: usize) -> Vec<f64> {
    let found = modes(system, state, count).unwrap().modes.into_iter();
    let vibrations = found.filter(|mode| mode.kind == Kind::Vibration);
    let lateral = |shape: &[f64], axis: usize| shape.chunks(7).map(|node| node[axis].powi(2)).sum::<f64>();
    let own = vibrations.filter(|mode| {
        let [x, y, z] = [0, 1, 2].map(|axis| lateral(&mode.shape, axis));
        [x, y, z][axis] > 0.9 * (x + y + z)
    });
    own.map(|mode| mode.eigenvalue.sqrt()).collect()
}

fn text(errors: &[f64]) -> String {
    errors.iter().map(|error| format!("{error:.1e} ")).collect()
}

/// `ω` of the free Rayleigh beam of 1 m with bending speed² `EI/(ρA)` and gyration² `I/A` near `ω = guess`:
/// `EI w'''' + ω² ρI w'' = ω² ρA w`, where ends have `w'' = 0` and `EI w''' + ω² ρI w' = 0`.
fn free_rayleigh(speed_square: f64, gyration_square: f64, guess: f64) -> f64 {
    let lacking = |omega: f64| {
        let (a, b) = (omega * omega * gyration_square / speed_square, omega * omega / speed_square);
        // k⁴ = a k² + b in cos k x, and k⁴ = −a k² + b in cosh k x.
        let root = (0.25 * a * a + b).sqrt();
        let (k, m) = ((0.5 * a + root).sqrt(), (root - 0.5 * a).sqrt());
        // About the middle, even: cos and cosh; odd: sin and sinh. Shear: w''' + a w'.
        let (half_k, half_m) = (0.5 * k, 0.5 * m);
        let even =
            (-k * k * half_k.cos()) * ((m * m + a) * m * half_m.tanh()) - (m * m) * ((k * k - a) * k * half_k.sin());
        let odd =
            (-k * k * half_k.sin()) * ((m * m + a) * m) - (m * m * half_m.tanh()) * (-(k * k - a) * k * half_k.cos());
        even * odd
    };
    // Bisection around the root next to the guess.
    let (mut low, mut high) = (0.97 * guess, 1.01 * guess);
    assert!(lacking(low) * lacking(high) < 0.0, "one root near {guess}");
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if lacking(low) * lacking(middle) <= 0.0 { high = middle } else { low = middle }
    }
    0.5 * (low + high)
}

/// Errors of the first five frequencies of a free beam in both planes: the third one falls with the order 4 of the
/// element, and with 16 elements the fifth is within 1e-3.
#[test]
fn free_beams_vibrate_like_rayleighs() {
    let roots = [
        4.730_040_744_862_704,
        7.853_204_624_095_838,
        10.995_607_838_001_671,
        14.137_165_491_257_464,
        17.278_759_657_399_48,
    ];
    for (axis, width) in [(1, 0.04), (2, 0.08)] {
        let mut errors = Vec::new();
        for elements in [4, 8, 16] {
            let mut beam = bar([width, 0.12 - width], elements);
            // Torsion far above.
            beam.material.shear = 1e13;
            let mut builder = SystemBuilder::default();
            builder.add_beam(&beam);
            let (system, state) = builder.finish(Vec3::zeros());
            let own = frequencies(&system, &state, 40, axis);
            let section = &beam.section;
            let moment = [section.second_moment_z, section.second_moment_y][axis - 1];
            let speed_square = beam.material.young * moment / (beam.material.density * section.area);
            let of_roots = roots.iter().zip(&own).map(|(root, own)| {
                let euler = root * root * speed_square.sqrt();
                // Rayleigh's estimate is the guess.
                let gyration_square = moment / section.area;
                let exact = free_rayleigh(speed_square, gyration_square, guess(euler, *root, gyration_square));
                own / exact - 1.0
            });
            errors.push(of_roots.collect::<Vec<f64>>());
            println!("{elements} elements, along {axis}: {}", text(&errors[errors.len() - 1]));
        }
        let orders: Vec<f64> = (0..3).map(|mode| (errors[1][mode] / errors[2][mode]).log2()).collect();
        println!("orders {orders:.2?}");
        assert!(orders.iter().all(|order| (order - 4.0).abs() < 0.3), "{orders:?}");
        assert!(errors[2].iter().all(|error| error.abs() < 1e-3), "{:?}", errors[2]);
    }
}

/// An upper estimate of a free beam's frequency by Rayleigh's quotient: near a free end slopes are larger than those of
/// a sine, `∫w'² ≈ (k² + 6 k/L) ∫w²`.
fn guess(euler: f64, root: f64, gyration_square: f64) -> f64 {
    euler / (1.0 + gyration_square * (root * root + 6.0 * root)).sqrt()
}

/// `ω² = EI k⁴/(ρA + ρI k²)` with `k = n π/L`, 1 to 5, of a beam on two hinges, in the plane where its sections are
/// high and in the one where they are low.
#[test]
fn hinged_beams_vibrate_like_rayleighs() {
    for width in [0.04, 0.08] {
        let mut all = Vec::new();
        for elements in [4, 8, 16] {
            let beam = bar([width, 0.12 - width], elements);
            let mut builder = SystemBuilder::default();
            let number = builder.add_beam(&beam);
            let axes = Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0);
            // About z at the start; the end may slide: its own stretching is far above.
            hold(&mut builder, "start", number, 0.0, &axes, revolute::PRIMITIVES);
            hold(&mut builder, "end", number, 1.0, &axes, revolute::PRIMITIVES);
            let (system, state) = builder.finish(Vec3::zeros());
            let own = frequencies(&system, &state, 24, 1);
            let (section, material) = (&beam.section, &beam.material);
            let errors: Vec<f64> = own
                .iter()
                .take(5)
                .enumerate()
                .map(|(number, own)| {
                    let k = PI * (number + 1) as f64;
                    let mass = material.density * (section.area + section.second_moment_z * k * k);
                    let exact = (material.young * section.second_moment_z * k.powi(4) / mass).sqrt();
                    own / exact - 1.0
                })
                .collect();
            println!("{elements} elements: {}", text(&errors));
            all.push(errors);
        }
        let orders: Vec<f64> = (0..3).map(|mode| (all[1][mode] / all[2][mode]).log2()).collect();
        println!("orders {orders:.2?}");
        assert!(orders.iter().all(|order| (order - 4.0).abs() < 0.3), "{orders:?}");
        assert!(all[2].iter().all(|error| error.abs() < 1e-3), "{:?}", all[2]);
    }
}

/// A material so stiff that a bar of it is nearly rigid: what it bends changes its swing by 1e-8 of the square of its
/// frequency.
const RIGID: Material = Material { young: 1e13, shear: 4e12, density: 7800.0, damping: 0.0 };

/// A thick bar on a pivot at its end is a physical pendulum, `ω² = m g (L/2)/(m (L² + b²)/12 + m L²/4)`, about either
/// axis. The tolerance is beyond what the bar bends, 1e-8 of the square, and the round-off of its stiffness, as much.
#[test]
fn a_rigid_bar_is_a_physical_pendulum() {
    let (length, sides, gravity) = (1.0_f64, [0.4_f64, 0.2], 9.81);
    for (axis, side) in [(1, sides[0]), (2, sides[1])] {
        for elements in [1, 2, 3] {
            let mut builder = SystemBuilder::default();
            let beam = BeamDesign { material: RIGID, ..bar(sides, elements) };
            let number = builder.add_beam(&beam);
            // It swings along `axis` about the other one.
            let pivot = if axis == 1 {
                Mat3::new(0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0)
            } else {
                Mat3::new(0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)
            };
            hold(&mut builder, "pivot", number, 0.0, &pivot, revolute::PRIMITIVES);
            let (system, mut state) = builder.finish(Vec3::x() * gravity);
            // Its own weight stretches it, which is what holds it upright.
            start::find_equilibrium(&system, &mut state, 0.0, 1e-10).unwrap();
            let found = modes(&system, &state, 1).unwrap();
            let about_pivot = (length * length + side * side) / 12.0 + 0.25 * length * length;
            let exact = gravity * 0.5 * length / about_pivot;
            let error = found.modes[0].eigenvalue / exact - 1.0;
            println!("{elements} elements, side {side}: {error:.1e}");
            assert!(error.abs() < 1e-6, "{error:e}");
        }
    }
}

/// What a free motion has kept: largest changes of momenta and of the energy, as shares, and the axes at the end.
struct Kept {
    momenta: f64,
    energy: f64,
    axes: Mat3,
}

fn kept(system: &System, state: &mut State, steps: (f64, u32), axes: impl Fn(&State) -> Mat3) -> Kept {
    let (mut begin, mut momenta, mut energy) = (None, 0.0_f64, 0.0_f64);
    integrate(system, state, 1.0, steps, |state| {
        let now = (system.momentum(&state.q, &state.momentum), energies(system, state).iter().sum::<f64>());
        let ((linear_0, angular_0), energy_0) = *begin.get_or_insert(now);
        let ((linear, angular), whole) = now;
        momenta = momenta.max((angular - angular_0).norm() / angular_0.norm());
        momenta = momenta.max((linear - linear_0).norm() / angular_0.norm());
        energy = energy.max((whole / energy_0 - 1.0).abs());
    })
    .unwrap();
    Kept { momenta, energy, axes: axes(state) }
}

/// The section axes of the first node.
fn section(state: &State) -> Mat3 {
    ancf14::mechanics::beam::ancf14::frame::NodeFrame::new(&state.q[..7], &state.triads[0]).section()
}

/// A bar of 1 x 0.4 x 0.2 m that spins about its intermediate axis tips over as the body with its moments does.
#[test]
fn a_rigid_bar_tips_over_like_a_body() {
    let (sides, spin) = ([0.4_f64, 0.2], Vec3::new(0.02, 5.0, 0.03));
    let turned = |step: f64, count: u32| {
        let mut builder = SystemBuilder::default();
        let middle = spin.cross(&(Vec3::x() * 0.5));
        let beam = BeamDesign { material: RIGID, angular_velocity: spin, velocity: -middle, ..bar(sides, 2) };
        builder.add_beam(&beam);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let of_bar = kept(&system, &mut state, (step, count), section);
        let mut builder = SystemBuilder::default();
        let mass = RIGID.density * sides[0] * sides[1];
        let [b, c] = sides.map(|side| side * side);
        let moments = Vec3::new(b + c, 1.0 + c, 1.0 + b) * (mass / 12.0);
        builder.add_body(&BodyDesign {
            name: "body".into(),
            mass,
            position: Vec3::zeros(),
            inertia: Mat3::from_diagonal(&moments),
            axes: Mat3::identity(),
            velocity: Vec3::zeros(),
            angular_velocity: spin,
        });
        let (system, mut state) = builder.finish(Vec3::zeros());
        let of_body = kept(&system, &mut state, (step, count), |state| kinematics::pose(&state.q, 0).axes);
        let apart = (of_bar.axes - of_body.axes).amax();
        println!("h = {step}: momenta {:.1e}, energy {:.1e}, apart {apart:.1e}", of_bar.momenta, of_bar.energy);
        (of_bar.momenta, of_bar.energy, apart)
    };
    let [coarse, fine] = [turned(4e-3, 1000), turned(2e-3, 2000)];
    // Round-off of the stiff axial force in 2,000 steps.
    assert!(coarse.0 < 1e-9 && fine.0 < 1e-9);
    // Both are of second order in the step.
    for (coarse, fine) in [(coarse.1, fine.1), (coarse.2, fine.2)] {
        assert!((3.0..5.5).contains(&(coarse / fine)), "{coarse:e} {fine:e}");
    }
    assert!(fine.1 < 1e-5 && fine.2 < 5e-3, "{} {}", fine.1, fine.2);
}

/// A free strip that spins fast, flexes and tumbles keeps its momenta to round-off and its energy to the order of the
/// step; nothing pumps energy into it.
#[test]
fn a_flexible_strip_keeps_momenta_and_energy() {
    let band = |step: f64, count: u32| {
        let mut builder = SystemBuilder::default();
        let material = Material { young: 2e9, shear: 8e8, ..RIGID };
        let spin = Vec3::new(60.0, 3.0, 8.0);
        builder.add_beam(&BeamDesign { material, angular_velocity: spin, ..bar([0.1, 0.02], 4) });
        let (system, mut state) = builder.finish(Vec3::zeros());
        let kept = kept(&system, &mut state, (step, count), section);
        println!("h = {step}: momenta {:.1e}, energy {:.1e}", kept.momenta, kept.energy);
        kept
    };
    let [coarse, fine] = [band(1e-3, 1000), band(5e-4, 2000)];
    assert!(coarse.momenta < 1e-9 && fine.momenta < 1e-9);
    assert!(fine.energy < 0.4 * coarse.energy && fine.energy < 1e-3, "{:e} {:e}", coarse.energy, fine.energy);
}

/// Where no joint acts, the momentum is that of the velocities, `M v`: also in a strip that a hinge holds and that
/// turns by 0.06 rad a step, where the mass matrix is another one in each step. Two corrections a step leave the third
/// power of the share of the rotary inertia, times the square of the turn: 0.5³ 0.06² where elements are as short as the
/// section is wide, and a thousandth of it where they are five times as long. Measured: the printed figures.
#[test]
fn momenta_are_those_of_the_velocities() {
    for (elements, most) in [(2, 4.5e-7), (12, 4.5e-4)] {
        let mut worst = 0.0_f64;
        let mut builder = SystemBuilder::default();
        let spin = Vec3::new(60.0, 0.0, 0.0);
        let number = builder.add_beam(&BeamDesign { angular_velocity: spin, ..bar([0.1, 0.02], elements) });
        // An axle along the strip.
        hold(&mut builder, "axle", number, 0.0, &Mat3::identity(), revolute::PRIMITIVES);
        let (system, mut state) = builder.finish(Vec3::y() * 9.81);
        integrate(&system, &mut state, 0.9, (1e-3, 200), |state| {
            let mut cache = FrameCache::default();
            cache.set(&system, &state.q, &state.triads);
            let mut momentum = vec![0.0; state.q.len()];
            system.mass_times(MassAt::new(&[], &cache), &state.velocity, &mut momentum);
            // The joint holds the first node.
            let (own, found) = (&state.momentum[7..], &momentum[7..]);
            let apart = own.iter().zip(found).map(|(own, found)| (own - found).abs()).fold(0.0, f64::max);
            let whole = own.iter().fold(0.0, |largest: f64, own| largest.max(own.abs()));
            worst = worst.max(apart / whole);
        })
        .unwrap();
        println!("{elements} elements: {worst:.1e}");
        assert!(worst < most, "{elements} elements: {worst:e}");
    }
}

/// Left out, nothing is added to the mass matrix: results are bit-identical to those of an Euler-Bernoulli beam. Of a
/// round section all of it is constant.
#[test]
fn left_out_it_adds_nothing() {
    let built = |design: &BeamDesign| {
        let mut builder = SystemBuilder::default();
        builder.add_beam(design);
        builder.finish(Vec3::zeros()).0
    };
    let without = BeamDesign { rotary_inertia: false, ..bar([0.1, 0.02], 3) };
    for element in ancf14_elements(&built(&without)) {
        assert_eq!(*element.inertia, Inertia::new(without.densities(), element.length));
    }
    assert!(built(&bar([0.1, 0.02], 3)).has_following_inertia());
    let round = BeamDesign { section: Section::circle(0.05), ..bar([0.1, 0.02], 3) };
    assert!(!built(&round).has_following_inertia());
    assert_ne!(*ancf14_elements(&built(&round)).next().unwrap().inertia, Inertia::new(round.densities(), 1.0 / 3.0));
}
