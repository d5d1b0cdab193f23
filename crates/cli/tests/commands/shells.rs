//! What programs and shells get: documents, pipes, completions, manual pages. A field that is lost, a line beside the
//! document or a command without its page shows.

use crate::command_line::{ancf14, model, text};
use crate::printed;
use serde_json::Value;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Three mistakes, the first in line 4.
const MISTAKEN: &str = r#"format = 1
model = { name = "Bad" }
simulation = { stop = 1 }
material.steel = { young = -1, poisson = 0.3, density = 7850 }
section.rod = { shape = "circle", radius = 0.01 }
beam.arm = { material = "stel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 0 }
"#;

fn document(ran: &Output) -> Value {
    assert!(ran.stderr.is_empty(), "{}", text(&ran.stderr));
    serde_json::from_slice(&ran.stdout).unwrap_or_else(|reason| panic!("{reason}: {}", text(&ran.stdout)))
}

/// Runs the program with a model on its standard input.
fn piped(directory: &Path, model: &str, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
    let command = command.current_dir(directory).args(arguments).stdin(Stdio::piped());
    let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(model.as_bytes()).unwrap();
    child.wait_with_output().unwrap()
}

/// The variables are those of the table.
#[test]
fn check_lists_variables_for_programs() {
    let directory = tempfile::tempdir().unwrap();
    let file = model("crane");
    let table = printed(&ancf14(directory.path(), &["check", &file]));
    let ran = ancf14(directory.path(), &["check", &file, "--json"]);
    assert!(ran.status.success());
    let document = document(&ran);
    assert!(document["format"] == 1 && document["model"] == "Crane" && document["stop"].is_f64());
    assert_eq!(document["errors"].as_array().unwrap().len(), 0);
    let variables = document["variables"].as_array().unwrap();
    let rows: Vec<&str> = table.lines().skip(1).take(variables.len()).collect();
    assert!(variables.len() > 50);
    for (row, variable) in rows.iter().zip(variables) {
        let cells: Vec<&str> = row.split_whitespace().collect();
        assert_eq!(cells[0], variable["reference"].to_string());
        assert_eq!(cells[1..4], ["name", "causality", "variability"].map(|key| variable[key].as_str().unwrap()));
        assert!(row.ends_with(variable["description"].as_str().unwrap()) && variable["unit"].is_string());
        assert_eq!(variable["start"].is_null(), ["output", "independent"].contains(&cells[2]), "{row}");
    }
}

#[test]
fn mistakes_have_their_places() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("bad.toml"), MISTAKEN).unwrap();
    for command in [
        &["check", "bad.toml", "--json"][..],
        &["run", "bad.toml", "--json"],
        &["pack", "bad.toml", "-o", "a.fmu", "--json"],
    ] {
        let ran = ancf14(directory.path(), command);
        assert_eq!(ran.status.code(), Some(2));
        let document = document(&ran);
        let errors = document["errors"].as_array().unwrap();
        let lines: Vec<_> = errors.iter().map(|error| error["line"].as_u64().unwrap()).collect();
        assert_eq!(lines, [4, 6, 6], "{document:#}");
        let first = &errors[0];
        assert!(
            first["column"] == 28
                && first["location"] == "bad.toml:4:28"
                && first["message"].as_str().unwrap().contains("steel.young")
        );
        assert_eq!(first["excerpt"], MISTAKEN.lines().nth(3).unwrap());
        assert!(errors.iter().any(|error| error["label"] == "did you mean `steel`?"));
    }
}

#[test]
fn errors_without_a_place_and_warnings_are_in_the_document() {
    let directory = tempfile::tempdir().unwrap();
    let ran = ancf14(directory.path(), &["run", "nothing.toml", "--json"]);
    let missing = document(&ran);
    assert!(ran.status.code() == Some(2) && missing["errors"][0]["line"].is_null());
    assert!(missing["errors"][0]["message"].as_str().unwrap().starts_with("cannot read nothing.toml"));
    let file = model("cantilever");
    let told = document(&ancf14(
        directory.path(),
        &["run", &file, "--json", "--set", "simulation.stop=0.002", "--set", "simulation.step=1e-3"],
    ));
    assert!(told["warnings"][0].as_str().unwrap().contains("simulation.step"), "{told:#}");
}

