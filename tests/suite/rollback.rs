//! A model taken back to a snapshot must go on with the very bits it went on with before: masters repeat steps.

use crate::curves::load;
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;

const MODELS: [(&str, &str); 12] = [
    ("pendulum", include_str!("../../models/pendulum.toml")),
    ("cantilever", include_str!("../../models/cantilever.toml")),
    ("princeton_beam", include_str!("../../models/princeton_beam.toml")),
    ("rotating_shaft", include_str!("../../models/rotating_shaft.toml")),
    ("lateral_buckling", include_str!("../../models/lateral_buckling.toml")),
    ("four_bar", include_str!("../../models/four_bar.toml")),
    ("crane", include_str!("../../models/crane.toml")),
    ("roll_up", include_str!("../../models/roll_up.toml")),
    ("elastica", include_str!("../../models/elastica.toml")),
    ("ring", include_str!("../../models/ring.toml")),
    ("helical_spring", include_str!("../../models/helical_spring.toml")),
    ("bend_45", include_str!("../../models/bend_45.toml")),
];

fn start(text: &str) -> Simulation {
    load(text, &[])
}

/// All values as bits.
fn bits(simulation: &Simulation) -> Vec<u64> {
    (0..simulation.variables().len()).map(|reference| simulation.value(reference).number().to_bits()).collect()
}

fn reference(simulation: &Simulation, name: &str) -> usize {
    simulation.variables().iter().position(|variable| variable.name == name).unwrap()
}

fn check(name: &str, mut simulation: Simulation) {
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
    assert_eq!(onwards(&mut simulation), first, "{name}");
}

#[test]
fn repeated_steps_give_the_same_bits() {
    for (name, text) in MODELS {
        check(name, start(text));
    }
}

/// With elements of ANCF24, which have no frames to go back to, alone and beside those of ANCF14: a shaft, a mechanism, a curve.
#[test]
fn repeated_steps_of_ancf24_give_the_same_bits() {
    for (place, beam) in [(3, "shaft"), (4, "strip"), (4, "crank"), (11, "arc")] {
        let (name, text) = MODELS[place];
        check(name, load(text, &[(&format!("{beam}.element"), "ancf24")]));
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

/// A fast motion that the step does not resolve gains energy from nowhere: the user hears of it, once, and not when it is resolved.
/// The pendulum is drawn so that its lower beam swings through the line of the upper one, which then spins up for milliseconds.
#[test]
fn energy_from_nowhere_is_warned_of() {
    let text = MODELS[0].1.replace("to = [1.3, 0, 0.5]", "to = [1.2, 0.3, 0.4]");
    let warnings = |step: &str, rows: u32| {
        let variational = ("simulation.integrator".to_owned(), "variational".to_owned());
        let overrides = [("simulation.step".to_owned(), step.to_owned()), variational];
        let mut simulation = Simulation::load("model.toml", &text, &overrides).unwrap();
        simulation.initialize(0.0).unwrap();
        let mut warnings = Vec::new();
        for row in 1..=rows {
            simulation.advance(f64::from(row) * 0.01).unwrap();
            warnings.extend(simulation.take_warnings());
        }
        warnings
    };
    let coarse = warnings("5e-3", 45);
    assert!(coarse.len() == 1 && coarse[0].contains("take a smaller simulation.step"), "{coarse:?}");
    assert!(warnings("2e-4", 49).is_empty());
}
