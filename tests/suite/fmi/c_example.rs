//! Do the C examples build with our header, run a unit to the same numbers as the safe interface gives, and give back
//! all memory?

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use ancf14::{
    fmi::{Model, Value, header, instance::Instance, location, variable::Causality},
    model::simulation::Simulation,
};
use tempfile::TempDir;

use super::ffi::MODEL;
use super::library_path;

/// The model of all examples but `simulate_fmi2.c`, which takes any.
const ARM: &str = include_str!("../../../c-examples/arm.toml");

/// An example, built, and the resources of a unit beside it.
struct Example {
    directory: TempDir,
    program: PathBuf,
}

impl Example {
    /// Example `name`, with `text` as its model, whose header has names that begin with `prefix`.
    fn build(name: &str, text: &str, prefix: &str) -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        let directory = tempfile::tempdir().unwrap();
        let here = directory.path();
        let model = Simulation::load("model.toml", text, &[]).unwrap();
        fs::create_dir_all(here.join("unit/resources")).unwrap();
        fs::write(here.join("unit/resources").join(location::MODEL_FILE), text).unwrap();
        let header = here.join(format!("{}.h", prefix.to_lowercase()));
        fs::write(header, header::text(model.about(), model.variables(), prefix).unwrap()).unwrap();
        fs::copy(library_path(), here.join(location::LIBRARY)).unwrap();
        let built = Command::new("cc")
            .current_dir(here)
            .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-I.", "-L.", "-o", name])
            .args(["include", "c-examples/fmi3"].map(|folder| format!("-I{}", root.join(folder).display())))
            .arg(root.join(format!("c-examples/{name}.c")))
            .args(["-lancf14", "-lm", &format!("-Wl,-rpath,{}", here.display())])
            .output()
            .unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        let program = here.join(name);
        Self { directory, program }
    }

    fn resources(&self) -> PathBuf {
        self.directory.path().join("unit/resources")
    }

    /// The resources and `words`, as the words of a command that runs in the example's directory.
    fn command(&self, mut command: Command, words: &[&str]) -> Output {
        // Cargo names folders there that may hold an older library.
        let command = command.env_remove("LD_LIBRARY_PATH").current_dir(self.directory.path());
        command.arg(self.resources()).args(words).output().unwrap()
    }

    /// What it prints, from a run that says nothing else.
    fn printed(&self, words: &[&str]) -> String {
        printed(&self.command(Command::new(&self.program), words))
    }

    /// The same under valgrind, which finds no wrong access to memory and nothing that was not given back.
    fn printed_under_valgrind(&self, words: &[&str]) -> String {
        let version = Command::new("valgrind").arg("--version").output();
        assert!(version.is_ok(), "valgrind is missing, which this test needs: `sh scripts/tools.sh` installs it");
        let mut valgrind = Command::new("valgrind");
        valgrind.args(["--quiet", "--error-exitcode=99", "--leak-check=full", "--show-leak-kinds=all"]);
        valgrind.args(["--errors-for-leak-kinds=all"]).arg(&self.program);
        printed(&self.command(valgrind, words))
    }
}

/// What a program printed that succeeded and did not complain, but for the accuracy of a short run.
fn printed(ran: &Output) -> String {
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    let complaints = String::from_utf8_lossy(&ran.stderr);
    let mut others = complaints.lines().filter(|line| !line.contains("because of the length of the steps"));
    assert_eq!(others.next(), None);
    String::from_utf8(ran.stdout.clone()).unwrap()
}

/// A row of the table as the safe interface has it.
fn row(instance: &mut Instance<Simulation>) -> Vec<f64> {
    let variables = instance.model().variables();
    let mut outputs: Vec<usize> =
        (0..variables.len()).filter(|place| variables[*place].causality == Causality::Output).collect();
    outputs.sort_by_key(|place| matches!(variables[*place].start, Value::Integer(_))); // Reals first, as in the example
    let values = outputs.into_iter().map(|place| instance.model().value(place).number());
    std::iter::once(instance.time()).chain(values).collect()
}

