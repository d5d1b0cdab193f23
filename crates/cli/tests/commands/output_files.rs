//! Is a file that a command leaves behind whole, its own, and of this very run? Nothing half-made may look complete,
//! nothing old may pass for new, no input may be written over, and exit code 0 means that everything was written. A
//! wrong code loses work.
#![cfg(unix)]

use std::fs;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::Duration;

const MODEL: &str = r#"format = 1
[model]
name = "Bob"
gravity = [0, 0, -9.81]
[body.bob]
mass = 1.0
position = [0, 0, -1]
inertia = [0.1, 0.1, 0.1]
[joint.hinge]
type = "revolute"
a = "ground"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[output.place]
at = "bob"
quantities = ["position", "velocity"]
[simulation]
stop = 0.1
step = 0.01
"#;

/// A run that does not end by itself.
const ENDLESS: [&str; 4] = ["run", "m.toml", "--set", "simulation.stop=1e5"];

struct Place(tempfile::TempDir);

impl Place {
    /// A folder with the model `m.toml`.
    fn new() -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        fs::write(place.at("m.toml"), MODEL).unwrap();
        place
    }

    fn at(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
        command.current_dir(self.0.path()).args(arguments);
        command
    }

    fn ancf14(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// A run that does not end by itself, when its first rows are on the disk.
    fn endless(&self) -> Child {
        started(self, &mut self.command(&ENDLESS))
    }

    /// The names of the results, sorted.
    fn results(&self) -> Vec<String> {
        let entries = fs::read_dir(self.at("m-results")).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.retain(|name| name != ".ancf14");
        names.sort();
        names
    }
}

/// A run of the model in `place`, when its first rows are on the disk.
fn started(place: &Place, command: &mut Command) -> Child {
    let run = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while fs::metadata(place.at("m-results/results.part.csv")).map_or(0, |there| there.len()) == 0 {
        std::thread::sleep(Duration::from_millis(10));
    }
    run
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

/// Every row of a file has as many columns as its header, and the last one ends.
fn assert_whole(path: &Path) {
    let text = fs::read_to_string(path).unwrap();
    assert!(text.ends_with('\n'));
    let columns: Vec<usize> = text.lines().map(|line| line.split(',').count()).collect();
    assert!(columns.len() >= 2 && columns.iter().all(|count| *count == columns[0]), "{columns:?}");
}

/// A run that ends early leaves its rows under another name, and pictures that say so; one that fails at its start
/// leaves nothing. In both cases nothing of the run before is left.
#[test]
fn regression_what_is_incomplete_looks_incomplete() {
    let place = Place::new();
    let complete =
        ["energy.svg", "index.html", "place.position.svg", "place.velocity.svg", "results.csv", "summary.json"];
    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 0);
    assert_eq!(place.results(), complete);
    fs::write(place.at("m-results/mine.svg"), "mine").unwrap();

    let load = "[load.push]\nat = \"bob\"\nforce = [0, 0, \"sqrt(0.055 - t)\"]\n";
    fs::write(place.at("m.toml"), format!("{MODEL}{load}")).unwrap();
    let output = place.ancf14(&["run", "m.toml"]);
    assert_eq!(code(&output), 1);
    assert!(text(&output.stderr).contains("m-results/results.part.csv"), "{}", text(&output.stderr));
    assert_eq!(
        place.results(),
        [
            "energy.svg",
            "index.html",
            "mine.svg",
            "place.position.svg",
            "place.velocity.svg",
            "results.part.csv",
            "summary.json"
        ]
    );
    assert_whole(&place.at("m-results/results.part.csv"));
    assert!(fs::read_to_string(place.at("m-results/energy.svg")).unwrap().contains("incomplete"));

    let load = load.replace("0.055", "-1");
    fs::write(place.at("m.toml"), format!("{MODEL}{load}")).unwrap();
    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 1);
    assert_eq!(place.results(), ["mine.svg"]);

    fs::write(place.at("m.toml"), MODEL).unwrap();
    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 0);
    assert_eq!(place.results().len(), complete.len() + 1);
    assert!(!fs::read_to_string(place.at("m-results/energy.svg")).unwrap().contains("incomplete"));
}

