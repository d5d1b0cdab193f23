//! Gears and racks: proportional coordinates of two joints, whatever number of turns they make, against closed forms. A
//! ratio that is upside down, a condition whose second side overwrites the first, or a reaction without the gear's part
//! shows in full.

use crate::running::{run, start, try_start, value, vector};
use crate::support::machines::drift;
use ancf14::fmi::Model;

/// Two wheels on parallel axles at 0 and at x = 0.3; `rest` has what acts on them.
fn wheels(ratio: f64, rest: &str, simulation: &str) -> String {
    let wheel = |name: &str, x: f64, inertia: f64| {
        format!(
            "[body.{name}]\nmass = 2\nposition = [{x}, 0, 0]\ninertia = [{inertia}, {inertia}, {inertia}]\n\
             [joint.{name}_axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"{name}\"\naxis = [0, 0, 1]\n\
             [output.{name}_turn]\nat = \"{name}_axle\"\nquantities = [\"angle\", \"angle_rate\", \"reaction_moment\"]\n"
        )
    };
    format!(
        "format = 1\n[model]\nname = \"Wheels\"\n{}{}\
         [gear.mesh]\na = \"small_axle\"\nb = \"large_axle\"\nratio = {ratio}\n\
         [output.teeth]\nat = \"mesh\"\nquantities = [\"effort\", \"power\"]\n{rest}\n[simulation]\n{simulation}\n",
        wheel("small", 0.0, 0.01),
        wheel("large", 0.3, 0.5),
    )
}

/// A motor on the small wheel turns both: `(J_1 + J_2/r²) x_1'' = T` over many turns, with the torque of the gear on
/// both, and its power.
#[test]
fn a_motor_turns_both_wheels() {
    let motor = "[actuator.motor]\njoint = \"small_axle\"\ncoordinate = \"angle\"\neffort = 0.6";
    for ratio in [-4.0, 4.0, 0.25] {
        let mut simulation = start(&wheels(ratio, motor, "stop = 4\nstep = 1e-3"));
        let acceleration = 0.6 / (0.01 + 0.5 / (ratio * ratio));
        run(&mut simulation, 0.5, 4.0, |simulation| {
            let time = simulation.time();
            let turn = acceleration * time * 1e-3 * f64::max(1.0, 1.0 / ratio.abs());
            let close = |name: &str, expected: f64| {
                let found = value(simulation, name);
                // A step takes chords for arcs: (turn of a step)²/12 of the rate; Newton leaves 1e-9 of a step.
                let bound = turn * turn / 12.0 + 1e-8;
                assert!(
                    (found - expected).abs() < bound * expected.abs().max(1.0),
                    "{ratio} {name} {found} {expected}"
                );
            };
            let [small, large] = ["small_turn.angle", "large_turn.angle"].map(|name| value(simulation, name));
            assert!((small - ratio * large).abs() < 1e-9, "{small} {large}");
            close("small_turn.angle", 0.5 * acceleration * time * time);
            close("large_turn.angle", 0.5 * acceleration * time * time / ratio);
            let torque = 0.01 * acceleration - 0.6;
            close("teeth.effort", torque);
            close("teeth.power", torque * acceleration * time);
            // Each axle transmits what turns its wheel: the gear's torque is a part of it.
            close("small_turn.reaction_moment[3]", 0.01 * acceleration);
            close("large_turn.reaction_moment[3]", 0.5 * acceleration / ratio);
        });
        assert!(ratio.abs() < 1.0 || value(&simulation, "small_turn.angle") > 50.0, "it must make many turns");
    }
}

