//! `totals` in `[simulation]` chooses which results of the whole mechanism stand behind those of the outputs. It must
//! change nothing else: a wrong code would shift the columns, compute another motion, or judge errors by other scales.

use ancf14::fmi::Model;
use ancf14::fmi::variable::Causality;
use ancf14::model::simulation::Simulation;
use ancf14_testing::running::{start, value};

const MODEL: &str = include_str!("../../../models/pendulum.toml");

/// The pendulum with a line in its last section, `[simulation]`.
fn with(line: &str) -> Simulation {
    let last = MODEL.rfind("\n[").unwrap();
    assert!(MODEL[last..].starts_with("\n[simulation]"));
    start(&format!("{MODEL}\n{line}\n"))
}

/// The names of the results.
fn names(simulation: &Simulation) -> Vec<&str> {
    let outputs = simulation.variables().iter().filter(|variable| variable.causality == Causality::Output);
    outputs.map(|variable| variable.name.as_str()).collect()
}

/// Nothing is left out by default; a list leaves the order of the others as it is, whatever its own.
#[test]
fn a_list_chooses_the_totals() {
    let all = with("");
    let (all, everything) = (names(&all), with("totals = [\"statistics\", \"energy\", \"momentum\"]"));
    assert_eq!(all, names(&everything));
    for (list, first_words) in
        [("", &[][..]), ("\"momentum\"", &["momentum"]), ("\"statistics\", \"energy\"", &["energy", "statistics"])]
    {
        let some = with(&format!("totals = [{list}]"));
        let is_total = |name: &str| ["energy.", "momentum.", "statistics."].iter().any(|word| name.starts_with(word));
        let wanted =
            all.iter().copied().filter(|name| !is_total(name) || first_words.iter().any(|word| name.starts_with(word)));
        assert_eq!(names(&some), wanted.collect::<Vec<_>>());
    }
}

/// What is left has the same values to the last bit, and the same estimated errors: these are compared with the
/// energies, shown or not.
#[test]
fn totals_change_nothing_else() {
    let (mut all, mut some) = (with(""), with("totals = [\"statistics\"]"));
    for time in [0.05, 0.1, 0.15] {
        all.advance(time).unwrap();
        some.advance(time).unwrap();
        for name in names(&some) {
            assert_eq!(value(&some, name).to_bits(), value(&all, name).to_bits(), "{name} at {time} s");
        }
    }
    assert!(value(&some, "statistics.steps") > 10.0);
    let errors = |simulation: &Simulation| -> Vec<(String, u64)> {
        simulation.estimated_errors().into_iter().map(|own| (own.name, own.error.to_bits())).collect()
    };
    let (mut of_all, of_some) = (errors(&all), errors(&some));
    assert!(of_all.iter().any(|(name, _)| name == "energy"));
    of_all.retain(|(name, _)| name != "energy");
    assert!(!of_some.is_empty());
    assert_eq!(of_all, of_some);
    assert_eq!(all.measures().energy.to_bits(), some.measures().energy.to_bits());
}

/// A state that was saved goes on as it was, also where results have no columns.
#[test]
fn totals_are_not_part_of_a_state() {
    let mut some = with("totals = []");
    some.advance(0.05).unwrap();
    let bytes = some.write(&some.snapshot(), Vec::new());
    some.advance(0.1).unwrap();
    let after: Vec<u64> = (0..some.variables().len()).map(|place| some.value(place).number().to_bits()).collect();
    let saved = some.read(&bytes).unwrap();
    some.restore(&saved);
    some.advance(0.1).unwrap();
    let again: Vec<u64> = (0..some.variables().len()).map(|place| some.value(place).number().to_bits()).collect();
    assert_eq!(after, again);
}
