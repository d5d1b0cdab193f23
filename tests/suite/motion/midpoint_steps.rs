//! A step of the midpoint integrator: a rejected one leaves the state as it was, however late it is rejected; a step
//! costs no memory; what borrows the integrator's memory between steps changes none; a step ends where refinements
//! fail, and at round-off.

use crate::motion::generalized_alpha::joint;
use crate::running::start as begin;
use crate::support::allocations::count;
use crate::support::machines::design;
use ancf14::fmi::Model;
use ancf14::math::jet::Jet;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::constraint::driven::Driven;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::input::guide::Guide;
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::state::lists::Lists;
use ancf14::mechanics::state::{State, Statistics};
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::solve::dynamics::midpoint::Midpoint;
use ancf14::solve::dynamics::start;
use ancf14::solve::step::integrator::Integrator;
use ancf14_testing::curves::load;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

const STEP: f64 = 1e-3;

/// A beam on a hinge that turns faster and faster, as its motion begins. While `is_broken`, the rate of the drive is
/// not a number: of a step, that counts after all else has been found.
fn driven(is_broken: &Arc<AtomicBool>) -> (System, State, Midpoint) {
    let mut builder = SystemBuilder::default();
    let mut beam = design("beam", 3);
    beam.material.damping = 1e-4;
    let beam = builder.add_beam(&beam);
    let root = builder.node(builder.node_at(beam, 0.0).unwrap());
    let pose = Pose { place: Vec3::zeros(), axes: Mat3::identity() };
    let sides = joint(&mut builder, "hinge", [&Marker::Ground(pose), &root], &pose, revolute::PRIMITIVES);
    let is_broken = Arc::clone(is_broken);
    let angle = Signal::Function(Arc::new(move |time| Jet {
        value: 20.0 * time * time,
        first: if is_broken.load(Ordering::Relaxed) { f64::NAN } else { 40.0 * time },
        second: 40.0,
    }));
    builder.add_drive("hinge", sides, Driven::Angle, (Guide::Value(angle), 0.0), None);
    let (system, mut state) = builder.finish(Vec3::new(0.0, 1.0, -9.0));
    let mut integrator = Midpoint::new(&system, 0.9, STEP, 1e-8);
    start::set_motion(&system, &mut integrator, &mut state).unwrap();
    (system, state, integrator)
}

/// The error of the steps has been carried over the step before its velocities are projected, where it is rejected:
/// from the first step on, also where the error is cleared of what no step resolves (every fourth one).
#[test]
fn steps_rejected_at_their_end_leave_no_trace() {
    let is_broken = Arc::new(AtomicBool::new(false));
    let (system, mut state, mut integrator) = driven(&is_broken);
    let (_, mut other, mut untroubled) = driven(&Arc::default());
    let uncounted = |state: &State| State { statistics: Statistics::default(), ..state.clone() };
    for number in 1..=6 {
        let (before, end) = (uncounted(&state), STEP * f64::from(number));
        is_broken.store(true, Ordering::Relaxed);
        let rejected = integrator.step(&system, &mut state, STEP, end).unwrap_err().to_string();
        assert!(rejected.contains("the rate of drive hinge"), "{rejected}");
        assert_eq!(uncounted(&state), before);
        is_broken.store(false, Ordering::Relaxed);
        integrator.step(&system, &mut state, STEP, end).unwrap();
        untroubled.step(&system, &mut other, STEP, end).unwrap();
        assert_eq!(uncounted(&state), uncounted(&other));
    }
    assert!(state.time_error.known == 3 && state.prediction.known == 2);
}

/// From the third step on: predictions and the derivatives of the motion are known then.
#[test]
fn steps_cost_no_memory() {
    let (system, mut state, mut integrator) = driven(&Arc::default());
    let mut step = |number: u32| integrator.step(&system, &mut state, STEP, STEP * f64::from(number)).unwrap();
    (1..=2).for_each(&mut step);
    assert_eq!(count(|| (3..=8).for_each(&mut step)), 0);
}

/// Results and estimates borrow the memory of the integrator between its steps, and may leave anything there.
#[test]
fn memory_lent_between_steps_changes_no_step() {
    let (system, mut state, mut integrator) = driven(&Arc::default());
    let (_, mut other, mut untroubled) = driven(&Arc::default());
    for number in 1..=6 {
        let end = STEP * f64::from(number);
        integrator.step(&system, &mut state, STEP, end).unwrap();
        untroubled.step(&system, &mut other, STEP, end).unwrap();
        assert_eq!(state, other);
        let lent = integrator.spare();
        let moved: Vec<f64> = state.q.iter().map(|value| value + 0.1).collect();
        lent.frames.set(&system, &moved, &state.triads);
        lent.state.clone_from(&state);
        let State { lists, holonomy, .. } = lent.state;
        let Lists { q, velocity, momentum, constraint_momenta, strain_rates, .. } = lists;
        for list in [q, velocity, momentum, constraint_momenta, strain_rates, holonomy] {
            list.fill(f64::NAN);
        }
    }
}

/// Three masses between springs that differ by a factor of 4e7, with steps far too long for two of them: corrections do
/// not shrink as their ratio promises, refinements fail, and the iteration that starts anew must still end: each step
/// takes a few iterations.
#[test]
fn steps_end_where_refinements_fail() {
    let masses: String = [5.88e8, 15.9, 96700.0]
        .iter()
        .enumerate()
        .map(|(number, stiffness)| {
            let before = if number == 0 { String::from("wall") } else { format!("mass{}", number - 1) };
            let speed = if number == 2 { 0.3 } else { 0.0 };
            format!(
                "[body.mass{number}]\nmass = 1\nposition = [{}, 0, 0]\ninertia = [0.1, 0.1, 0.1]\nvelocity = [{speed}, 0, 0]\n\
                 [joint.rail{number}]\ntype = \"prismatic\"\na = \"ground\"\nb = \"mass{number}\"\naxis = [1, 0, 0]\n\
                 [spring.spring{number}]\na = \"{before}\"\nb = \"mass{number}\"\nstiffness = {stiffness}\n",
                number + 1
            )
        })
        .collect();
    let mut simulation = begin(&format!(
        "format = 1\n[model]\nname = \"Masses\"\ngravity = [0, 0, 0]\n[frame.wall]\nposition = [0, 0, 0]\n{masses}\
         [load.push]\nat = \"mass1\"\nforce = [\"1.59*sin(2.39*t)\", 0, 0]\n\
         [simulation]\nstep = 0.558\noutput_step = 0.558\nstop = 9.3\n"
    ));
    for number in 1..=16 {
        simulation.advance(0.558 * f64::from(number)).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    let statistics = simulation.state().statistics;
    assert!(statistics.iterations <= 3 * statistics.steps, "{statistics:?}");
}

/// A tolerance below round-off: refinements no longer shrink, and are as small as they get. With round-off taken to be
/// 1e-14, 30 steps of the shaft were rejected.
#[test]
fn steps_end_at_round_off() {
    let shaft = include_str!("../../../models/rotating_shaft.toml");
    let mut simulation = load(shaft, &[("simulation.tolerance", "1e-14")]);
    simulation.advance(1.6).unwrap_or_else(|failure| panic!("{}", failure.message));
    let Statistics { steps, rejected, .. } = simulation.state().statistics;
    assert_eq!((steps, rejected), (3200, 0));
}
