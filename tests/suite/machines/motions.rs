//! Machines that move: kinematics, momentum, controllers and laws against closed forms.

use super::{check, column, last, machine, machine_with, results};
use std::f64::consts::{PI, TAU};

const CARDAN_SHAFT: &str = include_str!("../../machines/cardan_shaft.toml");
const DRILL_STRING: &str = include_str!("../../machines/drill_string.toml");
const FISHING_ROD: &str = include_str!("../../machines/fishing_rod.toml");
const GUIDE_WIRE: &str = include_str!("../../machines/guide_wire.toml");
const ROBOT: &str = include_str!("../../machines/robot.toml");
const SATELLITE: &str = include_str!("../../machines/satellite.toml");
const SLACK_CABLE: &str = include_str!("../../machines/slack_cable.toml");
const TOP: &str = include_str!("../../machines/spinning_top.toml");

/// `tan(out) = tan(in)/cos β` or `tan(in) cos β` by how the cross is drawn: its axis in the input shaft is z, across
/// the plane of the shafts, so that the output first lags: `tan(out) = cos β tan(in)`.
#[test]
fn cardan_shaft_turns_as_the_formula_says() {
    let results = results(CARDAN_SHAFT, &[]);
    let (input, output) = (column(&results, "input.angle"), column(&results, "output.angle"));
    let beta = PI / 6.0;
    let mut worst = 0.0_f64;
    for (input, output) in input.iter().zip(output) {
        let turns = (input / PI).round() * PI;
        let expected = turns + ((input - turns).tan() / beta.cos()).atan();
        let other = turns + ((input - turns).tan() * beta.cos()).atan();
        worst = worst.max((output - expected).abs().min((output - other).abs()));
    }
    println!("angle behind the joint: {worst:.2e} rad from the formula");
    // The flywheel winds the shafts up by J·acceleration·L/(GJ): 0.005·(20²·0.3)·0.9/(81e9·8e-8) = 8e-5.
    assert!(worst < 2e-4, "{worst}");
}

/// The bit of a long string sticks and slips: it stands still, then runs at more than twice the speed of the table. Its
/// mean is that of the table. At rest the string hangs from its weight: `(ρ g L²/2 + (M g − 50 kN) L/A)/E`.
#[test]
fn drill_string_stretches_and_sticks_and_slips() {
    let results = results(DRILL_STRING, &[]);
    let area = PI * (0.0635_f64.powi(2) - 0.0543_f64.powi(2));
    let stretch = (7850.0 * 9.81 * 1e6 / 2.0 + (20000.0 * 9.81 - 50e3) * 1e3 / area) / 206e9;
    check("stretch", -column(&results, "end.displacement[3]")[0], stretch, 1e-5);
    let (time, rate) = (results.time(), column(&results, "bit.angle_rate"));
    let late: Vec<f64> = time.iter().zip(rate).filter(|(time, _)| **time > 30.0).map(|(_, rate)| *rate).collect();
    let slowest = late.iter().copied().fold(f64::INFINITY, f64::min);
    let fastest = late.iter().copied().fold(0.0, f64::max);
    println!("speed of the bit: {slowest:.4} to {fastest:.3} rad/s");
    // While it sticks, it creeps by the smooth law: 0.05 rad/s times atanh of the torque over 4500 N m.
    assert!(slowest.abs() < 0.1 && fastest > 2.0 * TAU, "{slowest} to {fastest}");
}

/// At rest the line bears the fish and half of itself; the motion does not depend on the steps.
#[test]
fn fishing_rod_bears_the_fish() {
    let coarse = results(FISHING_ROD, &[]);
    let line = PI * 0.00025_f64.powi(2) * 1140.0;
    // Seen in the middle of the line.
    check("pull at rest", column(&coarse, "pull.section_force[1]")[0], 9.81 * (0.5 + line * 1.5), 1e-3);
    let fine = results(FISHING_ROD, &[("simulation.accuracy", "1e-4")]);
    for name in ["tip.position[1]", "tip.position[3]"] {
        let (coarse, fine) = (column(&coarse, name), column(&fine, name));
        let range =
            fine.iter().copied().fold(f64::NEG_INFINITY, f64::max) - fine.iter().copied().fold(f64::INFINITY, f64::min);
        let apart = coarse.iter().zip(fine).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        println!("{name}: {:.2e} of its range between an accuracy of 1e-3 and 1e-4", apart / range);
        // The accuracy that was asked for.
        assert!(apart < 1e-3 * range, "{name}: {apart} of {range}");
    }
}

