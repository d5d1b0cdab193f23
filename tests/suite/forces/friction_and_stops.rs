//! Friction and stops on the coordinates of joints against closed forms: where a block comes to rest, how it creeps,
//! how fast it is thrown back. Energy that is counted twice, a sign, or a stop that pulls shows in full.

use crate::running::{run, start, value};
use crate::support::machines::drift;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

/// A block of 2 kg on a rail along x.
fn block(start: &str, rest: &str, simulation: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Block\"\ngravity = [0, 0, 0]\n\
         [body.block]\nmass = 2\nposition = [0, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n{start}\n\
         [joint.rail]\ntype = \"prismatic\"\na = \"ground\"\nb = \"block\"\naxis = [1, 0, 0]\n\
         [output.way]\nat = \"rail\"\nquantities = [\"distance\", \"distance_rate\", \"reaction_force\"]\n{rest}\n\
         [simulation]\n{simulation}\n"
    )
}

/// With the smoothed friction `F v/√(v² + s²)` a block slides by `(m/F) ∫ √(v² + s²) dv`, which is `m v²/(2 F)` but for
/// the smoothing. It then stands still.
#[test]
fn a_block_slides_as_far_as_its_energy_lasts() {
    let (mass, friction, speed) = (2.0_f64, 5.0_f64, 0.01_f64);
    let rub =
        format!("[friction.rub]\njoint = \"rail\"\ncoordinate = \"distance\"\ncoulomb = {friction}\nspeed = {speed}");
    let whole = 0.5 * (1.0_f64.hypot(speed) + speed * speed * (1.0 / speed).asinh()) * mass / friction;
    let errors = [4e-3, 1e-3].map(|step| {
        let text = block("velocity = [1, 0, 0]", &rub, &format!("stop = 2\nstep = {step}"));
        let mut simulation = start(&text);
        simulation.advance(2.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        assert!(value(&simulation, "way.distance_rate").abs() < 1e-9, "{:e}", value(&simulation, "way.distance_rate"));
        (value(&simulation, "way.distance") - whole).abs()
    });
    // The smoothing adds 1e-4 to 0.2 m; a step is off by the square of `step friction/mass` where the block stops.
    assert!((whole - 0.2).abs() < 2e-4 && errors[0] < 2e-5 && errors[1] < 0.25 * errors[0], "{whole} {errors:?}");
    let [drifted, changed] = drift(&block("velocity = [1, 0, 0]", &rub, "stop = 1\nstep = 1e-3"), 1.0, (1e-3, 2000));
    // Without the first step, all of 1 J is gone.
    assert!(drifted.abs() < 1e-9 && (changed + 1.0).abs() < 0.01, "{drifted:e} {changed}");
}

/// Viscous friction beside dry friction: `v = (v0 + F/c) exp(−c t/m) − F/c` while the block slides, with second order
/// although dry friction alone would stop it within far less than a step.
#[test]
fn viscous_friction_keeps_the_order() {
    let rub = "[friction.rub]\njoint = \"rail\"\ncoordinate = \"distance\"\ncoulomb = 10\nviscous = 5";
    let exact = (15.0 + 2.0) * f64::exp(-5.0 / 2.0 * 0.3) - 2.0;
    let errors = [0.02, 0.01, 0.005].map(|step| {
        let mut simulation = start(&block("velocity = [15, 0, 0]", rub, &format!("stop = 0.3\nstep = {step}")));
        simulation.advance(0.3).unwrap_or_else(|failure| panic!("{}", failure.message));
        (value(&simulation, "way.distance_rate") - exact).abs()
    });
    // (c h/m)²/12 a step time constant: 2e-4 of 15 m/s with the coarsest.
    assert!(errors[0] < 5e-3, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.8..2.2).contains(&order), "order {order} of {errors:?}");
    }
}

