//! A step of generalized-alpha: its tangent is exact, so that Newton converges quadratically, but for what the damping
//! of the material has while elements are deformed; refused steps leave the state as it was; the state has all that the
//! next step needs; a step costs no memory.

use crate::motion::generalized_alpha::{joint, turning};
use crate::support::allocations::count;
use crate::support::machines::{ancf14, design};
use ancf14::math::jet::Jet;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::constraint::driven::Driven;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::force::spring::Spring;
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::input::guide::{FrameGuide, Guide};
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::marker::relative_coordinate::Measure;
use ancf14::mechanics::state::{State, Statistics};
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::solve::dynamics::generalized_alpha::GeneralizedAlpha;
use ancf14::solve::dynamics::start;
use ancf14::solve::step::integrator::{Integrator, MOST_HALVINGS, grid_step};
use ancf14::solve::step::limits;
use std::sync::Arc;

/// A machine with everything: a spinning beam with the `damping` of its material (s) on a moving frame, a body at its
/// end, a driven hinge, a spring with a damper, a load that turns with the section.
fn everything(damping: f64) -> (System, State) {
    let mut builder = SystemBuilder::default();
    let pose = Pose { place: Vec3::zeros(), axes: Mat3::identity() };
    let place = [Signal::Constant(0.0), Signal::Constant(0.0), turning(0.02)];
    let rotation = [0.3, 0.0, 0.0]
        .map(|rate| Signal::Function(Arc::new(move |time| Jet { value: rate * time, first: rate, second: 0.0 })));
    let frame = builder.add_frame("base", FrameGuide::Signals { place, rotation }, pose);
    let beam = builder.add_beam(&BeamDesign {
        line: Centerline::straight(Vec3::zeros(), Vec3::new(1.0, 0.3, -0.2), 3),
        section: Section { polar_moment: 4e-4, torsion_constant: 1e-6, ..Section::rectangle(0.02, 0.03) },
        material: Material { young: 2e8, shear: 8e7, density: 1000.0, damping },
        angular_velocity: Vec3::new(20.0, 4.0, 3.0),
        ..design("beam", 3)
    });
    let body = builder.add_body(&BodyDesign {
        name: "disk".into(),
        mass: 0.4,
        position: Vec3::new(1.1, 0.4, -0.2),
        inertia: Mat3::from_diagonal(&Vec3::new(2e-2, 1.5e-2, 1e-2)),
        axes: Mat3::identity(),
        velocity: Vec3::zeros(),
        angular_velocity: Vec3::new(10.0, 0.0, 5.0),
    });
    let (frame, body) = (builder.frame(frame), builder.body(body));
    let [root, tip] = [0.0, 1.0].map(|fraction| builder.node(builder.node_at(beam, fraction).unwrap()));
    joint(&mut builder, "root", [&frame, &root], &pose, spherical::PRIMITIVES);
    let hinge = Pose { place: Vec3::new(1.0, 0.35, -0.2), axes: Mat3::identity() };
    let sides = joint(&mut builder, "hinge", [&tip, &body], &hinge, revolute::PRIMITIVES);
    builder.add_drive("hinge", sides, Driven::Angle, (Guide::Value(turning(0.2)), 0.0), None);
    let coordinate =
        builder.add_relative_coordinate(Marker::Ground(Pose { place: Vec3::z(), ..pose }), body, Measure::Length);
    builder.add_spring(Spring {
        name: "strut".into(),
        coordinate,
        stiffness: 200.0,
        damping: 20.0,
        rest: 0.8,
        mobility: 0.0,
        law: None,
        memory: None,
    });
    builder.add_load(Load {
        name: "thrust".into(),
        site: Site::Point(builder.section_at(beam, 0.7)),
        guide: LoadGuide::Signals {
            force: [3.0, 20.0, -10.0].map(Signal::Constant),
            moment: [5.0, 2.0, -3.0].map(Signal::Constant),
        },
        direction: Direction::Follower,
    });
    builder.finish(Vec3::new(0.0, 1.0, -9.0))
}

/// [`everything`] with `damping` (s) as its motion begins.
fn moving_with(damping: f64, tolerance: f64) -> (System, State, GeneralizedAlpha) {
    let (system, mut state) = everything(damping);
    let mut integrator = GeneralizedAlpha::new(&system, 0.7, tolerance);
    start::set_motion(&system, &mut integrator, &mut state).unwrap();
    (system, state, integrator)
}

/// [`everything`], damped, as its motion begins.
fn moving(tolerance: f64) -> (System, State, GeneralizedAlpha) {
    moving_with(2e-3, tolerance)
}

/// Each correction is of the size of the last one's square: measured 0.9 to 11 times it. A term that the tangent misses
/// leaves a constant share instead, of 1e-4 and more.
#[test]
fn newton_is_quadratic() {
    let (system, mut state, mut integrator) = moving_with(0.0, 1e-9);
    let (step, mut seen) = (2e-3, 0);
    for number in 1..=20 {
        integrator.step(&system, &mut state, step, step * f64::from(number)).unwrap();
        let convergence = integrator.convergence.unwrap();
        let corrections = &convergence.corrections[..convergence.iterations];
        println!("{corrections:?}");
        for pair in corrections.windows(2).filter(|pair| pair[0] < 1e-3 && pair[0] > 1e-6) {
            assert!(pair[1] < 30.0 * pair[0] * pair[0], "{pair:?}");
            seen += 1;
        }
    }
    assert!(seen > 20, "{seen}");
}

