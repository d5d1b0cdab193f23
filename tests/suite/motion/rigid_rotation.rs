//! A rigid body turns as Euler says, to second order in the step: free of torque it keeps its angular momentum to
//! round-off and its energy to second order or better, also where it tips over about its intermediate axis, and its
//! directors stay orthonormal; tensor and principal moments are the same body; a top precesses and a disk wobbles at
//! the rate of theory. Wrong director inertia, or conditions that do work, show in the rates; a body that loses a
//! gyroscopic term falls like a stick.

use crate::running::{run, start, vector};
use crate::support::machines::{energies, integrate};
use ancf14::math::{Mat3, Vec3, rotation};
use ancf14::mechanics::body::kinematics;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use std::f64::consts::TAU;

/// A free body with these principal moments, axes along the global ones, that turns by `angular_velocity`.
fn free(moments: [f64; 3], angular_velocity: Vec3) -> (System, State) {
    let mut builder = SystemBuilder::default();
    builder.add_body(&BodyDesign {
        name: "body".into(),
        mass: 2.0,
        position: Vec3::new(0.3, -0.2, 0.1),
        inertia: Mat3::from_diagonal(&Vec3::from(moments)),
        axes: Mat3::identity(),
        velocity: Vec3::new(0.1, 0.2, -0.3),
        angular_velocity,
    });
    builder.finish(Vec3::zeros())
}

fn axes(state: &State) -> Mat3 {
    kinematics::pose(&state.q, 0).axes
}

/// A body that turns about its intermediate axis tips over, again and again. Its energy changes with order 4 in the
/// step: forces in the middle of a step do no work on quadratic conditions, and velocities that these do not allow have
/// energies of fourth order.
#[test]
fn tipping_keeps_momentum_energy_and_axes() {
    let bands = [4e-3, 2e-3].map(|step: f64| {
        let (system, mut state) = free(MOMENTS, Vec3::new(1e-3, 5.0, 0.0));
        let mut begin = None;
        let (mut drift, mut low, mut high, mut skew, mut tips, mut side) =
            (0.0_f64, f64::INFINITY, f64::NEG_INFINITY, 0.0_f64, 0, 1.0);
        integrate(&system, &mut state, 1.0, (step, (20.0 / step).round() as u32), |state| {
            let (linear, angular) = system.momentum(&state.q, &state.momentum);
            let (linear_0, angular_0) = *begin.get_or_insert((linear, angular));
            drift = drift.max((linear - linear_0).norm() / linear_0.norm());
            drift = drift.max((angular - angular_0).norm() / angular_0.norm());
            let energy = energies(&system, state)[0];
            (low, high) = (low.min(energy), high.max(energy));
            let axes = axes(state);
            skew = skew.max((axes.tr_mul(&axes) - Mat3::identity()).amax());
            // The intermediate axis points along the momentum, then against it.
            let now = axes.column(1).dot(&angular.normalize());
            if now * side < -0.9 {
                (tips, side) = (tips + 1, now.signum());
            }
        })
        .unwrap();
        let band = (high - low) / low;
        println!("h = {step}: momenta {drift:.1e}, energy {band:.1e}, directors {skew:.1e}, tipped {tips} times");
        assert!(tips >= 3, "it does not tip");
        // Round-off of 10,000 steps.
        assert!(drift < 1e-12 && skew < 1e-12, "{drift:e} {skew:e}");
        band
    });
    let ratio = bands[0] / bands[1];
    println!("ratio {ratio:.2}");
    assert!(bands[1] < 1e-8 && ratio > 12.0, "{bands:?}");
}

/// A fast body, 0.2 rad a step, for 160 turns. Taking all that the conditions do not allow out of the momentum at every
/// step costs 8 % of the energy in this time, and an eighth of it with half the step; taking out what alternates costs
/// a rest of higher order, 4 and more.
#[test]
fn regression_a_fast_body_keeps_its_energy() {
    let changes = [(2e-3, 5000), (1e-3, 10_000)].map(|(step, count)| {
        let (system, mut state) = free(MOMENTS, Vec3::new(60.0, 60.0, 52.9));
        let mut energy = Vec::new();
        integrate(&system, &mut state, 1.0, (step, count), |state| energy.push(energies(&system, state)[0])).unwrap();
        energy.iter().map(|now| (now / energy[0] - 1.0).abs()).fold(0.0, f64::max)
    });
    println!("energy changes by {changes:?} in 10 s");
    assert!(changes[0] < 1e-2 && changes[0] / changes[1] > 12.0, "{changes:?}");
}

const MOMENTS: [f64; 3] = [0.1, 0.2, 0.3];

