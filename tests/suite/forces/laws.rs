//! Springs with laws: functions of elongation and rate, ropes and bumpers. Forces over a step must work exactly as much
//! as the energy changes, with exact derivatives on both sides of every kink; motions must follow closed forms. A mean
//! that is off, a slope that belongs to the other side or a damper that is counted twice shows in full.

use crate::running::{run, start, try_start, value};
use crate::support::machines::drift;
use ancf14::fmi::Model;
use ancf14::mechanics::force::law::{Law, LawForce};
use ancf14::solve::modes::modes;
use std::f64::consts::PI;
use std::sync::Arc;

/// A smooth law with a rate, one with kinks, one with a jump at 0.5, and closed ones, each with the elongations of its
/// kinks.
fn laws() -> Vec<(&'static str, Law, &'static [f64])> {
    let function = |f: fn(f64, f64) -> [f64; 3], has_rate| Law::Function { function: Arc::new(f), has_rate };
    let smooth: fn(f64, f64) -> [f64; 3] =
        |x, v| [x + x.powi(3) + 0.3 * v * x.cos(), 1.0 + 3.0 * x * x - 0.3 * v * x.sin(), 0.3 * x.cos()];
    let kinked: fn(f64, f64) -> [f64; 3] = |x, v| {
        let open = if x > 0.2 { 1.0 } else { 0.0 };
        [5.0 * open * (x - 0.2) * (1.0 + 0.2 * v), 5.0 * open * (1.0 + 0.2 * v), open * (x - 0.2)]
    };
    vec![
        ("smooth", function(smooth, true), &[]),
        ("kinked", function(kinked, true), &[0.2]),
        ("jumping", function(|x, _| [if x < 0.5 { 1.0 } else { 3.0 } + x, 1.0, 0.0], false), &[0.5]),
        ("rope", Law::OneSided { sign: 1.0, stiffness: 40.0, damping: 0.7 }, &[0.0]),
        ("bumper", Law::OneSided { sign: -1.0, stiffness: 40.0, damping: 0.7 }, &[0.0]),
    ]
}

/// Ways that end, begin and lie on either side of all kinks, both ways, and short ones.
const WAYS: [[f64; 2]; 9] = [
    [-0.4, 0.9],
    [0.9, -0.4],
    [0.6, 0.9],
    [-0.7, -0.1],
    [-0.1, -0.7],
    [0.31, 0.31],
    [0.31, 0.31 + 1e-9],
    [-0.31, -0.31 - 1e-9],
    [0.3 - 1e-4, 0.3],
];

/// Over every way the elastic force works as much as the energy changes, and the derivatives are those of differences.
/// Of a short way the mean is the force in its middle.
#[test]
fn steps_take_the_mean_of_a_law_with_its_derivatives() {
    for (name, law, kinks) in laws() {
        for [from, to] in WAYS {
            for v in [-1.3, 0.0, 0.8] {
                let at = |to: f64, v: f64| law.over(from, to, v);
                let sum = |force: LawForce| force.elastic + force.viscous;
                let own = at(to, v);
                let work = own.elastic * (to - from) - (law.energy(to) - law.energy(from));
                // Integrals agree to 1e-14 of energies below 20 J.
                assert!(work.abs() < 1e-13, "{name} {from} {to}: {work:e}");
                let middle = law.at(0.5 * (from + to), v);
                if (to - from).abs() < 1e-6 {
                    let error = (sum(own) - sum(middle)).abs().max((own.by_v - middle.by_v).abs());
                    assert!(error < 1e-12, "{name} {from} {to}: {error:e}");
                    assert!((2.0 * own.by_x - middle.by_x).abs() < 1e-6, "{name} {from}: {} {}", own.by_x, middle.by_x);
                    continue;
                }
                // Central differences: the error is that of 1e-10 in the fourth derivatives and of round-off over 1e-5.
                let by_x = (sum(at(to + 1e-5, v)) - sum(at(to - 1e-5, v))) / 2e-5;
                let by_v = (sum(at(to, v + 1e-5)) - sum(at(to, v - 1e-5))) / 2e-5;
                assert!((own.by_x - by_x).abs() < 1e-6, "{name} {from} {to} {v}: {} {by_x}", own.by_x);
                assert!((own.by_v - by_v).abs() < 1e-6, "{name} {from} {to} {v}: {} {by_v}", own.by_v);
                assert!(kinks.iter().all(|kink| (kink - to).abs() > 1e-5), "{name}: a difference over a kink");
            }
        }
    }
}