/// Every number of the table, to the last bit.
#[test]
fn the_example_prints_what_the_model_computes() {
    let example = Example::build("simulate_fmi2", MODEL, "MODEL");
    let table = example.printed(&[]);
    assert_eq!(example.printed_under_valgrind(&[]), table);
    let mut lines = table.lines();
    assert!(lines.next().unwrap().starts_with("time,"));
    let mut instance = Instance::new(Simulation::load("model.toml", MODEL, &[]).unwrap(), false);
    instance.enter_initialization_mode().unwrap();
    instance.exit_initialization_mode().unwrap();
    let mut rows = 0;
    for line in lines {
        let printed: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        if rows > 0 {
            let time = instance.time();
            instance.do_step(time, printed[0] - time).unwrap();
        }
        assert_eq!(printed, row(&mut instance), "row {rows}");
        rows += 1;
    }
    assert_eq!(rows, 11, "0 to 0.1 s in steps of 0.01 s, both ends included");
}

/// Errors end the program with the library's reason on stderr.
#[test]
fn the_example_reports_errors() {
    let Example { directory, program } = Example::build("simulate_fmi2", MODEL, "MODEL");
    let ran =
        Command::new(&program).env_remove("LD_LIBRARY_PATH").arg(directory.path().join("missing")).output().unwrap();
    assert!(!ran.status.success());
    assert!(String::from_utf8_lossy(&ran.stderr).contains("simulate [logStatusError] fmi2Instantiate: cannot read"));
    assert!(!Command::new(&program).env_remove("LD_LIBRARY_PATH").output().unwrap().status.success());
}

/// The example itself compares the bits of repeated steps; here those of a new process too.
#[test]
fn saved_states_go_on_in_the_example() {
    let example = Example::build("save_and_restore", ARM, "ARM");
    let state = ["state.bin"];
    let go_on = ["state.bin", "go-on"];
    let text = example.printed(&state) + &example.printed(&go_on);
    let tips: Vec<&str> = text.lines().map(|line| line.split_once(": tip at ").unwrap().1).collect();
    assert_eq!(tips.len(), 4, "{text}");
    assert!(tips.iter().all(|tip| *tip == tips[0]), "{text}");
    assert_eq!(example.printed_under_valgrind(&state) + &example.printed_under_valgrind(&go_on), text);
}

/// The example itself compares an instance beside another one with the same alone.
#[test]
fn instances_of_the_example_do_not_meet() {
    let example = Example::build("two_instances", ARM, "ARM");
    let table = example.printed(&[]);
    assert_eq!(table.lines().count(), 11, "{table}");
    assert_eq!(example.printed_under_valgrind(&[]), table);
}

/// The example itself compares the unit's derivatives with differences.
#[test]
fn derivatives_of_the_example_are_those_of_differences() {
    let example = Example::build("jacobian", ARM, "ARM");
    let table = example.printed(&[]);
    assert_eq!(table.lines().count(), 10, "{table}");
    assert_eq!(example.printed_under_valgrind(&[]), table);
}

/// The host of FMI 3.0 returns early once, at the internal step where the tip has passed the height, and goes on from
/// there.
#[test]
fn a_step_of_the_example_returns_early() {
    let example = Example::build("simulate_fmi3", ARM, "ARM");
    let resources = format!("{}/", example.resources().display());
    let mut command = Command::new(&example.program);
    command.env_remove("LD_LIBRARY_PATH").arg(&resources);
    let table = printed(&command.output().unwrap());
    assert_eq!(example.printed_under_valgrind(&[]), table);
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect()).collect();
    assert_eq!(rows.len(), 7, "0 to 0.05 s in steps of 0.01 s, and one early return: {table}");
    let early: Vec<usize> = (0..rows.len()).filter(|row| rows[*row][1] == 1.0).collect();
    let [early] = early[..] else { panic!("{table}") };
    assert!(rows[early - 1][2] >= -1e-3 && rows[early][2] < -1e-3, "{table}");
    // A multiple of the internal step of 2 ms, to the rounding of its time.
    let steps = rows[early][0] / 2e-3;
    assert!((steps - steps.round()).abs() < 1e-9 && rows[early][0] % 1e-2 > 1e-3, "{table}");
}
