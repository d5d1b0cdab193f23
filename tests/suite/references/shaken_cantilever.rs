//! A cantilever shaken by a moving frame: by expressions of time, and by a host that gives the pose. What a host sets
//! is reached at the end of the communication step: at the ends of steps both machines are held at the same places, so
//! that only the shape of the motion in between, which no internal step sees if steps are the same, could differ.

use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

/// Angle about z and place along y, in time.
fn angle(time: f64) -> f64 {
    0.3 * (4.0 * time).sin()
}
fn place(time: f64) -> f64 {
    0.05 * (7.0 * time).sin()
}

const REST: &str = r#"
format = 1
[model]
name = "Shaken"
gravity = [0, 0, -9.81]
[material.resin]
young = 2e9
poisson = 0.3
density = 1500
damping = 5e-4
[section.flat]
shape = "rectangle"
width = 0.02
height = 0.01
[beam.arm]
material = "resin"
section = "flat"
from = [0, 0, 0]
to = [0.5, 0, 0]
elements = 4
[joint.root]
type = "weld"
a = "hand"
b = "arm.start"
[output.tip]
at = "arm.end"
quantities = ["position", "velocity", "rotation"]
[output.at_hand]
at = "hand"
quantities = ["position", "velocity", "acceleration", "rotation", "angular_velocity", "reaction_force", "reaction_moment"]
[output.at_root]
at = "root"
quantities = ["reaction_force", "reaction_moment"]
[simulation]
initial = "equilibrium"
stop = 1.0
step = 1e-3
"#;

fn expressions() -> String {
    let frame = "[frame.hand]\nposition = [0, \"0.05*sin(7*t)\", 0]\nrotation = [0, 0, \"0.3*sin(4*t)\"]\n";
    format!("{REST}{frame}")
}

fn hosted() -> String {
    format!("{REST}[frame.hand]\nposition = [0, 0, 0]\ninput = true\n")
}

fn by_expressions() -> Simulation {
    start(&expressions())
}

fn by_host() -> Simulation {
    start(&hosted())
}