/// A block of 1 kg on a rail along x.
fn block(start: &str, rest: &str, simulation: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Block\"\ngravity = [0, 0, 0]\n\
         [body.block]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n{start}\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"block\"\naxis = [1, 0, 0]\n\
         [output.way]\nat = \"rail\"\nquantities = [\"distance\", \"distance_rate\"]\n{rest}\n\
         [simulation]\n{simulation}\n"
    )
}

/// The quarter of a period of `x'' + x + x³ = 0` with the velocity 1 at 0, by the arithmetic-geometric mean.
fn duffing_quarter() -> f64 {
    let square = 3.0_f64.sqrt() - 1.0;
    let modulus = square / (2.0 * (1.0 + square));
    let (mut a, mut b) = (1.0, (1.0 - modulus).sqrt());
    for _ in 0..8 {
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
    }
    0.5 * PI / a / (1.0 + square).sqrt()
}

/// Duffing's oscillator is back at 0 after two quarters of its period: the error falls with the square of the step.
#[test]
fn duffing_oscillator_has_its_period() {
    let end = 2.0 * duffing_quarter();
    let errors = [40.0, 80.0, 160.0].map(|steps| {
        let step = end / steps;
        let law = "[spring.law]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"x + x^3\"";
        let mut simulation = start(&block("velocity = [1, 0, 0]", law, &format!("stop = {end}\nstep = {step}")));
        simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
        value(&simulation, "way.distance").abs()
    });
    // The midpoint rule's own factor is (step omega)²/12 of a phase of pi, with omega at most 1.8.
    assert!(errors[0] < 6e-3, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.9..2.1).contains(&order), "order {order} of {errors:?}");
    }
}

/// A conservative law with kinks keeps the energy without numerical dissipation; a viscous law takes as much as is
/// counted, on a joint and between two points that turn.
#[test]
fn energy_balance_of_laws_is_closed() {
    let law = |force: &str| format!("[spring.law]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"{force}\"");
    let moving = "velocity = [1, 0, 0]";
    let text = |force: &str| block(moving, &law(force), "stop = 1\nstep = 0.02");
    let [drifted, changed] = drift(&text("x + x^3 + 50*max(x - 0.3, 0) - 20*max(-0.2 - x, 0)"), 1.0, (0.02, 5_000));
    // Round-off of 5,000 steps of 0.5 J, and what Newton leaves of each.
    assert!(drifted.abs() < 2.5e-10 && changed.abs() < 2.5e-10, "{drifted:e} {changed:e}");
    let [drifted, changed] = drift(&text("x + x^3 + 0.2*v*abs(v) + 0.1*v*x^2"), 1.0, (0.02, 2_000));
    assert!(drifted.abs() < 1e-9 && changed < -0.3, "{drifted:e} {changed:e}");
    // A law that drives: its work is counted as well.
    let [drifted, changed] = drift(&text("x - 0.1*v*(1 - x^2)"), 1.0, (0.02, 2_000));
    assert!(drifted.abs() < 1e-9 && changed > 0.2, "{drifted:e} {changed:e}");
    let swinging = "format = 1\n[model]\nname = \"Swing\"\ngravity = [0, 0, 0]\n\
         [body.bob]\nmass = 1\nposition = [1, 0, 0]\ninertia = [0.1, 0.2, 0.3]\nvelocity = [1, 2, 0.3]\nangular_velocity = [1, 0, 2]\n\
         [point.hook]\non = \"bob\"\noffset = [-0.2, 0.1, 0]\n\
         [spring.rope]\na = \"ground\"\nb = \"hook\"\nstiffness = 500\ndamping = 0.5\nonly = \"tension\"\n\
         [simulation]\nstop = 1\nstep = 0.005";
    let [drifted, changed] = drift(swinging, 1.0, (0.005, 1_000));
    // A body that turns leaves 1e-12 J a step, with a linear spring too.
    assert!(drifted.abs() < 5e-9 && changed < -0.01, "{drifted:e} {changed:e}");
}

