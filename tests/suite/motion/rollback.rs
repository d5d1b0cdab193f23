//! A model taken back to a snapshot must go on with the very bits it went on with before: masters repeat steps.

use crate::curves::load;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::{Simulation, Snapshot};

const MODELS: [(&str, &str); 13] = [
    ("pendulum", include_str!("../../../models/pendulum.toml")),
    ("cantilever", include_str!("../../../models/cantilever.toml")),
    ("princeton_beam", include_str!("../../../models/princeton_beam.toml")),
    ("rotating_shaft", include_str!("../../../models/rotating_shaft.toml")),
    ("lateral_buckling", include_str!("../../../models/lateral_buckling.toml")),
    ("four_bar", include_str!("../../../models/four_bar.toml")),
    ("crane", include_str!("../../../models/crane.toml")),
    ("roll_up", include_str!("../../../models/roll_up.toml")),
    ("elastica", include_str!("../../../models/elastica.toml")),
    ("ring", include_str!("../../../models/ring.toml")),
    ("helical_spring", include_str!("../../../models/helical_spring.toml")),
    ("bend_45", include_str!("../../../models/bend_45.toml")),
    ("robot", include_str!("../../../models/robot.toml")),
];

fn start(text: &str) -> Simulation {
    load(text, &[])
}

/// Loaded only.
fn unstarted(text: &str, overrides: &[(&str, &str)]) -> Simulation {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| (key.to_string(), value.to_string())).collect();
    Simulation::load("model.toml", text, &overrides).unwrap_or_else(|failure| panic!("{}", failure.message))
}

/// All values as bits.
fn bits(simulation: &Simulation) -> Vec<u64> {
    (0..simulation.variables().len()).map(|reference| simulation.value(reference).number().to_bits()).collect()
}

fn reference(simulation: &Simulation, name: &str) -> usize {
    simulation.variables().iter().position(|variable| variable.name == name).unwrap()
}

/// The same state, through bytes, in a simulation that knows nothing but the file.
fn elsewhere(simulation: &Simulation, snapshot: &Snapshot, fresh: Simulation) -> Simulation {
    let bytes = simulation.write(snapshot, Vec::new());
    let read = fresh.read(&bytes).unwrap_or_else(|failure| panic!("{}", failure.message));
    let mut other = fresh;
    other.restore(&read);
    assert_eq!(bits(&other), bits(simulation));
    assert_eq!(other.write(&other.snapshot(), Vec::new()), bytes);
    other
}

fn check(name: &str, mut simulation: Simulation, fresh: Simulation) {
    let step = simulation.about().output_step;
    // Between two points of the grid of internal steps, too.
    for number in 1..=5 {
        simulation.advance(0.7 * f64::from(number) * step).unwrap();
    }
    let snapshot = simulation.snapshot();
    let before = bits(&simulation);
    let onwards = |simulation: &mut Simulation| {
        (5..10)
            .map(|number| {
                simulation.advance(f64::from(number) * step).unwrap();
                bits(simulation)
            })
            .collect::<Vec<_>>()
    };
    let first = onwards(&mut simulation);
    assert_ne!(first[0], before, "{name}");
    simulation.restore(&snapshot);
    assert_eq!(bits(&simulation), before, "{name}");
    let mut other = elsewhere(&simulation, &snapshot, fresh);
    assert_eq!(onwards(&mut simulation), first, "{name}");
    assert_eq!(onwards(&mut other), first, "{name}, from bytes");
}

#[test]
fn repeated_steps_give_the_same_bits() {
    for (name, text) in MODELS {
        check(name, start(text), unstarted(text, &[]));
    }
}

/// The lengths of steps that the solver chooses are part of the state.
#[test]
fn chosen_steps_are_repeated() {
    for (name, text) in MODELS.into_iter().filter(|(name, _)| ["pendulum", "rotating_shaft", "crane"].contains(name)) {
        let own: Vec<&str> = text.lines().filter(|line| !line.starts_with("step =")).collect();
        let text = own.join("\n");
        let simulation = start(&text);
        check(name, simulation, unstarted(&text, &[]));
    }
}