/// Axes after `duration` by Euler's equations, with the rule of Runge and Kutta in steps of 1e-4 s.
fn euler(mut omega: Vec3, duration: f64) -> Mat3 {
    let moments = Vec3::from(MOMENTS);
    let rate = |turn: &Mat3, omega: &Vec3| {
        let momentum = moments.component_mul(omega);
        (turn * omega.cross_matrix(), -omega.cross(&momentum).component_div(&moments))
    };
    let (mut turn, h) = (Mat3::identity(), 1e-4);
    for _ in 0..(duration / h).round() as u32 {
        let k1 = rate(&turn, &omega);
        let k2 = rate(&(turn + k1.0 * (0.5 * h)), &(omega + k1.1 * (0.5 * h)));
        let k3 = rate(&(turn + k2.0 * (0.5 * h)), &(omega + k2.1 * (0.5 * h)));
        let k4 = rate(&(turn + k3.0 * h), &(omega + k3.1 * h));
        turn += (k1.0 + k2.0 * 2.0 + k3.0 * 2.0 + k4.0) * (h / 6.0);
        omega += (k1.1 + k2.1 * 2.0 + k3.1 * 2.0 + k4.1) * (h / 6.0);
    }
    turn
}

/// Where the body has turned to is what Euler's equations say, with order 2 in the step.
#[test]
fn it_turns_as_euler_says() {
    let omega = Vec3::new(0.4, 5.0, -0.7);
    let expected = euler(omega, 2.0);
    let errors = [4e-3, 2e-3].map(|step: f64| {
        let (system, mut state) = free(MOMENTS, omega);
        integrate(&system, &mut state, 1.0, (step, (2.0 / step).round() as u32), |_| {}).unwrap();
        (axes(&state) - expected).norm()
    });
    let order = (errors[0] / errors[1]).log2();
    println!("off by {:.2e}, {:.2e}, order {order:.2}", errors[0], errors[1]);
    assert!(errors[1] < 1e-2 && (order - 2.0).abs() < 0.1, "{errors:?}");
}

/// Principal moments along skew axes, and the tensor of the same body along the global ones: the same motion. Through
/// the model file, with the signs of its products.
#[test]
fn a_tensor_is_the_same_body_as_its_principal_moments() {
    let turn = rotation::rotation_matrix(&Vec3::new(0.7, -0.4, 1.1));
    let moments = Vec3::new(0.12, 0.2, 0.27);
    let tensor = turn * Mat3::from_diagonal(&moments) * turn.transpose();
    let row = |v: Vec3| format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2]);
    let axes = [0, 1, 2].map(|axis| row(turn.column(axis).into_owned())).join(", ");
    let principal = format!("inertia = {}\naxes = [{axes}]", row(moments));
    let six = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].map(|(i, j)| tensor[(i, j)]);
    let motion = |inertia: &str| {
        let mut simulation = start(&format!(
            "format = 1\n[model]\nname = \"Body\"\ngravity = [0, 0, -9.81]\n\
             [body.block]\nmass = 3\nposition = [0.2, 0.1, -0.3]\nangular_velocity = [3, -2, 4]\n{inertia}\n\
             [joint.ball]\ntype = \"spherical\"\na = \"ground\"\nb = \"block\"\nat = [0, 0, 0]\n\
             [output.place]\nat = \"block\"\nquantities = [\"position\", \"velocity\", \"rotation\", \"angular_velocity\"]\n\
             [simulation]\nstop = 1\nstep = 2e-3\noutput_step = 0.01\n"
        ));
        let mut rows = Vec::new();
        run(&mut simulation, 0.01, 1.0, |simulation| {
            let names = ["position", "velocity", "rotation", "angular_velocity"];
            rows.push(names.map(|name| vector(simulation, &format!("place.{name}"))));
        });
        rows
    };
    let expected = motion(&principal);
    let found = motion(&format!("inertia = {six:?}"));
    let swing = (expected[99][2] - expected[0][2]).norm();
    let apart = found.iter().zip(&expected).flat_map(|(a, b)| a.iter().zip(b).map(|(a, b)| (a - b).norm()));
    let apart = apart.fold(0.0, f64::max);
    println!("apart {apart:.1e} after a turn of {swing:.1} rad");
    // Round-off of the eigenvalues, and of 500 steps.
    assert!(swing > 1.0 && apart < 1e-11, "{apart:e}");
    // The sign of the products matters.
    let [xx, yy, zz, xy, yz, zx] = six;
    let wrong = motion(&format!("inertia = {:?}", [xx, yy, zz, -xy, -yz, -zx]));
    assert!((wrong[99][0] - expected[99][0]).norm() > 1e-3);
}

