//! Do efforts that follow coordinates of joints act as controllers do? Gains must be those of springs and dampers,
//! exactly and in the tangent; couplings between joints, times and pieces must enter; what reads nothing must stay as
//! it is.

use crate::curves::{Curves, load};
use crate::running::{start, try_start, value};
use ancf14::fmi::Model;

/// A double pendulum with a slider on its end.
fn machine(parts: &str, simulation: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Machine"
gravity = [0, 0, -9.81]
[body.upper]
mass = 2
position = [0.5, 0, 0]
inertia = [0.02, 0.1, 0.1]
[body.lower]
mass = 1
position = [1.5, 0, 0]
inertia = [0.01, 0.05, 0.05]
[body.slider]
mass = 0.3
position = [2, 0, 0]
inertia = [1e-3, 1e-3, 1e-3]
[joint.shoulder]
type = "revolute"
a = "ground"
b = "upper"
at = [0, 0, 0]
axis = [0, 1, 0]
[joint.elbow]
type = "revolute"
a = "upper"
b = "lower"
at = [1, 0, 0]
axis = [0, 1, 0]
[joint.rail]
type = "prismatic"
a = "lower"
b = "slider"
axis = [1, 0, 0]
{parts}
[output.S]
at = "shoulder"
quantities = ["angle", "angle_rate", "reaction_moment"]
[output.E]
at = "elbow"
quantities = ["angle"]
[output.R]
at = "rail"
quantities = ["distance", "distance_rate"]
[simulation]
stop = 1
output_step = 0.05
{simulation}
"#
    )
}

const SPRINGS: &str = r#"
[spring.s]
joint = "shoulder"
coordinate = "angle"
stiffness = 60
damping = 3
[spring.e]
joint = "elbow"
coordinate = "angle"
force = "20*x + 5*x^3 + v"
[spring.r]
joint = "rail"
coordinate = "distance"
stiffness = 400
damping = 2
"#;

const GAINS: &str = r#"
[actuator.s]
joint = "shoulder"
coordinate = "angle"
effort = "-60*shoulder.angle - 3*shoulder.angle_rate"
[actuator.e]
joint = "elbow"
coordinate = "angle"
effort = "-20*elbow.angle - 5*elbow.angle^3 - elbow.angle_rate"
[actuator.r]
joint = "rail"
coordinate = "distance"
effort = "-400*rail.distance - 2*rail.distance_rate"
"#;

/// Gains on a joint's own coordinate are a spring and a damper: the same motion with each integrator, to the error of
/// its steps, which take the forces of springs at other instants; the same equilibrium and natural frequencies to
/// round-off.
#[test]
fn gains_are_springs_and_dampers() {
    for (steps, tolerance) in [
        ("step = 5e-4\nspectral_radius = 1", 2e-6),
        ("step = 5e-4", 2e-6),
        ("accuracy = 1e-5", 1e-4),
        ("integrator = \"generalized_alpha\"\nstep = 5e-4", 1e-9),
        ("analysis = \"static\"\nstep = 1", 1e-12),
    ] {
        let [springs, gains] = [SPRINGS, GAINS].map(|parts| Curves::run(&machine(parts, steps), &[]));
        for name in ["S.angle", "E.angle", "R.distance"] {
            let [springs, gains] = [&springs, &gains].map(|curves| curves.column(name));
            let most = springs.iter().zip(&gains).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(most < tolerance, "{steps}: {name} differs by {most}");
        }
    }
    let modes = |parts: &str| {
        let simulation = start(&machine(parts, "step = 1e-3"));
        let found = simulation.modes(3).unwrap_or_else(|failure| panic!("{}", failure.message));
        found.modes.iter().map(|mode| mode.eigenvalue).collect::<Vec<_>>()
    };
    let [springs, gains] = [SPRINGS, GAINS].map(modes);
    assert!(
        springs.len() == 3 && springs.iter().zip(&gains).all(|(a, b)| (a - b).abs() < 1e-9 * a),
        "{springs:?} {gains:?}"
    );
}