/// Where friction sets in within far less than a step, the block comes to rest all the same: its velocity does not
/// alternate.
#[test]
fn sharp_friction_holds_a_block() {
    let rub = "[friction.rub]\njoint = \"rail\"\ncoordinate = \"distance\"\ncoulomb = 5\nspeed = 1e-5";
    let mut simulation = start(&block("velocity = [1, 0, 0]", rub, "stop = 2\nstep = 1e-2"));
    let mut last = 0.0;
    run(&mut simulation, 1e-2, 2.0, |simulation| last = value(simulation, "way.distance_rate"));
    // Newton's tolerance, 1e-9 m, over a step.
    assert!(last.abs() < 1e-7, "{last:e}");
    // What a step adds where the block stops: the square of its length times the deceleration.
    assert!((value(&simulation, "way.distance") - 0.2).abs() < 3e-4, "{}", value(&simulation, "way.distance"));
}

/// Pushed by less than its friction, a block creeps at the rate at which the smoothed friction holds; the effort acts
/// against it on b, and its power is what is taken.
#[test]
fn a_held_block_creeps() {
    let rub = "[friction.rub]\njoint = \"rail\"\ncoordinate = \"distance\"\ncoulomb = 5\nviscous = 3\nspeed = 0.1\n\
        [load.push]\nat = \"block\"\nforce = [4, 0, 0]\n\
        [output.rubbing]\nat = \"rub\"\nquantities = [\"effort\", \"power\", \"distance\", \"distance_rate\"]";
    let mut simulation = start(&block("", rub, "stop = 5\nstep = 1e-2"));
    simulation.advance(5.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let mut rate = 0.1_f64;
    for _ in 0..50 {
        let whole = rate.hypot(0.1);
        rate -= (5.0 * rate / whole + 3.0 * rate - 4.0) / (5.0 * 0.01 / whole.powi(3) + 3.0);
    }
    let close = |name: &str, expected: f64| {
        let found = value(&simulation, name);
        // Reached to exp(-5 s/tau) of it, tau at most a fifth of a second.
        assert!((found - expected).abs() < 1e-8, "{name} {found} {expected}");
    };
    close("rubbing.distance_rate", rate);
    close("rubbing.effort", -4.0);
    close("way.reaction_force[1]", -4.0);
    close("rubbing.power", 4.0 * rate);
}

/// The velocity after a contact of a stop whose force is `k p (1 + d w)`, thrown against it at `v`: `∫ w/(1 + d w) dw`
/// is the same before and after, for any stiffness and mass.
fn thrown_back(v: f64, d: f64) -> f64 {
    let lost = v / d - (d * v).ln_1p() / (d * d);
    let mut back = 0.5 * v;
    for _ in 0..60 {
        let found = -back / d - (-d * back).ln_1p() / (d * d);
        back -= (found - lost) * (1.0 - d * back) / back;
    }
    back
}

/// A stop with damping throws a block back at the speed that Hunt and Crossley's law has, in both directions, and never
/// pulls.
#[test]
fn stops_throw_a_block_back() {
    let stops = "[stop.ends]\njoint = \"rail\"\ncoordinate = \"distance\"\nlower = -0.1\nupper = 0.05\nstiffness = 2e4\ndamping = 0.4\n\
        [output.hit]\nat = \"ends\"\nquantities = [\"effort\", \"power\", \"energy\"]";
    let once = thrown_back(1.0, 0.4);
    let twice = thrown_back(once, 0.4);
    assert!(once < 0.85 && once > 0.7, "{once}");
    let errors = [4e-4, 1e-4].map(|step| {
        let mut simulation = start(&block("velocity = [1, 0, 0]", stops, &format!("stop = 1\nstep = {step}")));
        let mut rates = [0.0; 2];
        let mut largest = 0.0_f64;
        run(&mut simulation, 1e-2, 0.5, |simulation| {
            let [way, rate] = ["way.distance", "way.distance_rate"].map(|name| value(simulation, name));
            let [effort, energy] = ["hit.effort", "hit.energy"].map(|name| value(simulation, name));
            largest = largest.max(energy);
            let depth = (way - 0.05).max(0.0) - (-0.1 - way).max(0.0);
            assert!(effort * depth <= 0.0 && (depth != 0.0 || effort == 0.0), "{effort} at {way}");
            assert!((energy - 1e4 * depth * depth).abs() < 1e-12, "{energy} at {way}");
            if depth == 0.0 && rate < 0.0 {
                rates[0] = -rate;
            } else if depth == 0.0 && rates[0] > 0.0 {
                rates[1] = rate;
            }
        });
        assert!(largest > 0.1, "{largest}");
        [(rates[0] - once).abs(), (rates[1] - twice).abs()]
    });
    // 80 and 300 steps a contact: its error is (omega step)²/12 of the velocity and less.
    assert!(errors[0].iter().all(|error| *error < 1e-3), "{errors:?}");
    assert!(errors[1].iter().zip(errors[0]).all(|(fine, coarse)| *fine < 0.2 * coarse + 1e-8), "{errors:?}");
    let [drifted, changed] = drift(&block("velocity = [1, 0, 0]", stops, "stop = 1\nstep = 1e-3"), 1.0, (1e-3, 1000));
    assert!(drifted.abs() < 1e-9 && changed < -0.5, "{drifted:e} {changed}");
}

/// Friction about an axis is a torque, and part of what the joint transmits.
#[test]
fn friction_brakes_a_wheel() {
    let text = "format = 1\n[model]\nname = \"Wheel\"\n\
        [body.wheel]\nmass = 3\nposition = [0, 0, 0]\ninertia = [0.03, 0.03, 0.05]\nangular_velocity = [0, 0, 20]\n\
        [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"wheel\"\naxis = [0, 0, 1]\n\
        [friction.bearing]\njoint = \"axle\"\ncoordinate = \"angle\"\ncoulomb = 0.2\n\
        [stop.far]\njoint = \"axle\"\ncoordinate = \"angle\"\nupper = 500\nstiffness = 100\n\
        [output.braking]\nat = \"bearing\"\nquantities = [\"angle\", \"angle_rate\", \"effort\", \"power\"]\n\
        [output.held]\nat = \"axle\"\nquantities = [\"reaction_moment\"]\n\
        [simulation]\nstop = 2\nstep = 1e-2";
    let mut simulation = start(text);
    run(&mut simulation, 0.5, 2.0, |simulation| {
        // Far above the speed of 1e-3 rad/s, the torque is all there but for 1e-8 of it.
        let rate = value(simulation, "braking.angle_rate");
        assert!((value(simulation, "braking.effort") + 0.2).abs() < 1e-8);
        assert!((value(simulation, "held.reaction_moment[3]") + 0.2).abs() < 1e-8);
        assert!((value(simulation, "braking.power") - 0.2 * rate).abs() < 1e-6);
    });
    assert!((value(&simulation, "braking.angle_rate") - (20.0 - 0.2 / 0.05 * 2.0)).abs() < 1e-6);
    let effort = simulation.variables().iter().find(|variable| variable.name == "braking.effort").expect("an output");
    assert_eq!(effort.quantity.unit, "N.m");
}

/// A host may move both limits of a stop, in any order; a step with limits that cross is refused, and goes on when they
/// fit.
#[test]
fn limits_may_not_cross_in_a_step() {
    let stops = "[stop.ends]\njoint = \"rail\"\ncoordinate = \"distance\"\nlower = -0.1\nupper = 0.05\nstiffness = 2e4";
    let mut simulation = start(&block("", stops, "stop = 1\nstep = 1e-2"));
    let set = |simulation: &mut Simulation, name: &str, value: f64| {
        let at = simulation.variables().iter().position(|variable| variable.name == name).expect("a parameter");
        simulation.set_value(at, Value::Real(value)).unwrap_or_else(|failure| panic!("{}", failure.message));
    };
    simulation.advance(0.1).unwrap_or_else(|failure| panic!("{}", failure.message));
    set(&mut simulation, "ends.lower", 0.1);
    let failure = simulation.advance(0.2).expect_err("both ends push");
    assert!(failure.message.contains("the lower limit of stop ends, 0.1, is not below"), "{}", failure.message);
    set(&mut simulation, "ends.upper", 0.3);
    simulation.advance(0.2).unwrap_or_else(|failure| panic!("{}", failure.message));
}
