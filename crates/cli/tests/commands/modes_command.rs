//! Does `ancf14 modes` write what docs/language/results.md says, and refuse what it cannot do? Exit codes, the columns
//! of its files to the letter, and the same bytes twice.

use ancf14_testing::root;
use std::path::Path;
use std::process::{Command, Output};

fn modes(directory: &Path, name: &str, arguments: &[&str]) -> Output {
    modes_of(directory, &format!("{}/models/{name}.toml", root().display()), arguments)
}

fn modes_of(directory: &Path, file: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ancf14"))
        .current_dir(directory)
        .arg("modes")
        .arg(file)
        .args(arguments)
        .output()
        .unwrap()
}

const BOB: &str = r#"format = 1
[model]
name = "Bob"
[body.bob]
mass = 2.0
position = [0.0, 0.0, -1.0]
inertia = [0.1, 0.1, 0.1]
[spring.rope]
a = "ground"
b = "bob"
stiffness = 100.0
[simulation]
stop = 1.0
step = 0.01
"#;

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A row a mode, a row a mode and place, a cell of the picture a mode; the table says it in words.
#[test]
fn files_are_written_as_agreed() {
    let directory = tempfile::tempdir().unwrap();
    let output = modes(directory.path(), "rotating_shaft", &["--count", "4"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    assert!(table.lines().nth(1).is_some_and(|line| line.contains("9.06071") && line.contains("56.9301")), "{table}");
    assert!(table.contains("disk, along y") && table.contains("shaft.end, turning about x"), "{table}");
    let file =
        |name: &str| std::fs::read_to_string(directory.path().join("rotating_shaft-results").join(name)).unwrap();
    let (list, shapes, picture) = (file("modes.csv"), file("shapes.csv"), file("modes.svg"));
    let rows: Vec<&str> = list.lines().collect();
    assert_eq!(
        rows[0],
        "mode,kind,frequency,angular_frequency,growth_rate,eigenvalue,modal_mass,damping_ratio,mesh_error,shear,moves"
    );
    assert_eq!(rows.len(), 5);
    let cells: Vec<&str> = rows[1].split(',').collect();
    assert_eq!(cells[..2], ["1", "vibration"]);
    let [frequency, omega, growth, square] = [2, 3, 4, 5].map(|place| cells[place].parse::<f64>().unwrap());
    assert!((omega * omega / square - 1.0).abs() < 1e-15 && growth == 0.0);
    assert!((frequency * std::f64::consts::TAU / omega - 1.0).abs() < 1e-15);
    let rows: Vec<Vec<&str>> = shapes.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(rows[0][..5], ["mode", "place", "position[1]", "position[2]", "position[3]"]);
    assert_eq!(
        rows[0][5..],
        ["displacement[1]", "displacement[2]", "displacement[3]", "turn[1]", "turn[2]", "turn[3]"]
    );
    // Seven nodes and the disk.
    assert_eq!(rows.len(), 1 + 4 * 8);
    assert_eq!((rows[1][1], rows[8][1]), ("shaft.node[0]", "disk"));
    assert_eq!(rows[8][6], "1", "what moves most moves by one");
    assert!(picture.contains("9.06071 Hz") && picture.matches("<polyline").count() == 8);
}

#[test]
fn the_same_bytes_come_twice() {
    let directory = tempfile::tempdir().unwrap();
    let files = ["first", "second"].map(|out| {
        assert!(modes(directory.path(), "crane", &["--out", out]).status.success());
        ["modes.csv", "shapes.csv", "modes.svg"]
            .map(|name| std::fs::read(directory.path().join(out).join(name)).unwrap())
    });
    assert!(files[0] == files[1]);
}

/// A static analysis is followed to the time that is asked for: bending makes the strip's frequencies others.
#[test]
fn a_static_path_is_followed() {
    let directory = tempfile::tempdir().unwrap();
    let first = |arguments: &[&str]| {
        let output = modes(directory.path(), "princeton_beam", arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout).lines().nth(1).unwrap().to_owned()
    };
    let (start, end) = (first(&[]), first(&["--time", "1"]));
    assert!(start != end && first(&["--time", "0"]) == start, "{start}\n{end}");
}

#[test]
fn mistakes_are_told() {
    let directory = tempfile::tempdir().unwrap();
    for (name, arguments, code, expected) in [
        ("cantilever", &["--time", "1"][..], 2, "analysis = \"static\""),
        ("cantilever", &["--count", "0"], 2, "a whole number from 1 to 65535"),
        ("cantilever", &["--count", "-3"], 2, "a whole number from 1 to 65535"),
        ("princeton_beam", &["--time=-1"], 2, "a time from 0 on"),
        ("princeton_beam", &["--time", "-1"], 2, "a time from 0 on"),
        ("princeton_beam", &["--time", "1.5"], 2, "simulation.stop is 1 s"),
        ("nothing", &[], 2, "cannot read"),
        ("princeton_beam", &["--set", "gravity[3]=sqrt(-1)"], 2, "gravity"),
    ] {
        let output = modes(directory.path(), name, arguments);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
    }
    // A body on a spring has six modes: fewer than are shown where no number is given, which is no reason for a
    // warning.
    std::fs::write(directory.path().join("bob.toml"), BOB).unwrap();
    for (arguments, is_warned) in [(&["--count", "7"][..], true), (&[], false)] {
        let output = modes_of(directory.path(), "bob.toml", arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert_eq!(text(&output.stderr).contains("the mechanism has only"), is_warned, "{}", text(&output.stderr));
    }
}

/// What cannot be written is noticed before the modes are looked for: no table, and nothing is left behind.
#[test]
fn regression_a_place_that_cannot_be_written_is_told_first() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("taken"), "").unwrap();
    std::fs::create_dir_all(directory.path().join("half/shapes.csv")).unwrap();
    for (out, code, expected) in [("taken", 2, "taken is a file"), ("half", 1, "cannot write half/shapes.csv")] {
        let output = modes(directory.path(), "cantilever", &["--out", out]);
        assert_eq!(output.status.code(), Some(code));
        assert!(text(&output.stdout).is_empty(), "{}", text(&output.stdout));
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
    }
    assert!(!directory.path().join("half/modes.csv").exists());
}

/// `ancf14 modes` with `--set arm.element=ancf24`: the first mode's frequency and its shape, moving by one at the end
/// and turning there by 1.3765/L (Euler and Bernoulli), within the 3e-3 of eight elements of order 2 and of shear,
/// 1e-5.
#[test]
fn the_modes_command_knows_sections() {
    let directory = tempfile::tempdir().unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_ancf14"))
        .current_dir(directory.path())
        .arg("modes")
        .arg(root().join("models/cantilever.toml"))
        .args(["--set", "arm.element=ancf24", "--count", "2", "--out", "."])
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let read = |name: &str| {
        let text = std::fs::read_to_string(directory.path().join(name)).unwrap();
        text.lines().map(|line| line.split(',').map(str::to_owned).collect()).collect::<Vec<Vec<String>>>()
    };
    let (list, shapes) = (read("modes.csv"), read("shapes.csv"));
    let exact = 1.875_104_f64.powi(2) * (2.1e11 * 0.005_f64.powi(2) / 12.0 / 7850.0).sqrt();
    let omega: f64 = list[1][3].parse().unwrap();
    // Nine nodes; the last one's displacement along z and turn about y.
    assert_eq!((shapes.len(), shapes[9][1].as_str()), (1 + 2 * 9, "arm.node[8]"));
    let [moved, turned]: [f64; 2] = [7, 9].map(|place| shapes[9][place].parse().unwrap());
    println!("frequency {:.1e}, moves by {moved}, turns by {turned}", omega / exact - 1.0);
    assert!((omega / exact - 1.0).abs() < 1e-2 && (moved.abs() - 1.0).abs() < 1e-12);
    assert!((turned / moved / -1.3765 - 1.0).abs() < 1e-2);
}