/// A law that jumps keeps the energy too; where Newton circles around the jump, a step is halved.
#[test]
fn a_law_that_jumps_keeps_the_energy() {
    let law = "[spring.law]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = [{ until = -0.2, is = -3 }, { until = 0.1, is = 0 }, { is = \"2 + x\" }]";
    let settings = "stop = 20\nstep = 0.02\nspectral_radius = 1\ntolerance = 1e-14";
    let mut simulation = start(&block("velocity = [1, 0, 0]", law, settings));
    let mut reach = [0.0_f64; 2];
    run(&mut simulation, 0.1, 20.0, |simulation| {
        let way = value(simulation, "way.distance");
        reach = [reach[0].min(way), reach[1].max(way)];
        // Round-off of a thousand steps of 0.5 J, and what Newton leaves of each.
        assert!(
            (value(simulation, "energy.total") - 0.5).abs() < 1e-9,
            "{:e}",
            value(simulation, "energy.total") - 0.5
        );
    });
    // It turns back where the energy is used up: 3 (-x - 0.2) = 0.5, and 2 (x - 0.1) + (x² - 0.01)/2 = 0.5.
    assert!(reach[0] < -0.36 && reach[0] > -0.367 && reach[1] > 0.32 && reach[1] < 0.328, "{reach:?}");
}

/// A mass that falls by 0.5 m onto a rope, or a bumper, is thrown back to where it was: a free fall and half an
/// oscillation are known.
#[test]
fn ropes_and_bumpers_throw_a_mass_back() {
    let (gravity, stiffness, way) = (9.81_f64, 900.0_f64, 0.5_f64);
    let (omega, fall) = (stiffness.sqrt(), (2.0 * way / gravity).sqrt());
    let contact = 2.0 / omega * (PI - (gravity * fall * omega / gravity).atan());
    let end = 2.0 * fall + contact;
    for (only, place, length) in [("tension", -0.5, 1.0), ("compression", 1.0, 0.5)] {
        let errors = [2e3, 8e3].map(|steps| {
            let mut simulation = start(&format!(
                "format = 1\n[model]\nname = \"Fall\"\ngravity = [0, 0, -{gravity}]\n\
                 [body.ball]\nmass = 1\nposition = [0, 0, {place}]\ninertia = [0.1, 0.1, 0.1]\n\
                 [spring.rope]\na = \"ground\"\nb = \"ball\"\nstiffness = {stiffness}\nlength = {length}\nonly = \"{only}\"\n\
                 [output.rope_force]\nat = \"rope\"\nquantities = [\"force\", \"energy\", \"distance\", \"distance_rate\", \"power\"]\n\
                 [output.at_ball]\nat = \"ball\"\nquantities = [\"displacement\"]\n\
                 [simulation]\nstop = 2\nstep = {}\n",
                end / steps
            ));
            simulation.advance(0.9 * fall).unwrap_or_else(|failure| panic!("{}", failure.message));
            assert_eq!([value(&simulation, "rope_force.force"), value(&simulation, "rope_force.energy")], [0.0; 2]);
            simulation.advance(fall + 0.5 * contact).unwrap_or_else(|failure| panic!("{}", failure.message));
            // Deepest point: by the energy.
            let deepest = gravity / stiffness + ((gravity / stiffness).powi(2) + 2.0 * gravity * way / stiffness).sqrt();
            let sign = if only == "tension" { 1.0 } else { -1.0 };
            let force = value(&simulation, "rope_force.force");
            assert!((force - sign * stiffness * deepest).abs() < 1e-3 * force.abs(), "{only}: {force}");
            let energy = value(&simulation, "rope_force.energy");
            assert!((energy - 0.5 * stiffness * deepest * deepest).abs() < 1e-3 * energy, "{only}: {energy}");
            let distance = value(&simulation, "rope_force.distance");
            assert!((distance - length - sign * deepest).abs() < 1e-3 * deepest, "{only}: {distance}");
            simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
            value(&simulation, "at_ball.displacement[3]").abs()
        });
        // Second order: a quarter of the step has a sixteenth of the error, but for where in a step the rope tightens.
        assert!(errors[0] < 1e-4 && errors[1] < 0.2 * errors[0], "{only}: {errors:?}");
    }
}

