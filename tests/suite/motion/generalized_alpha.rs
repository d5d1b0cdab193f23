//! Generalized-alpha must be of order 2, hold position constraints to round-off, damp what the step does not resolve as
//! its spectral radius says and nothing else, and agree with the midpoint rule where both are accurate. A missing or
//! wrong force, and weights that are off, show in one of these; wrong derivatives in generalized_alpha_steps.rs.

use crate::joints::joints_in_motion;
use crate::motion::dynamics::spinning;
use crate::random::Random;
use crate::support::machines::{clamp, design, energies, hold, integrate, march};
use ancf14::math::jet::Jet;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::coordinates::{NODE, P};
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::BeamDesign;
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::constraint::driven::Driven;
use ancf14::mechanics::constraint::joint::Joint;
use ancf14::mechanics::constraint::primitive::Primitive;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::force::load::{Direction, Load, LoadGuide, Site};
use ancf14::mechanics::force::spring::Spring;
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::input::guide::Guide;
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::marker::relative_coordinate::Measure;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::solve::dynamics::generalized_alpha::GeneralizedAlpha;
use ancf14::solve::step::response::{Responder, Response};
use nalgebra::Matrix3;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;

fn method(system: &System, radius: f64) -> GeneralizedAlpha {
    GeneralizedAlpha::new(system, radius, 1e-8)
}

/// Largest difference of the nodes' places, m; the machine has beams only.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let places = a.iter().zip(b).enumerate().filter(|(index, _)| index % NODE < P);
    places.fold(0.0, |largest, (_, (a, b))| largest.max((a - b).abs()))
}

/// The beam of `spinning`, spun up by a moment that turns with it: where the spin accelerates while the tangent turns,
/// the chart's own force counts.
fn spun_up() -> (System, State) {
    let section = Section {
        polar_moment: 4e-4,
        torsion_constant: 1e-5,
        second_moment_y: 2e-6,
        second_moment_z: 4e-6,
        ..Section::rectangle(0.02, 0.03)
    };
    let material = Material { young: 2e6, shear: 8e7, density: 1000.0, damping: 0.0 };
    let to = Vec3::new(1.2, 0.3, -0.4);
    let mut builder = SystemBuilder::default();
    let beam = builder.add_beam(&BeamDesign {
        line: Centerline::straight(Vec3::zeros(), to, 4),
        section,
        material,
        ..design("beam", 4)
    });
    // Grows smoothly: nothing that the steps do not resolve is stirred.
    let moment = [10.0, 3.0, 2.0].map(|size| {
        Signal::Function(Arc::new(move |time| {
            let (sin, cos) = (10.0 * PI * time).sin_cos();
            let rate = 10.0 * PI * size;
            Jet { value: size * (1.0 - cos), first: rate * sin, second: 10.0 * PI * rate * cos }
        }))
    });
    builder.add_load(Load {
        name: "motor".into(),
        site: Site::Point(builder.section_at(beam, 0.5)),
        guide: LoadGuide::Signals { force: [0.0; 3].map(Signal::Constant), moment },
        direction: Direction::Follower,
    });
    builder.finish(Vec3::zeros())
}

/// Halving the step divides the error by four, against the midpoint rule at a fine step. Without the chart's own force
/// the order is 1 where the spin accelerates, and the error 20 to 200 times larger.
#[test]
fn order_two_in_the_step() {
    for (name, (system, drawn), coarsest) in [("free", spinning(), 1e-3), ("spun up", spun_up(), 2e-3)] {
        let mut reference = drawn.clone();
        integrate(&system, &mut reference, 1.0, (5e-5, 4000), |_| {}).unwrap();
        for radius in [0.5, 0.8] {
            let error = |step: f64| {
                let mut state = drawn.clone();
                let count = (0.2 / step).round() as u32;
                march(&system, &mut state, &mut method(&system, radius), (step, count), |_| {}).unwrap();
                distance(&state.q, &reference.q)
            };
            let errors = [coarsest, 0.5 * coarsest, 0.25 * coarsest].map(error);
            let order = 0.5 * (errors[0] / errors[2]).log2();
            println!("{name}, {radius}: errors {errors:?}, order {order:.3}");
            // Axial vibrations of the beam, which these steps do not resolve, and the reference's own error count a
            // little.
            assert!((order - 2.0).abs() < 0.2, "{name}, {radius}: {order}");
        }
    }
}

