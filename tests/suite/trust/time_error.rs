//! The error that the lengths of steps cause, as a run carries it along, beside the true one.

use crate::running::{start, value};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;

/// A body on a spring, 31.6 rad/s, by rows of 5 ms.
pub(super) fn oscillator(step: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Oscillator\"\n[body.b]\nmass = 1\nposition = [0, 0, -1]\ninertia = [0.1, 0.1, 0.1]\n\
         velocity = [0, 0, 1]\n[frame.hook]\nposition = [0, 0, 0]\n[spring.coil]\na = \"hook\"\nb = \"b\"\nstiffness = 1000\n\
         [output.P]\nat = \"b\"\nquantities = [\"displacement\"]\n[simulation]\nstop = 1\nstep = {step}\noutput_step = 5e-3\n"
    )
}

/// A slender shaft that is spun up past its first critical speed.
pub(super) fn shaft(step: &str) -> String {
    let file = format!("{}/models/rotating_shaft.toml", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(file).expect("the model");
    let own = text.lines().filter(|line| !line.starts_with("step =") && !line.starts_with("output_step ="));
    format!("{}\nstep = {step}\noutput_step = 8e-3\n", own.collect::<Vec<_>>().join("\n"))
}

/// A component of an output at every row until `stop`, s, and the simulation there.
pub fn rows(text: &str, name: &str, interval: f64, stop: f64) -> (Vec<f64>, Simulation) {
    let mut simulation = start(text);
    let count = (stop / interval).round() as usize;
    let found = (1..=count).map(|row| {
        simulation.advance(row as f64 * interval).unwrap_or_else(|failure| panic!("{}", failure.message));
        value(&simulation, name)
    });
    (found.collect(), simulation)
}

/// The largest difference over the range of what is compared with.
pub fn difference(rows: &[f64], reference: &[f64]) -> f64 {
    let pairs = rows.iter().zip(reference);
    let largest = pairs.map(|(own, other)| (own - other).abs()).fold(0.0, f64::max);
    let (low, high) = reference.iter().fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(*x), high.max(*x)));
    largest / (high - low)
}

/// The share of its range that the run says a family of results is off by.
pub fn estimate(simulation: &Simulation, family: &str) -> f64 {
    let errors = simulation.estimated_errors();
    errors.iter().find(|own| own.name == family).unwrap_or_else(|| panic!("no {family} in {errors:?}")).error
}

/// The leading term of the error of an oscillation is `omega t (omega h)^2 / 12`, and a sixth of it more by the
/// dissipation; derivatives are taken half a step to a whole one late, so that what is left out is `omega h` beside it,
/// and of the next order.
#[test]
fn the_error_of_an_oscillation_is_known() {
    for (step, turn) in [("1e-3", 0.032), ("5e-4", 0.016)] {
        let (found, simulation) = rows(&oscillator(step), "P.displacement[3]", 5e-3, 1.0);
        let omega = 1000.0_f64.sqrt();
        let exact: Vec<f64> = (1..=200).map(|row| (omega * 5e-3 * f64::from(row)).sin() / omega).collect();
        let (truth, told) = (difference(&found, &exact), estimate(&simulation, "P.displacement"));
        assert!((told / truth - 1.0).abs() < turn, "{step}: {told} instead of {truth}");
    }
}

/// Past the critical speed the error grows by a factor and shrinks again, while the shaft turns by many turns. A run
/// with an eighth of the step has a 64th of the error.
#[test]
fn the_error_of_a_whirling_shaft_is_known() {
    let name = "middle.displacement[2]";
    let (found, simulation) = rows(&shaft("4e-3"), name, 8e-3, 1.2);
    let (exact, fine) = rows(&shaft("5e-4"), name, 8e-3, 1.2);
    let truth = difference(&found, &exact);
    let [told, fine] = [&simulation, &fine].map(|run| estimate(run, "middle.displacement"));
    // Both to the next order, a share of (4 ms * 60 rad/s)^2; the whirl's own growth multiplies it by some 3.
    assert!((told / truth - 1.0).abs() < 0.2, "{told} instead of {truth}");
    assert!((64.0 * fine / truth - 1.0).abs() < 0.2, "64 times {fine} instead of {truth}");
}

