//! Does the program do what its user reads? Exit codes, the table of results to the letter of its contract, and files
//! that can be looked at. A wrong code would give another code, other times, or text that does not read back.

use ancf14_testing::root;
use std::path::Path;
use std::process::{Command, Output};

/// A short run: the cantilever for a few steps.
const SHORT: [&str; 6] =
    ["--set", "simulation.stop=0.01", "--set", "simulation.output_step=0.003", "--set", "arm.elements=2"];

pub fn ancf14(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ancf14"))
        .current_dir(directory)
        .args(arguments)
        .output()
        .expect("the program runs")
}

pub fn model(name: &str) -> String {
    format!("{}/models/{name}.toml", root().display())
}

pub fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// Rows at start + k * output step and at the stop; every number reads back to a double, in the shortest way.
#[test]
fn results_are_written_as_agreed() {
    let directory = tempfile::tempdir().expect("a directory");
    let mut arguments = vec!["run"];
    let cantilever = model("cantilever");
    arguments.push(&cantilever);
    arguments.extend(SHORT);
    let output = ancf14(directory.path(), &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let complaints = text(&output.stderr);
    let errors = ["because of the length of the steps", "because of the mesh"];
    let mut others = complaints.lines().filter(|line| !errors.iter().any(|words| line.contains(words)));
    assert_eq!(others.next(), None, "a pipe gets no progress bar");
    let csv = std::fs::read_to_string(directory.path().join("cantilever-results/results.csv")).expect("results");
    let lines: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(lines[0][..3], ["time", "tip.displacement[1]", "tip.displacement[2]"]);
    assert_eq!(lines[0][lines[0].len() - 3..], ["statistics.steps", "statistics.iterations", "statistics.rejected"]);
    let times: Vec<_> = lines[1..].iter().map(|line| line[0].parse::<f64>().expect("a time")).collect();
    assert_eq!(times, [0.0, 0.003, 0.006, 0.009, 0.01]);
    for line in &lines[1..] {
        assert_eq!(line.len(), lines[0].len());
        for cell in line {
            let value: f64 = cell.parse().expect("a number");
            assert!(cell.len() <= format!("{value}").len().min(format!("{value:e}").len()), "{cell}");
        }
    }
    let fallen: f64 = lines[lines.len() - 1][3].parse().expect("a number");
    assert!(fallen < 0.0, "gravity pulls down, the tip is at {fallen}");
    let plot = std::fs::read_to_string(directory.path().join("cantilever-results/tip.displacement.svg")).expect("plot");
    assert!(plot.contains("displacement (m)") && plot.contains("time (s)") && plot.contains("\nz\n"));
}

/// The same command writes the same bytes.
#[test]
fn results_are_reproducible() {
    let directory = tempfile::tempdir().expect("a directory");
    let cantilever = model("cantilever");
    let run = |out: &str| {
        let arguments: Vec<_> = ["run", &cantilever, "--out", out].into_iter().chain(SHORT).collect();
        assert!(ancf14(directory.path(), &arguments).status.success());
        let file = |name: &str| std::fs::read(directory.path().join(out).join(name)).expect("a result");
        (file("results.csv"), file("energy.svg"))
    };
    assert!(run("first") == run("second"));
}

/// 2 for what the user wrote wrong, with a message that says what.
#[test]
fn mistakes_of_the_user_give_exit_code_2() {
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("latin.toml"), b"name = \"Tr\xe4ger\"").expect("write");
    let cantilever = model("cantilever");
    for (arguments, expected) in [
        (vec!["run", "nothing.toml"], "cannot read nothing.toml"),
        (vec!["run", "latin.toml"], "not UTF-8 text: byte 11, in line 1"),
        (vec!["run", &cantilever, "--set", "arm.yuong=1"], "unknown key `yuong`"),
        (vec!["run", &cantilever, "--set", "arm"], "KEY=VALUE was expected"),
        (
            vec!["pack", &cantilever, "-o", "c.fmu", "--binary", "amiga=a.so"],
            "linux64, win32, win64, darwin64, aarch64-linux, wasm32-wasip2",
        ),
        (vec!["header", &cantilever, "-o", "c.h", "--prefix", "9"], "9"),
        (vec!["jump"], "unrecognized subcommand"),
        (vec!["pack", &cantilever, "-o", "c.fmu", "--library", "nothing.so"], "nothing.so"),
    ] {
        let output = ancf14(directory.path(), &arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
    }
}

/// A load that no number describes after a while: exit code 1, and the rows until then are there.
#[test]
fn a_failed_run_keeps_its_rows() {
    let directory = tempfile::tempdir().expect("a directory");
    let load = "\n[load.push]\nat = \"arm.end\"\nforce = [0, 0, \"sqrt(0.005 - t)\"]\n";
    let file = std::fs::read_to_string(model("cantilever")).expect("model") + load;
    std::fs::write(directory.path().join("m.toml"), file).expect("write");
    let output = ancf14(directory.path(), &["run", "m.toml", "--set", "simulation.output_step=1e-3"]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert!(text(&output.stderr).starts_with("error: "), "{}", text(&output.stderr));
    let csv = std::fs::read_to_string(directory.path().join("m-results/results.part.csv")).expect("results");
    assert!(csv.lines().count() >= 4 && csv.ends_with('\n'), "{csv}");
    assert!(text(&output.stderr).contains("the rows up to t = 0.005 s are in m-results/results.part.csv"));
}

/// `check` lists every variable; the picture names everything that is drawn.
#[test]
fn check_lists_and_draws() {
    let directory = tempfile::tempdir().expect("a directory");
    let output = ancf14(directory.path(), &["check", &model("pendulum"), "--draw", "p.svg"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let listing = text(&output.stdout);
    for name in ["steel.young", "tip.position[3]", "simulation.step", "energy.total"] {
        assert!(listing.contains(name), "{name} is not in\n{listing}");
    }
    let picture = std::fs::read_to_string(directory.path().join("p.svg")).expect("picture");
    for name in ["upper", "lower", "hinge", "elbow", "tip"] {
        assert!(picture.contains(&format!(">{name}<")), "{name}");
    }
}

/// Header and FMU can be written; what is in them is tested where they are made.
#[test]
fn header_and_unit_are_written() {
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("library.so"), b"\x7fELF\x02\x01 and so on\x03\x00\x3e\x00").expect("write");
    let cantilever = model("cantilever");
    assert!(ancf14(directory.path(), &["header", &cantilever, "-o", "c.h"]).status.success());
    let pack = ["pack", &cantilever, "-o", "c.fmu", "--library", "library.so"];
    assert!(ancf14(directory.path(), &pack).status.success());
    assert!(std::fs::read_to_string(directory.path().join("c.h")).expect("header").contains("tip"));
    assert!(std::fs::read(directory.path().join("c.fmu")).expect("unit").starts_with(b"PK"));
}

/// An FMU has the libraries for other platforms that lie beside that of this one; one that is given takes the place of
/// the one that lies there.
#[test]
fn libraries_for_other_platforms_are_packed() {
    let directory = tempfile::tempdir().expect("a directory");
    let write = |name: &str, machine: u8| {
        let path = directory.path().join(name);
        std::fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        std::fs::write(path, [&b"\x7fELF\x02\x01 and so on\x03\x00"[..], &[machine, 0]].concat()).expect("write");
    };
    let cantilever = model("cantilever");
    let packed = |more: &[&str]| {
        let words = [&["pack", &cantilever, "-o", "c.fmu", "--library", "library.so"], more].concat();
        let output = ancf14(directory.path(), &words);
        (output.status.code(), text(&output.stdout) + &text(&output.stderr))
    };
    write("library.so", 0x3e);
    write("other.so", 0xb7);
    let (code, said) = packed(&[]);
    assert!(code == Some(0) && said.contains("packed for linux64 (library.so)\n"), "{said}");
    write("aarch64-linux/libancf14.so", 0xb7);
    let (code, said) = packed(&[]);
    let beside = "packed for linux64 (library.so), aarch64-linux (aarch64-linux/libancf14.so)\n";
    assert!(code == Some(0) && said.contains(beside), "{said}");
    let (code, said) = packed(&["--binary", "aarch64-linux=other.so"]);
    let given = "packed for linux64 (library.so), aarch64-linux (other.so)\n";
    assert!(code == Some(0) && said.contains(given), "{said}");
    std::fs::create_dir_all(directory.path().join("wasm32-wasip2")).expect("a folder");
    std::fs::write(directory.path().join("wasm32-wasip2/ancf14.wasm"), b"\0asm\x0d\0\x01\0").expect("write");
    let (code, said) = packed(&[]);
    assert!(code == Some(0) && said.contains(beside), "a component in an FMU of FMI 2.0: {said}");
    let (code, said) = packed(&["--fmi", "3"]);
    assert!(code == Some(0) && said.contains(", wasm32-wasip2 (wasm32-wasip2/ancf14.wasm)\n"), "{said}");
    let (code, said) = packed(&["--binary", "wasm32-wasip2=wasm32-wasip2/ancf14.wasm"]);
    assert!(code == Some(2) && said.contains("add --fmi 3"), "{said}");
    write("aarch64-linux/libancf14.so", 0x3e);
    let (code, said) = packed(&[]);
    assert!(code == Some(2) && said.contains("a shared library for linux64"), "{said}");
}

/// A model named like a word of C or C++ still gets an identifier that both take.
#[test]
fn names_that_are_keywords_pack() {
    let directory = tempfile::tempdir().expect("a directory");
    let named = std::fs::read_to_string(model("cantilever"))
        .expect("the model")
        .replace("name = \"Cantilever\"", "name = \"class\"");
    assert!(named.contains("\"class\""));
    std::fs::write(directory.path().join("m.toml"), named).expect("a file");
    let output = ancf14(directory.path(), &["header", "m.toml", "-o", "m.h"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(std::fs::read_to_string(directory.path().join("m.h")).expect("a header").contains("class_"));
}

/// Three bodies in a loop of welds: one of these is too many.
const LOOP: &str = r#"format = 1
model.name = "Loop"
[body.b1]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[body.b2]
mass = 1
position = [1, 0, 0]
inertia = [1, 1, 1]
[body.b3]
mass = 1
position = [0, 1, 0]
inertia = [1, 1, 1]
[joint.j1]
type = "weld"
a = "b1"
b = "b2"
[joint.j2]
type = "weld"
a = "b2"
b = "b3"
[joint.j3]
type = "weld"
a = "b3"
b = "b1"
[simulation]
stop = 0.1
step = 0.01
"#;

/// `check` finds what `run` refuses at its start, with the line; it is a joint that is too many, not a body.
#[test]
fn regression_check_finds_redundant_joints() {
    let directory = tempfile::tempdir().expect("a directory");
    std::fs::write(directory.path().join("m.toml"), LOOP).expect("write");
    for command in ["check", "run"] {
        let output = ancf14(directory.path(), &[command, "m.toml"]);
        let message = text(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(!text(&output.stdout).contains("no mistakes"));
        assert!(
            message.contains(": joint j")
                && message.contains("is redundant: other joints already impose its constraints"),
            "{message}"
        );
        assert!(message.contains("| [joint.j"), "{message}");
        assert!(message.contains("nothing holds the mechanism"), "{message}");
    }
}

/// A load that grows without bound at an instant is stepped over with many halvings, or loses energy: the user is told.
#[test]
fn regression_many_rejected_steps_are_told() {
    let directory = tempfile::tempdir().expect("a directory");
    let load = "\n[load.push]\nat = \"arm.end\"\nforce = [0, 0, \"1/(t - 0.0503)\"]\n";
    let file = std::fs::read_to_string(model("cantilever")).expect("model");
    for (load, is_warned) in [(load, true), ("", false)] {
        std::fs::write(directory.path().join("m.toml"), format!("{file}{load}")).expect("write");
        let output = ancf14(directory.path(), &["run", "m.toml", "--set", "simulation.stop=0.1"]);
        let message = text(&output.stderr);
        let told = message.contains("steps were rejected") || message.contains("the integrator has");
        assert_eq!(told, is_warned, "{message}");
    }
}

/// Stations of a beam are drawn as shapes at some instants, not as a line for each number.
#[test]
fn regression_stations_are_drawn_as_shapes() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = std::fs::read_to_string(model("cantilever")).expect("model");
    let output = "\n[output.shape]\non = \"arm\"\nquantities = [\"position\", \"velocity\", \"twist\"]\n";
    std::fs::write(directory.path().join("m.toml"), format!("{file}{output}")).expect("write");
    let run = ancf14(directory.path(), &["run", "m.toml", "--set", "simulation.stop=0.06"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    for name in ["shape.position", "shape.velocity.1", "shape.velocity.3", "shape.twist"] {
        let path = directory.path().join(format!("m-results/{name}.svg"));
        let plot = std::fs::read_to_string(&path).unwrap_or_else(|reason| panic!("{name}: {reason}"));
        for k in 0..=6 {
            let instant = format!("t = {} s", f64::from(k) / 100.0);
            assert!(plot.lines().any(|line| line.trim() == instant), "{name}: {instant}");
        }
    }
}

/// A table outside of the folder of the model is refused, with the way out; that way, every command that reads a model
/// takes it.
#[test]
fn files_elsewhere_need_a_word_of_the_user() {
    let directory = tempfile::tempdir().expect("a directory");
    let folder = directory.path().join("models");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(directory.path().join("pull.csv"), "time,force\n0,1\n1,2\n").expect("a table");
    let file = "format = 1\n[model]\nname = \"Pull\"\n[function.pull]\nfile = \"../pull.csv\"\n[body.b]\nmass = 1\nposition = [0, 0, 0]\n\
                inertia = [1, 1, 1]\n[load.l]\nat = \"b\"\nforce = [\"pull(t)\", 0, 0]\n[simulation]\nstop = 1\n";
    std::fs::write(folder.join("m.toml"), file).expect("a model");
    for command in
        [&["check", "m.toml"][..], &["run", "m.toml"], &["header", "m.toml", "-o", "m.h"], &["modes", "m.toml"]]
    {
        let refused = ancf14(&folder, command);
        let message = text(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{command:?}: {message}");
        assert!(
            message.contains("outside of the folder of the model file") && message.contains("--allow-outside"),
            "{message}"
        );
        let allowed = ancf14(&folder, &[command, &["--allow-outside"]].concat());
        assert!(allowed.status.success(), "{command:?}: {}", text(&allowed.stderr));
    }
}