/// The free spinning beam of MECHANICS 7.3: linear momentum is exact, angular momentum and energy are lost as the table
/// there says. Newton takes 3 iterations a step, with the tangent of the gyroscopic force only.
#[test]
fn free_spinning_beam() {
    for (radius, step, energy, angular) in
        [(0.8, 1e-3, 1.5e-4, 1e-3), (0.8, 5e-4, 4e-5, 2.5e-4), (1.0, 1e-3, 1e-5, 5e-5), (0.5, 1e-3, 3e-3, 5e-3)]
    {
        let (system, mut state) = spinning();
        let mut totals = Vec::new();
        let (mut start, mut drift) = (None, [0.0_f64; 2]);
        let steps = (step, (4.0 / step) as u32);
        march(&system, &mut state, &mut method(&system, radius), steps, |state| {
            totals.push(energies(&system, state).iter().sum::<f64>());
            let now = system.momentum(&state.q, &state.momentum);
            let (linear, angular) = *start.get_or_insert(now);
            drift[0] = drift[0].max((now.0 - linear).norm() / linear.norm());
            drift[1] = drift[1].max((now.1 - angular).norm() / angular.norm());
        })
        .unwrap();
        let tenth = totals.len() / 10;
        let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
        let change = mean(&totals[totals.len() - tenth..]) / mean(&totals[..tenth]) - 1.0;
        let iterations = state.statistics.iterations as f64 / state.statistics.steps as f64;
        println!("{radius}, h = {step}: energy {change:.1e}, momenta {drift:?}, {iterations:.2} iterations a step");
        assert!(change < 0.0 && change > -energy, "{radius}, {step}: {change:e}");
        assert!(drift[0] < 1e-12 && drift[1] < angular, "{radius}, {step}: {drift:?}");
        // Without any damping some vibrations are never small.
        assert!(iterations < if radius < 1.0 { 3.2 } else { 3.7 }, "{iterations}");
    }
}

/// Joints of every kind hold to round-off at every step, and what numerical damping takes from the energy is little.
#[test]
fn joints_hold() {
    let mut random = Random(11);
    let kinds = [("weld", weld::PRIMITIVES), ("spherical", spherical::PRIMITIVES), ("revolute", revolute::PRIMITIVES)];
    for (name, primitives) in kinds {
        let (system, mut state) = joints_in_motion::machine(&mut random, primitives);
        let (mut gap, mut totals, mut swing) = (0.0_f64, Vec::new(), 0.0_f64);
        let drawn = state.q.clone();
        march(&system, &mut state, &mut method(&system, 0.8), (1e-3, 400), |state| {
            let mut snapshot = FrameCache::default();
            let mut g = vec![0.0; system.constraints()];
            system.constraint_conditions(&snapshot.of(&system, state), &mut g);
            gap = g.iter().fold(gap, |gap, value| gap.max(value.abs()));
            let parts = energies(&system, state);
            totals.push(parts.iter().sum::<f64>());
            swing = swing.max(parts[0]);
        })
        .unwrap();
        let change = (totals[totals.len() - 1] - totals[0]) / swing;
        println!("{name}: conditions {gap:.1e}, energy {change:.1e}, moved {:.2} m", distance(&state.q, &drawn));
        assert!(distance(&state.q, &drawn) > 0.2, "nothing moves");
        assert!(gap < 1e-13, "{name}: {gap:e}");
        assert!(change < 0.0 && change > -1e-4, "{name}: {change:e}");
    }
}

