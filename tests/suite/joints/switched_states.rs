//! Do saved states and derivatives of communication steps know what switches have changed? Whoever goes back finds what
//! was engaged and where it holds; derivatives of a step in which something engages follow the motion behind it, and
//! what it holds.

use crate::curves::{Curves, load};
use crate::running::run;
use ancf14::fmi::Model;

/// A beam with a body at its end that a latch lets go, a wheel on the body with a brake, and a dock that takes hold of
/// the body in flight: all of it switches between 0.1 s and 0.3 s.
const EVERYTHING: &str = r#"format = 1
[model]
name = "Everything"
gravity = [0, 0, -9.81]
[material.plastic]
young = 2e9
poisson = 0.4
density = 1200
damping = 1e-3
[section.bar]
shape = "rectangle"
width = 0.02
height = 0.01
[beam.arm]
material = "plastic"
section = "bar"
from = [0, 0, 0]
to = [0.5, 0, 0]
elements = 3
[body.bob]
mass = 0.2
position = [0.55, 0, 0]
inertia = [4e-4, 4e-4, 4e-4]
[body.wheel]
mass = 0.1
position = [0.55, 0.05, 0]
inertia = [1e-4, 2e-4, 1e-4]
angular_velocity = [0, 30, 0]
[body.net]
mass = 0.5
position = [0.7, 0, -0.3]
inertia = [1e-3, 1e-3, 2e-3]
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[joint.latch]
type = "weld"
a = "arm.end"
b = "bob"
at = [0.5, 0, 0]
active = "t < 0.1234"
[joint.axle]
type = "revolute"
a = "bob"
b = "wheel"
axis = [0, 1, 0]
[lock.brake]
joint = "axle"
coordinate = "angle"
active = "t >= 0.155 and t < 0.23"
[joint.dock]
type = "revolute"
a = "net"
b = "bob"
axis = [0, 0, 1]
active = "t >= 0.2"
[drive.turner]
joint = "dock"
coordinate = "angle"
rate = "2 + t"
[load.push]
at = "bob"
force = [0, 0, 0.3]
moment = [0, 0.01, 0]
input = true
[output.B]
at = "bob"
quantities = ["position", "velocity", "angular_velocity", "acceleration"]
[output.N]
at = "net"
quantities = ["position", "quaternion", "velocity"]
[output.A]
at = "axle"
quantities = ["angle", "angle_rate", "reaction_moment"]
[output.D]
at = "dock"
quantities = ["angle", "angle_rate", "reaction_force"]
[output.K]
at = "brake"
quantities = ["effort"]
[simulation]
stop = 0.3
step = 2e-3
output_step = 0.02
tolerance = 1e-12
totals = ["energy", "work", "momentum", "statistics"]
"#;

/// The same bits behind a saved state, through bytes, wherever it was taken: before switches change, between them,
/// behind them.
#[test]
fn saved_states_know_the_switches() {
    let chosen = EVERYTHING.replace("step = 2e-3\noutput_step", "output_step");
    let alpha = EVERYTHING.replace("[simulation]\n", "[simulation]\nintegrator = \"generalized_alpha\"\n");
    for text in [EVERYTHING, &chosen, &alpha] {
        let mut simulation = load(text, &[]);
        let bits = |simulation: &ancf14::model::simulation::Simulation| {
            let all = 0..simulation.variables().len();
            all.map(|reference| simulation.value(reference).number().to_bits()).collect::<Vec<_>>()
        };
        let mut rows = Vec::new();
        let mut snapshots = vec![simulation.snapshot()];
        run(&mut simulation, 0.02, 0.3, |now| {
            rows.push(bits(now));
            snapshots.push(now.snapshot());
        });
        for first in [3, 6, 7, 8, 10, 12, 14] {
            let mut other = load(text, &[]);
            let bytes = simulation.write(&snapshots[first], Vec::new());
            let read = other.read(&bytes).unwrap_or_else(|failure| panic!("{}", failure.message));
            other.restore(&read);
            simulation.restore(&snapshots[first]);
            for (number, row) in rows.iter().enumerate().skip(first) {
                let end = f64::from(number as u32 + 1) * 0.02;
                for own in [&mut simulation, &mut other] {
                    own.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
                    assert_eq!(bits(own), *row, "from {first}, row {number}");
                }
            }
        }
    }
}

