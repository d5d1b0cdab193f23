//! True mesh errors: those that a run on a mesh four times as fine shows.

use crate::curves::Curves;
use ancf14::model::run::levels::{Level, merged};
use ancf14::model::simulation::Simulation;

/// The rows of a run with four times the elements and quadratic twist.
pub fn fine(text: &str) -> Curves {
    let twice = |own: Vec<(String, String)>| {
        let simulation = Simulation::load("model.toml", text, &own).unwrap();
        merged(&own, Level::DoubleElements.overrides(simulation.document()).unwrap())
    };
    let overrides = twice(twice(Vec::new()));
    let overrides: Vec<(&str, &str)> = overrides.iter().map(|(key, value)| (key.as_str(), value.as_str())).collect();
    Curves::run(text, &overrides)
}

/// The largest difference between `rows` and `fine` in the components of the result called `name`, as a share of their
/// range in `rows`.
pub fn true_error(rows: &Curves, fine: &Curves, name: &str) -> f64 {
    let (mut range, mut truth) = (0.0_f64, 0.0_f64);
    for column in rows.names().iter().filter(|column| column.split('[').next() == Some(name)) {
        let [own, fine] = [rows, fine].map(|curves| curves.column(column));
        let [low, high] =
            own.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| [value.min(low), value.max(high)]);
        range = range.max(high - low);
        truth = truth.max(rows.difference(&own, &fine, f64::INFINITY));
    }
    truth / range
}
