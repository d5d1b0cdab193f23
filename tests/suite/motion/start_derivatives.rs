//! Derivatives of the start, and what initial values are found from: closed forms of a cantilever, and whether anything
//! follows from an input or a parameter that the description does not name.

use crate::curves::load;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::Causality;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

/// A cantilever along x that a host pushes at its tip.
const CANTILEVER: &str = r#"
format = 1
[model]
name = "Cantilever"
[parameters]
side = 0.01
half = "side/2"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.square]
shape = "rectangle"
width = "2*half"
height = "side"
[beam.arm]
material = "steel"
section = "square"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
[joint.root]
type = "weld"
a = "ground"
b = "arm.start"
[load.tip]
at = "arm.end"
force = [0, 0, 0]
input = true
[output.P]
at = "arm.end"
quantities = ["position", "velocity", "acceleration"]
[output.R]
at = "root"
quantities = ["reaction_force", "applied_force", "reaction_moment", "applied_moment"]
[simulation]
initial = "START"
stop = 0.1
step = 1e-3
"#;

fn cantilever(start: &str) -> Simulation {
    let mut simulation = load(&CANTILEVER.replace("START", start), &[]);
    simulation.initialize(0.0).unwrap();
    simulation
}

fn place(simulation: &Simulation, name: &str) -> usize {
    simulation.variables().iter().position(|variable| variable.name == name).unwrap_or_else(|| panic!("no {name}"))
}

fn derivative(simulation: &mut Simulation, unknown: &str, known: &str) -> f64 {
    let [unknown, known] = [unknown, known].map(|name| place(simulation, name));
    simulation.initial_derivative(unknown, known).unwrap_or_else(|failure| panic!("{}", failure.message))
}

fn bits(simulation: &Simulation) -> Vec<u64> {
    (0..simulation.variables().len()).map(|at| simulation.value(at).number().to_bits()).collect()
}

/// At equilibrium `w = F L³/(3 E I)`, with 0.3 % of shear and elongation at most; the moment at the root is `F L`.
/// Asking leaves no trace.
#[test]
fn equilibrium_under_a_load() {
    let mut simulation = cantilever("equilibrium");
    let before = bits(&simulation);
    let slope = 1.0 / (3.0 * 2.1e11 * 1e-8 / 12.0);
    let found = derivative(&mut simulation, "P.position[3]", "tip.force[3]");
    assert!((found - slope).abs() < 3e-3 * slope, "{found} {slope}");
    // The equilibrium is solved to 1e-8 of the size at a change of 1e-4.
    assert!((derivative(&mut simulation, "R.reaction_force[3]", "tip.force[3]") + 1.0).abs() < 1e-4);
    assert!((derivative(&mut simulation, "R.applied_moment[2]", "tip.force[3]") - -1.0).abs() < 1e-4);
    assert_eq!(derivative(&mut simulation, "P.velocity[3]", "tip.force[3]"), 0.0);
    assert_eq!(bits(&simulation), before);

    let force = place(&simulation, "tip.force[3]");
    simulation.set_value(force, Value::Real(2.0)).unwrap();
    simulation.initialize(0.0).unwrap();
    let sag = simulation.value(place(&simulation, "P.position[3]")).number();
    let by_young = derivative(&mut simulation, "P.position[3]", "steel.young");
    assert!((by_young * 2.1e11 + sag).abs() < 1e-3 * sag, "{by_young} {sag}");
    let by_side = derivative(&mut simulation, "P.position[3]", "side");
    assert!((by_side * 0.01 + 4.0 * sag).abs() < 4e-3 * sag, "{by_side} {sag}");
    assert!((derivative(&mut simulation, "half", "side") - 0.5).abs() < 1e-9);
}