/// What a host has set before and since the initialization is in the bytes: fixed and tunable parameters, inputs with
/// derivatives.
#[test]
fn settings_are_in_the_bytes() {
    let text = MODELS[6].1;
    let mut simulation = unstarted(text, &[]);
    let set = |simulation: &mut Simulation, name: &str, value: Value| {
        let place = reference(simulation, name);
        simulation.set_value(place, value).unwrap();
    };
    set(&mut simulation, "boom.elements", Value::Integer(4));
    set(&mut simulation, "payload", Value::Real(300.0));
    set(&mut simulation, "foot.position[3]", Value::Real(0.25));
    simulation.initialize(2.0).unwrap();
    set(&mut simulation, "foot.position[1]", Value::Real(0.01));
    simulation.advance(2.03).unwrap();
    set(&mut simulation, "steel.damping", Value::Real(3e-4));
    set(&mut simulation, "gravity[1]", Value::Real(0.5));
    set(&mut simulation, "foot.position[2]", Value::Real(0.02));
    simulation.set_input_derivative(reference(&simulation, "foot.position[2]"), 0.125);
    let snapshot = simulation.snapshot();
    let mut other = elsewhere(&simulation, &snapshot, unstarted(text, &[]));
    for end in [2.05, 2.1] {
        simulation.advance(end).unwrap();
        other.advance(end).unwrap();
        assert_eq!(bits(&simulation), bits(&other));
    }
    // Neither the settings of the file nor those of the first initialization alone would do.
    let mut unset = unstarted(text, &[]);
    unset.initialize(2.0).unwrap();
    assert_ne!(bits(&unset), bits(&simulation));
}

/// Before the initialization there are settings only, even such as do not make a model yet.
#[test]
fn bytes_before_the_initialization() {
    let text = format!("{}\n[section.pipe]\nshape = \"tube\"\ninner = 0.01\nouter = 0.02\n", MODELS[1].1);
    let mut simulation = unstarted(&text, &[]);
    simulation.set_value(reference(&simulation, "arm.elements"), Value::Integer(3)).unwrap();
    simulation.set_value(reference(&simulation, "pipe.inner"), Value::Real(0.05)).unwrap();
    let mut other = elsewhere(&simulation, &simulation.snapshot(), unstarted(&text, &[]));
    for simulation in [&mut simulation, &mut other] {
        let refused = simulation.check().err();
        assert!(refused.is_some_and(|failure| failure.message.contains("`pipe.inner`")));
        assert!(simulation.initialize(0.0).is_err());
        simulation.set_value(reference(simulation, "pipe.inner"), Value::Real(0.015)).unwrap();
        simulation.initialize(0.0).unwrap();
        simulation.advance(0.01).unwrap();
    }
    assert_eq!(bits(&simulation), bits(&other));
}

/// Bytes that pass for a snapshot but are of another shape, or cut, are refused; none does harm.
#[test]
fn bytes_that_do_not_fit_are_refused() {
    let mut simulation = start(MODELS[1].1);
    simulation.advance(0.01).unwrap();
    let bytes = simulation.write(&simulation.snapshot(), Vec::new());
    let refusal = |other: Simulation| other.read(&bytes).err().map_or(String::new(), |failure| failure.message);
    let other_element = refusal(unstarted(MODELS[1].1, &[("arm.element", "ancf24")]));
    assert!(other_element.contains("another shape"), "{other_element}");
    let other_file = refusal(unstarted(MODELS[3].1, &[]));
    assert!(other_file.contains("settings"), "{other_file}");
    for length in 0..bytes.len() {
        assert!(simulation.read(&bytes[..length]).is_err(), "{length}");
    }
    for place in 0..bytes.len() {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0xff;
        if let Ok(snapshot) = simulation.read(&damaged) {
            simulation.restore(&snapshot);
            let _ = simulation.advance(simulation.time() + 1e-3);
        }
    }
}

/// With elements of ANCF24, which have no frames to go back to, alone and beside those of ANCF14: a shaft, a mechanism,
/// a curve.
#[test]
fn repeated_steps_of_ancf24_give_the_same_bits() {
    for (place, beam) in [(3, "shaft"), (4, "strip"), (4, "crank"), (11, "arc")] {
        let (name, text) = MODELS[place];
        let overrides = [(&*format!("{beam}.element"), "ancf24")];
        check(name, load(text, &overrides), unstarted(text, &overrides));
    }
}

/// Back over a reset and another mesh: the scratch memory of the solver must not be the wrong one's.
#[test]
fn snapshots_outlive_a_reset() {
    let mut simulation = start(MODELS[1].1);
    let step = simulation.about().output_step;
    simulation.advance(step).unwrap();
    let snapshot = simulation.snapshot();
    simulation.advance(2.0 * step).unwrap();
    let expected = bits(&simulation);
    simulation.reset();
    let elements = reference(&simulation, "arm.elements");
    let tolerance = reference(&simulation, "simulation.tolerance");
    simulation.set_value(elements, Value::Integer(3)).unwrap();
    simulation.set_value(tolerance, Value::Real(1e-3)).unwrap();
    simulation.initialize(0.0).unwrap();
    simulation.advance(step).unwrap();
    simulation.restore(&snapshot);
    simulation.advance(2.0 * step).unwrap();
    assert_eq!(bits(&simulation), expected);
}