/// Couplings to other joints, with time and pieces: the tangent is exact where Newton converges quadratically, so that
/// stiff gains take no more iterations than springs, and no step is rejected.
#[test]
fn couplings_are_in_the_tangent() {
    let coupled = r#"
[actuator.s]
joint = "shoulder"
coordinate = "angle"
effort = "-3000*(shoulder.angle - 0.3*sin(3*t)) - 80*shoulder.angle_rate + 200*elbow.angle + 3*rail.distance_rate"
[actuator.e]
joint = "elbow"
coordinate = "angle"
effort = [{ until = 0.5, is = "-900*elbow.angle - 20*elbow.angle_rate + 500*shoulder.angle" }, { is = "-900*elbow.angle - 20*elbow.angle_rate" }]
[actuator.r]
joint = "rail"
coordinate = "distance"
effort = "-2000*(rail.distance - 0.2*shoulder.angle) - 30*rail.distance_rate - 10*elbow.angle*shoulder.angle_rate"
"#;
    for (steps, most) in [
        ("step = 2e-3\ntolerance = 1e-12", 1.6),
        ("integrator = \"generalized_alpha\"\nstep = 2e-3\ntolerance = 1e-12", 3.05),
    ] {
        let curves = Curves::run(&machine(coupled, steps), &[]);
        let [steps_taken, iterations, rejected] =
            ["statistics.steps", "statistics.iterations", "statistics.rejected"].map(|name| curves.last(name));
        // Measured: 1.49 and 3.00 iterations a step. A tangent without a coupling converges linearly, with more.
        assert!(
            rejected == 0.0 && iterations < most * steps_taken,
            "{steps}: {iterations} iterations, {rejected} rejected"
        );
    }
    // Order 2 of the whole loop.
    let end =
        |step: &str| Curves::run(&machine(coupled, "step = 0.01"), &[("simulation.step", step)]).last("R.distance");
    let reference = end("0.00025");
    let [coarse, fine] = ["0.004", "0.002"].map(|step| (end(step) - reference).abs());
    assert!((1.7..2.4).contains(&(coarse / fine).log2()), "{coarse} {fine}");
}

/// The work of a controller closes the account, its effort and power are what it says, and a follower of another joint
/// keeps it in a gear's proportion at equilibrium.
#[test]
fn efforts_are_told_and_accounted_for() {
    let parts = "[actuator.s]\njoint = \"shoulder\"\ncoordinate = \"angle\"\neffort = \"-60*shoulder.angle - 3*shoulder.angle_rate + t\"\n\
                 [output.A]\nat = \"s\"\nquantities = [\"effort\", \"power\"]\n";
    let curves = Curves::run(&machine(parts, "step = 1e-3\ntotals = [\"energy\", \"work\"]"), &[]);
    let last = curves.time.len() - 1;
    let [angle, rate, effort, power] =
        ["S.angle", "S.angle_rate", "A.effort", "A.power"].map(|name| curves.column(name));
    for row in 0..=last {
        let wanted = -60.0 * angle[row] - 3.0 * rate[row] + curves.time[row];
        assert!((effort[row] - wanted).abs() < 1e-10, "{} {wanted}", effort[row]);
        assert!((power[row] - effort[row] * rate[row]).abs() < 1e-10);
    }
    let [total, work, drift] = ["energy.total", "work.actuators", "work.drift"].map(|name| curves.column(name));
    assert!((total[last] - total[0] - work[last] - drift[last]).abs() < 1e-10);
    assert!(drift[last].abs() < 1e-3 * work[last].abs(), "{} {}", drift[last], work[last]);
    // The integral of the power, by the trapezoidal rule over rows of 50 ms: half a percent.
    let integral: f64 = (1..=last).map(|row| 0.025 * (power[row] + power[row - 1])).sum();
    assert!((integral - work[last]).abs() < 0.02 * work[last].abs(), "{integral} {}", work[last]);
}

