//! Does `tune` write the numbers that the runs of a model have found, and nothing else, and does a run of that file give
//! their results? `pack` and `header` must take the same numbers: a host compares the GUIDs of both.

use super::command_line::{ancf14, text};
use super::view_command::solver;
use std::fs;
use std::path::Path;

/// A rod whose end is pushed aside: 8 elements are right to 0.5 %.
const ROD: &str = "format = 1\n[model]\nname = \"Rod\"\n\n[material.steel]\nyoung = 2.1e11\npoisson = 0.3\ndensity = 7850\n\
    [section.rod]\nshape = \"circle\"\nradius = 0.01\n\n[beam.arm] # the rod\nmaterial = \"steel\"\nsection = \"rod\"\n\
    from = [0, 0, 0]\nto = [1, 0, 0] # m\n\n[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\n\
    [load.push]\nat = \"arm.end\"\nforce = [0, 0, \"500*t\"]\n\n[output.tip]\nat = \"arm.end\"\n\
    quantities = [\"displacement\"]\n\n[simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.25\n";

fn done(directory: &Path, words: &[&str]) -> String {
    let output = ancf14(directory, words);
    assert!(output.status.success(), "{}", text(&output.stderr));
    text(&output.stdout).to_owned()
}

/// The copy differs from the file by two lines, and both give the same rows in every bit.
#[test]
fn a_tuned_file_gives_the_rows_of_the_finest_run() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("m.toml"), ROD).unwrap();
    let told = done(path, &["tune", "m.toml"]);
    assert!(told.contains("1 run, 8 elements, accuracy reached: ") && told.contains("bit-identical"), "{told}");
    assert!(told.contains("m.tuned.toml: arm.elements = 8\n"), "{told}");
    let header = "[beam.arm] # the rod\n";
    let wanted = ROD.replace(header, &format!("{header}elements = 8\ntwist = \"quadratic\"\n"));
    assert_eq!(fs::read_to_string(path.join("m.tuned.toml")).unwrap(), wanted);
    done(path, &["run", "m.toml", "-o", "own"]);
    done(path, &["run", "m.tuned.toml", "-o", "tuned"]);
    let rows = |folder: &str| fs::read(path.join(folder).join("results.csv")).unwrap();
    assert!(rows("own") == rows("tuned"));
}

/// A mass on springs, whose first run takes steps as long as its rows let them be.
const MOUNT: &str = "format = 1\n[model]\nname = \"Mount\"\ngravity = [0, 0, -9.81]\n\
    [body.mass]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
    [joint.mount]\ntype = \"bushing\"\na = \"ground\"\nb = \"mass\"\nstiffness = [1e2, 1e2, 1e2]\n\
        rotational_stiffness = [1e2, 1e2, 1e2]\n[output.motion]\nat = \"mass\"\nquantities = [\"position\"]\n\
    [simulation]\nstop = 5\noutput_step = 0.25\naccuracy = 0.03 # coarse\n";

/// Steps that are divided are written as an accuracy and as their longest one. The accuracy of the file is replaced
/// where it stands. The steps end elsewhere, and the command says by how much results differ. A file that gives
/// everything, and a pipe, are refused.
#[test]
fn divided_steps_become_an_accuracy() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let mount = MOUNT;
    fs::write(path.join("m.toml"), mount).unwrap();
    let output = ancf14(path, &["tune", "m.toml", "-o", "t.toml"]);
    let told = text(&output.stdout).to_owned() + &text(&output.stderr);
    assert!(
        output.status.success() && told.contains("a run of this file differs from the finest run by about 0."),
        "{told}"
    );
    let tuned = fs::read_to_string(path.join("t.toml")).unwrap();
    let line = tuned.lines().last().unwrap();
    let number = line.strip_prefix("accuracy = ").and_then(|rest| rest.strip_suffix(" # coarse")).unwrap();
    let accuracy: f64 = number.parse().unwrap();
    assert!(tuned.lines().count() == mount.lines().count() + 1 && accuracy <= 0.03 / 4.0, "{tuned}");
    fs::write(path.join("given.toml"), mount.replace("accuracy = 0.03 # coarse", "step = 0.01")).unwrap();
    for (file, reason) in [("given.toml", "tune has nothing to find"), ("-", "not a pipe")] {
        let refused = ancf14(path, &["tune", file, "-o", "x.toml"]);
        assert!(refused.status.code() == Some(2) && text(&refused.stderr).contains(reason), "{refused:?}");
        assert!(!path.join("x.toml").exists());
    }
}