/// A host computes the force of a wall, node by node: at the end, at rest, the pusher bears what the walls do.
#[test]
fn guide_wire_is_in_equilibrium_with_the_walls_of_a_host() {
    // Ten times the damping of the file: a bending wave of 2 Hz fades within the second half.
    let mut wire = machine_with(GUIDE_WIRE, &[("nitinol.damping", "0.05")]);
    wire.initialize().unwrap();
    let mut sum = [0.0; 2];
    // A node of 2e-5 kg on the floor's 0.5 N/m vibrates at 158 rad/s: the host looks often enough not to feed it.
    let steps = 4000;
    for step in 1..=steps {
        sum = [0.0; 2];
        for node in 1..=12 {
            let at = |i: usize| wire.value(&format!("node_{node}.position[{i}]")).unwrap();
            // Beyond 0.3 m the floor rises by 1 in 4; it pushes along its normal.
            let below = 0.25 * (at(1) - 0.3) - at(3);
            let force = if at(1) > 0.3 && below > 0.0 { 0.5 * below } else { 0.0 };
            let normal = [-0.25 / 1.0625_f64.sqrt(), 1.0 / 1.0625_f64.sqrt()];
            for (k, component) in [(0, 1), (1, 3)] {
                wire.set(&format!("wall_{node}.force[{component}]"), force * normal[k]).unwrap();
                sum[k] += force * normal[k];
            }
        }
        // 2 s to push, as long again to come to rest.
        wire.advance(f64::from(step) * 1e-3).unwrap();
    }
    let tip = wire.value("node_12.position[3]").unwrap();
    println!("walls push by {sum:?} N, the tip is up by {tip:.4} m");
    assert!(tip > 0.01, "the tip follows the floor: {tip}");
    for (k, component) in [(0, 1), (1, 3)] {
        let found = wire.value(&format!("pusher.reaction_force[{component}]")).unwrap();
        // What still moves: the wire of 3e-4 kg.
        check("reaction", found, -sum[k], 0.02);
    }
}

/// A controller outside holds both links; they sag as cantilevers with the weights that hang on them.
#[test]
fn robot_sags_by_the_bending_of_its_links() {
    let mut robot = machine(ROBOT);
    robot.initialize().unwrap();
    let (gravity, payload) = (9.81, 1.5);
    let per_length = 0.03 * 0.008 * 2700.0;
    let [first, second] = [0.5 * per_length, 0.4 * per_length];
    // The stator's inertia of 1e-3 kg m² lets 2.5 N m s/rad act within 0.4 ms: the controller must be about as fast.
    for step in 1..=6000_u32 {
        let read = |robot: &ancf14::Simulation, name: &str| robot.value(name).unwrap();
        let angle = [read(&robot, "bearing_1.angle"), read(&robot, "bearing_2.angle")];
        let rate = [read(&robot, "bearing_1.angle_rate"), read(&robot, "bearing_2.angle_rate")];
        let outer = (second * 0.2 + payload * 0.4) * gravity;
        let inner = (first * 0.25 + (1.0 + second + payload) * 0.5) * gravity + outer;
        let torque = [inner - 120.0 * angle[0] - 8.0 * rate[0], outer - 40.0 * angle[1] - 2.5 * rate[1]];
        robot.set("motor_1.effort", torque[0]).unwrap();
        robot.set("motor_2.effort", torque[1]).unwrap();
        robot.advance(f64::from(step) * 5e-4).unwrap();
    }
    let bending = 70e9 * 0.03 * 0.008_f64.powi(3) / 12.0;
    // Each link as a cantilever: its own weight, and the force and the moment at its end.
    let end = |length: f64, force: f64, moment: f64| {
        let own = per_length * gravity;
        [
            own * length.powi(4) / 8.0 + force * length.powi(3) / 3.0 + moment * length.powi(2) / 2.0,
            own * length.powi(3) / 6.0 + force * length.powi(2) / 2.0 + moment * length,
        ]
        .map(|value| value / bending)
    };
    let held = (second + payload) * gravity;
    let [sag, slope] = end(0.5, held + 1.0 * gravity, (second * 0.2 + payload * 0.4) * gravity);
    let [outer, _] = end(0.4, payload * gravity, 0.0);
    let angles = [robot.value("bearing_1.angle").unwrap(), robot.value("bearing_2.angle").unwrap()];
    // The controller compensates for rigid links at the level: its angles come to nearly 0, and what is left tilts the
    // arm.
    let tilt = 0.9 * angles[0] + 0.4 * angles[1];
    let found = -robot.value("tool_motion.position[3]").unwrap() + tilt;
    // Second order of the slopes, 0.06²/2.
    check("sag of the tool", found, sag + 0.4 * slope + outer, 0.01);
}