/// One step of an undamped vibration by `x, h x', h² a`, from the definition; `speed` is the angular frequency times
/// the step.
fn amplification(radius: f64, speed: f64) -> Matrix3<f64> {
    let (alpha_m, alpha_f) = ((2.0 * radius - 1.0) / (radius + 1.0), radius / (radius + 1.0));
    let gamma = 0.5 + alpha_f - alpha_m;
    let beta = 0.25 * (0.5 + gamma) * (0.5 + gamma);
    let square = speed * speed;
    // (1 − α_m) a' + α_m a = −Ω² [(1 − α_f) x' + α_f x], x' = x + v + (1/2 − β) a + β a'.
    let divisor = 1.0 - alpha_m + square * (1.0 - alpha_f) * beta;
    let a = [
        -square / divisor,
        -square * (1.0 - alpha_f) / divisor,
        -(alpha_m + square * (1.0 - alpha_f) * (0.5 - beta)) / divisor,
    ];
    Matrix3::new(
        1.0 + beta * a[0],
        1.0 + beta * a[1],
        0.5 - beta + beta * a[2],
        gamma * a[0],
        1.0 + gamma * a[1],
        1.0 - gamma + gamma * a[2],
        a[0],
        a[1],
        a[2],
    )
}

/// A bar of one element, held at one end, vibrates along itself in its slowest mode: tip, root's and tip's slope. The
/// energy of a small strain is quadratic in them: every step is that of one linear vibration, at any ratio of step and
/// period. Far beyond the step the amplitude falls by the spectral radius a step.
#[test]
fn axial_vibration_is_damped_as_theory_says() {
    const MODE: [usize; 3] = [3, 7, 10];
    let bar = design("bar", 1);
    // Per area: stretches at the ends and in the middle with weights 1/6, 4/6, 1/6, and the mass of cubic shapes.
    let (e, rho) = (bar.material.young, bar.material.density);
    let stretches = [(Vec3::x(), 1.0), (Vec3::new(-0.25, 1.5, -0.25), 4.0), (Vec3::z(), 1.0)];
    let stiffness: Matrix3<f64> =
        stretches.iter().map(|(by_q, weight)| by_q * by_q.transpose() * (e * weight / 6.0)).sum();
    let mass = Matrix3::new(4.0, 13.0, -3.0, 13.0, 156.0, -22.0, -3.0, -22.0, 4.0) * (rho / 420.0);
    let factor = mass.cholesky().unwrap().l();
    let inverse = factor.try_inverse().unwrap();
    let modes = (inverse * stiffness * inverse.transpose()).symmetric_eigen();
    let slowest = modes.eigenvalues.imin();
    let frequency = modes.eigenvalues[slowest].sqrt();
    let shape = inverse.transpose() * modes.eigenvectors.column(slowest);
    for radius in [0.0, 0.5, 0.8, 1.0] {
        for speed in [0.1, 1.0, 10.0, 1e3] {
            let step = speed / frequency;
            let mut builder = SystemBuilder::default();
            let number = builder.add_beam(&bar);
            clamp(&mut builder, number);
            let (system, mut state) = builder.finish(Vec3::zeros());
            // Of 1e-3 of the length.
            let rate = 1e-3 / shape[1] / step;
            for (place, index) in MODE.into_iter().enumerate() {
                state.velocity[index] = rate * shape[place];
            }
            let drawn = state.q.clone();
            let mut expected = nalgebra::Vector3::new(0.0, rate * step, 0.0);
            let matrix = amplification(radius, speed);
            let (mut error, mut energy) = (0.0_f64, Vec::new());
            march(&system, &mut state, &mut method(&system, radius), (step, 40), |state| {
                let moved = MODE.map(|index| state.q[index] - drawn[index]);
                for (moved, shape) in moved.iter().zip(&shape) {
                    error = error.max((moved - expected[0] * shape).abs());
                }
                energy.push(energies(&system, state).iter().sum::<f64>());
                expected = matrix * expected;
            })
            .unwrap();
            let values = matrix.complex_eigenvalues();
            let found = values.iter().fold(0.0_f64, |largest, value| largest.max(value.norm()));
            let left = energy[40] / energy[0];
            println!(
                "{radius}, {speed}: {error:.1e} m of theory, which damps by {found:.4} a step; energy left {left:.1e}"
            );
            // Round-off of a length of 1 m.
            assert!(error < 1e-14, "{radius}, {speed}: {error:e} m");
            if speed == 1e3 {
                // Three like eigenvalues far beyond the step: `n²` counts too in the power of the matrix, and its
                // square in the energy.
                assert!((found - radius).abs() < 0.015, "{radius}: {found}");
                // What round-off of the length stretches, a unit of it, beside the velocity at the start.
                let round_off = (f64::EPSILON * speed / 1e-3).powi(2);
                assert!(left < 1e4 * radius.powi(80) + round_off, "{radius}: {left:e}");
            }
            if radius == 1.0 {
                assert!((found - 1.0).abs() < 1e-7 && left > 0.1, "{found}, {left:e}");
            }
        }
    }
}