/// Rows that bound the steps of the first run do not bound those of the file: its longest step is that of the finest
/// run.
#[test]
fn steps_that_rows_bound_are_divided() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    let mount =
        MOUNT.replace("stop = 5\noutput_step = 0.25\naccuracy = 0.03", "stop = 2\noutput_step = 0.02\naccuracy = 0.1");
    fs::write(path.join("m.toml"), mount).unwrap();
    // The file would be off by ten times as much if it had no longest step.
    let told = done(path, &["tune", "m.toml", "-o", "t.toml"]);
    let distance = told.split("finest run by about ").nth(1).and_then(|rest| rest.split(' ').next());
    assert!(distance.unwrap().parse::<f64>().unwrap() < 0.05, "{told}");
    let tuned = fs::read_to_string(path.join("t.toml")).unwrap();
    let (longest, parts): (f64, f64) = match tuned.lines().find_map(|line| line.strip_prefix("longest_step = ")) {
        Some(number) => (number.parse().unwrap(), 0.02 / number.parse::<f64>().unwrap()),
        None => panic!("{tuned}"),
    };
    assert!(longest <= 0.01 && (parts - parts.round()).abs() < 1e-9, "{tuned}");
}

/// A unit has the elements that were found, and a header the GUID of that unit: that of the tuned file. Meshes stay as
/// they begin where that is asked for.
#[test]
fn units_have_the_elements_that_were_found() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("m.toml"), ROD).unwrap();
    fs::write(path.join("library.so"), b"\x7fELF\x02\x01 and so on\x03\x00\x3e\x00").unwrap();
    let pack = ["pack", "m.toml", "-o", "m.fmu", "--library", "library.so"];
    let told = done(path, &pack);
    assert!(told.contains("found with the model's own loads and drives: arm.elements = 8 (1 run, "), "{told}");
    assert!(!done(path, &[&pack[..], &["--no-refine"]].concat()).contains("found with"));
    done(path, &["tune", "m.toml", "-o", "t.toml"]);
    let header = |file: &str, more: &[&str]| {
        done(path, &[&["header", file, "-o", "m.h"], more].concat());
        fs::read_to_string(path.join("m.h")).unwrap()
    };
    let own = header("m.toml", &[]);
    assert_eq!(own, header("t.toml", &[]));
    assert_ne!(own, header("m.toml", &["--no-refine"]));
}

