//! Steps that the solver chooses, by the accuracies that it reaches.

use super::Section;
use ancf14::model::simulation::Simulation;
use ancf14_testing::curves::{Curves, load};
use std::collections::BTreeMap;
use std::fmt::Write;

const MODELS: [(&str, &str); 5] = [
    ("rotating shaft", super::shaft::MODEL),
    ("lateral buckling", super::buckling::MODEL),
    ("four-bar linkage, damped", include_str!("../../../../models/four_bar.toml")),
    ("cantilever", include_str!("../../../../models/cantilever.toml")),
    ("pendulum", include_str!("../../../../models/pendulum.toml")),
];

/// An overwritten number of one model.
const DAMPED: (&str, &str) = ("steel.damping", "1e-4");

const ACCURACIES: [&str; 3] = ["1e-2", "1e-3", "1e-4"];
/// The reference takes three times as many steps as the last of them.
const REFERENCE: &str = "1e-5";

/// What follows places, slopes and angles.
const PLACES: [&str; 5] = ["position", "displacement", "angle", "twist", "rotation"];

/// A run without a step.
fn run(title: &str, model: &str, accuracy: &str) -> (Curves, Simulation) {
    let own: Vec<&str> = model.lines().filter(|line| !line.starts_with("step =")).collect();
    let damped = title.contains("damped").then_some(DAMPED);
    let overrides: Vec<_> = [("simulation.accuracy", accuracy)].into_iter().chain(damped).collect();
    let mut simulation = load(&own.join("\n"), &overrides);
    (Curves::record(&mut simulation), simulation)
}

/// The largest error of each family of results that the run follows, as a share of the family's range.
fn errors(own: &(Curves, Simulation), reference: &Curves) -> BTreeMap<String, f64> {
    let (curves, simulation) = own;
    let followed: Vec<String> = simulation.estimated_errors().into_iter().map(|own| own.name).collect();
    let mut families = BTreeMap::<String, (f64, f64)>::new();
    for name in curves.names() {
        let family = name.split('[').next().unwrap_or(name);
        if !followed.iter().any(|own| own == family) {
            continue;
        }
        let (now, exact) = (curves.column(name), reference.column(name));
        let difference = now.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let range = exact.iter().fold(f64::NEG_INFINITY, |most, x| most.max(*x))
            - exact.iter().fold(f64::INFINITY, |least, x| least.min(*x));
        let own = families.entry(family.to_owned()).or_default();
        *own = (own.0.max(difference), own.1.max(range));
    }
    families.into_iter().filter(|(_, (_, range))| *range > 0.0).map(|(name, (d, range))| (name, d / range)).collect()
}

/// The largest of those whose quantity is a place or an angle, and of all others.
fn largest(errors: &BTreeMap<String, f64>) -> [Option<f64>; 2] {
    let mut largest = [None; 2];
    for (name, error) in errors {
        let is_place = PLACES.iter().any(|quantity| name.ends_with(&format!(".{quantity}")));
        let own = &mut largest[usize::from(!is_place)];
        *own = Some(own.unwrap_or(0.0_f64).max(*error));
    }
    largest
}

fn percent(error: Option<f64>) -> String {
    error.map_or(String::from("-"), |error| format!("{:.2} %", 100.0 * error))
}

/// The section.
pub fn write(section: &mut Section) {
    section.say(&format!(
        "Models without `simulation.step`, beside runs with `accuracy = {REFERENCE}`: steps, steps that were taken again, and the largest error over all rows as a share of the range, \
         of places and angles and of the other results that are followed (velocities, strains, stresses, forces and moments, efforts, accelerations); `told` is the worst of all as the run itself estimates it."
    ));
    let mut table = String::from(
        "| model | accuracy | steps | again | places, angles | others | told |\n|---|---|---|---|---|---|---|\n",
    );
    for (title, model) in MODELS {
        let (reference, _) = run(title, model, REFERENCE);
        for accuracy in ACCURACIES {
            let own = run(title, model, accuracy);
            let [places, others] = largest(&errors(&own, &reference)).map(percent);
            let statistics = own.1.state().statistics;
            let told =
                own.1.least_accurate().map_or(String::new(), |worst| format!("{}: {}", worst.name, worst.size()));
            let (steps, again) = (statistics.steps, statistics.rejected);
            // Writing into a String cannot fail.
            let _ = writeln!(table, "| {title} | {accuracy} | {steps} | {again} | {places} | {others} | {told} |");
        }
    }
    section.say(&table);
}
