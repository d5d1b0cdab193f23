//! Does `ancf14 run --inputs` move a mechanism as the same functions of time in the model file do? Wrong values between
//! the rows, or a jump that is smeared over a step, would make another motion; a column that nobody reads would be an
//! input that somebody thinks is given.

use crate::printed;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

const MODEL: &str = r#"format = 1
[model]
name = "Pushed"
[body.block]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[joint.slide]
type = "prismatic"
a = "ground"
b = "block"
axis = [1, 0, 0]
[body.cart]
mass = 1
position = [0, 1, 0]
inertia = [1, 1, 1]
[joint.rail]
type = "prismatic"
a = "ground"
b = "cart"
axis = [1, 0, 0]
[drive.pull]
joint = "rail"
coordinate = "distance"
RATE
[load.push]
at = "block"
FORCE
[output.motion]
at = "block"
quantities = ["position", "velocity"]
[output.rail]
at = "cart"
quantities = ["position"]
[simulation]
stop = 1
step = 0.1
"#;

/// A ramp, a jump of the force at 0.13 s, a corner at 0.31 s, and the last value held; before the first row too.
const TABLE: &str = "time,push.force[1] [N],pull.rate\n0.05,1,0.5\n0.13,3,0.5\n0.13,-2,0.5\n0.31,4,2\n0.7,0,2\n";

fn model(force: &str, rate: &str) -> String {
    MODEL.replace("FORCE", force).replace("RATE", rate)
}

fn with_inputs() -> String {
    model("force = [0, 0, 0]\ninput = true", "rate = 0\ninput = \"rate\"")
}

fn run(folder: &Path, model: &str, table: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("m.toml"), model).unwrap();
    fs::write(folder.join("i.csv"), table).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
    command.current_dir(folder).args(["run", "m.toml", "-o", "results"]).args(arguments);
    command.output().unwrap()
}

fn rows(folder: &Path) -> Vec<Vec<f64>> {
    let table = fs::read_to_string(folder.join("results/results.csv")).unwrap();
    let header: Vec<&str> = table.lines().next().unwrap().split(',').collect();
    let wanted: Vec<usize> = (0..header.len()).filter(|at| !header[*at].contains("statistics")).collect();
    let row = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        wanted.iter().map(|at| cells[*at].parse().unwrap()).collect()
    };
    table.lines().skip(1).map(row).collect()
}

/// The same motion as with the values as functions of time in pieces, to round-off.
#[test]
fn inputs_act_as_functions_of_time() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    printed(&run(folder, &with_inputs(), TABLE, &["--inputs", "i.csv"]));
    let inputs = rows(folder);
    let force = "force = [[{ until = 0.05, is = 1 }, { until = 0.13, is = \"1 + 25*(t - 0.05)\" }, { until = 0.31, is = \"-2 + (t - 0.13)/0.03\" }, \
                 { until = 0.7, is = \"4 - (t - 0.31)*4/0.39\" }, { is = 0 }], 0, 0]";
    let rate = "rate = [{ until = 0.13, is = 0.5 }, { until = 0.31, is = \"0.5 + (t - 0.13)/0.12\" }, { is = 2 }]";
    printed(&run(folder, &model(force, rate), TABLE, &[]));
    let functions = rows(folder);
    assert_eq!((inputs.len(), functions.len()), (11, 11));
    for (input, function) in inputs.iter().zip(&functions) {
        for (a, b) in input.iter().zip(function) {
            // Round-off of some tens of steps on numbers of 1.
            assert!((a - b).abs() < 1e-12, "{input:?} {function:?}");
        }
    }
    let end = functions.last().unwrap();
    assert!(end.iter().any(|value| value.abs() > 0.1), "it moves: {end:?}");
}

/// Mistakes are told with the line and the column, and what is meant.
#[test]
fn mistakes_are_told_where_they_are() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    for (table, expected) in [
        ("time,push.forse[1]\n0,1\n", &["no input `push.forse[1]`", "i.csv:1:6", "did you mean `push.force[1]`?"][..]),
        ("t,push.force[1]\n0,1\n", &["the first column is `t`", "`time` was expected", "i.csv:1:1"]),
        ("time,push.force[1]\n0,1\n0.2\n", &["this row has 1 cell(s)", "i.csv:3:1"]),
        ("time,push.force[1]\n0,1\n0.2,\n", &["a number is missing", "i.csv:3:5"]),
        ("time,push.force[1]\n0.2,1\n0.1,1\n", &["the times do not ascend", "0.1 comes after 0.2", "i.csv:3:1"]),
        ("time,push.force[1]\n1,1\n1,2\n1,3\n", &["three rows are at t = 1 s", "i.csv:4:1"]),
        ("time,push.force[1],push.force[1]\n0,1,2\n", &["is there twice", "i.csv:1:20"]),
        ("time\n0\n", &["the table has no inputs", "i.csv:1:1"]),
        ("time,push.force[1]\n", &["the table has no rows", "i.csv:1:1"]),
    ] {
        let ran = run(folder, &with_inputs(), table, &["--inputs", "i.csv"]);
        let message = String::from_utf8(ran.stderr).unwrap();
        assert_eq!(ran.status.code(), Some(2), "{message}");
        for expected in expected {
            assert!(message.contains(expected), "{expected} is not in\n{message}");
        }
        assert!(!folder.join("results").exists());
    }
}

/// A verification would repeat the run without the inputs; and no run writes over its inputs.
#[test]
fn inputs_are_neither_verified_nor_written_over() {
    let place = tempfile::tempdir().unwrap();
    let folder = place.path();
    let told = |arguments: &[&str], model: &str| {
        let ran = run(folder, model, TABLE, arguments);
        assert_eq!(ran.status.code(), Some(2));
        String::from_utf8(ran.stderr).unwrap()
    };
    assert!(told(&["--inputs", "i.csv", "--verify"], &with_inputs()).contains("cannot be used with"));
    let verified = with_inputs().replace("step = 0.1", "step = 0.1\nverify = true");
    assert!(told(&["--inputs", "i.csv"], &verified).contains("a run with --inputs cannot be verified"));
    fs::create_dir(folder.join("results")).unwrap();
    fs::write(folder.join("results/results.csv"), TABLE).unwrap();
    let message = told(&["--inputs", "results/results.csv"], &with_inputs());
    assert!(message.contains("is the table of inputs"), "{message}");
    assert_eq!(fs::read_to_string(folder.join("results/results.csv")).unwrap(), TABLE);
}
