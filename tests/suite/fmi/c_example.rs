//! Does the C example build with our header and run a packed model to the same numbers as the safe interface gives?

use std::{
    fs,
    io::Cursor,
    path::{Path, PathBuf},
    process::Command,
};

use ancf14::{
    fmi::{Model, Value, header, instance::Instance, package, variable::Causality},
    model::simulation::Simulation,
};
use tempfile::TempDir;

use super::ffi::{MODEL, library_path};

/// The example and an unpacked unit side by side.
fn build() -> (TempDir, PathBuf) {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let directory = tempfile::tempdir().unwrap();
    let here = directory.path();
    let model = Simulation::load("model.toml", MODEL, &[]).unwrap();
    let library = fs::read(library_path()).unwrap();
    let contents = package::Contents { model: MODEL, licences: "", icon: &[], drawing: "", legend: "" };
    let fmu =
        package::fmu(model.about(), model.variables(), &contents, &[(package::Platform::NATIVE, library)]).unwrap();
    zip::ZipArchive::new(Cursor::new(fmu)).unwrap().extract(here.join("unit")).unwrap();
    fs::write(here.join("model.h"), header::text(model.about(), model.variables(), "MODEL").unwrap()).unwrap();
    fs::copy(library_path(), here.join(package::LIBRARY)).unwrap();
    let built = Command::new("cc")
        .current_dir(here)
        .args(["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic", "-I.", "-L.", "-o", "simulate"])
        .arg(format!("-I{}", root.join("include").display()))
        .arg(root.join("c-examples/simulate.c"))
        .args(["-lancf14", &format!("-Wl,-rpath,{}", here.display())])
        .output()
        .unwrap();
    assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
    let program = here.join("simulate");
    (directory, program)
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
    let (directory, program) = build();
    // Cargo names folders there that may hold an older library.
    let ran = Command::new(program)
        .env_remove("LD_LIBRARY_PATH")
        .arg(directory.path().join("unit/resources"))
        .output()
        .unwrap();
    assert!(ran.status.success(), "{}", String::from_utf8_lossy(&ran.stderr));
    assert_eq!(String::from_utf8_lossy(&ran.stderr), "");
    let table = String::from_utf8(ran.stdout).unwrap();
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
    let (directory, program) = build();
    let ran =
        Command::new(&program).env_remove("LD_LIBRARY_PATH").arg(directory.path().join("missing")).output().unwrap();
    assert!(!ran.status.success());
    assert!(String::from_utf8_lossy(&ran.stderr).contains("simulate [logStatusError] fmi2Instantiate: cannot read"));
    assert!(!Command::new(&program).env_remove("LD_LIBRARY_PATH").output().unwrap().status.success());
}