fn start(text: &str) -> Simulation {
    let mut simulation =
        Simulation::load("model.toml", text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation
}

fn reference(simulation: &Simulation, name: &str) -> usize {
    simulation.variables().iter().position(|variable| variable.name == name).unwrap_or_else(|| panic!("{name}"))
}

fn value(simulation: &Simulation, name: &str) -> f64 {
    simulation.value(reference(simulation, name)).number()
}

fn vector(simulation: &Simulation, name: &str) -> [f64; 3] {
    [1, 2, 3].map(|i| value(simulation, &format!("{name}[{i}]")))
}

/// Sets the pose of `time`; the quaternion need not be of length 1.
fn set_pose(simulation: &mut Simulation, time: f64) {
    let half = 0.5 * angle(time);
    let pairs = [
        ("hand.position[2]", place(time)),
        ("hand.quaternion[1]", 3.0 * half.cos()),
        ("hand.quaternion[4]", 3.0 * half.sin()),
    ];
    for (name, number) in pairs {
        simulation.set_value(reference(simulation, name), Value::Real(number)).unwrap();
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// With the same steps outside and inside, the host's machine goes through the same places: to round-off. Without the
/// numerical dissipation, which begins with the strain rates of the start, and these with a velocity of the frame that
/// the host does not give.
#[test]
fn expression_and_host_agree() {
    let still = |text: String| start(&text.replace("step = 1e-3", "step = 1e-3\nspectral_radius = 1"));
    let (mut first, mut second) = (still(expressions()), still(hosted()));
    let mut largest = 0.0_f64;
    for number in 1..=500 {
        let time = 1e-3 * f64::from(number);
        set_pose(&mut second, time);
        first.advance(time).unwrap();
        second.advance(time).unwrap();
        for name in ["tip.position", "tip.rotation", "at_hand.position", "at_hand.rotation"] {
            largest = largest.max(difference(vector(&first, name), vector(&second, name)));
        }
    }
    println!("largest difference {largest:.1e} m, rad");
    assert!(largest < 1e-9, "{largest}");
    assert!(difference(vector(&first, "at_hand.rotation"), [0.0, 0.0, angle(0.5)]) < 1e-12);
    // The sway of the tip against the hand is no rounding.
    let sway = value(&first, "tip.position[2]") - place(0.5) - 0.5 * angle(0.5).sin();
    assert!(sway.abs() > 1e-3, "{sway}");
}

/// A host that sets the value at the beginning of its step and the derivative is off by the curvature of the motion:
/// order 2 in its step.
#[test]
fn values_with_derivatives_converge_with_order_two() {
    // All communication steps are whole numbers of internal steps: the error of these is the same on both sides.
    let quick = |simulation: &mut Simulation| {
        let step = reference(simulation, "simulation.step");
        simulation.set_value(step, Value::Real(2.5e-4)).unwrap();
        simulation.initialize(0.0).unwrap();
    };
    let mut exact = by_expressions();
    quick(&mut exact);
    let mut expected = Vec::new();
    for number in 1..=20 {
        exact.advance(0.02 * f64::from(number)).unwrap();
        expected.push(vector(&exact, "tip.position"));
    }
    // Largest at 20 times: at a single one the swinging tip may be right by chance.
    let error = |parts: u32| {
        let mut simulation = by_host();
        quick(&mut simulation);
        let step = 0.02 / f64::from(parts);
        let mut largest = 0.0_f64;
        for number in 0..20 * parts {
            let time = f64::from(number) * step;
            set_pose(&mut simulation, time);
            let (half, rate) = (0.5 * angle(time), 0.6 * (4.0 * time).cos());
            for (name, slope) in [
                ("hand.position[2]", 0.35 * (7.0 * time).cos()),
                ("hand.quaternion[1]", -3.0 * half.sin() * rate),
                ("hand.quaternion[4]", 3.0 * half.cos() * rate),
            ] {
                let reference = reference(&simulation, name);
                simulation.set_input_derivative(reference, slope);
            }
            simulation.advance(f64::from(number + 1) * step).unwrap();
            if (number + 1) % parts == 0 {
                let place = vector(&simulation, "tip.position");
                largest = largest.max(difference(place, expected[(number / parts) as usize]));
            }
        }
        largest
    };
    let errors = [error(2), error(4), error(8)];

    let orders = [(errors[0] / errors[1]).log2(), (errors[1] / errors[2]).log2()];
    println!("errors {errors:?} m, orders {orders:?}");
    assert!(orders.iter().all(|order| (1.7..2.6).contains(order)), "{orders:?}");
}

/// What the frame must supply is what the joint to it transmits; the frame's motion is that of its expressions.
#[test]
fn the_frame_supplies_the_reaction_of_its_joint() {
    let mut simulation = by_expressions();
    for number in 1..=100 {
        let time = 5e-3 * f64::from(number);
        simulation.advance(time).unwrap();
        for quantity in ["reaction_force", "reaction_moment"] {
            let supply = vector(&simulation, &format!("at_hand.{quantity}"));
            let reaction = vector(&simulation, &format!("at_root.{quantity}"));
            assert!(difference(supply, reaction) < 1e-9, "{quantity} at {time}: {supply:?} {reaction:?}");
        }
        let rate = 1.2 * (4.0 * time).cos();
        assert!(difference(vector(&simulation, "at_hand.velocity"), [0.0, 0.35 * (7.0 * time).cos(), 0.0]) < 1e-12);
        assert!(difference(vector(&simulation, "at_hand.acceleration"), [0.0, -49.0 * place(time), 0.0]) < 1e-12);
        assert!(difference(vector(&simulation, "at_hand.angular_velocity"), [0.0, 0.0, rate]) < 1e-12);
    }
    let weight = 1500.0 * 0.02 * 0.01 * 0.5 * 9.81;
    let mut still = by_host();
    still.advance(0.01).unwrap();
    // At rest the frame carries the weight.
    assert!((value(&still, "at_hand.reaction_force[3]") - weight).abs() < 1e-6 * weight);
}

/// A quaternion of length 0 says nothing of the orientation: the frame keeps the one it has, at the start the one that
/// is drawn, and the log says so once. Masters set all inputs to 0 at the start.
#[test]
fn regression_a_quaternion_without_length_changes_nothing() {
    let (mut zero, mut kept) = (by_host(), by_host());
    let quaternion = [1, 2, 3, 4].map(|k| reference(&zero, &format!("hand.quaternion[{k}]")));
    let turned = [1.0, 0.0, 0.0, 2e-3];
    for simulation in [&mut zero, &mut kept] {
        for (at, part) in quaternion.into_iter().zip(turned) {
            simulation.set_value(at, Value::Real(part)).unwrap();
        }
        simulation.advance(1e-3).unwrap();
        assert_eq!(simulation.take_warnings(), [""; 0]);
    }
    quaternion.into_iter().for_each(|at| zero.set_value(at, Value::Real(0.0)).unwrap());
    for time in [2e-3, 3e-3] {
        [&mut zero, &mut kept].into_iter().for_each(|simulation| simulation.advance(time).unwrap());
        for (zero, kept) in vector(&zero, "at_hand.rotation").into_iter().zip(vector(&kept, "at_hand.rotation")) {
            assert!((zero - kept).abs() < 1e-15, "{zero} {kept}");
        }
    }
    let warnings = zero.take_warnings();
    let [warning] = &warnings[..] else { panic!("one warning: {warnings:?}") };
    assert!(warning.starts_with("the quaternion of frame hand is 0"), "{warning}");
    let (output, input) = (reference(&zero, "tip.position[2]"), quaternion[3]);
    // The differences are of equal numbers: round-off of 0.5 m over 1e-3.
    assert!(zero.partial_derivative(output, input).unwrap().abs() < 1e-12);

    let drawn = format!("{REST}[frame.hand]\nposition = [0, 0, 0]\nrotation = [0, 0, 0.5]\ninput = true\n");
    let drawn = format!("{drawn}[output.turned]\nat = \"hand\"\nquantities = [\"quaternion\"]\n");
    let mut simulation = Simulation::load("model.toml", &drawn, &[]).unwrap();
    for k in 1..=4 {
        let at = reference(&simulation, &format!("hand.quaternion[{k}]"));
        simulation.set_value(at, Value::Real(0.0)).unwrap();
    }
    simulation.initialize(0.0).unwrap();
    assert_eq!(simulation.take_warnings().len(), 1);
    assert!((value(&simulation, "turned.quaternion[4]") - 0.25_f64.sin()).abs() < 1e-15);
    simulation.advance(1e-3).unwrap();
    assert!((value(&simulation, "turned.quaternion[4]") - 0.25_f64.sin()).abs() < 1e-15);
}

/// A rotation vector is an orientation like any other: the same motion as by quaternions, with the same velocities that
/// a host gives at the start, and derivatives that are those of the vector.
#[test]
fn rotation_vectors_are_inputs_too() {
    let by_vector = format!("{REST}[frame.hand]\nposition = [0, 0, 0]\ninput = \"rotation\"\n");
    let mut simulation = start(&by_vector);
    let mut expected = by_host();
    let inputs = ["hand.position", "hand.rotation"].map(|name| [1, 2, 3].map(|k| format!("{name}[{k}]")));
    for name in inputs.iter().flatten() {
        assert_eq!(value(&simulation, name), 0.0, "a master may start all of them at 0");
    }
    let vector_at = |time: f64| [0.2 * angle(time), 0.1 * time, angle(time)];
    for step in 1..=50 {
        let time = 1e-3 * f64::from(step);
        let [x, y, z] = vector_at(time);
        let length = (x * x + y * y + z * z).sqrt();
        let part = (0.5 * length).sin() / length;
        for (name, number) in inputs[1].iter().zip([x, y, z]) {
            let at = reference(&simulation, name);
            simulation.set_value(at, Value::Real(number)).unwrap();
        }
        for (k, number) in [(0.5 * length).cos(), part * x, part * y, part * z].into_iter().enumerate() {
            let at = reference(&expected, &format!("hand.quaternion[{}]", k + 1));
            expected.set_value(at, Value::Real(number)).unwrap();
        }
        if step == 1 {
            // The velocity of the start, which the target follows to the end of the step.
            let rate = [0.24, 0.1, 1.2];
            for (k, rate) in rate.into_iter().enumerate() {
                let at = reference(&simulation, &inputs[1][k]);
                simulation.set_value(at, Value::Real(0.0)).unwrap();
                simulation.set_input_derivative(at, rate);
                let at = reference(&expected, &format!("hand.quaternion[{}]", k + 2));
                expected.set_value(at, Value::Real(0.0)).unwrap();
                expected.set_input_derivative(at, 0.5 * rate);
            }
            expected.set_value(reference(&expected, "hand.quaternion[1]"), Value::Real(1.0)).unwrap();
        }
        simulation.advance(time).unwrap();
        expected.advance(time).unwrap();
        for name in ["tip.position", "tip.velocity"] {
            // A quaternion of 1 and half the rate times the step is off by the step's angle cubed, 1e-9 over 1e-3 s.
            assert!(difference(vector(&simulation, name), vector(&expected, name)) < 1e-6, "{name} at {time}");
        }
    }
    let (output, input) = (reference(&simulation, "tip.position[2]"), reference(&simulation, "hand.rotation[3]"));
    let before = simulation.snapshot();
    let now = simulation.value(input).number();
    let mut with = |change: f64| {
        simulation.restore(&before);
        simulation.set_value(input, Value::Real(now + change)).unwrap();
        simulation.advance(0.051).unwrap();
        (value(&simulation, "tip.position[2]"), simulation.partial_derivative(output, input).unwrap())
    };
    let [(low, _), (_, derivative), (high, _)] = [-1e-3, 0.0, 1e-3].map(&mut with);
    // Central differences over 1e-3 rad leave 1e-6 of a motion that turns.
    let difference = (high - low) / 2e-3;
    assert!(
        derivative.abs() > 1e-4 && (derivative - difference).abs() < 1e-5 * derivative.abs(),
        "{derivative} {difference}"
    );
}