/// Numbers that inputs ask for are found with a table of them: a force that bends a rod to a hook, where the start value
/// of the input leaves it straight. A mistake of the table ends the command, and writes nothing.
#[test]
fn inputs_of_a_table_ask_for_elements() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("m.toml"), ROD.replace("force = [0, 0, \"500*t\"]", "force = [0, 0, 0]\ninput = true"))
        .unwrap();
    fs::write(path.join("push.csv"), "time,push.force[3]\n0,0\n1,3e5\n").unwrap();
    fs::write(path.join("bad.csv"), "time,pull.force[3]\n0,0\n1,3e5\n").unwrap();
    fs::write(path.join("library.so"), b"\x7fELF\x02\x01 and so on\x03\x00\x3e\x00").unwrap();
    let pack = ["pack", "m.toml", "-o", "m.fmu", "--library", "library.so"];
    assert!(done(path, &pack).contains("arm.elements = 8 (1 run, "));
    let told = done(path, &[&pack[..], &["--inputs", "push.csv"]].concat());
    assert!(told.contains("found with push.csv: arm.elements = 16 (2 runs, "), "{told}");
    let tuned = done(path, &["tune", "m.toml", "-o", "t.toml", "--inputs", "push.csv"]);
    assert!(tuned.contains("t.toml: arm.elements = 16\n"), "{tuned}");
    let header = |file: &str, more: &[&str]| {
        done(path, &[&["header", file, "-o", "m.h"], more].concat());
        fs::read_to_string(path.join("m.h")).unwrap()
    };
    assert_eq!(header("m.toml", &["--inputs", "push.csv"]), header("t.toml", &[]));
    let given = ancf14(path, &["pack", "t.toml", "-o", "t.fmu", "--library", "library.so", "--inputs", "push.csv"]);
    assert!(given.status.success() && text(&given.stderr).contains("leave out --inputs"), "{given:?}");
    for command in [&["pack", "m.toml", "--library", "library.so", "-o"][..], &["tune", "m.toml", "-o"]] {
        let target = if command[0] == "pack" { "x.fmu" } else { "x.toml" };
        let refused = ancf14(path, &[command, &[target, "--inputs", "bad.csv"]].concat());
        let told = text(&refused.stderr);
        assert!(refused.status.code() == Some(2) && told.contains("the model has no input `pull.force[3]`"), "{told}");
        assert!(!path.join(target).exists());
    }
}

/// A page shows the run that is accurate, as that of `run --view`; `--no-refine` shows the first one. The solver in the
/// page gets the numbers that were found.
#[test]
fn pages_show_the_accurate_run() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("m.toml"), ROD.replace("500*t", "3e5*t")).unwrap();
    fs::write(path.join("ancf14.wasm"), solver()).unwrap();
    let page = |name: &str, more: &[&str]| {
        let told = done(path, &[&["view", "m.toml", "-o", name], more].concat());
        (told, fs::read_to_string(path.join(name)).unwrap())
    };
    let (told, own) = page("own.html", &[]);
    assert!(told.starts_with("2 runs, 16 elements, accuracy reached: 0."), "{told}");
    done(path, &["run", "m.toml", "-o", "out", "--view"]);
    assert!(own == fs::read_to_string(path.join("out/view.html")).unwrap());
    let (told, once) = page("once.html", &["--no-refine"]);
    assert!(!told.contains("accuracy reached") && once != own, "{told}");
    let (_, live) = page("live.html", &["--live=ancf14.wasm"]);
    let numbers = "[\"arm.elements\",\"16\"],[\"arm.twist\",\"quadratic\"]";
    assert!(live.contains(numbers) && !once.contains(numbers));
}

/// Files of VTK have the stations of the accurate run, in the same bytes each time.
#[test]
fn exports_are_those_of_the_accurate_run() {
    let directory = tempfile::tempdir().unwrap();
    let path = directory.path();
    fs::write(path.join("m.toml"), ROD.replace("500*t", "3e5*t")).unwrap();
    done(path, &["tune", "m.toml", "-o", "t.toml"]);
    let export = |file: &str, more: &[&str]| {
        let told = done(path, &[&["export", file, "--vtk", "out"], more].concat());
        (told, fs::read(path.join("out/beams_4.vtp")).unwrap())
    };
    let stations = |bytes: &[u8]| {
        let text = String::from_utf8_lossy(bytes).into_owned();
        text.split_once("NumberOfPoints=\"").unwrap().1.split_once('"').unwrap().0.to_owned()
    };
    let (told, own) = export("m.toml", &[]);
    assert!(told.starts_with("2 runs, 16 elements, accuracy reached: 0."), "{told}");
    assert!(own == export("m.toml", &[]).1);
    assert_eq!(stations(&own), stations(&export("t.toml", &[]).1));
    let (told, once) = export("m.toml", &["--no-refine"]);
    assert!(!told.contains("accuracy reached"), "{told}");
    assert_ne!(stations(&own), stations(&once));
}