/// Arrays are files of the run that they are of, and only a run that comes to its end leaves them.
#[test]
fn arrays_belong_to_their_run() {
    let place = Place::new();
    assert_eq!(code(&place.ancf14(&["run", "m.toml", "--format", "npz"])), 0);
    assert!(place.at("m-results/results.csv").exists());
    // A zip archive.
    assert!(fs::read(place.at("m-results/results.npz")).unwrap().starts_with(b"PK\x03\x04"));
    assert!(fs::read_to_string(place.at("m-results/index.html")).unwrap().contains("results.npz"));
    let load = "[load.push]\nat = \"bob\"\nforce = [0, 0, \"sqrt(0.055 - t)\"]\n";
    fs::write(place.at("m.toml"), format!("{MODEL}{load}")).unwrap();
    assert_eq!(code(&place.ancf14(&["run", "m.toml", "--format", "npz"])), 1);
    assert!(place.at("m-results/results.part.csv").exists() && !place.at("m-results/results.npz").exists());
    fs::write(place.at("m.toml"), MODEL).unwrap();
    assert_eq!(code(&place.ancf14(&["run", "m.toml", "--format", "npz"])), 0);
    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 0);
    assert!(!place.at("m-results/results.npz").exists());
    let refused = place.ancf14(&["run", "m.toml", "--format", "parquet"]);
    assert_eq!(code(&refused), 2);
    assert!(text(&refused.stderr).contains("csv, npz"), "{}", text(&refused.stderr));
}

/// Errors are files of the run that they are of: the next run without them takes them away. A wrong accuracy is refused
/// before anything runs.
#[test]
fn errors_belong_to_their_run() {
    let place = Place::new();
    let swinging = MODEL.replace("position = [0, 0, -1]", "position = [1, 0, 0]");
    fs::write(place.at("m.toml"), swinging).unwrap();
    let output = place.ancf14(&["run", "m.toml", "--verify=1e-8"]);
    assert_eq!(code(&output), 0, "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("errors, estimated by 2 more runs"), "{}", text(&output.stdout));
    assert!(text(&output.stderr).contains("miss 1e-6 % of their range"), "{}", text(&output.stderr));
    assert_whole(&place.at("m-results/errors.csv"));
    assert!(fs::read_to_string(place.at("m-results/errors.svg")).unwrap().contains("place.velocity[3]"));
    let rows = |name: &str| fs::read_to_string(place.at("m-results").join(name)).unwrap().lines().count();
    // Three counts are no physical quantities.
    let columns = fs::read_to_string(place.at("m-results/results.csv")).unwrap();
    assert_eq!(rows("errors.csv") - 1, columns.lines().next().unwrap().split(',').count() - 1 - 3);

    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 0);
    assert!(place.results().iter().all(|name| !name.starts_with("errors")), "{:?}", place.results());
    let output = place.ancf14(&["run", "m.toml", "--set", "simulation.verify=true"]);
    assert_eq!(code(&output), 0);
    assert!(place.at("m-results/errors.csv").exists());
    let output = place.ancf14(&["run", "m.toml", "--verify=0.5"]);
    assert!(!text(&output.stderr).contains("miss"), "{}", text(&output.stderr));
    assert_eq!(code(&place.ancf14(&["run", "m.toml", "--verify=2"])), 2);
    assert_eq!(code(&place.ancf14(&["run", "m.toml", "--set", "simulation.verify=0.1"])), 2);
}

