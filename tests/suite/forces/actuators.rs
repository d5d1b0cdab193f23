//! Actuators: efforts on joint coordinates and between two points, against closed forms; energy, momentum, reactions
//! and host inputs.

use crate::running::{run, start, value, vector};
use ancf14::fmi::{Model, Value};
use ancf14::solve::modes::modes;
use std::f64::consts::PI;

/// A wheel on a fixed axle.
const WHEEL: &str = r#"
format = 1
[model]
name = "Wheel"
[body.wheel]
mass = 3
position = [0, 0, 0]
inertia = [0.03, 0.03, 0.05]
[joint.axle]
type = "revolute"
a = "ground"
b = "wheel"
axis = [0, 0, 1]
[output.axle_motion]
at = "axle"
quantities = ["angle", "angle_rate", "effort", "reaction_moment"]
[output.motor_motion]
at = "motor"
quantities = ["angle", "effort", "power"]
"#;

fn wheel(actuator: &str, simulation: &str) -> String {
    format!(
        "{WHEEL}[actuator.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\n{actuator}\n[simulation]\n{simulation}\n"
    )
}

/// A torque that is linear in time over each step is taken exactly by the midpoint rule: the rate is `∫ effort dt / I`
/// to round-off, and so are power and the moment about the axis that the joint transmits.
#[test]
fn a_torque_spins_a_wheel() {
    let mut simulation = start(&wheel("effort = \"0.3 - 0.4*t\"", "stop = 2\nstep = 1e-2\noutput_step = 1e-2"));
    let mut time = 0.0;
    run(&mut simulation, 1e-2, 2.0, |simulation| {
        time += 1e-2;
        let (effort, rate) = (0.3 - 0.4 * time, (0.3 * time - 0.2 * time * time) / 0.05);
        let read = |name: &str| value(simulation, name);
        assert!(
            (read("axle_motion.angle_rate") - rate).abs() < 1e-11,
            "{} at {time} s",
            read("axle_motion.angle_rate")
        );
        for name in ["axle_motion.effort", "motor_motion.effort", "axle_motion.reaction_moment[3]"] {
            assert!((read(name) - effort).abs() < 1e-11, "{name} {} at {time} s", read(name));
        }
        assert!(
            (read("motor_motion.power") - effort * rate).abs() < 1e-10,
            "{} at {time} s",
            read("motor_motion.power")
        );
        // All energy is kinetic, and all of it is the motor's.
        let energy = 0.5 * 0.05 * rate * rate;
        assert!((read("energy.total") - energy).abs() < 1e-11, "{} at {time} s", read("energy.total"));
    });
}

/// The host's effort holds from the communication point on at which it is given; every communication step of 0.1 s adds
/// its share of the rate.
#[test]
fn a_host_gives_the_effort() {
    let mut simulation = start(&wheel("input = true\neffort = 0.1", "stop = 1\nstep = 1e-2\noutput_step = 1e-2"));
    let place = simulation.variables().iter().position(|variable| variable.name == "motor.effort").expect("an input");
    let mut rate = 0.0;
    for step in 1..=10 {
        let effort = 0.1 * f64::from(step % 3);
        simulation.set_value(place, Value::Real(effort)).unwrap_or_else(|failure| panic!("{}", failure.message));
        simulation.advance(0.1 * f64::from(step)).unwrap_or_else(|failure| panic!("{}", failure.message));
        rate += 0.1 * effort / 0.05;
        assert!((value(&simulation, "axle_motion.angle_rate") - rate).abs() < 1e-11, "step {step}");
        assert!((value(&simulation, "motor_motion.effort") - effort).abs() < 1e-15, "step {step}");
    }
}

/// A pendulum under the torque that the equation of motion asks for, `I θ'' + m g l cos θ`, moves as wanted but for the
/// error of the step, of order 2.
#[test]
fn computed_torque_moves_a_pendulum_as_wanted() {
    let error = |step: f64| {
        let text = format!(
            "format = 1\n[model]\nname = \"Pendulum\"\ngravity = [0, 0, -9.81]\n\
             [body.bob]\nmass = 2\nposition = [0.5, 0, 0]\ninertia = [0.02, 0.03, 0.02]\n\
             [joint.pivot]\ntype = \"revolute\"\na = \"ground\"\nb = \"bob\"\nat = [0, 0, 0]\naxis = [0, -1, 0]\n\
             [actuator.motor]\njoint = \"pivot\"\ncoordinate = \"angle\"\n\
             effort = \"-0.53*2*sin(2*t) + 2*9.81*0.5*cos(0.5*sin(2*t) - t)\"\n\
             [output.swing]\nat = \"pivot\"\nquantities = [\"angle\"]\n\
             [simulation]\nstop = 0.5\nstep = {step}\noutput_step = 0.5\n"
        );
        // θ = sin(2 t)/2 − t begins at rest.
        let mut simulation = start(&text);
        simulation.advance(0.5).unwrap_or_else(|failure| panic!("{}", failure.message));
        (value(&simulation, "swing.angle") - (0.5 * f64::sin(1.0) - 0.5)).abs()
    };
    let errors = [4e-3, 2e-3, 1e-3].map(error);
    assert!(errors[0] < 1e-4, "{errors:?}");
    for pair in errors.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((1.9..2.1).contains(&order), "order {order} of {errors:?}");
    }
}