/// In copies a coordinate is that of the same copy, and parameters in the gains are tunable.
#[test]
fn copies_have_their_own_loops() {
    let text = r#"format = 1
[model]
name = "Pair"
[parameters]
gain = 50
[copy.arms]
count = 2
[copy.arms.body.arm]
mass = 1
position = ["0.5", "k", 0]
inertia = [0.01, 0.02, 0.02]
angular_velocity = [0, 0, "k"]
[copy.arms.joint.hinge]
type = "revolute"
a = "ground"
b = "arm"
at = [0, "k", 0]
axis = [0, 0, 1]
[copy.arms.actuator.motor]
joint = "hinge"
coordinate = "angle"
effort = "-gain*k*hinge.angle"
[output.first]
at = "hinge_1"
quantities = ["angle"]
[output.second]
at = "hinge_2"
quantities = ["angle"]
[simulation]
stop = 1
step = 1e-3
output_step = 0.1
"#;
    let curves = Curves::run(text, &[]);
    for (name, number) in [("first.angle", 1.0_f64), ("second.angle", 2.0)] {
        // About the hinge: 0.02 + 0.25 kg m²; the rate as given, which the hinge makes that of the body about it.
        let frequency = (50.0 * number / 0.27).sqrt();
        let angle = curves.column(name);
        let amplitude = angle.iter().fold(0.0_f64, |most, angle| most.max(angle.abs()));
        let phase = |row: usize| (frequency * curves.time[row]).sin();
        let scale = angle[1] / phase(1);
        assert!(amplitude > 1e-3);
        for (row, angle) in angle.iter().enumerate() {
            // (ω h)³/12 of a phase of up to 20 rad.
            assert!((angle - scale * phase(row)).abs() < 2e-3 * scale.abs(), "{name}, row {row}: {angle}");
        }
    }
    let mut simulation = load(text, &[]);
    let place = simulation.variables().iter().position(|variable| variable.name == "gain").expect("a parameter");
    simulation.advance(0.1).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.set_value(place, ancf14::fmi::Value::Real(0.0)).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.advance(0.2).unwrap_or_else(|failure| panic!("{}", failure.message));
    let [before, after] = [0.3, 0.4].map(|end| {
        simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
        value(&simulation, "first.angle")
    });
    assert!((after - 2.0 * before + value(&load(text, &[]), "first.angle")).is_finite() && before != after);
}

/// A drive cannot follow another coordinate, and neither can a load: that is told, not ignored.
#[test]
fn drives_and_loads_do_not_follow() {
    for parts in [
        "[drive.d]\njoint = \"rail\"\ncoordinate = \"distance\"\nvalue = \"0.1*elbow.angle\"\n",
        "[load.l]\nat = \"slider\"\nforce = [0, 0, \"-elbow.angle_rate\"]\n",
    ] {
        let message = try_start(&machine(parts, "step = 1e-3")).expect_err("a mistake");
        assert!(message.contains("is not known here") && message.contains("[gear]"), "{message}");
    }
}

/// The example of docs/language/drives.md: the pole, which falls by itself, stands again after two seconds.
#[test]
fn the_example_of_the_page_balances() {
    let page = include_str!("../../../docs/language/drives.md");
    let text = page.split("```toml\n").find(|text| text.contains("name = \"CartPole\"")).expect("the example");
    let text = text.split("```").next().expect("its end");
    let balanced = Curves::run(text, &[]).column("upright.angle");
    let fallen = Curves::run(text, &[("motor.effort", "0")]).column("upright.angle");
    assert!(balanced.iter().all(|angle| angle.abs() < 0.1) && balanced[100].abs() < 2e-3, "{balanced:?}");
    assert!(fallen.iter().any(|angle| angle.abs() > 0.3), "{fallen:?}");
}