/// Two rigid bodies, one hung on the ground and one on it, with a damper between.
fn double_pendulum() -> (System, State) {
    let mut builder = SystemBuilder::default();
    let body = |name: &str, position: Vec3, angular_velocity: Vec3| BodyDesign {
        name: name.into(),
        mass: 2.0,
        position,
        inertia: Mat3::new(0.05, 0.01, 0.0, 0.01, 0.04, 0.0, 0.0, 0.0, 0.03),
        axes: Mat3::identity(),
        velocity: Vec3::zeros(),
        angular_velocity,
    };
    let upper = builder.add_body(&body("upper", Vec3::new(0.3, 0.0, 0.0), Vec3::new(1.0, 0.5, 2.0)));
    let lower = builder.add_body(&body("lower", Vec3::new(0.6, 0.3, 0.1), Vec3::new(0.0, -1.0, 1.0)));
    let ground = Marker::Ground(Pose::default());
    let [upper, lower] = [upper, lower].map(|number| builder.body(number));
    let elbow = Pose { place: Vec3::new(0.6, 0.0, 0.0), axes: Mat3::identity() };
    joint(&mut builder, "hook", [&ground, &upper], &Pose::default(), spherical::PRIMITIVES);
    let sides = joint(&mut builder, "elbow", [&upper, &lower], &elbow, revolute::PRIMITIVES);
    let coordinate = builder.add_relative_coordinate(sides[0], sides[1], Measure::Angle(0));
    builder.add_spring(Spring {
        name: "damper".into(),
        coordinate,
        stiffness: 2.0,
        damping: 0.3,
        rest: 0.2,
        mobility: 0.0,
        law: None,
        memory: None,
    });
    builder.finish(Vec3::new(0.5, -9.0, 2.0))
}

/// Ties a joint of `primitives` at `pose` to both `parts`; returns its sides.
pub fn joint(
    builder: &mut SystemBuilder,
    name: &str,
    parts: [&Marker; 2],
    pose: &Pose,
    primitives: &'static [Primitive],
) -> [Marker; 2] {
    let [a, b] = parts.map(|part| builder.tied(part, pose));
    builder.add_joint(Joint {
        name: format!("joint {name}"),
        a,
        b,
        primitives,
        drive: None,
        gear: None,
        slide: None,
        holding: None,
    });
    [a, b]
}