/// Two bodies in space with a motor between them and a cylinder that pushes them apart: efforts inside a mechanism
/// change no momentum, and its energy by their work alone, here the integral of their power by Simpson's rule over
/// every two steps. Steps take the work to order 2: its error falls by 4 where the step is halved.
#[test]
fn inner_efforts_keep_momentum_and_balance_energy() {
    let misses = |step: f64| {
        let text = format!(
            "format = 1\n[model]\nname = \"Pair\"\n\
             [body.hull]\nmass = 4\nposition = [0, 0, 0]\ninertia = [0.3, 0.2, 0.4]\nvelocity = [0.2, 0, 0]\nangular_velocity = [0.3, 0.1, 0]\n\
             [body.arm]\nmass = 1\nposition = [0.6, 0, 0.1]\ninertia = [0.02, 0.05, 0.04]\nvelocity = [0.2, 0, 0]\nangular_velocity = [0.3, 0.1, 0]\n\
             [frame.post]\nposition = [0, 3, 0]\n\
             [joint.shoulder]\ntype = \"cylindrical\"\na = \"hull\"\nb = \"arm\"\nat = [0.3, 0, 0]\naxis = [0, 0.6, 0.8]\n\
             [actuator.motor]\njoint = \"shoulder\"\ncoordinate = \"angle\"\neffort = \"0.2*sin(5*t)\"\n\
             [actuator.screw]\njoint = \"shoulder\"\ncoordinate = \"distance\"\neffort = \"0.1*cos(4*t)\"\n\
             [actuator.cylinder]\na = \"hull\"\nb = \"arm\"\neffort = \"0.3 - 0.2*t\"\n\
             [output.motor_power]\nat = \"motor\"\nquantities = [\"power\"]\n\
             [output.screw_power]\nat = \"screw\"\nquantities = [\"power\", \"distance\"]\n\
             [output.cylinder_power]\nat = \"cylinder\"\nquantities = [\"power\", \"distance\", \"distance_rate\"]\n\
             [output.hull_motion]\nat = \"hull\"\nquantities = [\"position\"]\n[output.arm_motion]\nat = \"arm\"\nquantities = [\"position\"]\n\
             [simulation]\nstop = 1\nstep = {step}\noutput_step = {step}\n"
        );
        let mut simulation = start(&text);
        let power = |simulation: &_| {
            ["motor", "screw", "cylinder"]
                .map(|name| value(simulation, &format!("{name}_power.power")))
                .iter()
                .sum::<f64>()
        };
        let [linear, angular] = ["momentum.linear", "momentum.angular"].map(|name| vector(&simulation, name));
        let (mut powers, energy) = (vec![power(&simulation)], value(&simulation, "energy.total"));
        run(&mut simulation, step, 1.0, |simulation| {
            powers.push(power(simulation));
            // Sums of some thousand roundings of 1e-16.
            assert!((vector(simulation, "momentum.linear") - linear).norm() < 1e-11);
            assert!((vector(simulation, "momentum.angular") - angular).norm() < 1e-11);
            let apart = vector(simulation, "arm_motion.position") - vector(simulation, "hull_motion.position");
            assert!((value(simulation, "cylinder_power.distance") - apart.norm()).abs() < 1e-12);
        });
        let work: f64 = powers.windows(3).step_by(2).map(|p| (p[0] + 4.0 * p[1] + p[2]) * step / 3.0).sum();
        (work, (value(&simulation, "energy.total") - energy - work).abs())
    };
    let [(work, coarse), (_, fine)] = [4e-3, 2e-3].map(misses);
    assert!(work.abs() > 5e-3, "{work} J");
    let order = (coarse / fine).log2();
    assert!(
        coarse < 1e-4 * work.abs() && (1.9..2.1).contains(&order),
        "{coarse:e} J, {fine:e} J of {work} J: order {order}"
    );
}

