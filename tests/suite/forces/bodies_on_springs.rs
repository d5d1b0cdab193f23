//! Bodies on springs and dampers have closed forms: period and decrement of a two-point spring, of the springs on the
//! coordinates of joints and of a bushing along and about its three axes; displacement and turn under a constant load;
//! momenta and energy of two bodies on an anisotropic bushing that turn far. A factor, a wrong axis or a moment that is
//! missing shows in full.

use crate::random::Random;
use crate::running::{run, start, value, vector};
use crate::support::machines::{energies, integrate};
use crate::support::oscillation::{period_and_decrement, theory};
use crate::support::parts::{body, cushion};
use ancf14::math::Vec3;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::marker::relative_coordinate::Measure;
use ancf14::mechanics::marker::relative_coordinate::RelativeCoordinate;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use std::f64::consts::TAU;

const MASS: f64 = 2.0;
const INERTIA: [f64; 3] = [0.05, 0.08, 0.11];
const RATIO: f64 = 0.05;

/// A block of [`MASS`] and [`INERTIA`] that starts with these velocities; `rest` holds it.
fn block(velocity: Vec3, angular: Vec3, rest: &str) -> String {
    let list = |v: Vec3| format!("[{}, {}, {}]", v[0], v[1], v[2]);
    format!(
        "format = 1\n[model]\nname = \"Block\"\n\
         [body.block]\nmass = {MASS}\nposition = [0.3, -0.2, 0.5]\ninertia = {INERTIA:?}\n\
         velocity = {}\nangular_velocity = {}\n\
         [output.at_block]\nat = \"block\"\nquantities = [\"displacement\", \"rotation\"]\n{rest}\n",
        list(velocity),
        list(angular)
    )
}

/// Simulates five periods of 200 steps and compares with an oscillator of stiffness `k` and inertia `m`.
fn check(what: &str, text: &str, reading: &str, (k, m): (f64, f64)) {
    check_with(200.0, what, text, reading, (k, m));
}

/// [`check`] with this many steps a period.
fn check_with(steps: f64, what: &str, text: &str, reading: &str, (k, m): (f64, f64)) {
    let omega = (k / m).sqrt();
    let step = TAU / omega / steps;
    let mut simulation = start(&format!("{text}\n[simulation]\nstop = 10\nstep = {step}\noutput_step = {step}\n"));
    let mut samples = vec![0.0];
    run(&mut simulation, step, 5.0 * steps * step, |simulation| samples.push(value(simulation, reading)));
    let (period, decrement) = period_and_decrement(&samples, step);
    let (period_expected, decrement_expected) = theory(omega, RATIO);
    let errors = [period / period_expected - 1.0, decrement / decrement_expected - 1.0];
    println!("{what}: period off by {:.1e}, decrement by {:.1e}", errors[0], errors[1]);
    // The midpoint rule at 200 steps a period: (2 pi / 200)^2 / 12 = 8e-5.
    assert!(errors[0].abs() < 3e-4 && errors[1].abs() < 1e-3, "{what}: {errors:?}");
}

/// The damper that gives [`RATIO`].
fn damper(k: f64, m: f64) -> f64 {
    2.0 * RATIO * (k * m).sqrt()
}