/// Steady precession of a heavy top on its tip, 60 degrees off the vertical: both rates `w` that solve
/// `(I1 cos) w^2 - I3 s w + m g l = 0` with the spin `s` about its axis.
#[test]
fn a_top_precesses_at_the_rate_of_theory() {
    let (mass, arm, gravity) = (1.3, 0.15, 9.81);
    let (about_center, about_axis) = (8e-3, 6e-3);
    let (tilt, spin) = (60_f64.to_radians(), 200.0);
    let about_tip = about_center + mass * arm * arm;
    let (a, b, c) = (about_tip * tilt.cos(), -about_axis * spin, mass * gravity * arm);
    let root = (b * b - 4.0 * a * c).sqrt();
    // The slow one; fast tops go round with about m g l / (I3 s).
    let rate = 2.0 * c / (-b + root);
    let direction = Vec3::new(tilt.sin(), 0.0, tilt.cos());
    let turning = Vec3::z() * rate;
    // The spin about the axis has a part of the precession in it.
    let angular = direction * (spin - rate * tilt.cos()) + turning;
    let list = |v: Vec3| format!("[{:?}, {:?}, {:?}]", v[0], v[1], v[2]);
    let across = Vec3::y();
    let text = format!(
        "format = 1\n[model]\nname = \"Top\"\ngravity = [0, 0, -{gravity}]\n\
         [body.top]\nmass = {mass}\nposition = {}\ninertia = [{about_center}, {about_center}, {about_axis}]\n\
         axes = [{}, {}, {}]\nvelocity = {}\nangular_velocity = {}\n\
         [joint.tip]\ntype = \"spherical\"\na = \"ground\"\nb = \"top\"\nat = [0, 0, 0]\n\
         [output.center]\nat = \"top\"\nquantities = [\"position\"]\n\
         [simulation]\nstop = 10\nstep = 5e-4\noutput_step = 5e-3\n",
        list(direction * arm),
        list(across.cross(&direction)),
        list(across),
        list(direction),
        list(turning.cross(&direction) * arm),
        list(angular),
    );
    let mut simulation = start(&text);
    let duration = 3.0;
    let (mut angle, mut before, mut nodding) = (0.0, 0.0_f64, 0.0_f64);
    run(&mut simulation, 5e-3, duration, |simulation| {
        let center = vector(simulation, "center.position");
        let now = center[1].atan2(center[0]);
        let change = now - before;
        angle += change - TAU * (change / TAU).round();
        before = now;
        nodding = nodding.max((center[2] / arm - tilt.cos()).abs());
    });
    let found = angle / duration;
    let fast = mass * gravity * arm / (about_axis * spin);
    println!("precession {found:.4} rad/s, theory {rate:.4}, of a fast top {fast:.4}; nodding {nodding:.1e}");
    assert!((found / rate - 1.0).abs() < 2e-3, "{found}");
    assert!((found / fast - 1.0).abs() < 1e-1);
    // Steady: what nods is the error of the step, (omega h)^2 / 12 of 0.1 rad.
    assert!(nodding < 5e-3, "{nodding:e}");
}

/// A flat disk has no director inertia across itself (`E1 = 0`): the mass matrix is singular, the motion is not.
/// Thrown, it wobbles with the rate `L/I` of a symmetric body, twice its spin for small angles.
#[test]
fn a_flat_disk_wobbles() {
    let (moment, spin, tilt) = (0.02, 10.0, 0.1_f64);
    let (system, mut state) =
        free([2.0 * moment, moment, moment], Vec3::new(spin * tilt.cos(), spin * tilt.sin(), 0.0));
    assert_eq!(system.bodies[0].director_inertia[0], 0.0);
    let step = 5e-4;
    let mut begin = None;
    let (mut angle, mut before, mut drift, mut low, mut high) = (0.0, None, 0.0_f64, f64::INFINITY, f64::NEG_INFINITY);
    let mut rate = 0.0;
    integrate(&system, &mut state, 1.0, (step, 4000), |state| {
        let angular = system.momentum(&state.q, &state.momentum).1;
        let center = Vec3::from_column_slice(&state.q[..3]);
        // About the center of mass: the body flies.
        let own = angular - center.cross(&Vec3::from_column_slice(&state.momentum[..3]));
        let own_0 = *begin.get_or_insert(own);
        drift = drift.max((own - own_0).norm() / own_0.norm());
        let energy = energies(&system, state)[0];
        (low, high) = (low.min(energy), high.max(energy));
        // The turn of the disk's axis about the momentum.
        let along = own_0.normalize();
        let across = (Vec3::z() - along * along[2]).normalize();
        let axis = axes(state).column(0).into_owned();
        let now = axis.dot(&along.cross(&across)).atan2(axis.dot(&across));
        let change: f64 = now - before.unwrap_or(now);
        angle += change - TAU * (change / TAU).round();
        before = Some(now);
        rate = own_0.norm() / moment;
    })
    .unwrap();
    let found = angle / (4000.0 * step);
    println!("wobble {found:.4} rad/s, theory {rate:.4}; momentum {drift:.1e}, energy {:.1e}", (high - low) / low);
    // (omega h)^2 / 12 of 20 rad/s, 5e-4 s: 1e-5.
    assert!((found / rate - 1.0).abs() < 1e-4, "{found}");
    assert!(drift < 1e-12 && (high - low) / low < 1e-4);
}
