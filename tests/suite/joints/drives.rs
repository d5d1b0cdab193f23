//! A drive must put its coordinate where its function says, to round-off and for good: over many turns, in steps that
//! have to be halved, from a rate that is integrated, two on one joint, and from a start that is not as drawn. Its
//! effort must be the power that goes into the machine. A drive that integrates its condition drifts; one that forgets
//! turns is off by 2 pi; a false moment or arm shows in the power.

use crate::running::{run, start, try_start, value, vector};
use crate::support::parts::gap;
use ancf14::math::{Mat3, Vec3, rotation};
use ancf14::mechanics::body::kinematics;
use ancf14::mechanics::system::mass::MassAt;
use ancf14::model::simulation::Simulation;
use ancf14::solve::step::response::{Responder, Response};

/// An eccentric body on a skew axis through the origin; `joint` is its kind, `rest` the drives and the simulation.
fn wheel(joint: &str, gravity: [f64; 3], rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Wheel\"\ngravity = {gravity:?}\n\
         [body.wheel]\nmass = 2\nposition = {CENTER:?}\ninertia = [0.05, 0.08, 0.1, 0.004, -0.006, 0.01]\n\
         [joint.axle]\ntype = \"{joint}\"\na = \"ground\"\nb = \"wheel\"\nat = [0, 0, 0]\naxis = [1, 2, 2]\n\
         [output.axle_turn]\nat = \"axle\"\nquantities = [\"angle\"]\n\
         [output.wheel_place]\nat = \"wheel\"\nquantities = [\"position\", \"velocity\"]\n{rest}\n"
    )
}

const CENTER: [f64; 3] = [0.1, 0.25, 0.2];

fn axis() -> Vec3 {
    Vec3::new(1.0, 2.0, 2.0) / 3.0
}

fn motor(motion: &str) -> String {
    format!(
        "[drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\n{motion}\n\
         [output.motor_torque]\nat = \"motor\"\nquantities = [\"angle\", \"effort\"]\n"
    )
}

fn settings(step: &str, output_step: &str) -> String {
    format!("[simulation]\nstop = 3\nstep = {step}\noutput_step = {output_step}\n")
}

/// How far directors and section axes are from orthonormal triads.
fn skewness(simulation: &Simulation) -> f64 {
    let (system, state) = (simulation.system(), simulation.state());
    let mut worst = 0.0_f64;
    for body in &system.bodies {
        let axes = kinematics::pose(&state.q, body.start).axes;
        worst = worst.max((axes.tr_mul(&axes) - Mat3::identity()).amax());
    }
    for triad in &state.triads {
        let lengths = [triad.t.norm() - 1.0, triad.u.norm() - 1.0, triad.t.dot(&triad.u)];
        worst = lengths.into_iter().fold(worst, |worst, value| worst.max(value.abs()));
    }
    worst
}

/// 25 turns at 60 rad/s: in small steps; in steps of 1.2 rad, which are halved twice; in steps of a whole turn, which
/// look like none.
#[test]
fn many_turns_leave_no_drift() {
    for (step, every) in [("1e-3", 0.02), ("0.02", 0.02), ("\"2*pi/60\"", 2.0 * std::f64::consts::PI / 60.0)] {
        let text = wheel("revolute", [1.0, -2.0, -9.0], &(motor("value = \"60*t\"") + &settings(step, step)));
        let mut simulation = start(&text);
        let (mut apart, mut skew, mut off, mut worst) = (0.0_f64, 0.0_f64, 0.0_f64, 0.0_f64);
        run(&mut simulation, every, 25.0 * std::f64::consts::TAU / 60.0, |simulation| {
            let angle = 60.0 * simulation.state().time;
            for name in ["axle_turn.angle", "motor_torque.angle"] {
                apart = apart.max((value(simulation, name) - angle).abs());
            }
            skew = skew.max(skewness(simulation));
            worst = worst.max(gap(simulation.system(), simulation.state()));
            let place = rotation::rotation_matrix(&(axis() * angle)) * Vec3::from(CENTER);
            off = off.max((vector(simulation, "wheel_place.position") - place).norm());
        });
        let turns = value(&simulation, "axle_turn.angle") / std::f64::consts::TAU;
        let rejected = value(&simulation, "statistics.rejected");
        println!(
            "h = {step}: {turns:.2} turns, angle off by {apart:.1e}, place by {off:.1e}, axes by {skew:.1e}, gap {worst:.1e}, {rejected} rejected"
        );
        assert!(turns > 24.9);
        assert_eq!(rejected > 0.0, step != "1e-3", "steps beyond 0.5 rad of a body are halved");
        // Round-off of an angle of 157 rad, 3e-14, and of the conditions.
        assert!(apart < 1e-12 && off < 1e-12 && skew < 1e-13 && worst < 1e-12);
    }
}