/// A state goes into another instance of the same model too, whatever that one was doing.
#[test]
fn snapshots_fit_other_instances() {
    let mut first = start(MODELS[1].1);
    let step = first.about().output_step;
    first.advance(step).unwrap();
    let snapshot = first.snapshot();
    first.advance(2.0 * step).unwrap();
    let mut second = Simulation::load("model.toml", MODELS[1].1, &[]).unwrap();
    let elements = reference(&second, "arm.elements");
    second.set_value(elements, Value::Integer(5)).unwrap();
    second.initialize(0.0).unwrap();
    second.restore(&snapshot);
    second.advance(2.0 * step).unwrap();
    assert_eq!(bits(&second), bits(&first));
}

/// A step that fails leaves everything as it was, and what follows is as if it had not been tried.
#[test]
fn failed_steps_leave_no_trace() {
    let text = MODELS[1].1.replace("[simulation]", "[load.blow]\nat = \"arm.end\"\nforce = [0, 0, [{ until = 0.0205, is = \"0\" }, { until = 0.03, is = \"sqrt(-1)\" }, { is = \"0\" }]]\n\n[simulation]");
    let mut simulation = start(&text);
    simulation.advance(0.02).unwrap();
    let before = bits(&simulation);
    let failure = simulation.advance(0.025).unwrap_err();
    assert!(failure.message.contains("load blow is not a finite number"), "{}", failure.message);
    assert_eq!(bits(&simulation), before);
    assert_eq!(simulation.time(), 0.02);
}

/// What follows from a tunable parameter is checked when it is set between two steps, and the old value comes back.
#[test]
fn tunable_parameters_keep_their_bounds() {
    let text = "[parameters]\nP = 1.0\nQ = { value = \"2*P\", max = 6.0 }\n[load.push]\nat = \"arm.end\"\nforce = [0, 0, \"-Q\"]\n";
    let mut simulation = start(&format!("{}\n{text}", MODELS[1].1));
    let p = reference(&simulation, "P");
    simulation.advance(0.01).unwrap();
    simulation.set_value(p, Value::Real(2.5)).unwrap();
    let refused = simulation.set_value(p, Value::Real(5.0)).unwrap_err();
    assert!(refused.message.contains("`Q` must be at most 6, this is 10"), "{}", refused.message);
    assert_eq!(simulation.value(p), Value::Real(2.5));
    simulation.advance(0.02).unwrap();
}

/// A step too small to get anywhere is refused with its number, instead of hanging the host.
#[test]
fn absurdly_small_steps_are_refused() {
    let overrides = [("simulation.step".to_owned(), "1e-300".to_owned())];
    let mut simulation = Simulation::load("model.toml", MODELS[1].1, &overrides).unwrap();
    simulation.initialize(0.0).unwrap();
    let failure = simulation.advance(0.005).unwrap_err();
    assert!(failure.message.contains("internal steps of 1e-300 s"), "{}", failure.message);
}

/// A static path is judged from where it is, also after a host has gone back from elsewhere at the same time: the strut
/// buckles between A and C, whatever was tried before.
#[test]
fn buckling_is_told_after_a_rollback() {
    let text = r#"
format = 1
[model]
name = "Strut"
[material.steel]
young = 2e11
poisson = 0.3
density = 7850
[section.strip]
shape = "rectangle"
width = 0.02
height = 0.004
[beam.strut]
material = "steel"
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 4
[joint.root]
type = "weld"
a = "ground"
b = "strut.start"
[load.tip]
at = "strut.end"
force = [0, 0, 0]
input = true
[simulation]
analysis = "static"
stop = 10
step = 1
output_step = 1
"#;
    // Euler: pi² E I/4 with I = 0.02 0.004³/12.
    let critical = 52.6;
    let warnings = |detour: bool| {
        let mut simulation = start(text);
        let force = reference(&simulation, "tip.force[1]");
        let drawn = simulation.snapshot();
        let to = |simulation: &mut Simulation, share: f64, end: f64| {
            simulation.set_value(force, Value::Real(-share * critical)).unwrap();
            simulation.advance(end).unwrap();
            simulation.take_warnings().len()
        };
        assert_eq!(to(&mut simulation, 0.5, 1.0), 0);
        let a = simulation.snapshot();
        if detour {
            simulation.restore(&drawn);
            assert_eq!(to(&mut simulation, 1.5, 1.0), 1);
            simulation.restore(&a);
        }
        to(&mut simulation, 1.5, 2.0)
    };
    assert_eq!([warnings(false), warnings(true)], [1, 1]);
}
