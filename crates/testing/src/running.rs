//! A model file that runs, and its results by their names.

use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::model::simulation::Simulation;

/// Loads and initializes; the message where that fails.
pub fn try_start(text: &str) -> Result<Simulation, String> {
    let mut simulation = Simulation::load("m.toml", text, &[]).map_err(|failure| failure.message)?;
    simulation.initialize(simulation.about().start).map_err(|failure| failure.message)?;
    Ok(simulation)
}

pub fn start(text: &str) -> Simulation {
    try_start(text).unwrap_or_else(|message| panic!("{message}"))
}

/// The result or parameter of this name.
pub fn value(simulation: &Simulation, name: &str) -> f64 {
    let place = simulation.variables().iter().position(|variable| variable.name == name);
    simulation.value(place.unwrap_or_else(|| panic!("no variable {name}"))).number()
}

/// Its three components.
pub fn vector(simulation: &Simulation, name: &str) -> Vec3 {
    Vec3::from_fn(|i, _| value(simulation, &format!("{name}[{}]", i + 1)))
}

/// Advances to `stop` in steps of `every` and hands the simulation to `watch` after each.
pub fn run(simulation: &mut Simulation, every: f64, stop: f64, mut watch: impl FnMut(&Simulation)) {
    for number in 1..=(stop / every).round() as u32 {
        let end = f64::from(number) * every;
        simulation.advance(end).unwrap_or_else(|failure| panic!("at {end} s: {}", failure.message));
        watch(simulation);
    }
}

/// The bits of all variables.
pub fn bits(simulation: &Simulation) -> Vec<u64> {
    (0..simulation.variables().len()).map(|index| simulation.value(index).number().to_bits()).collect()
}

/// Advances to `end` twice from the present state, the second time from its copy, and goes back: all variables must have
/// the same bits, which it returns.
pub fn goes_on_to_the_bit(simulation: &mut Simulation, end: f64) -> Vec<u64> {
    let snapshot = simulation.snapshot();
    let [once, again] = [(); 2].map(|()| {
        simulation.advance(end).unwrap_or_else(|failure| panic!("at {end} s: {}", failure.message));
        let found = bits(simulation);
        simulation.restore(&snapshot);
        found
    });
    assert_eq!(once, again, "to {end} s");
    once
}