/// As drawn, a load changes accelerations and reactions, linearly, and no place.
#[test]
fn as_drawn_under_a_load() {
    let mut simulation = cantilever("as_drawn");
    let force = place(&simulation, "tip.force[3]");
    let names = ["P.acceleration[3]", "R.reaction_force[3]", "P.position[3]"];
    let found = names.map(|name| derivative(&mut simulation, name, "tip.force[3]"));
    let before = names.map(|name| simulation.value(place(&simulation, name)).number());
    simulation.set_value(force, Value::Real(1.0)).unwrap();
    simulation.initialize(0.0).unwrap();
    for (k, name) in names.into_iter().enumerate() {
        let change = simulation.value(place(&simulation, name)).number() - before[k];
        assert!((found[k] - change).abs() <= 1e-9 * change.abs(), "{name}: {} {change}", found[k]);
    }
    assert!(found[0] > 1.0 && found[1].abs() > 0.01 && found[2] == 0.0, "{found:?}");
}

/// What a joint does to side a is what it does to side b with the other sign; nothing is 0, not -0.
#[test]
fn applied_loads_are_reactions_with_the_other_sign() {
    let mut simulation = cantilever("equilibrium");
    for force in [0.0, 3.0] {
        simulation.set_value(place(&simulation, "tip.force[3]"), Value::Real(force)).unwrap();
        simulation.initialize(0.0).unwrap();
        for (what, k) in ["force", "moment"].into_iter().flat_map(|what| (1..=3).map(move |k| (what, k))) {
            let [reaction, applied] = ["reaction", "applied"]
                .map(|side| simulation.value(place(&simulation, &format!("R.{side}_{what}[{k}]"))).number());
            assert_eq!(applied.to_bits(), (0.0 - reaction).to_bits(), "{what} {k}");
        }
    }
}

const MODELS: [&str; 8] = [
    include_str!("../../../models/crane.toml"),
    include_str!("../../../models/four_bar.toml"),
    include_str!("../../../tests/suite/fmi/model.toml"),
    include_str!("../../../tests/suite/fmi/both_elements.toml"),
    include_str!("../../../tests/fmpy/coupling/arm.toml"),
    include_str!("../../../tests/fmpy/coupling/bushed.toml"),
    include_str!("../../../tests/fmpy/coupling/held.toml"),
    include_str!("../../../models/robot.toml"),
];

/// Changes every input and every parameter, one after the other, by a thousandth, and looks at what the description
/// says is not found from it: the same bits. Machines that begin as drawn, where much is said, have inputs of every
/// kind.
#[test]
fn initial_values_follow_from_what_is_named() {
    let drawn = crate::motion::step_derivatives::MACHINE.replace("KNUCKLE", "rate");
    let mut silent = 0;
    for text in MODELS.into_iter().chain([drawn.as_str(), &CANTILEVER.replace("START", "as_drawn")]) {
        let mut simulation = load(text, &[]);
        simulation.initialize(0.0).unwrap();
        let before = bits(&simulation);
        let variables = simulation.variables().to_vec();
        let calculated = |causality| matches!(causality, Causality::Output | Causality::CalculatedParameter);
        for (known, variable) in variables.iter().enumerate().filter(|(_, v)| !calculated(v.causality)) {
            let unnamed = |v: &ancf14::fmi::variable::Variable| {
                calculated(v.causality) && v.found_from.as_ref().is_some_and(|list| !list.contains(&known))
            };
            let Value::Real(start) = variable.start else { continue };
            if !variables.iter().any(unnamed) {
                continue;
            }
            let changed = if start == 0.0 { 1e-3 } else { 1.001 * start };
            simulation.set_value(known, Value::Real(changed)).unwrap();
            // A drive begins at 0, a machine fits together: not every change has a start.
            if simulation.initialize(0.0).is_ok() {
                let after = bits(&simulation);
                for at in (0..variables.len()).filter(|at| unnamed(&variables[*at])) {
                    assert_eq!(after[at], before[at], "{} by {}", variables[at].name, variable.name);
                    silent += 1;
                }
            }
            simulation.reset();
            simulation.initialize(0.0).unwrap();
        }
    }
    assert!(silent > 900, "{silent} pairs were looked at");
}

