//! Derivatives of a communication step: by the host's inputs against differences through repeated steps, by time
//! against differences between steps.

use crate::curves::load;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

/// Everything that a host can give: a frame, an angle, a rate, a distance, loads at a point, along a beam, on a body,
/// dead and following, an effort between two points; and of everything that can be measured something.
pub const MACHINE: &str = r#"
format = 1
[model]
name = "Everything"
gravity = [0, 0, -9.81]
[material.soft]
young = 2e9
poisson = 0.3
density = 1500
damping = 2e-4
[section.strip]
shape = "rectangle"
width = 0.02
height = 0.005
[frame.hand]
position = [0, 0, 0]
input = true
[beam.arm]
material = "soft"
section = "strip"
from = [0, 0, 0]
to = [0.5, 0.1, 0.05]
elements = 3
[beam.finger]
material = "soft"
section = "strip"
from = [0.5, 0.1, 0.05]
to = [0.5, 0.4, 0.1]
elements = 2
[body.slider]
mass = 0.2
position = [0.5, 0.4, 0.1]
inertia = [2e-4, 3e-4, 4e-4]
[joint.grip]
type = "bushing"
a = "hand"
b = "arm.start"
stiffness = [2e4, 2e4, 2e4]
damping = [20, 20, 20]
rotational_stiffness = [50, 50, 50]
rotational_damping = [0.1, 0.1, 0.1]
[joint.knuckle]
type = "revolute"
a = "arm.end"
b = "finger.start"
axis = [0, 0, 1]
[joint.rail]
type = "prismatic"
a = "finger.end"
b = "slider"
axis = [0, 1, 0]
[drive.bend]
joint = "knuckle"
coordinate = "angle"
input = "KNUCKLE"
[drive.slide]
joint = "rail"
coordinate = "distance"
input = "value"
[load.push]
at = "arm.end"
force = [0.1, 0, 0]
moment = [0, 0.01, 0]
input = true
[load.wind]
on = "finger"
force = [0, 0, 0.2]
follower = true
input = true
[actuator.squeeze]
a = "arm.node[1]"
b = "finger.end"
effort = 0.2
input = true
[output.cylinder]
at = "squeeze"
quantities = ["distance", "distance_rate", "effort", "power"]
[output.tip]
at = "finger.end"
quantities = ["position", "velocity", "acceleration", "rotation", "quaternion", "angular_velocity", "section_force", "section_moment"]
[output.middle]
at = "arm@0.5"
quantities = ["position", "rotation", "twist", "curvature", "torsion", "stress"]
[output.wrist]
at = "grip"
quantities = ["reaction_force", "reaction_moment"]
[output.hinge]
at = "knuckle"
quantities = ["angle", "angle_rate", "effort", "reaction_moment"]
[output.needed]
at = "hand"
quantities = ["reaction_force", "reaction_moment"]
[simulation]
stop = 1.0
step = 2e-3
output_step = 2e-3
tolerance = 1e-12
"#;

fn places(simulation: &Simulation, wanted: Causality) -> Vec<usize> {
    let variables = simulation.variables().iter().enumerate();
    let real = |value| matches!(value, Value::Real(_));
    variables.filter(|(_, v)| v.causality == wanted && real(v.start)).map(|(place, _)| place).collect()
}

/// The name without its component.
fn family(simulation: &Simulation, place: usize) -> &str {
    let name = &simulation.variables()[place].name;
    name.split('[').next().unwrap_or(name)
}

