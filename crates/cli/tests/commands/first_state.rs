//! `simulation.from_state`: a model file names the state that it begins with. The program, a program in Rust and an FMU
//! must begin with the same bits as `--from-state`, and each mistake must be told with the place of the name.

use crate::printed;
use crate::stages::{MODEL, column, rows, run};
use ancf14::fmi::Model;
use ancf14::fmi::instance::Instance;
use ancf14::fmi::location::{MODEL_FILE, STATE_FILE};
use ancf14::model::file::{Folder, Reach};
use ancf14::model::simulation::Simulation;
use std::fs;
use std::path::Path;

/// The strip without its load, and with a stiffer spring.
fn other() -> String {
    MODEL.replace("-2*t/0.1", "0").replace("stiffness = 50", "stiffness = 60")
}

/// A model that begins with the file `state`.
fn named(model: &str) -> String {
    format!("{model}from_state = \"state\"\n")
}

/// The state of half a run, in `state`.
fn keep(folder: &Path) {
    printed(&run(folder, MODEL, "first", &["--set", "simulation.stop=0.1", "--save-state", "state"]));
}

const COLUMNS: [&str; 4] = ["tip.displacement[3]", "tip.velocity[3]", "tip.acceleration[3]", "rail.distance"];

#[test]
fn all_ways_begin_with_the_same_bits() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    keep(folder);
    printed(&run(folder, &other(), "given", &["--from-state", "state"]));
    let said = printed(&run(folder, &named(&other()), "named", &[]));
    assert!(said.starts_with("begins with the state of state, as the model file says\n"), "{said}");
    let [given, by_name] = ["given", "named"].map(|out| rows(folder, out));
    assert_eq!(given, by_name);
    assert_eq!(column(&given, "time")[..2], [0.1, 0.105]);
    // A program in Rust, and through the same functions C and Python.
    let mut simulation = ancf14::Simulation::open(folder.join("m.toml")).unwrap();
    let results = simulation.record(&COLUMNS).unwrap();
    // The library of an FMU, in its resources.
    let resources = folder.join("resources");
    fs::create_dir(&resources).unwrap();
    fs::write(resources.join(MODEL_FILE), named(&other())).unwrap();
    fs::copy(folder.join("state"), resources.join(STATE_FILE)).unwrap();
    let model = Simulation::load_packed(&resources, MODEL_FILE, &named(&other())).unwrap();
    let references =
        COLUMNS.map(|name| model.variables().iter().position(|variable| variable.name == name).unwrap() as u32);
    let mut unit = Instance::new(model, false);
    unit.setup_experiment(None, 0.1, None).unwrap();
    unit.enter_initialization_mode().unwrap();
    unit.exit_initialization_mode().unwrap();
    for row in 0..=20 {
        let mut values = [0.0; 4];
        unit.get_real(&references, &mut values).unwrap();
        for (place, name) in COLUMNS.into_iter().enumerate() {
            let expected = column(&given, name)[row];
            assert_eq!(values[place], expected, "{name} in row {row}");
            assert_eq!(results.column(name).unwrap()[row], expected, "{name} in row {row}");
        }
        let [from, to] = [20 + row, 21 + row].map(|row| row as f64 * 0.005);
        unit.do_step(if row == 0 { 0.1 } else { from }, to - if row == 0 { 0.1 } else { from }).unwrap();
    }
}

/// A host that starts at another time is told so; after a reset the model begins with the state again.
#[test]
fn units_begin_at_the_time_of_their_state() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    keep(folder);
    let mut model =
        Simulation::load_in(Some(Folder::new(folder, Reach::Inside)), "m.toml", &named(&other()), &[]).unwrap();
    assert_eq!(model.about().start, 0.1);
    let plain = Simulation::load_in(Some(Folder::new(folder, Reach::Inside)), "m.toml", &other(), &[]).unwrap();
    assert_ne!(model.about().guid, plain.about().guid);
    let refused = model.initialize(0.0).err().unwrap().message;
    assert!(refused.contains("at t = 0.1 s, and cannot start at t = 0 s"), "{refused}");
    model.initialize(0.1).unwrap();
    model.advance(0.15).unwrap();
    model.reset();
    model.initialize(0.1).unwrap();
    assert_eq!(model.time(), 0.1);
}

/// Each mistake is told where the file names the state, and nothing is computed.
#[test]
fn mistakes_of_the_state_are_those_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    keep(folder);
    let refused = |model: &str, arguments: &[&str], texts: &[&str]| {
        let ran = run(folder, model, "refused", arguments);
        let message = String::from_utf8_lossy(&ran.stderr).into_owned();
        println!("{message}");
        assert_eq!(ran.status.code(), Some(2), "{message}");
        texts.iter().for_each(|text| assert!(message.contains(text), "{message}"));
        assert!(!folder.join("refused/results.csv").exists());
    };
    let place = "from_state = \"state\"";
    refused(&named(&MODEL.replace("elements = 4", "elements = 5")), &[], &["the state has beam strip with 4", place]);
    refused(&named(MODEL), &["--set", "simulation.stop=0.1"], &["the run ends at 0.1 s", "to a later time", place]);
    refused(&named(MODEL), &["--from-state", "state"], &["a run begins with one state. Leave out one of the two"]);
    refused(&named(MODEL), &["--verify"], &["a run that begins with a state cannot be verified"]);
    refused(&named(MODEL), &["--save-state", "state"], &["choose another name to write to"]);
    refused(&named(MODEL).replace("\"state\"", "\"missing\""), &[], &["cannot read missing", "relative to the folder"]);
    refused(&named(MODEL).replace("\"state\"", "\"m.toml\""), &[], &["`m.toml` is not the state of a run"]);
    refused(
        &named(MODEL).replace("[simulation]", "[simulation]\ninitial = \"equilibrium\""),
        &[],
        &["both say what the motion begins with", "remove it"],
    );
    let memory = ancf14::Simulation::from_text("m.toml", &named(MODEL)).err().unwrap().to_string();
    assert!(memory.contains("this model is a text without a folder"), "{memory}");
    let mut damaged = fs::read(folder.join("state")).unwrap();
    *damaged.last_mut().unwrap() ^= 1;
    fs::write(folder.join("state"), damaged).unwrap();
    refused(&named(MODEL), &[], &["its checksum is wrong, the file is damaged", place]);
}
