//! Does `ancf14 export` leave files of this very run and no others, the same bytes each time, as many as were asked
//! for, and the run as far as it came? A wrong code mixes two runs in ParaView, or fills a disk. That VTK reads the
//! files and finds the numbers of results.csv in them, tests/fmpy/test_vtk.py holds.

use ancf14_testing::root;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

fn export(directory: &Path, model: &str, arguments: &[&str]) -> Output {
    let model = format!("{}/models/{model}.toml", root().display());
    let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
    command.current_dir(directory).args(["export", &model, "--vtk", "out"]).args(arguments).output().unwrap()
}

/// The files in `out`, but for the list of the folder.
fn files(directory: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(directory.join("out")).unwrap().map(|entry| entry.unwrap());
    let files = entries.map(|entry| (entry.file_name().into_string().unwrap(), std::fs::read(entry.path()).unwrap()));
    files.filter(|(name, _)| name != ".ancf14").collect()
}

/// Names and times that a list has.
fn listed(list: &[u8]) -> Vec<(String, f64)> {
    let text = String::from_utf8(list.to_vec()).unwrap();
    let quoted =
        |line: &str, key: &str| line.split_once(&format!("{key}=\"")).unwrap().1.split_once('"').unwrap().0.to_owned();
    let entries = text.lines().filter(|line| line.contains("<DataSet "));
    entries.map(|line| (quoted(line, "file"), quoted(line, "timestep").parse().unwrap())).collect()
}

const SHORT: [&str; 4] = ["--set", "simulation.stop=0.05", "--set", "arm.elements=2"];

/// A file of each row of results, named in the list with its time; the same bytes in a second run; and nothing of a run
/// before that had more.
#[test]
fn exports_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str]| {
        let output = export(directory.path(), "cantilever", &[&SHORT, arguments].concat());
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        (String::from_utf8(output.stdout).unwrap(), files(directory.path()))
    };
    let (told, found) = run(&[]);
    assert!(
        told.starts_with("11 instants of beams, joints, outputs, ") && told.contains("open out/beams.pvd in ParaView"),
        "{told}"
    );
    assert_eq!(found.len(), 3 * 12);
    for kind in ["beams", "joints", "outputs"] {
        let wanted = |number: u32| (format!("{kind}_{number:02}.vtp"), f64::from(number) * 5.0 / 1e3);
        assert_eq!(listed(&found[&format!("{kind}.pvd")]), (0..11).map(wanted).collect::<Vec<_>>());
    }
    assert!(run(&[]).1 == found, "the same run made other files");
    // Rows 0, 4, 8 and the last one; single digits are enough.
    let (_, fewer) = run(&["--every", "4"]);
    let times: Vec<f64> = listed(&fewer["beams.pvd"]).into_iter().map(|(_, time)| time).collect();
    assert_eq!(times, [0.0, 0.02, 0.04, 0.05]);
    assert_eq!(fewer.len(), 3 * 5);
    assert_eq!(fewer["beams_1.vtp"], found["beams_04.vtp"]);
    assert_eq!(fewer["beams_3.vtp"], found["beams_10.vtp"]);
}

/// A run that fails is written as far as it came, with its lists.
#[test]
fn failed_runs_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let output = export(directory.path(), "ring", &["--set", "rod.element=ancf24"]);
    assert_eq!(output.status.code(), Some(1));
    let found = files(directory.path());
    let list = listed(&found["beams.pvd"]);
    assert!(list.len() > 1 && list.len() < 101, "{} instants", list.len());
    assert!(list.iter().all(|(name, _)| found.contains_key(name)));
}

/// An export that is killed leaves lists that can be read, of files that are there.
#[test]
fn killed_exports_can_be_opened() {
    let directory = tempfile::tempdir().unwrap();
    let model = format!("{}/models/cantilever.toml", root().display());
    let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
    // More rows than any computer writes before it is killed.
    command.args(["export", &model, "--vtk", "out", "--every=1", "--set", "simulation.stop=1000"]);
    let mut child = command.current_dir(directory.path()).stderr(Stdio::null()).spawn().unwrap();
    let list = directory.path().join("out/beams.pvd");
    let instants = || std::fs::read(&list).map_or(0, |list| listed(&list).len());
    let begin = Instant::now();
    // The first list has one instant; the next one comes after a second.
    while instants() < 2 && begin.elapsed() < Duration::from_secs(60) {
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let list = listed(&std::fs::read(&list).unwrap());
    assert!(list.len() > 1, "{} instants", list.len());
    assert!(list.iter().all(|(name, _)| directory.path().join("out").join(name).exists()));
}

/// Nobody gets a hundred thousand files without asking for them, and nothing is touched before.
#[test]
fn long_runs_are_asked_about() {
    let directory = tempfile::tempdir().unwrap();
    let long = ["--set", "simulation.stop=100"];
    let output = export(directory.path(), "cantilever", &long);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.starts_with("error: the run has 20001 rows") && told.contains("--every=3 for one row in 3"), "{told}");
    assert!(!directory.path().join("out").exists());
    for wrong in ["0", "-1", "x", "1.5", "99999999999999999999"] {
        let output = export(directory.path(), "cantilever", &[&format!("--every={wrong}")]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
    std::fs::write(directory.path().join("out"), "mine").unwrap();
    let output = export(directory.path(), "cantilever", &SHORT);
    assert_eq!(output.status.code(), Some(2));
    let told = String::from_utf8(output.stderr).unwrap();
    assert!(told.contains("out is a file; give the name of a folder"), "{told}");
}