/// In equilibrium the effort of a motor twists a shaft by `T l/(G Jt)`, exactly in one linear element, as a moment
/// does.
#[test]
fn a_motor_twists_a_shaft() {
    let text = "format = 1\n[model]\nname = \"Shaft\"\n\
                [material.steel]\nyoung = 2e11\nshear = 8e10\ndensity = 7800\n\
                [section.rod]\nshape = \"circle\"\nradius = 0.01\n\
                [beam.shaft]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 2\n\
                [joint.wall]\ntype = \"weld\"\na = \"ground\"\nb = \"shaft.start\"\n\
                [joint.bearing]\ntype = \"cylindrical\"\na = \"ground\"\nb = \"shaft.end\"\naxis = [1, 0, 0]\n\
                [actuator.motor]\njoint = \"bearing\"\ncoordinate = \"angle\"\neffort = \"20*t\"\n\
                [output.end]\nat = \"bearing\"\nquantities = [\"angle\", \"reaction_moment\", \"effort\"]\n\
                [output.foot]\nat = \"wall\"\nquantities = [\"reaction_moment\"]\n\
                [simulation]\nanalysis = \"static\"\nstop = 1\n";
    let mut simulation = start(text);
    run(&mut simulation, 0.5, 1.0, |simulation| {
        let torque = value(simulation, "end.effort");
        let stiffness = 8e10 * 0.5 * PI * 0.01_f64.powi(4);
        // Large strains stiffen a twisted shaft by (twist rate · radius)², here 3e-4 of 1e-4.
        let (angle, expected) = (value(simulation, "end.angle"), torque / stiffness);
        assert!((angle - expected).abs() < 1e-4 * expected, "{angle} instead of {expected} rad");
        for (name, sign) in [("end", 1.0), ("foot", -1.0)] {
            let moment = vector(simulation, &format!("{name}.reaction_moment"));
            assert!((moment.x - sign * torque).abs() < 1e-7 * torque, "{name}: {moment}");
        }
    });
}

/// A cylinder from a fixed post carries a hinged bar: moments about the hinge give its force, and the post takes it.
#[test]
fn a_cylinder_carries_a_bar() {
    let text = |effort: f64| {
        format!(
            "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, -10]\n\
             [body.bar]\nmass = 3\nposition = [2, 0, 0]\ninertia = [0.1, 1, 1]\n\
             [frame.post]\nposition = [2, 0, -1]\n\
             [joint.hinge]\ntype = \"revolute\"\na = \"ground\"\nb = \"bar\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n\
             [actuator.lift]\na = \"post\"\nb = \"bar\"\neffort = {effort}\n\
             [output.bar_motion]\nat = \"bar\"\nquantities = [\"acceleration\"]\n\
             [output.post_load]\nat = \"post\"\nquantities = [\"reaction_force\"]\n\
             [simulation]\nstop = 0.1\nstep = 1e-2\n"
        )
    };
    let simulation = start(&text(30.0));
    assert!(vector(&simulation, "bar_motion.acceleration").norm() < 1e-12);
    // The post gives what it takes from the lift.
    assert!((vector(&simulation, "post_load.reaction_force") - nalgebra::Vector3::new(0.0, 0.0, 30.0)).norm() < 1e-12);
    let simulation = start(&text(0.0));
    // (m g l)/(I + m l²) · l
    let free = 3.0 * 10.0 * 2.0 / (1.0 + 12.0) * 2.0;
    assert!((vector(&simulation, "bar_motion.acceleration").z + free).abs() < 1e-12);
}

/// A bar of 2 m on a hinge, carried by a cylinder from a post 1 m below the hinge. With the angle `θ` of the bar the
/// cylinder is `l = √(5 + 4 sin θ)` long; its effort `m g r/l'` holds the weight at `θ = 0`, and has the stiffness
/// `−e l'' = e l'²/l` there, which alone makes the bar swing.
#[test]
fn the_effort_of_a_cylinder_has_a_stiffness() {
    let text = "format = 1\n[model]\nname = \"Bar\"\ngravity = [0, 0, -10]\n\
                [body.bar]\nmass = 3\nposition = [2, 0, 0]\ninertia = [0.1, 1, 1]\n\
                [point.post]\noffset = [0, 0, -1]\n\
                [joint.hinge]\ntype = \"revolute\"\na = \"ground\"\nb = \"bar\"\nat = [0, 0, 0]\naxis = [0, -1, 0]\n\
                [actuator.lift]\na = \"post\"\nb = \"bar\"\neffort = \"30*sqrt(5)\"\n\
                [simulation]\nstop = 1\n";
    let simulation = start(text);
    let found = modes(simulation.system(), simulation.state(), 1).expect("a mode");
    let slope = 2.0 / 5.0_f64.sqrt();
    let eigenvalue = 60.0 / slope * slope * slope / 5.0_f64.sqrt() / (1.0 + 3.0 * 4.0);
    assert_eq!(found.modes.len(), 1);
    assert!((found.modes[0].eigenvalue / eigenvalue - 1.0).abs() < 1e-10, "{} 1/s²", found.modes[0].eigenvalue);
}

/// A torque that ends within a step: steps end there, so that nothing of it is lost.
#[test]
fn steps_end_where_an_effort_ends() {
    let effort = "effort = [{ until = 0.155, is = 1 }, { is = 0 }]";
    let mut simulation = start(&wheel(effort, "stop = 0.2\nstep = 1e-2\noutput_step = 1e-2"));
    run(&mut simulation, 1e-2, 0.2, |_| {});
    let rate = value(&simulation, "axle_motion.angle_rate");
    assert!((rate - 0.155 / 0.05).abs() < 1e-11, "{rate} rad/s");
}