#[test]
fn springs_on_coordinates_vibrate_as_theory_says() {
    let along = Vec3::new(1.0, 2.0, -2.0) / 3.0;
    let guide = "[joint.guide]\ntype = \"prismatic\"\na = \"ground\"\nb = \"block\"\naxis = [1, 2, -2]\n";
    let k = 130.0;
    let c = damper(k, MASS);
    // Its other end is a frame that does not move, on the line of the guide: rest length as drawn.
    let spring = format!(
        "[frame.wall]\nposition = [1.3, 1.8, -1.5]\n\
         [spring.tie]\na = \"wall\"\nb = \"block\"\nstiffness = {k}\ndamping = {c}\n\
         [output.along]\nat = \"guide\"\nquantities = [\"distance\"]\n"
    );
    check("two-point spring", &block(along, Vec3::zeros(), &(guide.to_owned() + &spring)), "along.distance", (k, MASS));
    let on_distance =
        format!("{guide}stiffness = {k}\ndamping = {c}\n[output.along]\nat = \"guide\"\nquantities = [\"distance\"]\n");
    check("distance of a joint", &block(along, Vec3::zeros(), &on_distance), "along.distance", (k, MASS));

    // About an axis off the center of mass, through more than a turn: the spring is linear in the angle.
    let (k, arm) = (20.0, Vec3::new(0.3, -0.2, 0.0));
    let inertia = INERTIA[2] + MASS * arm.norm_squared();
    let c = damper(k, inertia);
    let hinge = format!(
        "[joint.hinge]\ntype = \"revolute\"\na = \"ground\"\nb = \"block\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
         stiffness = {k}\ndamping = {c}\n[output.about]\nat = \"hinge\"\nquantities = [\"angle\"]\n"
    );
    let spin = Vec3::z() * 60.0;
    // 0.26 rad a step at 200 steps a period: an error of the midpoint rule of its square over 12, so five times as
    // many.
    check_with(1000.0, "angle of a joint", &block(spin.cross(&arm), spin, &hinge), "about.angle", (k, inertia));
}

const STIFFNESS: [f64; 3] = [100.0, 250.0, 600.0];
const ROTATIONAL: [f64; 3] = [4.0, 9.0, 17.0];

fn bushing(dampers: &str) -> String {
    format!(
        "[joint.pad]\ntype = \"bushing\"\na = \"ground\"\nb = \"block\"\n\
         stiffness = {STIFFNESS:?}\nrotational_stiffness = {ROTATIONAL:?}\n{dampers}"
    )
}

#[test]
fn a_bushing_vibrates_along_and_about_its_axes() {
    for axis in 0..3 {
        let unit = Vec3::ith(axis, 1.0);
        let dampers = [0, 1, 2].map(|axis| damper(STIFFNESS[axis], MASS));
        let text = block(unit, Vec3::zeros(), &bushing(&format!("damping = {dampers:?}\n")));
        let reading = format!("at_block.displacement[{}]", axis + 1);
        check(&format!("along {axis}"), &text, &reading, (STIFFNESS[axis], MASS));

        let dampers = [0, 1, 2].map(|axis| damper(ROTATIONAL[axis], INERTIA[axis]));
        let text = block(Vec3::zeros(), unit * 5.0, &bushing(&format!("rotational_damping = {dampers:?}\n")));
        let reading = format!("at_block.rotation[{}]", axis + 1);
        check(&format!("about {axis}"), &text, &reading, (ROTATIONAL[axis], INERTIA[axis]));
    }
}

/// Under a constant force the displacement is `F/k` along each axis; under a moment about an axis the turn is `M/k`,
/// however far.
#[test]
fn a_bushing_gives_way_by_load_over_stiffness() {
    let loaded = |force: Vec3, moment: Vec3| {
        let list = |v: Vec3| format!("[{}, {}, {}]", v[0], v[1], v[2]);
        let load = format!("[load.push]\nat = \"block\"\nforce = {}\nmoment = {}\n", list(force), list(moment));
        let settings = "[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\noutput_step = 1\n";
        let simulation = start(&block(Vec3::zeros(), Vec3::zeros(), &(bushing("") + &load + settings)));
        (vector(&simulation, "at_block.displacement"), vector(&simulation, "at_block.rotation"))
    };
    let force = Vec3::new(30.0, -20.0, 50.0);
    let expected = Vec3::from_fn(|i, _| force[i] / STIFFNESS[i]);
    let (displacement, rotation) = loaded(force, Vec3::zeros());
    assert!((displacement - expected).norm() < 1e-13 && rotation.norm() < 1e-13, "{displacement} {rotation}");
    for (axis, stiffness) in ROTATIONAL.into_iter().enumerate() {
        let turn = Vec3::ith(axis, 2.0);
        let moment = turn * stiffness;
        let (displacement, rotation) = loaded(Vec3::zeros(), moment);
        assert!((rotation - turn).norm() < 1e-12 && displacement.norm() < 1e-13, "{displacement} {rotation}");
    }
}

