//! Gears with a law: the coordinate of one joint is a function of that of another one, against closed forms. A slope
//! that is missing in a force, or a bend that is missing in an acceleration, shows in full.

use crate::running::{run, start, try_start, value};
use ancf14::fmi::Model;

/// A cam on an axle and a follower on a rail of its own, with an eccentric law of 0.02 m; `rest` has what acts on them.
fn mechanism(law: &str, rest: &str, simulation: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Cam\"\n[parameters]\necc = 0.02\n\
         [body.cam]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.001, 0.001, 0.001]\n\
         [body.follower]\nmass = 2\nposition = [0, 0, 0.1]\ninertia = [0.01, 0.01, 0.01]\n\
         [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"cam\"\naxis = [0, 1, 0]\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"follower\"\naxis = [0, 0, 1]\n\
         [gear.contact]\na = \"rail\"\nb = \"axle\"\nlaw = {law}\n\
         [output.turn]\nat = \"axle\"\nquantities = [\"angle\", \"angle_rate\", \"reaction_moment\"]\n\
         [output.lift]\nat = \"rail\"\nquantities = [\"distance\", \"distance_rate\", \"distance_acceleration\"]\n\
         [output.force]\nat = \"contact\"\nquantities = [\"effort\", \"power\"]\n{rest}\n[simulation]\n{simulation}\n"
    )
}

const ECCENTRIC: &str = "\"ecc*(1 - cos(x))\"";

/// A motor turns the cam at 30 rad/s: the follower has the acceleration `e ω² cos x`, and the cam pushes with its mass
/// times that, over many turns.
#[test]
fn a_driven_cam_moves_its_follower() {
    let motor = "[drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"30*t\"";
    let mut simulation =
        start(&mechanism(ECCENTRIC, motor, "stop = 1\nstep = 1e-3\nintegrator = \"generalized_alpha\""));
    let (mut worst, e, mass, rate) = ([0.0_f64; 3], 0.02, 2.0, 30.0);
    run(&mut simulation, 0.01, 1.0, |simulation| {
        let angle = rate * simulation.time();
        let acceleration = e * rate * rate * angle.cos();
        let expected = [
            ("lift.distance", e * (1.0 - angle.cos()), e),
            ("lift.distance_acceleration", acceleration, e * rate * rate),
            ("force.effort", mass * acceleration, mass * e * rate * rate),
        ];
        for ((name, expected, size), worst) in expected.into_iter().zip(&mut worst) {
            *worst = worst.max((value(simulation, name) - expected).abs() / size);
        }
    });
    println!("errors of lift, acceleration and force: {worst:?}");
    assert!(value(&simulation, "turn.angle") > 29.9, "it makes many turns");
    // Conditions hold to round-off; accelerations are those of steps that turn the cam by 0.03 rad: (0.03)².
    assert!(worst[0] < 1e-9 && worst[1..].iter().all(|worst| *worst < 9e-4), "{worst:?}");
}

/// At rest the cam carries the spring of the follower, and the motor has the slope of the law times that: virtual work.
#[test]
fn a_cam_carries_a_spring() {
    let rest = "[drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"20*t\"\n[output.torque]\nat = \"motor\"\nquantities = [\"effort\"]\n\
                [spring.valve]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"5000*x + 40\"";
    let mut simulation = start(&mechanism(ECCENTRIC, rest, "analysis = \"static\"\nstop = 1\nstep = 0.02"));
    run(&mut simulation, 0.02, 1.0, |simulation| {
        let angle = 20.0 * simulation.time();
        let force = 5000.0 * 0.02 * (1.0 - angle.cos()) + 40.0;
        let [found, torque] = ["force.effort", "torque.effort"].map(|name| value(simulation, name));
        // Newton's tolerance of 1e-8 of the size, times the stiffness.
        assert!((found - force).abs() < 1e-4, "{found} {force}");
        assert!((torque - force * 0.02 * angle.sin()).abs() < 1e-4, "{torque} {}", force * 0.02 * angle.sin());
    });
}

/// A flywheel that nothing drives moves its follower back and forth: `(J + m f'(x)²) x'² = (J + m f'(0)²) x'(0)²`, with
/// second order.
#[test]
fn a_free_cam_keeps_its_energy() {
    let errors = [4e-3, 2e-3, 1e-3].map(|step| {
        let text = mechanism(ECCENTRIC, "", &format!("stop = 2\nstep = {step}\nspectral_radius = 1"))
            .replace("[body.follower]", "angular_velocity = [0, 10, 0]\n[body.follower]");
        let mut simulation = start(&text);
        let mut worst = 0.0_f64;
        run(&mut simulation, 0.02, 2.0, |simulation| {
            let slope = 0.02 * value(simulation, "turn.angle").sin();
            let expected = 10.0 * (0.001 / (0.001 + 2.0 * slope * slope)).sqrt();
            worst = worst.max((value(simulation, "turn.angle_rate") / expected - 1.0).abs());
            let gap = value(simulation, "lift.distance") - 0.02 * (1.0 - value(simulation, "turn.angle").cos());
            assert!(gap.abs() < 1e-10, "{gap}");
        });
        assert!(value(&simulation, "turn.angle") > 12.0);
        worst
    });
    println!("errors of the speed: {errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.2).contains(&order), "order {order} of {errors:?}");
    }
}