/// A pinion lowers a rack: `(m + J r²) x'' = m g`, and at rest a torque of `m g/r` holds it.
#[test]
fn a_rack_turns_its_pinion() {
    let text = |motor: &str, simulation: &str| {
        format!(
            "format = 1\n[model]\nname = \"Rack\"\ngravity = [0, 0, -9.81]\n\
             [body.pinion]\nmass = 1\nposition = [0, 0, 0]\ninertia = [0.02, 0.02, 0.02]\n\
             [body.rack]\nmass = 3\nposition = [0.05, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n\
             [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"pinion\"\naxis = [0, 1, 0]\n\
             [joint.guide]\ntype = \"cylindrical\"\na = \"ground\"\nb = \"rack\"\naxis = [0, 0, 1]\nrotational_stiffness = 1\n\
             [gear.teeth]\na = \"axle\"\nb = \"guide\"\nb_coordinate = \"distance\"\nratio = -20\n\
             [output.pinion_turn]\nat = \"axle\"\nquantities = [\"angle\"]\n\
             [output.way]\nat = \"guide\"\nquantities = [\"distance\"]\n\
             [output.mesh]\nat = \"teeth\"\nquantities = [\"effort\"]\n{motor}\n[simulation]\n{simulation}\n"
        )
    };
    let mut simulation = start(&text("", "stop = 1\nstep = 1e-3"));
    simulation.advance(1.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    let fall = 0.5 * 3.0 * 9.81 / (3.0 + 0.02 * 400.0);
    let way = value(&simulation, "way.distance");
    // The pinion turns by up to 0.053 rad a step, of which chords are off by the square over 12.
    assert!((way + fall).abs() < 2.5e-4 * fall, "{way}");
    assert!((value(&simulation, "pinion_turn.angle") + 20.0 * way).abs() < 1e-9);
    let spring = "[spring.watch]\njoint = \"axle\"\ncoordinate = \"angle\"\nforce = \"0.4*x\"";
    let rest = start(&text(spring, "analysis = \"static\"\nstop = 1\nstep = 1"));
    // The torque of the spring carries the weight at the pinion's radius of 1/20 m.
    let angle = 3.0 * 9.81 / 20.0 / 0.4;
    assert!((value(&rest, "pinion_turn.angle") - angle).abs() < 1e-8, "{}", value(&rest, "pinion_turn.angle"));
    assert!((value(&rest, "mesh.effort") - 0.4 * angle).abs() < 1e-8, "{}", value(&rest, "mesh.effort"));
    let variables = rest.variables();
    let unit = |name: &str| variables.iter().find(|variable| variable.name == name).unwrap().quantity.unit.clone();
    assert_eq!([unit("teeth.ratio"), unit("mesh.effort")], ["rad/m", "N.m"]);
}

/// Two pendulums of which one turns twice as far as the other: the motion of one pendulum of the sum of both,
/// `J x'' = -m g l (sin x + 1/2 sin(x/2))`, with second order; and no energy is lost or gained.
#[test]
fn geared_pendulums_keep_the_order_and_the_energy() {
    let text = |step: f64| {
        let pendulum = |name: &str, y: f64| {
            format!(
                "[body.{name}]\nmass = 1\nposition = [1, {y}, 0]\ninertia = [0.1, 0.1, 0.1]\n\
                 [joint.{name}_hinge]\ntype = \"revolute\"\na = \"ground\"\nb = \"{name}\"\nat = [0, {y}, 0]\naxis = [0, 1, 0]\n\
                 [output.{name}_turn]\nat = \"{name}_hinge\"\nquantities = [\"angle\"]\n"
            )
        };
        format!(
            "format = 1\n[model]\nname = \"Pendulums\"\ngravity = [0, 0, -9.81]\n{}{}\
             [gear.belt]\na = \"one_hinge\"\nb = \"two_hinge\"\nratio = 2\n\
             [simulation]\nstop = 2\nstep = {step}\nspectral_radius = 1\n",
            pendulum("one", 0.0),
            pendulum("two", 1.0),
        )
    };
    // Both begin level: 1.1 x'' (1 + 1/4) = g (cos x + cos(x/2)/2), by Runge and Kutta's rule of order 4.
    let slope = |x: f64| 9.81 * (x.cos() + 0.5 * (0.5 * x).cos()) / (1.1 * 1.25);
    let (mut x, mut v, steps) = (0.0, 0.0, 20_000);
    let h = 2.0 / f64::from(steps);
    for _ in 0..steps {
        let k1 = [v, slope(x)];
        let k2 = [v + 0.5 * h * k1[1], slope(x + 0.5 * h * k1[0])];
        let k3 = [v + 0.5 * h * k2[1], slope(x + 0.5 * h * k2[0])];
        let k4 = [v + h * k3[1], slope(x + h * k3[0])];
        x += h / 6.0 * (k1[0] + 2.0 * k2[0] + 2.0 * k3[0] + k4[0]);
        v += h / 6.0 * (k1[1] + 2.0 * k2[1] + 2.0 * k3[1] + k4[1]);
    }
    let errors = [0.02, 0.01, 0.005].map(|step| {
        let mut simulation = start(&text(step));
        simulation.advance(2.0).unwrap_or_else(|failure| panic!("{}", failure.message));
        let [one, two] = ["one_turn.angle", "two_turn.angle"].map(|name| value(&simulation, name));
        assert!((one - 2.0 * two).abs() < 1e-10, "{one} {two}");
        (one - x).abs()
    });
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.9..2.1).contains(&order), "order {order} of {errors:?}");
    }
    let [coarse, changed] = drift(&text(0.01), 1.0, (0.01, 2_000));
    let [fine, _] = drift(&text(0.005), 1.0, (0.005, 4_000));
    // Joints act at the mean of the ends of a step: the account is of second order, and does not grow.
    println!("drift {coarse:e}, {fine:e} of {changed} J");
    assert!(coarse.abs() < 1e-3 * changed.abs() && fine.abs() < 0.3 * coarse.abs(), "{coarse:e} {fine:e} {changed}");
}