/// With the step, the difference to the midpoint rule goes to zero, as its square; so do those of the multipliers from
/// the response of the instant.
#[test]
fn double_pendulum_agrees_with_the_midpoint_rule() {
    let difference = |step: f64| {
        let (system, state) = double_pendulum();
        let (mut ours, mut theirs) = (state.clone(), state);
        let steps = (step, (0.5 / step).round() as u32);
        march(&system, &mut ours, &mut method(&system, 0.8), steps, |_| {}).unwrap();
        integrate(&system, &mut theirs, 1.0, steps, |_| {}).unwrap();
        let mut response = Response::default();
        Responder::new(&system).respond(&system, &ours, &mut response).unwrap();
        let size = |a: &[f64], b: &[f64]| a.iter().zip(b).fold(0.0_f64, |largest, (a, b)| largest.max((a - b).abs()));
        let multipliers = size(&ours.multipliers, &response.multipliers);
        [size(&ours.q, &theirs.q), size(&ours.velocity, &theirs.velocity), multipliers]
    };
    let (coarse, fine) = (difference(2e-3), difference(1e-3));
    for (coarse, fine) in coarse.into_iter().zip(fine) {
        let order = (coarse / fine).log2();
        println!("differences {coarse:.2e}, {fine:.2e}: order {order:.3}");
        assert!((order - 2.0).abs() < 0.05, "{order}");
    }
}

/// A rigid body swings with the period of the physical pendulum, `4 K(sin A/2) sqrt(J/(m g s))`.
#[test]
fn pendulum_has_its_period() {
    let (mass, arm, moment, gravity, amplitude) = (2.0, 0.4, 0.1, 9.81, 1.0_f64);
    let (sin, cos) = amplitude.sin_cos();
    let mut builder = SystemBuilder::default();
    let number = builder.add_body(&BodyDesign {
        name: "bob".into(),
        mass,
        position: Vec3::new(sin, -cos, 0.0) * arm,
        inertia: Mat3::from_diagonal(&Vec3::new(0.08, 0.07, moment)),
        axes: Mat3::identity(),
        velocity: Vec3::zeros(),
        angular_velocity: Vec3::zeros(),
    });
    let axes = Mat3::from_columns(&[Vec3::z(), Vec3::x(), Vec3::y()]);
    let (ground, bob) = (Marker::Ground(Pose::default()), builder.body(number));
    joint(&mut builder, "hinge", [&ground, &bob], &Pose { place: Vec3::zeros(), axes }, revolute::PRIMITIVES);
    let (system, mut state) = builder.finish(Vec3::y() * -gravity);
    // Arithmetic-geometric mean.
    let (mut a, mut b) = (1.0_f64, (0.5 * amplitude).cos());
    while (a - b).abs() > 1e-15 {
        (a, b) = (0.5 * (a + b), (a * b).sqrt());
    }
    let frequency = (mass * gravity * arm / (moment + mass * arm * arm)).sqrt();
    let period = TAU / (a * frequency);
    let mut crossings = Vec::new();
    let mut before = (0.0, 0.0);
    march(&system, &mut state, &mut method(&system, 0.9), (period / 400.0, 2200), |state| {
        let now = (state.time, state.q[0]);
        if before.1 > 0.0 && now.1 <= 0.0 {
            crossings.push(before.0 + (now.0 - before.0) * before.1 / (before.1 - now.1));
        }
        before = now;
    })
    .unwrap();
    let found = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
    println!("{} periods of {found:.6} s, exact {period:.6} s: {:.1e}", crossings.len() - 1, found / period - 1.0);
    assert!(crossings.len() == 6, "{crossings:?}");
    // A linear vibration is longer by (2 pi/400)^2/12 = 2e-5 and a bit, by the weights of the method.
    assert!((found / period - 1.0).abs() < 1e-4, "{found}");
}

/// `size (30 t + (1 − cos 20 t)/2)`.
pub fn turning(size: f64) -> Signal {
    Signal::Function(Arc::new(move |time| {
        let (sin, cos) = (20.0 * time).sin_cos();
        let [value, first, second] = [30.0 * time + 0.5 * (1.0 - cos), 30.0 + 10.0 * sin, 200.0 * cos];
        Jet { value: size * value, first: size * first, second: size * second }
    }))
}