/// A rigid bar of 1 m on a hinge, let go as it lies.
fn pendulum(step: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Pendulum\"\ngravity = [0, 0, -9.81]\n[body.bar]\nmass = 2\nposition = [0.5, 0, 0]\n\
         inertia = [0.001, 0.17, 0.17]\n[joint.hinge]\ntype = \"revolute\"\na = \"ground\"\nb = \"bar\"\nat = [0, 0, 0]\n\
         axis = [0, 1, 0]\n[output.hinge_load]\nat = \"hinge\"\nquantities = [\"reaction_force\"]\n[output.motion]\n\
         at = \"bar\"\nquantities = [\"acceleration\", \"velocity\", \"displacement\"]\n[simulation]\nstop = 4\nstep = {step}\noutput_step = 0.04\n"
    )
}

/// A joint turns with the bar, unevenly: half of the error is that it acts where it is at the mean of a step's ends
/// instead of at the middle of the time. Forces and accelerations at an instant are those of a motion that is off; of
/// these the error is told that 5 % of the looks exceed, to a sixteenth of it.
#[test]
fn the_errors_of_reactions_and_accelerations_are_known() {
    for (name, is_rough) in [
        ("hinge_load.reaction_force", true),
        ("motion.acceleration", true),
        ("motion.velocity", false),
        ("motion.displacement", false),
    ] {
        let row = |step: &str| {
            let (columns, mut runs): (Vec<_>, Vec<_>) =
                (1..=3).map(|component| rows(&pendulum(step), &format!("{name}[{component}]"), 0.04, 4.0)).unzip();
            (columns, runs.pop().expect("three runs"))
        };
        let ((found, simulation), (exact, _)) = (row("5e-3"), row("6.25e-4"));
        let range = |column: &Vec<f64>| {
            let (low, high) = column.iter().fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(*x), high.max(*x)));
            high - low
        };
        let range = exact.iter().map(range).fold(0.0, f64::max);
        let mut errors: Vec<f64> = (0..found[0].len())
            .map(|row| found.iter().zip(&exact).map(|(own, other)| (own[row] - other[row]).abs()).fold(0.0, f64::max))
            .collect();
        errors.sort_by(f64::total_cmp);
        let share = if is_rough { errors.len() / 20 } else { 0 };
        let truth = errors[errors.len() - 1 - share] / range;
        let told = estimate(&simulation, name);
        assert!((told / truth - 1.0).abs() < 0.15, "{name}: {told} instead of {truth}");
    }
}

/// A run tells when its results are off by more than 0.5 %, and which step would do; with that step it is silent.
#[test]
fn inexact_results_are_told() {
    for (step, expected) in [("4e-3", true), ("2e-4", false)] {
        let (_, mut simulation) = rows(&oscillator(step), "P.displacement[3]", 4e-3, 1.0);
        simulation.conclude();
        let warnings = simulation.take_warnings();
        let told = warnings.iter().any(|line| line.contains("because of the length of the steps"));
        assert_eq!(told, expected, "{step}: {warnings:?}");
    }
}

/// What is known of the error is part of an FMU state: a run that goes back, or goes on from bytes, ends with the same
/// bits.
#[test]
fn the_error_is_part_of_the_state() {
    let text = oscillator("1e-3");
    let (_, mut simulation) = rows(&text, "P.displacement[3]", 5e-3, 0.3);
    let snapshot = simulation.snapshot();
    let bytes = simulation.write(&snapshot, Vec::new());
    let finish = |simulation: &mut Simulation| {
        (61..=100).for_each(|row| simulation.advance(f64::from(row) * 5e-3).expect("a step"));
        estimate(simulation, "P.displacement")
    };
    let straight = finish(&mut simulation);
    simulation.restore(&snapshot);
    assert_eq!(finish(&mut simulation), straight);
    let mut other = start(&text);
    let read = other.read(&bytes).expect("a state");
    other.restore(&read);
    assert_eq!(finish(&mut other), straight);
}

/// Generalized-alpha carries no error along, nor do machines with elements of ANCF24.
#[test]
fn nothing_is_told_of_what_is_not_followed() {
    let text = oscillator("1e-3") + "integrator = \"generalized_alpha\"\n";
    assert_eq!(rows(&text, "P.displacement[3]", 5e-3, 0.1).1.least_accurate(), None);
}