/// A free satellite that turns its two panels by a geared motor: nothing moves its momenta. Both panels turn alike
/// against the hub.
#[test]
fn inner_gears_keep_momenta() {
    let panel = |name: &str, y: f64| {
        format!(
            "[body.{name}]\nmass = 3\nposition = [0.1, {y}, 0.2]\ninertia = [0.5, 0.1, 0.6]\nvelocity = [1, 0, 0]\n\
             [joint.{name}_bearing]\ntype = \"revolute\"\na = \"hub\"\nb = \"{name}\"\nat = [0, {y}, 0]\naxis = [0, 1, 0.2]\n\
             [output.{name}_turn]\nat = \"{name}_bearing\"\nquantities = [\"angle\"]\n"
        )
    };
    let text = format!(
        "format = 1\n[model]\nname = \"Satellite\"\n\
         [body.hub]\nmass = 20\nposition = [0, 0, 0]\ninertia = [2, 3, 2.5]\nvelocity = [1, 0, 0]\n{}{}\
         [gear.link]\na = \"left_bearing\"\nb = \"right_bearing\"\nratio = -1.5\n\
         [actuator.motor]\njoint = \"left_bearing\"\ncoordinate = \"angle\"\neffort = \"4*sin(3*t)\"\n\
         [simulation]\nstop = 4\nstep = 0.01\n",
        panel("left", 1.0),
        panel("right", -1.0)
    );
    let mut simulation = start(&text);
    let before = ["momentum.linear", "momentum.angular"].map(|name| vector(&simulation, name));
    let mut turned = 0.0_f64;
    run(&mut simulation, 0.1, 4.0, |simulation| {
        let [left, right] = ["left_turn.angle", "right_turn.angle"].map(|name| value(simulation, name));
        assert!((left + 1.5 * right).abs() < 1e-10, "{left} {right}");
        turned = turned.max(left.abs());
        let now = ["momentum.linear", "momentum.angular"].map(|name| vector(simulation, name));
        for (now, before) in now.iter().zip(&before) {
            assert!((now - before).norm() < 1e-10 * 26.0, "{now} {before}");
        }
    });
    assert!(turned > 1.0, "{turned}");
}

