//! Do `ancf14 reduce` and `ancf14 linearize` pack small FMUs, and refuse what an FMU cannot be?

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

fn ancf14(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ancf14")).current_dir(directory).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

const ARM: &str = r#"format = 1
model = { name = "Arm", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3, mass_damping = 0.5 }
section.rod = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["displacement"] }
simulation = { stop = 1, step = 1e-3 }
"#;

/// A model and a file that has the beginning of a library.
fn folder() -> tempfile::TempDir {
    let directory = tempfile::tempdir().unwrap();
    fs::write(directory.path().join("arm.toml"), ARM).unwrap();
    fs::write(directory.path().join("library.so"), b"\x7fELF\x02\x01 and so on\x03\x00\x3e\x00").unwrap();
    directory
}

/// The names of files stand in the archive as they are.
fn has(archive: &[u8], name: &str) -> bool {
    archive.windows(name.len()).any(|own| own == name.as_bytes())
}

#[test]
fn reduced_systems_are_packed() {
    let directory = folder();
    let common = ["--inputs", "push.force[3]", "--outputs"];
    for (command, fmi, folder) in
        [("reduce", "2", "linux64"), ("reduce", "3", "x86_64-linux"), ("linearize", "2", "linux64")]
    {
        let mut all = vec![command, "arm.toml"];
        all.extend(common);
        all.extend(["tip.displacement[3]", "--fmi", fmi, "--library", "library.so", "-o", "small.fmu"]);
        let output = ancf14(directory.path(), &all);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stdout).contains("small.fmu"), "{}", text(&output.stdout));
        assert!(!text(&output.stderr).contains("amplitude_error"), "{}", text(&output.stderr));
        let archive = fs::read(directory.path().join("small.fmu")).unwrap();
        let library = format!("binaries/{folder}/");
        for name in ["resources/linear.toml", "modelDescription.xml", "documentation/index.html", &library] {
            assert!(has(&archive, name), "{name}");
        }
        assert!(!has(&archive, "resources/model.toml"));
        let again = ancf14(directory.path(), &all);
        assert!(again.status.success() && fs::read(directory.path().join("small.fmu")).unwrap() == archive);
    }
}

/// No amplitude is measured where the arm falls. A warning says so, for FMUs only.
#[test]
fn states_without_an_amplitude_error_are_told() {
    let directory = folder();
    fs::write(directory.path().join("arm.toml"), ARM.replace("gravity = [0, 0, 0]", "gravity = [0, 0, -9.81]"))
        .unwrap();
    for (file, told) in [("small.fmu", true), ("small.npz", false)] {
        let mut all = vec!["reduce", "arm.toml", "--inputs", "push.force[3]", "--outputs", "tip.displacement[3]"];
        all.extend(["-o", file]);
        all.extend(if told { &["--library", "library.so"][..] } else { &[] });
        let output = ancf14(directory.path(), &all);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let words = "warning: the FMU has no amplitude_error: the mechanism moves";
        assert_eq!(text(&output.stderr).contains(words), told, "{}", text(&output.stderr));
    }
}

#[test]
fn mistakes_are_told() {
    let directory = folder();
    for (arguments, code, expected) in [
        (
            &["linearize", "arm.toml", "--set", "arm.elements=40", "-o", "m.fmu", "--library", "library.so"][..],
            1,
            "an FMU can have at most 300",
        ),
        (&["reduce", "arm.toml", "-o", "m.fmu", "--library", "nothing.so"], 2, "nothing.so"),
        (&["reduce", "arm.toml", "-o", "m.fmu", "--fmi", "4"], 2, "2 or 3 was expected"),
        (&["reduce", "arm.toml", "-o", "m.fmi"], 2, "ends in .npz, .mat, .json, .mo or .fmu"),
    ] {
        let output = ancf14(directory.path(), arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
        assert!(!directory.path().join("m.fmu").exists(), "{arguments:?}");
    }
    let library = fs::hard_link(directory.path().join("library.so"), directory.path().join("own.fmu"));
    library.unwrap();
    let output = ancf14(directory.path(), &["reduce", "arm.toml", "-o", "own.fmu", "--library", "library.so"]);
    assert!(
        output.status.code() == Some(2) && text(&output.stderr).contains("is a library to pack"),
        "{}",
        text(&output.stderr)
    );
}

/// A flat shaft in round bearings: its matrices stand still in the frame that turns.
const SHAFT: &str = r#"format = 1
model = { name = "Shaft", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-4 }
section.flat = { shape = "rectangle", width = 0.02, height = 0.01 }
beam.shaft = { material = "steel", section = "flat", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.motor = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.bearing = { type = "cylindrical", a = "ground", b = "shaft.end", axis = [1, 0, 0] }
drive.spin = { joint = "motor", coordinate = "angle", value = "10*t" }
load.push = { at = "shaft@0.5", force = [0, 0, 0], input = true }
output.middle = { at = "shaft@0.5", quantities = ["displacement"] }
simulation = { stop = 1, step = 1e-3 }
"#;

/// A system in the frame that turns has the matrices of one position: a file may have them, an FMU would turn on.
#[test]
fn systems_that_turn_are_no_units() {
    let directory = folder();
    fs::write(directory.path().join("shaft.toml"), SHAFT).unwrap();
    let arguments = ["linearize", "shaft.toml", "--steady", "spin=20", "-o"];
    let output = ancf14(directory.path(), &[&arguments[..], &["m.fmu", "--library", "library.so"]].concat());
    assert!(!output.status.success() && !directory.path().join("m.fmu").exists());
    assert!(text(&output.stderr).contains("in the frame that turns"), "{}", text(&output.stderr));
    let output = ancf14(directory.path(), &[&arguments[..], &["m.json"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
}
