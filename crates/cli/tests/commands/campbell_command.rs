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

/// A balanced disk of 5 kg in the middle of a steel shaft with internal damping, which is unstable above its critical
/// speed.
const SHAFT: &str = r#"format = 1
model = { name = "Shaft", gravity = [0, 0, 0] }
material.steel = { young = 2.1e11, poisson = 0.3, density = 7850, damping = 2e-4 }
section.shaft = { shape = "circle", radius = 0.01 }
beam.shaft = { material = "steel", section = "shaft", from = [0, 0, 0], to = [1, 0, 0], elements = 8 }
body.disk = { mass = 5, position = [0.5, 0, 0], inertia = [0.025, 0.0125, 0.0125] }
joint.hub = { type = "weld", a = "shaft@0.5", b = "disk", at = [0.5, 0, 0] }
joint.left = { type = "revolute", a = "ground", b = "shaft.start", axis = [1, 0, 0] }
joint.right = { type = "inline", a = "ground", b = "shaft.end", axis = [1, 0, 0] }
drive.motor = { joint = "left", coordinate = "angle", rate = "60*smoothstep(0, 0.3, t)" }
output.whirl = { at = "shaft@0.5", quantities = ["displacement"] }
simulation = { stop = 0.5, output_step = 2e-3 }
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

/// A rotor without an unbalance has no steady rotation at its critical speed itself, where nothing holds the whirl: the
/// search goes on beside it.
#[test]
fn balanced_rotors_pass_their_critical_speed() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("shaft.toml"), SHAFT).unwrap();
    let output = ancf14(directory.path(), &["campbell", "shaft.toml", "--speeds", "0:300:50", "--json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let critical = document["critical_speeds"].as_array().unwrap();
    let forward: Vec<f64> =
        critical.iter().filter(|own| own["direction"] == "forward").map(|own| own["speed"].as_f64().unwrap()).collect();
    // The left bearing holds the slope, the right one does not. Rayleigh's quotient with the shape of a force in the
    // middle, w = x^2 (9 - 11 x) and y (3 - 5 y^2) from the other end: the shaft counts with the mean of its square, and
    // the disk with a slope of 6/7, forward and as fast as the rotation. The true shape makes 1e-3 at most.
    let (inertia, mass) = (std::f64::consts::PI * 1e-8 / 4.0, 7850.0 * std::f64::consts::PI * 1e-4);
    let mean_square = (81.0 / 160.0 - 33.0 / 64.0 + 121.0 / 896.0 + 3.0 / 8.0 - 6.0 / 32.0 + 25.0 / 896.0) / 0.765625;
    let of_disk = 5.0 + (0.0125 - 0.025) * (6.0_f64 / 7.0).powi(2);
    let exact = (768.0 / 7.0 * 2.1e11 * inertia / (of_disk + mean_square * mass)).sqrt();
    assert!(forward.len() == 1 && (forward[0] / exact - 1.0).abs() < 1e-3, "{forward:?} {exact}");
}

/// In the frame that turns, both modes are circles, at `10 − Ω` and `−10 − Ω`: an unbalance excites the first one where
/// it stands still, at 10 rad/s. A load fixed in space goes round with `−Ω` and meets neither, although `10 − Ω` has its
/// frequency at 5 rad/s.
#[test]
fn circles_answer_to_loads_of_their_own_direction() {
    let directory = tempfile::tempdir().unwrap();
    let output = ancf14(directory.path(), &["campbell", "whirl.toml", "--speeds", "0:15:3", "--json"]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let critical = document["critical_speeds"].as_array().unwrap();
    let speeds: Vec<f64> = critical.iter().map(|own| own["speed"].as_f64().unwrap()).collect();
    assert!(speeds.len() == 1 && (speeds[0] / 10.0 - 1.0).abs() < 1e-6, "{document}");
    assert!(critical[0]["direction"] == "forward" && critical[0]["excited_by"] == "unbalance", "{document}");
}

/// A system in which nothing fades is kept as a whole: there is nothing to leave out.
#[test]
fn systems_that_do_not_fade_stay_whole() {
    let directory = tempfile::tempdir().unwrap();
    let output = ancf14(directory.path(), &["reduce", "whirl.toml", "--order", "50", "-o", "small.json"]);
    let text = printed(&output);
    assert!(text.starts_with("4 states reduced to 4, 4 of them kept exactly, the error is at most 0.0e0"), "{text}");
}

/// For programs: what moves most in each mode, beside speeds and frequencies.
#[test]
fn programs_get_what_moves() {
    let directory = tempfile::tempdir().unwrap();
    let output = ancf14(directory.path(), &["campbell", "whirl.toml", "--speeds", "0:8:4", "--json"]);
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let moves: Vec<&str> = document["moves"].as_array().unwrap().iter().map(|own| own.as_str().unwrap()).collect();
    let points: Vec<usize> =
        document["modes"].as_array().unwrap().iter().map(|own| own.as_array().unwrap().len()).collect();
    assert!(moves.len() == 2 && points == [3, 3], "{document}");
    assert!(moves.iter().all(|own| ["carrier", "mass"].contains(own)), "{moves:?}");
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