/// An inverted pendulum is held by the torsion spring of a wheel through a gear: it is stable while `4 k` is more than
/// `(m g + P) l`, and told where it is not.
#[test]
fn stability_sees_through_gears() {
    let text = |stiffness: f64| {
        format!(
            "format = 1\n[model]\nname = \"Inverted\"\ngravity = [0, 0, -10]\n\
             [body.bob]\nmass = 1\nposition = [0, 0, 0.5]\ninertia = [0.1, 0.1, 0.1]\n\
             [body.wheel]\nmass = 1\nposition = [1, 0, 0]\ninertia = [0.2, 0.2, 0.2]\n\
             [joint.foot]\ntype = \"revolute\"\na = \"ground\"\nb = \"bob\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n\
             [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"wheel\"\naxis = [0, 1, 0]\nstiffness = {stiffness}\n\
             [gear.belt]\na = \"axle\"\nb = \"foot\"\nratio = 2\n\
             [load.weight]\nat = \"bob\"\nforce = [0, 0, \"-10*t\"]\n\
             [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.1\n"
        )
    };
    let warnings = |stiffness: f64| {
        let mut simulation = start(&text(stiffness));
        run(&mut simulation, 0.1, 1.0, |_| {});
        simulation.take_warnings()
    };
    // The wheel turns by 2 where the bob turns by 1: 4 k against 5 (1 + t) N m/rad.
    assert_eq!(warnings(2.6), Vec::<String>::new());
    let told = warnings(2.01);
    assert!(told.len() == 1 && told[0].contains("unstable") && told[0].contains("0.6"), "{told:?}");
    let dynamic = text(2.0).replace("analysis = \"static\"\n", "");
    let found = start(&dynamic).modes(1).unwrap_or_else(|failure| panic!("{}", failure.message));
    let expected = (4.0 * 2.0 - 5.0) / (0.1 + 0.25 + 4.0 * 0.2);
    let eigenvalue = found.modes[0].eigenvalue;
    assert!((eigenvalue - expected).abs() < 1e-9 * expected, "{eigenvalue} {expected}");
}

/// A gear between joints to a frame that turns: the frame's work is that of the joints and of the gear, so that the
/// account of energy closes.
#[test]
fn gears_on_moving_frames_are_accounted_for() {
    let text = "format = 1\n[model]\nname = \"Carousel\"\n\
        [frame.table]\nposition = [0, 0, 0]\nrotation = [0, 0, \"0.5*t^2\"]\n\
        [body.one]\nmass = 1\nposition = [1, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n\
        [body.two]\nmass = 1\nposition = [0, 1, 0]\ninertia = [0.1, 0.1, 0.1]\n\
        [joint.first]\ntype = \"prismatic\"\na = \"table\"\nb = \"one\"\naxis = [1, 0, 0]\nstiffness = 50\n\
        [joint.second]\ntype = \"revolute\"\na = \"ground\"\nb = \"two\"\nat = [0, 0, 0]\naxis = [0, 0, 1]\n\
        [gear.link]\na = \"first\"\nb = \"second\"\nratio = 0.2\n\
        [simulation]\nstop = 2\nstep = 0.001\n";
    let [coarse, changed] = drift(text, 1.0, (0.002, 1_000));
    let [fine, _] = drift(text, 1.0, (0.001, 2_000));
    // The joints of frames act at the middle of a step: of second order.
    assert!(changed > 1.0 && coarse.abs() < 1e-3 * changed, "{coarse:e} {fine:e} {changed}");
    assert!(fine.abs() < 0.3 * coarse.abs() + 1e-9, "{coarse:e} {fine:e}");
}

/// Two gears between the same joints hold the same thing twice, or nothing can move: the message names the gear.
#[test]
fn redundant_gears_are_named() {
    let text = wheels(2.0, "[gear.other]\na = \"large_axle\"\nb = \"small_axle\"\nratio = 0.5", "stop = 1\nstep = 0.1");
    let Err(message) = try_start(&text) else { panic!("it must be refused") };
    assert!(message.contains("gear mesh") || message.contains("gear other"), "{message}");
    assert!(message.contains("is redundant"), "{message}");
}
