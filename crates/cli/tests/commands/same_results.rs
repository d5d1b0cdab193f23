//! Does `ancf14::Simulation` compute what `ancf14 run` computes? A second way to the same solver must not have its own
//! steps, its own rows or its own warnings: numbers are compared to the last bit, warnings word by word.

use std::fs;
use std::process::Command;

use ancf14::Simulation;
use ancf14_testing::root;

/// Rows, columns and warnings of a model that warns at its start and at its end.
#[test]
fn results_are_those_of_the_command() {
    let overrides = ["simulation.stop=0.05", "arm.elements=5"];
    let file = root().join("models/cantilever.toml");
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
    command.current_dir(folder.path()).arg("run").arg(&file).args(["-o", "results"]);
    overrides.iter().for_each(|one| _ = command.args(["--set", one]));
    let ran = command.output().unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let pairs: Vec<(&str, &str)> = overrides.iter().map(|one| one.split_once('=').unwrap()).collect();
    let mut simulation = Simulation::open_with(&file, &pairs).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    let results = simulation.record(&[]).unwrap();

    let table = fs::read_to_string(folder.path().join("results/results.csv")).unwrap();
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().unwrap().split(',').collect();
    let rows: Vec<Vec<f64>> = lines.map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 11);
    assert_eq!(results.time(), rows.iter().map(|row| row[0]).collect::<Vec<f64>>());
    assert_eq!(results.columns().count(), header.len() - 1);
    for ((name, values), place) in results.columns().zip(1..) {
        assert_eq!(name, header[place].trim_matches('"'));
        assert_eq!(values, rows.iter().map(|row| row[place]).collect::<Vec<f64>>(), "{name}");
        assert_eq!(results.column(name), Some(values));
    }
    assert_eq!(results.column("nobody"), None);

    let complaints = String::from_utf8(ran.stderr).unwrap();
    let told: Vec<&str> = complaints.lines().filter_map(|line| line.strip_prefix("warning: ")).collect();
    assert!(!told.is_empty(), "the model warns of something");
    assert_eq!(simulation.take_warnings(), told);
    assert_eq!(simulation.take_warnings(), Vec::<String>::new());
}