/// A shaft turned at its start, in steps of 6 rad and of a whole turn: halved, and no turn is lost along it.
#[test]
fn steps_of_more_than_half_a_turn_count_right() {
    for (step, every) in [("1e-3", 0.1), ("0.1", 0.1), ("\"2*pi/60\"", 2.0 * std::f64::consts::PI / 60.0)] {
        let text = format!(
            "format = 1\n[model]\nname = \"Shaft\"\n\
             [material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7800\n\
             [section.rod]\nshape = \"circle\"\nradius = 0.01\n\
             [beam.shaft]\nmaterial = \"steel\"\nsection = \"rod\"\nfrom = [0, 0, 0]\nto = [0.3, 0.6, 0.6]\n\
             elements = 4\nangular_velocity = [20, 40, 40]\n\
             [joint.axle]\ntype = \"revolute\"\na = \"ground\"\nb = \"shaft.start\"\naxis = [1, 2, 2]\n\
             [joint.bearing]\ntype = \"cylindrical\"\na = \"ground\"\nb = \"shaft.end\"\naxis = [1, 2, 2]\n\
             [drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"60*t\"\n\
             [output.here]\nat = \"axle\"\nquantities = [\"angle\"]\n\
             [output.there]\nat = \"bearing\"\nquantities = [\"angle\"]\n\
             [output.tip]\nat = \"shaft.end\"\nquantities = [\"rotation\", \"twist\"]\n{}",
            settings(step, step)
        );
        let mut simulation = start(&text);
        let (mut apart, mut skew) = ([0.0_f64; 3], 0.0_f64);
        run(&mut simulation, every, 25.0 * std::f64::consts::TAU / 60.0, |simulation| {
            let angle = 60.0 * simulation.state().time;
            let rotation = (vector(simulation, "tip.rotation") - axis() * angle).norm();
            let found = [value(simulation, "here.angle") - angle, value(simulation, "there.angle") - angle, rotation];
            for (apart, found) in apart.iter_mut().zip(found) {
                *apart = apart.max(found.abs());
            }
            skew = skew.max(skewness(simulation));
        });
        println!(
            "h = {step}: driven end off by {:.1e}, other end {:.1e}, rotation {:.1e}, triads {skew:.1e}",
            apart[0], apart[1], apart[2]
        );
        assert_eq!(value(&simulation, "statistics.rejected") > 0.0, step != "1e-3");
        // The torsion of a shaft that turns steadily stays at round-off of the angles.
        assert!(apart[0] < 1e-12 && apart[1] < 1e-9 && apart[2] < 1e-9 && skew < 1e-14, "{apart:?} {skew:e}");
    }
}

/// The value of a drive given by its rate is the exact integral, whatever the steps, jumps inside of steps included.
#[test]
fn rates_end_where_their_integral_says() {
    type Integral = fn(f64) -> f64;
    let cases: [(&str, Integral); 3] = [
        ("\"10*sin(3*t)^2 + t*exp(-t) - 2/(1 + t^2)\"", |t| {
            10.0 * (0.5 * t - (6.0 * t).sin() / 12.0) + 1.0 - (1.0 + t) * (-t).exp() - 2.0 * t.atan()
        }),
        ("[{ until = 0.35, is = \"2\" }, { is = \"-1 + 3*t^2\" }]", |t| {
            let later = |t: f64| t * t * t - t;
            if t < 0.35 { 2.0 * t } else { 0.7 + later(t) - later(0.35) }
        }),
        ("\"7*cos(40*t)\"", |t| 7.0 * (40.0 * t).sin() / 40.0),
    ];
    for (rate, integral) in cases {
        for step in ["7e-3", "0.03"] {
            let text = wheel("revolute", [0.0; 3], &(motor(&format!("rate = {rate}")) + &settings(step, "0.05")));
            let mut simulation = start(&text);
            let mut apart = 0.0_f64;
            run(&mut simulation, 0.05, 2.0, |simulation| {
                let time = simulation.state().time;
                apart = apart.max((value(simulation, "axle_turn.angle") - integral(time)).abs());
            });
            println!("{rate}, h = {step}: off by {apart:.1e}");
            // Round-off of some 300 sums of angles of up to 20 rad.
            assert!(apart < 1e-12, "{rate}: {apart:e}");
        }
    }
}