/// Pictures of an output that has gone go too; what `modes` wrote stays, with a warning if it was another model's.
#[test]
fn regression_old_pictures_go() {
    let place = Place::new();
    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 0);
    assert!(text(&place.ancf14(&["modes", "m.toml"]).stderr).lines().all(|line| !line.contains("another model")));
    fs::write(place.at("m.toml"), MODEL.replace("output.place", "output.spot")).unwrap();
    let output = place.ancf14(&["run", "m.toml"]);
    assert!(text(&output.stderr).contains("modes.csv, shapes.csv and modes.svg"), "{}", text(&output.stderr));
    let expected = [
        "energy.svg",
        "index.html",
        "modes.csv",
        "modes.svg",
        "results.csv",
        "shapes.csv",
        "spot.position.svg",
        "spot.velocity.svg",
        "summary.json",
    ];
    assert_eq!(place.results(), expected);
}

/// Whether the tests themselves were started to ignore a signal: then their children do so too.
fn is_ignored(signal: i32) -> bool {
    let status = fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.is_some_and(|mask| u64::from_str_radix(mask.trim(), 16).unwrap() & (1 << (signal - 1)) != 0)
}

/// Whatever ends a run from outside: its rows stay, whole, and the exit code and a message say what happened.
#[test]
fn regression_interrupted_runs_keep_their_rows() {
    for (signal, expected, name) in [("-INT", 130, "Ctrl-C"), ("-TERM", 143, "SIGTERM"), ("-HUP", 129, "SIGHUP")] {
        if is_ignored(expected - 128) {
            continue;
        }
        let place = Place::new();
        let run = place.endless();
        assert!(Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap().success());
        let output = run.wait_with_output().unwrap();
        assert_eq!(code(&output), expected, "{}", text(&output.stderr));
        let message = text(&output.stderr);
        assert!(message.contains(name) && message.contains("m-results/results.part.csv"), "{message}");
        assert_whole(&place.at("m-results/results.part.csv"));
        assert!(!place.at("m-results/results.csv").exists());
        assert!(fs::read_to_string(place.at("m-results/energy.svg")).unwrap().contains("incomplete"));
    }
}

/// A signal that the process was started to ignore, as by nohup, does not end a run.
#[test]
fn regression_ignored_signals_stay_ignored() {
    let place = Place::new();
    let program = env!("CARGO_BIN_EXE_ancf14");
    let mut shell = Command::new("sh");
    shell.current_dir(place.0.path()).args(["-c", "trap '' HUP; exec \"$@\"", "sh", program]);
    let mut run = started(&place, shell.args(ENDLESS));
    let send = |signal: &str, run: &Child| {
        assert!(Command::new("kill").args([signal, &run.id().to_string()]).status().unwrap().success());
    };
    send("-HUP", &run);
    let size = || fs::metadata(place.at("m-results/results.part.csv")).unwrap().len();
    let before = size();
    while size() == before {
        assert!(run.try_wait().unwrap().is_none(), "the run has ended");
        std::thread::sleep(Duration::from_millis(10));
    }
    send("-TERM", &run);
    assert_eq!(code(&run.wait_with_output().unwrap()), 143);
}

/// The second run into a folder refuses; a killed one blocks nobody, and its rows are whole too.
#[test]
fn regression_a_folder_has_one_run() {
    let place = Place::new();
    let mut first = place.endless();
    for command in ["run", "modes"] {
        let second = place.ancf14(&[command, "m.toml"]);
        assert_eq!(code(&second), 1);
        assert!(text(&second.stderr).contains("another ancf14 is writing into m-results"), "{}", text(&second.stderr));
    }
    first.kill().unwrap();
    first.wait().unwrap();
    assert_whole(&place.at("m-results/results.part.csv"));
    assert_eq!(code(&place.ancf14(&["run", "m.toml"])), 0);
    assert!(!place.at("m-results/results.part.csv").exists());
}