/// Two units that start from their drawings have no loop: the arm's pose follows from no load, and of the forearm only
/// the loads from the pose.
#[test]
fn coupled_units_have_no_initial_loop() {
    let of_inputs = |text: &str, name: &str| {
        let simulation = load(text, &[]);
        let variables = simulation.variables();
        let inputs = |list: &Vec<usize>| list.iter().filter(|at| variables[**at].causality == Causality::Input).count();
        variables[place(&simulation, name)].found_from.as_ref().map(inputs)
    };
    assert_eq!(of_inputs(MODELS[4], "arm_end.position[1]"), Some(0));
    assert_eq!(of_inputs(MODELS[4], "arm_end.quaternion[1]"), Some(0));
    assert_eq!(of_inputs(MODELS[5], "weight_motion.position[1]"), Some(0));
    assert_eq!(of_inputs(MODELS[5], "hand_load.applied_force[1]"), None);
}

/// Values far beyond everything mechanical are refused, or give numbers: no result is infinite or NaN with a call that
/// succeeds.
#[test]
fn regression_results_are_numbers() {
    let cases = [
        (include_str!("../../../models/crane.toml"), "foot.position[1]"),
        (include_str!("../../../models/crane.toml"), "foot.position[2]"),
        (include_str!("../../../models/helical_spring.toml"), "steel.young"),
        (MODELS[5], "hand.position[1]"),
    ];
    for (text, name) in cases {
        let mut simulation = load(text, &[]);
        let at = place(&simulation, name);
        let step = simulation.about().output_step;
        if simulation.set_value(at, Value::Real(1e308)).is_err() {
            continue;
        }
        let finite = |simulation: &Simulation| {
            (0..simulation.variables().len()).all(|at| simulation.value(at).number().is_finite())
        };
        let outcome = simulation.initialize(0.0).and_then(|()| {
            assert!(finite(&simulation), "{name}");
            simulation.advance(step)
        });
        match outcome {
            Ok(()) => assert!(finite(&simulation), "{name}"),
            Err(failure) => assert!(!failure.message.is_empty()),
        }
    }
}

/// A drive begins at 0 as drawn: nothing follows from another start. A host that asks for the whole Jacobian, or the
/// adjoint one, gets 0 there, with one line in the log, and the derivatives with respect to all else.
#[test]
fn regression_values_that_cannot_begin_otherwise() {
    let hinge = "type = \"revolute\"\naxis = [0, 1, 0]";
    let drive = "[drive.motor]\njoint = \"root\"\ncoordinate = \"angle\"\ninput = \"value\"\n";
    let text = CANTILEVER.replace("START", "as_drawn").replacen("type = \"weld\"", hinge, 1) + drive;
    let mut instance = Instance::of(Standard::Fmi3, load(&text, &[]), false);
    instance.enter_initialization_mode().unwrap();
    let names = ["P.acceleration[3]", "R.reaction_force[3]", "motor.value", "tip.force[3]"];
    let [acceleration, reaction, value, force] = names.map(|name| place(instance.model(), name) as u32);
    let mut changes = [7.0; 2];
    instance.take_entries();
    for _ in 0..2 {
        instance.directional_derivative(&[acceleration, reaction], &[value], &[1.0], &mut changes).unwrap();
        assert_eq!(changes, [0.0; 2]);
        instance.adjoint_derivative(&[acceleration, reaction], &[value], &[1.0, 1.0], &mut changes[..1]).unwrap();
        assert_eq!(changes[0], 0.0);
        instance.set_real(&[force], &[1.0]).unwrap();
    }
    let told: Vec<String> = instance.take_entries().into_iter().map(|entry| entry.message).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(
        told[0].contains("with respect to motor.value are given as 0") && told[0].contains("let it begin at 0"),
        "{told:?}"
    );
    instance.directional_derivative(&[acceleration, reaction], &[force, value], &[1.0, 1.0], &mut changes).unwrap();
    assert!(changes[0] > 1.0, "{changes:?}");
}