/// A rate that jumps throws the wheel in one step; from then on it turns freely about its center, and the multiplier of
/// the drive is what that needs: nothing. Momentum that the conditions do not allow, left in after the jump, would come
/// back with the other sign in every step: 3.5 kN m for ever.
#[test]
fn a_jump_of_a_rate_leaves_no_ringing() {
    let rate = "rate = [{ until = 0.3, is = \"0\" }, { is = \"3\" }]";
    let mut simulation = start(&wheel("revolute", [0.0; 3], &(motor(rate) + &settings("1e-3", "1e-3"))));
    let mut largest = 0.0_f64;
    run(&mut simulation, 1e-3, 1.0, |simulation| {
        if simulation.state().time > 0.3021 {
            // The drive's condition is the last one.
            largest = simulation.state().multipliers.last().map_or(f64::NAN, |own| largest.max(own.abs()));
        }
    });
    println!("largest multiplier after the jump {largest:.1e} N m");
    // (omega h)^2 of the impulse over the step, with 3 rad/s and 1e-3 s.
    assert!(largest < 0.1, "{largest:e}");
}

/// Power that the drives give, change of energy per time, W, at the instant.
fn powers(simulation: &Simulation, rates: &[f64], efforts: &[f64]) -> [f64; 2] {
    let (system, state) = (simulation.system(), simulation.state());
    let mut response = Response::default();
    Responder::new(system).respond(system, state, &mut response).unwrap();
    let mut inertia = vec![0.0; state.q.len()];
    system.mass_times(MassAt::CONSTANT, &response.acceleration, &mut inertia);
    let kinetic: f64 = inertia.iter().zip(&state.velocity).map(|(force, velocity)| force * velocity).sum();
    let lift: f64 = system
        .bodies
        .iter()
        .map(|body| {
            -body.mass * system.gravity.dot(&Vec3::from_column_slice(&state.velocity[body.start..body.start + 3]))
        })
        .sum();
    [rates.iter().zip(efforts).map(|(rate, effort)| rate * effort).sum(), kinetic + lift]
}

const TWO: &str = "[drive.motor]\njoint = \"axle\"\ncoordinate = \"angle\"\nvalue = \"2*sin(3*t)\"\n\
                   [drive.ram]\njoint = \"axle\"\ncoordinate = \"distance\"\nvalue = \"0.2*(1 - cos(5*t))\"\n\
                   [output.torque]\nat = \"motor\"\nquantities = [\"angle\", \"effort\"]\n\
                   [output.thrust]\nat = \"ram\"\nquantities = [\"distance\", \"effort\"]\n";

/// Two drives on a cylindrical joint: the motion is the screw that both describe; effort times rate is the change of
/// the energy per time, at every instant to round-off, and summed over the run by the trapezium rule with order 2.
#[test]
fn efforts_are_the_power_that_goes_in() {
    let gravity = [1.0, -2.0, -9.0];
    let misses = [4e-3, 2e-3].map(|step| {
        let mut simulation =
            start(&wheel("cylindrical", gravity, &(TWO.to_owned() + &settings(&step.to_string(), "0.02"))));
        let rates = |t: f64| [6.0 * (3.0 * t).cos(), (5.0 * t).sin()];
        let efforts = |simulation: &Simulation| ["torque.effort", "thrust.effort"].map(|name| value(simulation, name));
        let (mut off, mut unbalanced, mut largest) = (0.0_f64, 0.0_f64, 0.0_f64);
        let begin = value(&simulation, "energy.total");
        let (mut work, mut miss) = (0.0, 0.0_f64);
        let mut before = powers(&simulation, &rates(0.0), &efforts(&simulation))[0];
        run(&mut simulation, step, 1.2, |simulation| {
            let t = simulation.state().time;
            let turn = rotation::rotation_matrix(&(axis() * (2.0 * (3.0 * t).sin())));
            let place = turn * Vec3::from(CENTER) + axis() * (0.2 * (1.0 - (5.0 * t).cos()));
            off = off.max((vector(simulation, "wheel_place.position") - place).norm());
            let [given, taken] = powers(simulation, &rates(t), &efforts(simulation));
            unbalanced = unbalanced.max((given - taken).abs());
            largest = largest.max(given.abs());
            work += 0.5 * step * (before + given);
            before = given;
            miss = miss.max((value(simulation, "energy.total") - begin - work).abs());
        });
        println!(
            "h = {step}: screw off by {off:.1e} m, power by {:.1e} of {largest:.1} W, work by {miss:.1e} J",
            unbalanced / largest
        );
        assert!(off < 1e-13 && unbalanced < 1e-12 * largest, "{off:e} {unbalanced:e}");
        miss
    });
    let order = (misses[0] / misses[1]).log2();
    println!("order {order:.2}");
    assert!(misses[1] < 0.02 && (order - 2.0).abs() < 0.2, "{misses:?}");
}