/// A hardening spring under a weight rests where its law says, and vibrates there with its slope.
#[test]
fn equilibria_and_modes_use_the_law() {
    let law = "[spring.law]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"100*x + 1000*x^3\"\nrest = 0.05";
    let load = "[load.push]\nat = \"block\"\nforce = [20, 0, 0]\n[output.holds]\nat = \"law\"\nquantities = [\"force\", \"distance\"]";
    let simulation = start(&block("", &format!("{law}\n{load}"), "analysis = \"static\"\nstop = 1\nstep = 1"));
    let mut stretch = 0.2_f64;
    for _ in 0..20 {
        stretch -= (100.0 * stretch + 1000.0 * stretch.powi(3) - 20.0) / (100.0 + 3000.0 * stretch * stretch);
    }
    assert!((value(&simulation, "holds.distance") - 0.05 - stretch).abs() < 1e-10);
    assert!((value(&simulation, "holds.force") - 20.0).abs() < 1e-8, "{}", value(&simulation, "holds.force"));
    let text = block("", &format!("{law}\n{load}"), "initial = \"equilibrium\"\nstop = 1\nstep = 1e-3");
    let simulation = start(&text);
    let found = modes(simulation.system(), simulation.state(), 1).expect("a mode");
    let omega = found.modes[0].eigenvalue.sqrt();
    let expected = (100.0 + 3000.0 * stretch * stretch).sqrt();
    assert!((omega / expected - 1.0).abs() < 1e-9, "{omega} {expected}");
}

/// A torque law on an angle, with its sign, its part in the reaction of the joint, and the power that its damper takes.
#[test]
fn a_law_on_an_angle_turns_a_wheel_back() {
    let text = "format = 1\n[model]\nname = \"Wheel\"\n\
        [body.wheel]\nmass = 3\nposition = [0, 0, 0]\ninertia = [0.03, 0.03, 0.05]\nangular_velocity = [0, 0, 2]\n\
        [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"wheel\"\naxis = [0, 0, 1]\n\
        [spring.clock]\njoint = \"axle\"\ncoordinate = \"angle\"\nforce = \"k*sin(x) + 0.1*v\"\nrest = -0.2\n\
        [output.seen]\nat = \"clock\"\nquantities = [\"angle\", \"angle_rate\", \"force\", \"power\", \"energy\"]\n\
        [output.held]\nat = \"axle\"\nquantities = [\"reaction_moment\"]\n\
        [parameters]\nk = 0.4\n[simulation]\nstop = 1\nstep = 1e-3";
    let mut simulation = start(text);
    run(&mut simulation, 0.1, 1.0, |simulation| {
        let [angle, rate] = ["seen.angle", "seen.angle_rate"].map(|name| value(simulation, name));
        let torque = 0.4 * (angle + 0.2).sin() + 0.1 * rate;
        let close = |name: &str, expected: f64| {
            let found = value(simulation, name);
            assert!((found - expected).abs() < 1e-12, "{name} {found} {expected}");
        };
        close("seen.force", torque);
        close("held.reaction_moment[3]", -torque);
        close("seen.power", 0.1 * rate * rate);
        close("seen.energy", 0.4 * (1.0 - (angle + 0.2).cos()));
    });
    let force = simulation.variables().iter().find(|variable| variable.name == "seen.force").expect("an output");
    assert_eq!(force.quantity.unit, "N.m");
}

/// Where a law is not defined, the run ends with a message that names the spring and where it was.
#[test]
fn an_undefined_law_is_named() {
    let law = |force: &str| format!("[spring.odd]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"{force}\"");
    let simulation = "stop = 1\nstep = 0.01";
    let at_start = try_start(&block("", &law("ln(x - 1)"), simulation)).expect_err("ln(-1)");
    assert!(at_start.contains("spring odd") && at_start.contains("x = 0"), "{at_start}");
    let mut later = start(&block("velocity = [1, 0, 0]", &law("0*sqrt(0.305 - x)"), simulation));
    let failure = later.advance(1.0).expect_err("sqrt(-1)").message;
    assert!(failure.contains("spring odd") && failure.contains("v = 1.0"), "{failure}");
}
