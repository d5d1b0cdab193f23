//! Runs of a model file: what they cost, and what comes out.

use crate::clock;
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::load;

/// A model file without its outputs, but with those of `outputs`: what is watched beyond need would be timed too.
pub fn watching(model: &str, outputs: &str) -> String {
    let mut text = String::new();
    let mut kept = true;
    for line in model.lines() {
        if line.starts_with('[') {
            kept = !line.starts_with("[output.");
        }
        if kept {
            text += line;
            text.push('\n');
        }
    }
    text + outputs
}

/// Brings an initialized simulation to its stop time.
pub fn finish(simulation: &mut Simulation) {
    let (stop, step) = (simulation.about().stop, simulation.about().output_step);
    for number in 1..=(stop / step).round() as u32 {
        simulation.advance(f64::from(number) * step).unwrap_or_else(|failure| panic!("{}", failure.message));
    }
}

/// CPU time from the initial state to the stop time, s: the steps alone.
pub fn stepping(model: &str, keys: &[(&str, &str)]) -> f64 {
    clock::least(|| {
        let mut simulation = load(model, keys);
        clock::timed(|| finish(&mut simulation))
    })
}

/// CPU time of the first equilibria, s, of a set of `cases` of keys together. Files are read and machines built before,
/// as those of the peer are; the solver is set up within.
pub fn equilibria(model: &str, cases: &[Vec<(&str, String)>]) -> f64 {
    clock::least(|| cases.iter().map(|keys| equilibrium(model, keys)).sum())
}

/// A simulation that has not been initialized.
pub fn drawn(model: &str, keys: &[(&str, String)]) -> Simulation {
    let keys: Vec<_> = keys.iter().map(|(key, value)| (key.to_string(), value.clone())).collect();
    Simulation::load("model.toml", model, &keys).unwrap_or_else(|failure| panic!("{}", failure.message))
}

fn equilibrium(model: &str, keys: &[(&str, String)]) -> f64 {
    let mut simulation = drawn(model, keys);
    clock::timed(|| simulation.initialize(0.0).unwrap_or_else(|failure| panic!("{}", failure.message)))
}
