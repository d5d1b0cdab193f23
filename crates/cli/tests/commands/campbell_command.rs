//! Do `ancf14 campbell`, `ancf14 linearize --steady` and `ancf14 reduce` print and write what docs/linearization.md
//! says, and refuse what has no meaning?

use super::printed;
use std::path::Path;
use std::process::{Command, Output};

/// A mass on two springs in a plane that turns: `λ⁴ + 2(ω² + Ω²)λ² + (ω² − Ω²)² = 0` in the frame that turns, `λ = ±i(ω ±
/// Ω)`, with `ω = 10 rad/s`: the lower one stands still at 10 rad/s.
const WHIRL: &str = r#"format = 1
model = { name = "Whirl", gravity = [0, 0, 0] }
body.rotor = { mass = 1, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1] }
body.carrier = { mass = 1e-9, position = [0, 0, 0], inertia = [1e-9, 1e-9, 1e-9] }
body.mass = { mass = 2, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1] }
joint.shaft = { type = "revolute", a = "ground", b = "rotor", axis = [0, 0, 1] }
joint.x = { type = "prismatic", a = "rotor", b = "carrier", axis = [1, 0, 0], stiffness = 200 }
joint.y = { type = "prismatic", a = "carrier", b = "mass", axis = [0, 1, 0], stiffness = 200 }
drive.motor = { joint = "shaft", coordinate = "angle", value = "5*t" }
load.push = { at = "mass", force = [0, 0, 0], input = true }
output.mass = { at = "y", quantities = ["distance"] }
simulation = { stop = 2, step = 1e-3 }
"#;

fn ancf14(directory: &Path, arguments: &[&str]) -> Output {
    std::fs::write(directory.join("whirl.toml"), WHIRL).unwrap();
    Command::new(env!("CARGO_BIN_EXE_ancf14")).current_dir(directory).args(arguments).output().unwrap()
}

/// The table, the CSV file with the closed form in every row, the diagram with its strokes.
#[test]
fn tables_and_diagrams_have_the_vibrations() {
    let directory = tempfile::tempdir().unwrap();
    let arguments = ["campbell", "whirl.toml", "--speeds", "0:8:2", "-o", "c.csv", "--plot", "c.svg"];
    let text = printed(&ancf14(directory.path(), &arguments));
    assert!(text.contains("frequencies in the frame that turns") || text.contains("in the fixed frame"), "{text}");
    let list = std::fs::read_to_string(directory.path().join("c.csv")).unwrap();
    let rows: Vec<&str> = list.lines().collect();
    assert_eq!(rows[0], "speed,mode,frequency,damping_ratio,real,direction,unstable");
    assert_eq!(rows.len(), 11, "{list}");
    let is_turning = text.contains("the frame that turns");
    for row in &rows[1..] {
        let cells: Vec<&str> = row.split(',').collect();
        let number = |cell: usize| cells[cell].parse::<f64>().unwrap();
        let (speed, frequency) = (number(0), std::f64::consts::TAU * number(2));
        let exact = if is_turning { [10.0 - speed, 10.0 + speed] } else { [10.0, 10.0] };
        assert!(exact.iter().any(|exact| (frequency / exact - 1.0).abs() < 1e-6), "{row}");
        assert_eq!(cells[6], "0", "{row}");
    }
    let picture = std::fs::read_to_string(directory.path().join("c.svg")).unwrap();
    assert!(picture.contains("mode 1") && picture.contains("1 x and 2 x the speed"), "{}", &picture[..200]);
}

/// `linearize --steady` names the rotation and the frame; `modes` names the command.
#[test]
fn steady_rotations_are_named() {
    let directory = tempfile::tempdir().unwrap();
    let text = printed(&ancf14(directory.path(), &["linearize", "whirl.toml", "--steady", "motor=4"]));
    assert!(text.contains("about the rotation of motor with 4 rad/s, in the f"), "{text}");
    let text = printed(&ancf14(directory.path(), &["modes", "whirl.toml"]));
    assert!(text.contains("ancf14 campbell --drive motor"), "{text}");
    for (arguments, reason) in [
        (&["linearize", "whirl.toml", "--steady", "motor"][..], "motor=100"),
        (&["linearize", "whirl.toml", "--steady", "engine=1"], "its drives are: motor"),
        (&["campbell", "whirl.toml", "--speeds", "5:0:1"], "rises from FIRST to LAST"),
        (&["campbell", "whirl.toml", "--speeds", "0,2,1"], "must rise"),
        (&["linearize", "whirl.toml", "--steady", "motor=1", "--check"], "cannot be used with"),
    ] {
        let output = ancf14(directory.path(), arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && message.contains(reason), "{arguments:?}: {message}");
    }
}

/// A rod with damping, reduced to a file; what has no damping says why not.
#[test]
fn reduced_systems_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let rod = r#"format = 1
model = { name = "Rod", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 1e-3 }
section.rod = { shape = "circle", radius = 0.01 }
beam.arm = { material = "steel", section = "rod", from = [0, 0, 0], to = [1, 0, 0], elements = 4 }
joint.root = { type = "weld", a = "ground", b = "arm.start" }
load.push = { at = "arm.end", force = [0, 0, 0], input = true }
output.tip = { at = "arm.end", quantities = ["displacement"] }
simulation = { stop = 1, step = 1e-3 }
"#;
    std::fs::write(directory.path().join("rod.toml"), rod).unwrap();
    let inputs = ["--inputs", "push.force[3]", "--outputs", "tip.displacement[3]"];
    let run = |more: &[&str]| {
        let arguments: Vec<&str> =
            ["reduce", "rod.toml"].into_iter().chain(inputs).chain(more.iter().copied()).collect();
        ancf14(directory.path(), &arguments)
    };
    let text = printed(&run(&["--order", "4", "--check", "-o", "small.json"]));
    assert!(text.contains("states reduced to 4, the error is at most") && text.contains("largest error"), "{text}");
    let file = std::fs::read_to_string(directory.path().join("small.json")).unwrap();
    assert!(file.contains("\"states\":[\"balanced[1]\""), "{file}");
    let text = printed(&run(&["--error", "1%", "--method", "modal", "-o", "small.npz"]));
    assert!(text.contains("states reduced to"), "{text}");
    let text = printed(&run(&["--order", "6", "--method", "craig-bampton", "-o", "small.json"]));
    assert!(text.contains("states reduced to 6: small.json\nthe largest error at the frequencies"), "{text}");
    let file = std::fs::read_to_string(directory.path().join("small.json")).unwrap();
    assert!(file.contains("\"states\":[\"mode[1]\",\"mode[2]\",\"static[1]\",\"mode[1].rate\""), "{file}");
    let output = run(&["--order", "1", "--method", "craig-bampton", "-o", "small.json"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("ask for at least 2, or take --method balanced"));
    let output = run(&["--error", "2", "-o", "small.npz"]);
    assert!(String::from_utf8_lossy(&output.stderr).contains("a share between 0 and 1"));
}