/// The wheels turn the satellite by `∫∫ T/J`; nothing moves its center of mass.
#[test]
fn satellite_turns_by_its_torque_and_keeps_its_momentum() {
    let results = results(SATELLITE, &[]);
    let per_length = 1.9e-3 * 1600.0;
    // Hub and wings about z; the wings as slender bars.
    let inertia = 90.0 + 2.0 * per_length * (6.6_f64.powi(3) - 0.6_f64.powi(3)) / 3.0;
    let angle = last(&results, "attitude.rotation[3]");
    // The wings still swing at the end, by the share of their rigid-body motion that 30 s of damping leave.
    check("slew", angle, 3.0 * 25.0 / inertia, 5e-3);
    for i in 1..=3 {
        let momentum = column(&results, &format!("momentum.linear[{i}]"));
        let largest = momentum.iter().map(|value| value.abs()).fold(0.0, f64::max);
        // 400 kg that round-off moves.
        assert!(largest < 1e-9, "momentum {largest} along {i}");
    }
}

/// The catenary of a chain of 24 m over 20 m: `2 a sinh(10/a) = 24`, `H = μ g a`, sag `a (cosh(10/a) − 1)`; the wire's
/// `EI` and give are of the order of 1e-3.
#[test]
fn slack_cable_hangs_as_a_catenary() {
    let mut cable = machine_with(SLACK_CABLE, &[]);
    cable.initialize().unwrap();
    let mut a: f64 = 9.0;
    for _ in 0..50 {
        let x = 10.0 / a;
        a -= (2.0 * a * x.sinh() - 24.0) / (2.0 * (x.sinh() - x * x.cosh()));
    }
    let weight = 5000.0 * PI * 1e-4 * 9.81;
    check("horizontal force", cable.value("hanger_load.reaction_force[1]").unwrap().abs(), weight * a, 2e-3);
    check("sag", -cable.value("middle.position[3]").unwrap(), a * ((10.0 / a).cosh() - 1.0), 2e-3);
}

/// A fast top precesses by `m g l/(I_3 w)` to first order; exactly, by the smaller root of
/// `I_1 W² cos θ − I_3 w W + m g l = 0`, about which it nutates when let go at rest.
#[test]
fn top_precesses_slowly() {
    let results = results(TOP, &[]);
    let (x, y) = (column(&results, "motion.position[1]"), column(&results, "motion.position[2]"));
    let mut turned = 0.0;
    for k in 1..x.len() {
        turned += (x[k - 1] * y[k] - y[k - 1] * x[k]).atan2(x[k - 1] * x[k] + y[k - 1] * y[k]);
    }
    let rate = turned / results.time().last().unwrap();
    let (gravity, spin) = (0.2 * 9.81 * 0.05, 1.6e-4 * 300.0);
    // Let go at rest it falls into cycloids, whose mean differs by the square of gravity·I_1/(I_3 w)², 2 %.
    check("precession", rate, gravity / spin, 0.02);
}