/// A motion on the way: everything that is given moves.
pub fn set_out(simulation: &mut Simulation, step: f64, steps: u32) -> f64 {
    let inputs = places(simulation, Causality::Input);
    let mut end = 0.0;
    for number in 1..=steps {
        for (k, input) in inputs.iter().enumerate() {
            let start = simulation.variables()[*input].start.number();
            let swing = 0.02 * f64::from(number) / f64::from(steps) * (1.0 + 0.3 * k as f64).sin();
            simulation.set_value(*input, Value::Real(start + swing)).unwrap();
            simulation.set_input_derivative(*input, 0.05 * (2.0 + 0.7 * k as f64).cos());
        }
        end = step * f64::from(number);
        simulation.advance(end).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
    end
}

/// Largest difference between the derivatives and central differences of fourth order through repeated steps; over the
/// largest derivative of the same family of results by the same input.
pub fn worst(mut simulation: Simulation, step: f64, steps: u32) -> (f64, String) {
    let begin = if steps > 1 { set_out(&mut simulation, step, steps - 1) } else { 0.0 };
    let start = simulation.snapshot();
    let end = begin + step;
    let (inputs, outputs) = (places(&simulation, Causality::Input), places(&simulation, Causality::Output));
    let slopes: Vec<f64> = (0..inputs.len()).map(|k| 0.05 * (2.0 + 0.7 * k as f64).cos()).collect();
    let results = |simulation: &mut Simulation| {
        for (input, slope) in inputs.iter().zip(&slopes) {
            simulation.set_input_derivative(*input, *slope);
        }
        simulation.advance(end).unwrap();
        outputs.iter().map(|place| simulation.value(*place).number()).collect::<Vec<f64>>()
    };
    results(&mut simulation);
    let mut jacobian = Vec::new();
    for input in &inputs {
        let own = |output: &usize| simulation.partial_derivative(*output, *input);
        let column: Result<Vec<f64>, _> = outputs.iter().map(own).collect();
        jacobian.push(column.unwrap_or_else(|failure| panic!("{}", failure.message)));
    }
    // Small against what the step bends, large against Newton's rest.
    let is_load = |input: &usize| ["force", "moment"].iter().any(|word| family(&simulation, *input).ends_with(word));
    let change = |input: &usize| if is_load(input) { 0.02 } else { 1e-4 };
    let changes: Vec<f64> = inputs.iter().map(change).collect();
    // How far each family of results goes with any of these changes.
    let reach = |output: &usize| {
        let family = family(&simulation, *output);
        let own = outputs.iter().enumerate().filter(|(_, other)| self::family(&simulation, **other) == family);
        let all = own.flat_map(|(k, _)| jacobian.iter().zip(&changes).map(move |(column, by)| (column[k] * by).abs()));
        all.fold(0.0, f64::max)
    };
    let reaches: Vec<f64> = outputs.iter().map(reach).collect();
    let mut worst = (0.0, String::new());
    for ((column, input), change) in jacobian.iter().zip(&inputs).zip(&changes) {
        let value = simulation.value(*input).number();
        let mut differences = vec![0.0; outputs.len()];
        for (offset, weight) in [(-2.0, 1.0 / 12.0), (-1.0, -2.0 / 3.0), (1.0, 2.0 / 3.0), (2.0, -1.0 / 12.0)] {
            simulation.restore(&start);
            simulation.set_value(*input, Value::Real(value + offset * change)).unwrap();
            for (sum, value) in differences.iter_mut().zip(results(&mut simulation)) {
                *sum += weight * value;
            }
        }
        simulation.restore(&start);
        for (k, output) in outputs.iter().enumerate() {
            let error = (column[k] * change - differences[k]).abs() / reaches[k];
            if error > worst.0 && family(&simulation, *output) != "middle.stress" {
                let names = [output, input].map(|place| &simulation.variables()[*place].name);
                let numbers = [column[k], differences[k] / change];
                worst = (
                    error,
                    format!("d({})/d({}) = {:e}, by differences {:e}", names[0], names[1], numbers[0], numbers[1]),
                );
            }
        }
    }
    worst
}

/// Keys and values that differ from the file's.
type Overrides<'a> = &'a [(&'a str, &'a str)];

pub fn machine(word: &str, overrides: Overrides) -> Simulation {
    load(&MACHINE.replace("KNUCKLE", word), overrides)
}

/// Both midpoint rules, generalized-alpha and statics; one internal step and several, on the grid and off it; right
/// after the start and on the way; all elements.
#[test]
fn derivatives_by_inputs() {
    let conserving: Overrides = &[];
    let undamped = &[("simulation.spectral_radius", "1")];
    let alpha = &[("simulation.integrator", "generalized_alpha")];
    let statics = &[("simulation.analysis", "static")];
    let quadratic = &[("arm.twist", "quadratic"), ("finger.strain", "small")];
    let other = &[("finger.element", "ancf24")];
    let quadratic_alpha = &[("arm.twist", "quadratic"), ("simulation.integrator", "generalized_alpha")];
    let cases: [(&str, Overrides, &str, f64, u32); 10] = [
        ("conserving, one step", conserving, "value", 2e-3, 1),
        ("conserving, on the way", conserving, "rate", 2e-3, 6),
        ("conserving, five internal steps", conserving, "value", 1e-2, 4),
        ("conserving, off the grid", conserving, "rate", 7e-3, 4),
        ("undamped", undamped, "value", 4e-3, 4),
        ("generalized-alpha", alpha, "rate", 4e-3, 4),
        ("generalized-alpha, quadratic twist", quadratic_alpha, "rate", 4e-3, 4),
        ("static", statics, "value", 1e-2, 3),
        ("quadratic twist, small strain", quadratic, "value", 4e-3, 4),
        ("ANCF24 and ANCF14", other, "value", 2e-3, 3),
    ];
    for (name, overrides, word, step, steps) in cases {
        let (error, what) = worst(machine(word, overrides), step, steps);
        println!("{name}: {error:.1e} ({what})");
        // The differences leave 5e-5 of a family, by the fourth power of their step and by what Newton leaves of a
        // section's moment; a term that is missing shows at 1e-2.
        assert!(error < 1e-4, "{name}: {error:.1e} ({what})");
    }
}

/// Strong damping with generalized-alpha: derivatives have the exact matrix of a step, and the differences leave 1e-9
/// of a family. With the matrix of the iteration, which leaves out a part of the damping, derivatives would be off by
/// 7e-7.
#[test]
fn derivatives_of_damped_steps_by_inputs() {
    let overrides = &[("soft.damping", "0.1"), ("simulation.integrator", "generalized_alpha")];
    let (error, what) = worst(machine("rate", overrides), 4e-3, 4);
    println!("{error:.1e} ({what})");
    assert!(error < 1e-7, "{error:.1e} ({what})");
}

pub fn place(simulation: &Simulation, name: &str) -> usize {
    simulation.variables().iter().position(|variable| variable.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn rate(simulation: &mut Simulation, name: &str) -> f64 {
    let place = place(simulation, name);
    simulation.output_derivative(place).unwrap_or_else(|failure| panic!("{name}: {}", failure.message))
}

fn value(simulation: &Simulation, name: &str) -> f64 {
    simulation.value(place(simulation, name)).number()
}

/// Positions go with velocities, velocities with accelerations, quaternions with angular velocities, a driven angle
/// with its drive.
#[test]
fn derivatives_by_time_of_what_moves() {
    for overrides in [&[][..], &[("simulation.integrator", "generalized_alpha")], &[("finger.element", "ancf24")]] {
        let mut simulation = machine("rate", overrides);
        set_out(&mut simulation, 2e-3, 20);
        let near = |a: f64, b: f64, scale: f64, what: &str| {
            assert!((a - b).abs() < 1e-8 * scale, "{what}: {a:e}, {b:e} expected, of {scale:e}");
        };
        let vector = |simulation: &Simulation, name: &str, count: usize| -> Vec<f64> {
            (1..=count).map(|i| value(simulation, &format!("{name}[{i}]"))).collect()
        };
        let [v, a, w] =
            ["velocity", "acceleration", "angular_velocity"].map(|n| vector(&simulation, &format!("tip.{n}"), 3));
        let largest = |list: &[f64]| list.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(largest(&v) > 0.1 && largest(&w) > 1.0, "it moves: {v:?}, {w:?}");
        for i in 0..3 {
            near(rate(&mut simulation, &format!("tip.position[{}]", i + 1)), v[i], largest(&v), "position");
            near(rate(&mut simulation, &format!("tip.velocity[{}]", i + 1)), a[i], largest(&a), "velocity");
        }
        let q = vector(&simulation, "tip.quaternion", 4);
        let expected = [
            -w[0] * q[1] - w[1] * q[2] - w[2] * q[3],
            w[0] * q[0] + w[1] * q[3] - w[2] * q[2],
            w[1] * q[0] + w[2] * q[1] - w[0] * q[3],
            w[2] * q[0] + w[0] * q[2] - w[1] * q[1],
        ];
        for (i, expected) in expected.iter().enumerate() {
            near(
                rate(&mut simulation, &format!("tip.quaternion[{}]", i + 1)),
                0.5 * expected,
                largest(&w),
                "quaternion",
            );
        }
        let driven = value(&simulation, "bend.rate") + 2e-3 * 0.05 * slope_of(&simulation, "bend.rate");
        // Generalized-alpha keeps drives at the level of positions.
        if overrides.is_empty() {
            near(rate(&mut simulation, "hinge.angle"), driven, 1.0, "angle");
        }
    }
}

/// The derivative that [`set_out`] gives an input, over 0.05.
fn slope_of(simulation: &Simulation, name: &str) -> f64 {
    let inputs = places(simulation, Causality::Input);
    let k = inputs.iter().position(|input| *input == place(simulation, name)).unwrap();
    (2.0 + 0.7 * k as f64).cos()
}

/// The energies of an undamped strip under a host's force change as the work done on it; momenta, reactions and
/// accelerations by the difference quotient of the last communication step, or before there is one by that of the first
/// internal step.
#[test]
fn derivatives_by_time_of_energy_and_the_rest() {
    let text = include_str!("../fmi/model.toml")
        .replace(r#"["position", "velocity"]"#, r#"["position", "velocity", "acceleration"]"#);
    let mut simulation = load(&text, &[]);
    let early = rate(&mut simulation, "momentum.linear[3]");
    let start = value(&simulation, "momentum.linear[3]");
    let mut copy = load(&text, &[]);
    copy.advance(1e-3).unwrap();
    assert_eq!(early, (value(&copy, "momentum.linear[3]") - start) / 1e-3);
    let force = place(&simulation, "tip.force[3]");
    simulation.set_value(force, Value::Real(-40.0)).unwrap();
    simulation.advance(0.02).unwrap();
    let before = simulation.value(place(&simulation, "momentum.linear[3]")).number();
    simulation.advance(0.021).unwrap();
    let quotient = (value(&simulation, "momentum.linear[3]") - before) / 1e-3;
    assert!(quotient.abs() > 0.1);
    // Times are multiples of the step to round-off.
    assert!((rate(&mut simulation, "momentum.linear[3]") - quotient).abs() < 1e-10 * quotient.abs());
    let power = -40.0 * value(&simulation, "P.velocity[3]");
    let rates = ["kinetic", "elastic", "gravity", "total"].map(|part| rate(&mut simulation, &format!("energy.{part}")));
    assert!(power.abs() > 1.0);
    assert!(
        (rates[0] + rates[1] + rates[2] - power).abs() < 1e-8 * rates[0].abs().max(power.abs()),
        "{rates:?}, {power}"
    );
    assert!((rates[3] - power).abs() < 1e-8 * rates[0].abs().max(power.abs()));
    // Over three internal steps: all of them count, also after a state has gone through bytes.
    let before = value(&simulation, "momentum.linear[3]");
    simulation.advance(0.024).unwrap();
    let quotient = (value(&simulation, "momentum.linear[3]") - before) / 3e-3;
    let bytes = simulation.write(&simulation.snapshot(), Vec::new());
    let read = copy.read(&bytes).unwrap_or_else(|failure| panic!("{}", failure.message));
    copy.restore(&read);
    for simulation in [&mut simulation, &mut copy] {
        assert!((rate(simulation, "momentum.linear[3]") - quotient).abs() < 1e-10 * quotient.abs());
    }
}

/// Derivatives go with FMU states, also as bytes; and they belong to a step of the machine as it was then.
#[test]
fn derivatives_belong_to_the_last_step() {
    let mut simulation = machine("value", &[]);
    let (output, input) = (place(&simulation, "tip.velocity[3]"), place(&simulation, "push.force[3]"));
    let derivative_of = |simulation: &mut Simulation| simulation.partial_derivative(output, input).unwrap();
    assert_eq!(derivative_of(&mut simulation), 0.0, "no step has been taken");
    let end = set_out(&mut simulation, 4e-3, 3);
    let derivative = simulation.partial_derivative(output, input).unwrap();
    let acceleration = rate(&mut simulation, "tip.acceleration[2]");
    let snapshot = simulation.snapshot();
    // What is set after the step is of the next one.
    simulation.set_value(input, Value::Real(5.0)).unwrap();
    assert_eq!(derivative_of(&mut simulation), derivative);
    simulation.advance(end + 4e-3).unwrap();
    assert_ne!(simulation.partial_derivative(output, input).unwrap(), derivative);
    simulation.restore(&snapshot);
    assert_eq!(derivative_of(&mut simulation), derivative);
    let mut other = machine("value", &[]);
    let read = other.read(&simulation.write(&snapshot, Vec::new())).unwrap_or_else(|f| panic!("{}", f.message));
    other.restore(&read);
    assert_eq!(other.partial_derivative(output, input).unwrap(), derivative);
    assert_eq!(rate(&mut other, "tip.acceleration[2]"), acceleration);
    // Asking leaves no trace in what follows.
    let mut unasked = machine("value", &[]);
    unasked.restore(&read);
    for simulation in [&mut other, &mut unasked] {
        simulation.advance(end + 8e-3).unwrap();
    }
    assert_eq!(value(&other, "tip.position[1]").to_bits(), value(&unasked, "tip.position[1]").to_bits());
    // A parameter that is tuned is of the next step; the last one had the old machine, also where nothing had been
    // asked for before.
    simulation.restore(&snapshot);
    simulation.set_value(place(&simulation, "gravity[3]"), Value::Real(-90.0)).unwrap();
    let tuned = simulation.write(&simulation.snapshot(), Vec::new());
    let next = |simulation: &mut Simulation| {
        assert_eq!(derivative_of(simulation), derivative);
        assert_eq!(rate(simulation, "tip.acceleration[2]"), acceleration);
        simulation.advance(end + 4e-3).unwrap();
        [derivative_of(simulation).to_bits(), value(simulation, "tip.position[3]").to_bits()]
    };
    let expected = next(&mut simulation);
    assert_ne!(f64::from_bits(expected[0]), derivative);
    let read = other.read(&tuned).unwrap_or_else(|f| panic!("{}", f.message));
    other.restore(&read);
    assert_eq!(next(&mut other), expected);
    other.reset();
    assert_eq!(derivative_of(&mut other), 0.0);
}

/// A quaternion counts by its direction: derivatives by one of another length are those by the unit one, over the
/// length.
#[test]
fn quaternions_of_any_length() {
    let derivative = |length: f64| {
        let mut simulation = machine("value", &[]);
        for (name, part) in [("[1]", 1.0), ("[2]", 0.02), ("[3]", 0.01), ("[4]", -0.015)] {
            let place = place(&simulation, &format!("hand.quaternion{name}"));
            simulation.set_value(place, Value::Real(part * length)).unwrap();
        }
        simulation.advance(2e-3).unwrap();
        let [output, input] = ["tip.velocity[3]", "hand.quaternion[3]"].map(|name| place(&simulation, name));
        simulation.partial_derivative(output, input).unwrap() * length
    };
    let unit = derivative(1.0);
    assert!(unit.abs() > 1e-3);
    for length in [1e-6, 1e-3, 1e6] {
        let own = derivative(length);
        assert!((own - unit).abs() < 1e-8 * unit.abs(), "{length}: {own:e}, {unit:e}");
    }
}

/// A tunable parameter acts from when it is set, in the instance that it was set in and in one that goes on from its
/// bytes.
#[test]
fn derivatives_by_time_after_a_tuned_parameter() {
    let mut simulation = machine("value", &[]);
    set_out(&mut simulation, 2e-3, 2);
    let before = rate(&mut simulation, "tip.velocity[3]");
    simulation.set_value(place(&simulation, "gravity[3]"), Value::Real(-100.0)).unwrap();
    let mut other = machine("value", &[]);
    let read =
        other.read(&simulation.write(&simulation.snapshot(), Vec::new())).unwrap_or_else(|f| panic!("{}", f.message));
    other.restore(&read);
    let own = rate(&mut simulation, "tip.velocity[3]");
    assert!((own - before).abs() > 1.0);
    assert_eq!(own.to_bits(), rate(&mut other, "tip.velocity[3]").to_bits());
}

/// Before the first step, too: derivatives that are difference quotients are those of a run that begins with the tuned
/// parameter, and without the jump of the results that gravity enters. The drawn start does not depend on gravity.
#[test]
fn regression_quotients_after_a_parameter_tuned_before_the_first_step() {
    let text = include_str!("../../../models/pendulum.toml");
    let load = || Simulation::load("pendulum.toml", text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    let tune = |simulation: &mut Simulation| {
        simulation.set_value(place(simulation, "gravity[3]"), Value::Real(-20.0)).unwrap();
    };
    let [mut early, mut late, mut other] = [load(), load(), load()];
    tune(&mut early);
    [&mut early, &mut late].into_iter().for_each(|simulation| simulation.initialize(0.0).unwrap());
    tune(&mut late);
    let read = other.read(&late.write(&late.snapshot(), Vec::new())).unwrap_or_else(|f| panic!("{}", f.message));
    other.restore(&read);
    for name in ["momentum.linear[1]", "momentum.linear[3]", "momentum.angular[2]"] {
        let expected = rate(&mut early, name);
        assert!(expected.abs() > 1e-3, "{name}: {expected}");
        assert_eq!(rate(&mut late, name).to_bits(), expected.to_bits(), "{name}");
        assert_eq!(rate(&mut other, name).to_bits(), expected.to_bits(), "{name}, from bytes");
    }
}