/// Drawn at 0, a drive that begins elsewhere is an error with its value; `initial = "equilibrium"` assembles the
/// machine there, more than a turn away too, and starts it with the drive's rate.
#[test]
fn a_drive_that_does_not_begin_as_drawn() {
    for angle in [0.3, -1.7, 7.0] {
        let rest = motor(&format!("value = \"{angle} + 2*t\"")) + &settings("1e-3", "0.01");
        let text = wheel("revolute", [0.0, 0.0, -9.81], &rest);
        let message = try_start(&text).unwrap_err();
        println!("{message}");
        assert!(message.contains("motor") && message.contains(&angle.to_string()), "{message}");

        let mut simulation = start(&(text + "initial = \"equilibrium\"\n"));
        for time in [0.0, 0.05] {
            if time > 0.0 {
                run(&mut simulation, 0.01, time, |_| {});
            }
            let expected = angle + 2.0 * time;
            assert!((value(&simulation, "axle_turn.angle") - expected).abs() < 1e-12);
            let place = rotation::rotation_matrix(&(axis() * expected)) * Vec3::from(CENTER);
            assert!((vector(&simulation, "wheel_place.position") - place).norm() < 1e-12);
            let velocity = axis().cross(&place) * 2.0;
            let found = vector(&simulation, "wheel_place.velocity");
            // Velocities are round-off at the start, of order 2 in the step later: (omega h)^2 with 2 rad/s, 1e-3 s.
            assert!((found - velocity).norm() < if time > 0.0 { 1e-5 } else { 1e-12 }, "{found} {velocity}");
        }
    }
}

/// A beam of 8 m spun up by a drive to 4 rad/s in 15 s, in steps of omega h = 0.02: it is stretched by
/// `rho w^2 L^3 / 3 E` and no more. The plain midpoint rule adds 4e-4 m, four times as much, or fails.
#[test]
fn a_beam_spun_up_shows_no_false_extension() {
    let text = "format = 1\n[model]\nname = \"SpinUp\"\n\
        [material.steel]\nyoung = 2e11\npoisson = 0.3\ndensity = 7800\n\
        [section.bar]\nshape = \"rectangle\"\nwidth = 0.1\nheight = 0.1\n\
        [beam.arm]\nmaterial = \"steel\"\nsection = \"bar\"\nfrom = [0, 0, 0]\nto = [8, 0, 0]\nelements = 4\n\
        [joint.hub]\ntype = \"revolute\"\na = \"ground\"\nb = \"arm.start\"\naxis = [0, 0, 1]\n\
        [drive.motor]\njoint = \"hub\"\ncoordinate = \"angle\"\n\
        value = [{ until = 15, is = \"4/15*(t^2/2 + (15/(2*pi))^2*(cos(2*pi*t/15) - 1))\" }, { is = \"30 + 4*(t - 15)\" }]\n\
        [output.tip]\nat = \"arm.end\"\nquantities = [\"position\", \"axial_strain\"]\n\
        [simulation]\nstop = 20\nstep = 5e-3\noutput_step = 5e-3\n";
    let mut simulation = start(text);
    let expected = 7800.0 * 16.0 * 512.0 / (3.0 * 2e11);
    let (mut sum, mut count, mut low, mut high) = (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
    run(&mut simulation, 5e-3, 20.0, |simulation| {
        if simulation.state().time > 16.0 {
            let extension = vector(simulation, "tip.position").norm() - 8.0;
            (low, high) = (low.min(extension), high.max(extension));
            sum += extension;
            count += 1.0;
        }
    });
    let mean = sum / count;
    println!("extension {mean:.4e} m, between {low:.4e} and {high:.4e}, true {expected:.4e}");
    // Quadratic strain over 4 elements: some 1e-3; the smooth run-up leaves little vibration.
    assert!((mean / expected - 1.0).abs() < 2e-3, "{mean:e}");
    assert!((high - low) < 0.02 * expected, "{:e}", high - low);
}