/// Derivatives of a communication step over which switches change: those of the motion behind them, with what they
/// hold. Compared with differences of repeated steps.
#[test]
fn derivatives_pass_switches() {
    for integrator in ["conserving", "generalized_alpha"] {
        let mut simulation = load(EVERYTHING, &[("simulation.integrator", integrator)]);
        let inputs = ["push.force[3]", "push.moment[2]"]
            .map(|name| simulation.variables().iter().position(|variable| variable.name == name).expect("an input"));
        let outputs: Vec<usize> = (0..simulation.variables().len())
            .filter(|place| {
                ["B.", "N.", "A.", "D.", "K."].iter().any(|own| simulation.variables()[*place].name.starts_with(own))
            })
            .collect();
        // The latch, the brake, the dock with its drive, the brake again; all of them.
        for [begin, end] in [[0.11, 0.13], [0.15, 0.16], [0.195, 0.205], [0.225, 0.24], [0.12, 0.24]] {
            simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message));
            simulation.advance(begin).unwrap_or_else(|failure| panic!("{}", failure.message));
            let start = simulation.snapshot();
            let mut at = |place: usize, by: f64| {
                simulation.restore(&start);
                let own = simulation.value(place).number();
                simulation
                    .set_value(place, ancf14::fmi::Value::Real(own + by))
                    .unwrap_or_else(|failure| panic!("{}", failure.message));
                simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
                let values: Vec<f64> = outputs.iter().map(|output| simulation.value(*output).number()).collect();
                let derivatives = if by == 0.0 {
                    outputs.iter().map(|output| simulation.partial_derivative_of(*output, place)).collect()
                } else {
                    Vec::new()
                };
                (values, derivatives)
            };
            for place in &inputs {
                let by = 1e-3;
                let (after, _) = at(*place, by);
                let (before, _) = at(*place, -by);
                let (_, derivatives) = at(*place, 0.0);
                let largest = derivatives.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
                for (number, derivative) in derivatives.iter().enumerate() {
                    let difference = (after[number] - before[number]) / (2.0 * by);
                    // Differences of second order, and round-off of 1e-12 of the values over the change.
                    let tolerance = 2e-4 * difference.abs() + 1e-6 * largest;
                    assert!(
                        (derivative - difference).abs() < tolerance,
                        "{integrator}, {begin} to {end}: output {number} by input {place}: {derivative} {difference}"
                    );
                }
            }
        }
    }
}

trait Derivative {
    fn partial_derivative_of(&mut self, output: usize, input: usize) -> f64;
}

impl Derivative for ancf14::model::simulation::Simulation {
    fn partial_derivative_of(&mut self, output: usize, input: usize) -> f64 {
        Model::partial_derivative(self, output, input).unwrap_or_else(|failure| panic!("{}", failure.message))
    }
}

/// A statics analysis: a prop carries the arm until it is taken away; the spring behind it takes over. A lock holds
/// what the arm has then.
#[test]
fn equilibria_switch_too() {
    let text = r#"format = 1
[model]
name = "Prop"
gravity = [0, 0, -9.81]
[body.arm]
mass = 1
position = [0.5, 0, 0]
inertia = [0.01, 0.02, 0.02]
[joint.hinge]
type = "revolute"
a = "ground"
b = "arm"
at = [0, 0, 0]
axis = [0, 1, 0]
[spring.law]
joint = "hinge"
coordinate = "angle"
stiffness = 20
[load.push]
at = "arm"
force = [0, 0, "-10*t"]
[lock.prop]
joint = "hinge"
coordinate = "angle"
active = "t < 0.5 or t >= 0.75"
[output.H]
at = "hinge"
quantities = ["angle"]
[output.P]
at = "prop"
quantities = ["effort"]
[simulation]
analysis = "static"
stop = 1
step = 0.125
output_step = 0.125
"#;
    let curves = Curves::run(text, &[]);
    let [angle, effort] = ["H.angle", "P.effort"].map(|name| curves.column(name));
    assert!(angle[..4].iter().all(|angle| angle.abs() < 1e-12), "{angle:?}");
    assert!((effort[2] + 0.5 * (9.81 + 2.5)).abs() < 1e-9, "{effort:?}");
    for row in [4, 5] {
        let force = 9.81 + 1.25 * row as f64;
        assert!((20.0 * angle[row] - 0.5 * force * angle[row].cos()).abs() < 1e-8, "{angle:?}");
        assert!(effort[row] == 0.0);
    }
    assert!(angle[6..].iter().all(|own| (own - angle[5]).abs() < 1e-12), "{angle:?}");
}
