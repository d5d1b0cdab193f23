//! A mesh finer than beam theory resolves is told when the model starts, before a host waits for its first step: with
//! its size, its cost and a better number. A host sets the number of elements as a parameter, and no file says what
//! it sets.

use crate::curves::load;
use ancf14::fmi::{Model, Value};

const FOUR_BAR: &str = include_str!("../../../models/four_bar.toml");

/// The rocker is 0.12 m long and 8 mm thick, a radius of gyration of 2.3 mm: with 2,000 elements an element is 1/38
/// of that. Elements of a tenth, 520 of them, are enough. One communication step of 20 ms would take 489 steps
/// instead of 5, and 10 s.
#[test]
fn regression_a_host_that_sets_2000_elements_is_told() {
    let mut simulation = load(FOUR_BAR, &[]);
    let elements = simulation.variables().iter().position(|variable| variable.name == "rocker.elements").unwrap();
    let mut told = |count: i32| {
        simulation.set_value(elements, Value::Integer(count)).unwrap();
        simulation.take_warnings();
        simulation.initialize(0.0).unwrap();
        simulation
            .take_warnings()
            .into_iter()
            .filter(|line| line.contains("finer than beam theory"))
            .collect::<Vec<_>>()
    };
    let lines = told(2000);
    assert_eq!(lines.len(), 1, "{lines:?}");
    for part in ["the 2000 elements of rocker", "1/38 of the radius", "4 times as long", "set rocker.elements to 520"] {
        assert!(lines[0].contains(part), "{part}: {lines:?}");
    }
    assert!(told(520).is_empty());
}

/// Every shipped model starts without such a line.
#[test]
fn shipped_models_are_not_too_fine() {
    for entry in std::fs::read_dir(ancf14_testing::root().join("models")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let mut simulation = load(&std::fs::read_to_string(&path).unwrap(), &[]);
            simulation.initialize(0.0).unwrap();
            let warnings = simulation.take_warnings();
            assert!(warnings.iter().all(|line| !line.contains("finer than beam")), "{}: {warnings:?}", path.display());
        }
    }
}