/// One number is the stiffness along all axes, or about them.
#[test]
fn a_bushing_may_be_alike_along_all_axes() {
    let pad = |stiffness: &str, rotational: &str| {
        format!(
            "[joint.pad]\ntype = \"bushing\"\na = \"ground\"\nb = \"block\"\n\
             stiffness = {stiffness}\nrotational_stiffness = {rotational}\n\
             [load.push]\nat = \"block\"\nforce = [30, -20, 50]\nmoment = [1, 2, -1]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 1\noutput_step = 1\n"
        )
    };
    let moved = |pad: &str| {
        let simulation = start(&block(Vec3::zeros(), Vec3::zeros(), pad));
        ["at_block.displacement", "at_block.rotation"].map(|name| vector(&simulation, name))
    };
    let one = moved(&pad("\"2*50\"", "9"));
    assert!((one[0] - Vec3::new(0.3, -0.2, 0.5)).norm() < 1e-13, "{one:?}");
    assert_eq!(one, moved(&pad("[100, 100, 100]", "[9, 9, 9]")));
}

/// Two free bodies that turn against each other by more than two radians on a bushing with six different stiffnesses.
#[test]
fn an_anisotropic_bushing_keeps_momenta_and_energy() {
    let run = |step: f64, count: u32, every: u32| {
        let mut random = Random(131);
        let mut builder = SystemBuilder::default();
        let mut add = |name: &str, angular_velocity: Vec3, random: &mut Random| {
            let still = BodyDesign { angular_velocity, velocity: random.vector(), ..body(name, random) };
            let body = builder.add_body(&still);
            builder.body(body)
        };
        let first = add("first", Vec3::new(0.5, -1.0, 0.3), &mut random);
        let second = add("second", Vec3::new(2.0, 3.0, -2.0), &mut random);
        let pose = Pose { place: random.vector() * 0.3, axes: random.rotation() };
        let sides = [first, second].map(|side| builder.tied(&side, &pose));
        cushion(&mut builder, sides, [20.0, 40.0, 70.0], [0.3, 0.5, 0.8], 0.0);
        let (system, mut state) = builder.finish(Vec3::zeros());
        let mut start = None;
        let (mut drift, mut low, mut high, mut turn, mut number) =
            (0.0_f64, f64::INFINITY, f64::NEG_INFINITY, 0.0_f64, 0);
        let [a, b] = sides;
        integrate(&system, &mut state, 1.0, (step, count), |state| {
            let (linear, angular) = system.momentum(&state.q, &state.momentum);
            let (linear_0, angular_0) = *start.get_or_insert((linear, angular));
            drift = drift.max((linear - linear_0).norm() / linear_0.norm());
            drift = drift.max((angular - angular_0).norm() / angular_0.norm());
            let mut snapshot = FrameCache::default();
            let c = snapshot.of(&system, state);
            let components =
                [0, 1, 2].map(|axis| RelativeCoordinate { a, b, measure: Measure::Rotation(axis) }.value(&c, 0.0));
            turn = turn.max(Vec3::from(components).norm());
            if number % every == 0 {
                let energy: f64 = energies(&system, state).iter().sum();
                (low, high) = (low.min(energy), high.max(energy));
            }
            number += 1;
        })
        .unwrap();
        (drift, (high - low) / high, turn)
    };
    let (coarse, fine) = (run(4e-3, 500, 1), run(2e-3, 1000, 2));
    println!(
        "momenta {:.1e}, energy bands {:.1e}, {:.1e}, ratio {:.2}, turned by {:.2} rad",
        fine.0,
        coarse.1,
        fine.1,
        coarse.1 / fine.1,
        fine.2
    );
    assert!(fine.2 > 1.5, "nothing turns");
    // Round-off of 1000 steps; (omega h)^2 / 8 with some rad/s.
    assert!(fine.0 < 1e-12 && fine.1 < 1e-3 && (coarse.1 / fine.1 - 4.0).abs() < 0.5);
}