/// The frequencies are those of modes.csv.
#[test]
fn modes_are_listed_for_programs() {
    let directory = tempfile::tempdir().unwrap();
    let file = model("cantilever");
    let document = document(&ancf14(directory.path(), &["modes", &file, "--count", "3", "-o", "out", "--json"]));
    let table = std::fs::read_to_string(directory.path().join("out/modes.csv")).unwrap();
    let modes = document["modes"].as_array().unwrap();
    assert_eq!(modes.len(), 3);
    for (row, mode) in table.lines().skip(1).zip(modes) {
        let cells: Vec<&str> = row.split(',').collect();
        assert_eq!(cells[1], mode["kind"].as_str().unwrap());
        for (cell, key) in cells[2..8].iter().zip([
            "frequency",
            "angular_frequency",
            "growth_rate",
            "eigenvalue",
            "modal_mass",
            "damping_ratio",
        ]) {
            // The reader of JSON here may miss the last bit.
            let (own, told) = (cell.parse::<f64>().unwrap(), mode[key].as_f64().unwrap());
            assert!((own - told).abs() <= 2.0 * f64::EPSILON * own.abs(), "{key}: {own} {told}");
        }
    }
}

#[test]
fn quiet_commands_say_nothing() {
    let directory = tempfile::tempdir().unwrap();
    let file = model("four_bar");
    let short = ["--set", "simulation.stop=0.05"];
    let run = ancf14(directory.path(), &[&["run", "--quiet", &file], &short[..]].concat());
    assert!(run.status.success() && run.stdout.is_empty());
    assert!(directory.path().join("four_bar-results/results.csv").is_file());
    let check = ancf14(directory.path(), &["check", "-q", &file]);
    assert!(check.status.success() && check.stdout.is_empty());
    assert!(printed(&ancf14(directory.path(), &["check", "-q", "--resolved", &file])).contains("[model]"));
}

/// A model from a pipe gives the bytes of the model from the file.
#[test]
fn models_come_from_pipes() {
    let directory = tempfile::tempdir().unwrap();
    let file = model("cantilever");
    let short = ["--set", "simulation.stop=0.02"];
    printed(&ancf14(directory.path(), &[&["run", &file], &short[..]].concat()));
    let stdin = std::fs::read_to_string(&file).unwrap();
    printed(&piped(directory.path(), &stdin, &[&["run", "-"], &short[..]].concat()));
    let read = |folder: &str| std::fs::read(directory.path().join(folder).join("results.csv")).unwrap();
    assert_eq!(read("cantilever-results"), read("model-results"));
    let refused = piped(directory.path(), MISTAKEN, &["check", "-"]);
    assert!(refused.status.code() == Some(2) && text(&refused.stderr).contains("--> standard input:4:28"));
    let part = MISTAKEN
        .replace("young = -1", "young = 2e11")
        .replace("\"stel\"", "\"steel\"")
        .replace("elements = 0", "elements = 2");
    let part: Vec<&str> =
        part.lines().filter(|line| !line.starts_with("model") && !line.starts_with("simulation")).collect();
    std::fs::write(directory.path().join("part.toml"), part.join("\n")).unwrap();
    let whole = "format = 1\nmodel = { name = \"Whole\" }\nsimulation = { stop = 1 }\ninclude.wing = { file = \"part.toml\" }\n";
    assert!(printed(&piped(directory.path(), whole, &["check", "-"])).contains("standard input: no mistakes"));
    // These commands load the model twice.
    let twice: [&[&str]; 2] = [&["linearize", "-", "--at", "equilibrium"], &["export", "-", "--vtk", "out"]];
    for words in twice {
        let free = stdin.replace("elements", "# elements");
        printed(&piped(directory.path(), &free, &[words, &short].concat()));
    }
}

/// Every command has its page and is completed.
#[test]
fn shells_and_manuals_know_all_commands() {
    let directory = tempfile::tempdir().unwrap();
    printed(&ancf14(directory.path(), &["man", "pages"]));
    let help = printed(&ancf14(directory.path(), &["--help"]));
    assert!(help.contains("share/doc/ancf14/book/index.html"), "{help}");
    let commands: Vec<&str> = help
        .lines()
        .skip_while(|line| *line != "Commands:")
        .skip(1)
        .map_while(|line| line.split_whitespace().next())
        .collect();
    assert!(commands.len() > 8, "{help}");
    let completed = ["bash", "zsh", "fish"].map(|shell| printed(&ancf14(directory.path(), &["completions", shell])));
    for command in commands.iter().filter(|command| **command != "help") {
        let page = std::fs::read_to_string(directory.path().join(format!("pages/ancf14-{command}.1"))).unwrap();
        assert!(page.contains(&format!("\\fBancf14 {command}\\fR")), "{page}");
        assert!(completed.iter().all(|text| text.contains(command)), "{command}");
    }
}