/// At rest a spring on the follower turns the cam against a spring on its axle: `k f(x) f'(x) = -c (x - x0)`. Its
/// vibrations have the stiffness that includes the bend of the law.
#[test]
fn equilibria_and_modes_know_the_law() {
    let springs = "[spring.valve]\njoint = \"rail\"\ncoordinate = \"distance\"\nforce = \"5000*x + 40\"\n\
                   [spring.axle_spring]\njoint = \"axle\"\ncoordinate = \"angle\"\nforce = \"1.5*(x - 1)\"";
    let slope = |x: f64| (5000.0 * 0.02 * (1.0 - x.cos()) + 40.0) * 0.02 * x.sin() + 1.5 * (x - 1.0);
    let (mut low, mut high) = (0.0, 2.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if slope(middle) < 0.0 { &mut low } else { &mut high }) = middle;
    }
    let text = mechanism(ECCENTRIC, springs, "stop = 1\nstep = 1e-3\ninitial = \"equilibrium\"\ntolerance = 1e-12");
    let simulation = start(&text);
    let angle = value(&simulation, "turn.angle");
    assert!((angle - low).abs() < 1e-8, "{angle} {low}");
    let stiffness = (slope(low + 1e-5) - slope(low - 1e-5)) / 2e-5;
    let inertia = 0.001 + 2.0 * (0.02 * low.sin()).powi(2);
    let modes = simulation.modes(1).unwrap_or_else(|failure| panic!("{}", failure.message));
    let found = modes.modes[0].eigenvalue;
    // Differences of the slope: 1e-10 of it.
    assert!((found / (stiffness / inertia) - 1.0).abs() < 1e-7, "{found} {}", stiffness / inertia);
}

/// A law that is not 0 as drawn is refused with its value; tables and several turns are laws too; the parameters in a
/// law are those of the FMU.
#[test]
fn laws_agree_with_the_drawing() {
    let failure = try_start(&mechanism("\"ecc*cos(x)\"", "", "stop = 1\nstep = 0.01")).unwrap_err();
    assert!(failure.contains("the law of gear contact is 0.02 at x = 0"), "{failure}");
    let table = "[function.profile]\ntable = [[0, 0], [1, 0.001], [2, 0.01], [4.2, 0.01], [5.2, 0.001], [6.283185307179586, 0]]\n\
                 interpolation = \"monotone\"\noutside = \"repeat\"\n[drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"20*t\"";
    let mut simulation = start(&mechanism("\"profile(x)\"", table, "stop = 1\nstep = 1e-3"));
    run(&mut simulation, 0.02, 1.0, |simulation| {
        let (angle, lift) = (20.0 * simulation.time(), value(simulation, "lift.distance"));
        let phase = angle % std::f64::consts::TAU;
        assert!(!(2.0..4.2).contains(&phase) || (lift - 0.01).abs() < 1e-9, "{angle}: {lift}");
    });
    let names: Vec<_> = simulation.variables().iter().map(|variable| variable.name.clone()).collect();
    assert!(names.iter().any(|name| name == "ecc") && !names.iter().any(|name| name == "contact.ratio"), "{names:?}");
}

/// A law without a value where the motion goes ends the run, and the message names the gear.
#[test]
fn a_law_that_ends_ends_the_run() {
    let motor = "[function.profile]\ntable = [[0, 0], [1, 0.001], [2, 0.01]]\ninterpolation = \"monotone\"\noutside = \"error\"\n\
                 [drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"5*t\"";
    let mut simulation = start(&mechanism("\"profile(x)\"", motor, "stop = 1\nstep = 0.01"));
    let failure = simulation.advance(1.0).unwrap_err().message;
    println!("{failure}");
    assert!(failure.contains("gear contact"), "{failure}");
}

/// The example of docs/language/drives.md: the valve opens by its lift once in each turn, and the cam pushes it all the
/// time.
#[test]
fn the_example_of_the_page_opens() {
    let page = include_str!("../../../docs/language/drives.md");
    let text = page.split("```toml\n").find(|text| text.contains("name = \"ValveTrain\"")).expect("the example");
    let mut simulation = start(text.split("```").next().expect("its end"));
    let (mut widest, mut least) = (0.0_f64, f64::INFINITY);
    run(&mut simulation, 1e-3, 0.2, |simulation| {
        widest = widest.max(value(simulation, "opening.distance"));
        least = least.min(value(simulation, "contact.effort"));
    });
    assert!((widest / 0.009 - 1.0).abs() < 0.02 && least > 0.0, "{widest} {least}");
}