/// A driven hinge turns a beam by exactly what the drive prescribes, over several turns; rates and multipliers follow.
#[test]
fn driven_hinge_follows_exactly() {
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(&BeamDesign { section: Section::rectangle(0.04, 0.04), ..design("arm", 2) });
    let axes = Mat3::from_columns(&[Vec3::z(), Vec3::x(), Vec3::y()]);
    hold(&mut builder, "hub", number, 0.0, &axes, revolute::PRIMITIVES);
    let ground = Marker::Ground(Pose { place: Vec3::zeros(), axes });
    let arm = builder.tied(&builder.node(0), &Pose { place: Vec3::zeros(), axes });
    let drive = builder.add_drive("hub", [ground, arm], Driven::Angle, (Guide::Value(turning(1.0)), 0.0), None);
    let (system, mut state) = builder.finish(Vec3::zeros());
    let (mut gap, mut rate_gap) = (0.0_f64, 0.0_f64);
    march(&system, &mut state, &mut method(&system, 0.8), (1e-3, 700), |state| {
        let expected = turning(1.0).jet(state.time);
        gap = gap.max((state.relative_values[drive] - expected.value).abs());
        let slope_rate = Vec3::from_column_slice(&state.velocity[3..6]).norm();
        rate_gap = rate_gap.max((slope_rate - expected.first.abs()).abs());
    })
    .unwrap();
    println!("{:.2} turns, gap {gap:.1e} rad, rate {rate_gap:.1e}", state.relative_values[drive] / TAU);
    assert!(state.relative_values[drive] > 3.0 * TAU);
    assert!(gap < 1e-13, "{gap:e}");
    // Of 40 rad/s: rates come from the equation of the step, to its order; and the arm bends a little.
    assert!(rate_gap < 0.05, "{rate_gap:e}");
}

/// The logarithmic decrement of a cantilever with damped material that is released, by generalized-alpha or the
/// midpoint rule.
fn decrement(radius: Option<f64>, ratio: f64) -> f64 {
    let base = design("beam", 4);
    let (material, section) = (base.material, base.section);
    let frequency = 1.875_104_068_711_961_f64.powi(2)
        * (material.young * section.second_moment_y / (material.density * section.area)).sqrt();
    let damping = 2.0 * ratio / frequency;
    let mut builder = SystemBuilder::default();
    let number = builder.add_beam(&BeamDesign { material: Material { damping, ..material }, ..base });
    clamp(&mut builder, number);
    let (system, mut state) = builder.finish(Vec3::z() * -1.0);
    let mut heights = Vec::new();
    let watch = |state: &State| heights.push(state.q[state.q.len() - 5]);
    let steps = (TAU / frequency / 200.0, 2000);
    match radius {
        Some(radius) => march(&system, &mut state, &mut method(&system, radius), steps, watch).unwrap(),
        None => integrate(&system, &mut state, 1.0, steps, watch).unwrap(),
    }
    let extremes: Vec<f64> = heights.windows(3).filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0).map(|w| w[1]).collect();
    let swings: Vec<f64> = extremes.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let half_periods = (swings.len() - 1) as f64;
    2.0 * (swings[0] / swings[swings.len() - 1]).ln() / half_periods
}

/// A damped cantilever decays as the damping of its material says, whatever the numerical damping: by
/// `2 pi D/sqrt(1 − D²)` a period.
#[test]
fn damped_cantilever_decays() {
    let ratio = 0.02_f64;
    let exact = TAU * ratio / (1.0 - ratio * ratio).sqrt();
    for radius in [None, Some(0.5), Some(0.9)] {
        let found = decrement(radius, ratio);
        println!("{radius:?}: {found:.5}, exact {exact:.5}");
        // The second mode counts in the first swing.
        assert!((found / exact - 1.0).abs() < 2e-3, "{radius:?}: {found}");
    }
}