/// A free strip that turns by `turn` rad a step of 1 ms about an oblique axis, with the `damping` of its material, s.
fn turning_strip(damping: f64, turn: f64) -> (System, State) {
    let mut builder = SystemBuilder::default();
    builder.add_beam(&BeamDesign {
        line: Centerline::straight(Vec3::zeros(), Vec3::new(0.5, 0.1, 0.05), 8),
        section: Section::rectangle(0.02, 0.005),
        material: Material { young: 2e9, shear: 8e8, density: 1500.0, damping },
        elements: ancf14(Strain::Large, Twist::Linear),
        angular_velocity: Vec3::new(3.0, 4.0, 12.0) * (turn / 13e-3),
        ..design("strip", 8)
    });
    builder.finish(Vec3::zeros())
}

/// Newton's matrix leaves out what the damping of the material changes by as elements are deformed, but not what it
/// changes by as they turn: a strip that is bent much less than it turns, 0.05 rad a step, takes as many iterations
/// with damping as without. Without the turn of the matrix, corrections would shrink by a part of the turn only, and
/// most steps take one iteration more.
#[test]
fn damped_strips_that_turn_take_no_more_iterations() {
    let totals = [0.0, 1e-4, 1e-3, 1e-2].map(|damping| {
        let (system, mut state) = turning_strip(damping, 0.05);
        let mut integrator = GeneralizedAlpha::new(&system, 0.8, 1e-11);
        start::set_motion(&system, &mut integrator, &mut state).unwrap();
        for number in 1..=50 {
            integrator.step(&system, &mut state, 1e-3, 1e-3 * f64::from(number)).unwrap();
        }
        state.statistics.iterations
    });
    println!("{totals:?} iterations in 50 steps");
    // A step or two may have their last correction just above the tolerance.
    assert!(totals.iter().all(|total| *total <= totals[0] + 2), "{totals:?}");
}

/// A strongly damped beam that a step of 10 ms deforms a lot: with the matrix of the iteration Newton does not converge
/// within its limit, and the exact one takes over.
#[test]
fn steps_that_the_fast_matrix_does_not_solve_are_taken_with_the_exact_one() {
    let (system, mut state, mut integrator) = moving_with(1e-2, 1e-9);
    integrator.step(&system, &mut state, 1e-2, 1e-2).unwrap_or_else(|error| panic!("{error}"));
    let (all, last) = (state.statistics.iterations, integrator.convergence.unwrap().iterations);
    assert!(all == (limits::ITERATIONS + last) as u64, "{all} iterations, {last} of them with the exact matrix");
}

/// A refused step leaves all but the counts as it was; halved, it goes through.
#[test]
fn refused_steps_leave_no_trace() {
    let (system, mut state, mut integrator) = moving(1e-8);
    integrator.step(&system, &mut state, 1e-3, 1e-3).unwrap();
    let uncounted = |state: &State| State { statistics: Statistics::default(), ..state.clone() };
    let before = uncounted(&state);
    for (step, reason) in [(0.06, "10 iterations"), (4.0, "frame base turned by 1.20 rad")] {
        let refused = integrator.step(&system, &mut state, step, 1e-3 + step).unwrap_err().to_string();
        assert!(refused.contains(reason), "{refused}");
        assert_eq!(uncounted(&state), before);
    }
    grid_step(&mut integrator, &system, &mut state, 0.06, 0.061).unwrap();
    println!("{:?}", state.statistics);
    assert!(state.time == 0.061 && state.statistics.rejected > 0 && state.halving < MOST_HALVINGS);
}

/// A tangent that turns too far in a step is refused though Newton finds a solution.
#[test]
fn turns_are_limited() {
    let mut builder = SystemBuilder::default();
    builder.add_beam(&BeamDesign { angular_velocity: Vec3::z() * 60.0, ..design("beam", 1) });
    let (system, mut state) = builder.finish(Vec3::zeros());
    let mut integrator = GeneralizedAlpha::new(&system, 0.8, 1e-8);
    start::set_motion(&system, &mut integrator, &mut state).unwrap();
    let refused = integrator.step(&system, &mut state, 0.01, 0.01).unwrap_err().to_string();
    assert!(refused.contains("the tangent at beam.start turned by 0."), "{refused}");
}

/// From a copy of the state another integrator goes on with the very bits: nothing else persists.
#[test]
fn copies_go_on_with_the_same_bits() {
    let (system, mut state, mut integrator) = moving(1e-8);
    let (_, mut copy, mut other) = moving(1e-8);
    let step = |integrator: &mut GeneralizedAlpha, state: &mut State, number: u32| {
        integrator.step(&system, state, 1e-3, 1e-3 * f64::from(number)).unwrap();
    };
    (1..=5).for_each(|number| step(&mut integrator, &mut state, number));
    copy.clone_from(&state);
    assert_eq!(copy, state.clone());
    (6..=10).for_each(|number| step(&mut integrator, &mut state, number));
    assert_ne!(copy, state);
    (6..=10).for_each(|number| step(&mut other, &mut copy, number));
    assert_eq!(copy, state);
}

#[test]
fn steps_cost_no_memory() {
    let (system, mut state, mut integrator) = moving(1e-8);
    integrator.step(&system, &mut state, 1e-3, 1e-3).unwrap();
    assert_eq!(count(|| integrator.step(&system, &mut state, 1e-3, 2e-3).unwrap()), 0);
}