/// No output is written over an input, whatever the input is called.
#[test]
fn regression_inputs_are_spared() {
    let place = Place::new();
    let library = b"\x7fELF\x02\x01 and so on\x03\x00\x3e\x00";
    fs::write(place.at("library.so"), library).unwrap();
    fs::copy(place.at("m.toml"), place.at("drawn.svg")).unwrap();
    fs::hard_link(place.at("m.toml"), place.at("hard.fmu")).unwrap();
    fs::hard_link(place.at("library.so"), place.at("library.fmu")).unwrap();
    std::os::unix::fs::symlink("m.toml", place.at("soft.svg")).unwrap();
    fs::create_dir(place.at("m-results")).unwrap();
    std::os::unix::fs::symlink("../m.toml", place.at("m-results/results.csv")).unwrap();
    fs::create_dir(place.at("modes")).unwrap();
    fs::hard_link(place.at("m.toml"), place.at("modes/shapes.csv")).unwrap();
    for arguments in [
        &["check", "drawn.svg", "--draw", "./drawn.svg"][..],
        &["check", "m.toml", "--draw", "soft.svg"],
        &["pack", "m.toml", "-o", "hard.fmu", "--library", "library.so"],
        &["pack", "m.toml", "-o", "library.fmu", "--library", "library.so"],
        &["header", "m.toml", "-o", "./m.toml"],
        &["run", "m.toml"],
        &["modes", "m.toml", "-o", "modes"],
    ] {
        let output = place.ancf14(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(text(&output.stderr).contains("choose another name"), "{}", text(&output.stderr));
        assert_eq!(fs::read_to_string(place.at("m.toml")).unwrap(), MODEL, "{arguments:?}");
        assert_eq!(fs::read_to_string(place.at("drawn.svg")).unwrap(), MODEL, "{arguments:?}");
        assert_eq!(fs::read(place.at("library.so")).unwrap(), library, "{arguments:?}");
    }
}

/// Exit code 0 means that everything was written; a reader who has gone is no failure.
#[test]
fn regression_failed_writes_are_told() {
    let place = Place::new();
    if Path::new("/dev/full").exists() {
        for arguments in [&["check", "m.toml"][..], &["run", "m.toml"], &["modes", "m.toml"], &["--help"]] {
            let full = File::options().write(true).open("/dev/full").unwrap();
            let status = place.command(arguments).stdout(full).stderr(Stdio::null()).status().unwrap();
            assert_eq!(status.code(), Some(1), "{arguments:?}");
        }
    }
    let mut listing = place.command(&["check", "m.toml", "--draw", "m.svg"]).stdout(Stdio::piped()).spawn().unwrap();
    drop(listing.stdout.take());
    assert!(listing.wait().unwrap().success());
    assert!(place.at("m.svg").exists());
}

/// What the arguments ask for is checked before anything is read or written.
#[test]
fn regression_names_of_outputs_are_checked() {
    let place = Place::new();
    fs::write(place.at("taken"), "kept").unwrap();
    for (arguments, expected) in [
        (&["run", "m.toml", "--out", "taken"][..], "taken is a file"),
        (&["check", "m.toml", "--draw", "m.gif"], "ends in .svg or .png"),
        (&["check", "m.toml", "--draw", "picture"], "ends in .svg or .png"),
        (&["pack", "m.toml", "-o", "m.zip"], "ends in .fmu"),
        (&["header", "m.toml", "-o", "other.toml"], "other.toml has the name of a model file"),
    ] {
        let output = place.ancf14(arguments);
        assert_eq!(code(&output), 2, "{arguments:?}");
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
    }
    assert_eq!(fs::read_to_string(place.at("taken")).unwrap(), "kept");
    assert_eq!(code(&place.ancf14(&["check", "m.toml", "--draw", "m.PNG"])), 0);
    assert!(fs::read(place.at("m.PNG")).unwrap().starts_with(b"\x89PNG"));
}

/// A run that would fill the disk is refused, by `check` too.
#[test]
fn regression_the_number_of_rows_is_bounded() {
    let place = Place::new();
    for command in ["run", "check"] {
        for step in ["1e-12", "5e-324"] {
            let output = place.ancf14(&[command, "m.toml", "--set", &format!("simulation.output_step={step}")]);
            assert_eq!(code(&output), 2);
            assert!(text(&output.stderr).contains("rows of results"), "{}", text(&output.stderr));
        }
    }
    assert!(!place.at("m-results/results.part.csv").exists());
}
