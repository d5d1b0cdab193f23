//! Does `ancf14 linearize` write what docs/linearization.md says, and refuse what it cannot do? And does `ancf14 modes
//! --damped` give the same poles?

use ancf14_testing::root;
use std::path::Path;
use std::process::{Command, Output};

fn ancf14(directory: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ancf14")).current_dir(directory).args(arguments).output().unwrap()
}

fn model(name: &str) -> String {
    format!("{}/models/{name}.toml", root().display())
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A mass on a spring and a damper along x, `m = 2 kg`, `k = 200 N/m`, `c = 4 N s/m`, with a force as the input: `λ² + 2
/// λ + 100 = 0`.
const SLIDER: &str = r#"format = 1
model = { name = "Slider", gravity = [0, 0, 0] }
body.slider = { mass = 2, position = [0, 0, 0], inertia = [0.1, 0.1, 0.1] }
joint.rail = { type = "prismatic", a = "ground", b = "slider", axis = [1, 0, 0], damping = 4, stiffness = 200 }
load.push = { at = "slider", force = [0, 0, 0], input = true }
output.way = { at = "rail", quantities = ["distance", "distance_rate"] }
simulation = { stop = 1, step = 1e-3 }
"#;

/// The poles as a table, `f = 10/2π`, `ζ = 0.1`.
#[test]
fn poles_are_listed() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("slider.toml"), SLIDER).unwrap();
    let output = ancf14(directory.path(), &["linearize", "slider.toml"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let table = text(&output.stdout);
    let cells: Vec<&str> = table.lines().nth(1).unwrap().split_whitespace().collect();
    assert_eq!(cells, ["1", "1.59155", "1.58357", "0.1000", "-1.00000", "oscillating"], "{table}");
    assert!(table.contains("2 states, 6 inputs, 2 outputs at t = 0 s"), "{table}");
    let damped = ancf14(directory.path(), &["modes", "slider.toml", "--damped"]);
    assert!(damped.status.success(), "{}", text(&damped.stderr));
    let row = text(&damped.stdout).lines().nth(1).unwrap().to_owned();
    assert!(row.starts_with("1     1.59155       1.58357    0.1000         oscillating  slider"), "{row}");
    let list = std::fs::read_to_string(directory.path().join("slider-results/damped_modes.csv")).unwrap();
    let rows: Vec<&str> = list.lines().collect();
    assert_eq!(rows[0], "mode,kind,frequency,damped_frequency,damping_ratio,real,imaginary,moves");
    let ratio: f64 = rows[1].split(',').nth(4).unwrap().parse().unwrap();
    assert!(rows.len() == 2 && (ratio - 0.1).abs() < 1e-14, "{list}");
}

/// `A = [0 1; −100 −2]`, `B = [0; ½]`, `C = 1`, in JSON exactly as computed; the other files have the same numbers.
#[test]
fn files_have_the_matrices() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("slider.toml"), SLIDER).unwrap();
    for file in ["s.json", "s.npz", "s.mat"] {
        let arguments =
            ["linearize", "slider.toml", "--inputs", "push.force[1]", "--outputs", "way.distance", "-o", file];
        let output = ancf14(directory.path(), &arguments);
        assert!(output.status.success(), "{}", text(&output.stderr));
        assert!(text(&output.stdout).ends_with(&format!("2 states, 1 inputs, 1 outputs at t = 0 s: {file}\n")));
    }
    let read = |name: &str| std::fs::read(directory.path().join(name)).unwrap();
    let document: serde_json::Value = serde_json::from_slice(&read("s.json")).unwrap();
    let number = |name: &str, row: usize, column: usize| document[name][row][column].as_f64().unwrap();
    let a = [number("A", 0, 0), number("A", 0, 1), number("A", 1, 0), number("A", 1, 1)];
    let exact = [0.0, 1.0, -100.0, -2.0];
    assert!(a.iter().zip(exact).all(|(own, exact)| (own - exact).abs() < 1e-12), "{a:?}");
    assert!((number("B", 1, 0) - 0.5).abs() < 1e-14 && (number("C", 0, 0) - 1.0).abs() < 1e-10);
    assert_eq!(document["states"][1], "slider.position[1].rate");
    // Both begin as their formats say, and hold the numbers of A.
    let (archive, matlab) = (read("s.npz"), read("s.mat"));
    assert!(archive.starts_with(b"PK") && matlab.starts_with(b"MATLAB 5.0") && &matlab[124..128] == b"\x00\x01IM");
    let column = [a[0].to_le_bytes(), a[2].to_le_bytes(), a[1].to_le_bytes(), a[3].to_le_bytes()].concat();
    for bytes in [archive, matlab] {
        assert!(bytes.windows(column.len()).any(|own| own == column));
    }
}

/// With inputs that are held for `h`, the slider follows `A = exp(h A)` of `λ = −1 ± √99 i`, and its static answer stays
/// `1/k`: `C (1 − A)⁻¹ B = 1/200`.
#[test]
fn sampled_matrices_are_exact() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("slider.toml"), SLIDER).unwrap();
    let common = ["linearize", "slider.toml", "--inputs", "push.force[1]", "--outputs", "way.distance", "-o"];
    let run = |more: &[&str]| ancf14(directory.path(), &[&common[..], more].concat());
    assert!(run(&["s.json", "--discrete", "0.05"]).status.success());
    let read = std::fs::read(directory.path().join("s.json")).unwrap();
    let document: serde_json::Value = serde_json::from_slice(&read).unwrap();
    assert_eq!(document["dt"], 0.05);
    let number = |name: &str, row: usize, column: usize| document[name][row][column].as_f64().unwrap();
    let (h, w) = (0.05_f64, 99.0_f64.sqrt());
    let (decay, sine, cosine) = ((-h).exp(), (w * h).sin(), (w * h).cos());
    let exact =
        [[cosine + sine / w, sine / w], [-100.0 * sine / w, cosine - sine / w]].map(|row| row.map(|own| own * decay));
    for (row, exact) in exact.iter().enumerate() {
        // Round-off of a series and some doublings, beside an entry of 8.
        (0..2).for_each(|column| assert!((number("A", row, column) - exact[column]).abs() < 1e-13, "{row} {column}"));
    }
    let [[a, b], [c, d]] = [0, 1].map(|row| [0, 1].map(|column| f64::from(row == column) - number("A", row, column)));
    let [f, g] = [0, 1].map(|row| number("B", row, 0));
    let answer = number("C", 0, 0) * (d * f - b * g) / (a * d - b * c);
    assert!((200.0 * answer - 1.0).abs() < 1e-12, "{answer}");
    for (file, expected) in [("s.mo", "s.mo is a system of continuous time"), ("s.json", "a time above 0 was expected")]
    {
        let refused = run(&[file, "--discrete", if file == "s.mo" { "0.05" } else { "0" }]);
        assert!(!refused.status.success() && text(&refused.stderr).contains(expected), "{}", text(&refused.stderr));
    }
}

/// A model of Modelica names inputs and outputs, takes whole values, and has the numbers of the matrices.
#[test]
fn models_of_modelica_are_written() {
    let directory = tempfile::tempdir().unwrap();
    let pushed = SLIDER.replace("force = [0, 0, 0]", "force = [3, 0, 0]").replace("Slider", "end");
    std::fs::write(directory.path().join("slider.toml"), pushed).unwrap();
    let inputs = ["--inputs", "push.force[1]", "--outputs", "way.distance,way.distance_rate", "-o", "s.mo"];
    let output =
        ancf14(directory.path(), &[&["linearize", "slider.toml", "--at", "equilibrium"], &inputs[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let model = std::fs::read_to_string(directory.path().join("s.mo")).unwrap();
    // `end` is a word of the language.
    assert!(model.starts_with("model x_end \"Linear system of end") && model.ends_with("end x_end;\n"), "{model}");
    for line in [
        "  Modelica.Blocks.Interfaces.RealInput push_force_1(unit = \"N\") \"push.force[1]\";",
        "  Modelica.Blocks.Interfaces.RealOutput way_distance(unit = \"m\") \"way.distance\";",
        "  parameter Real u0[1] = {3e0} \"inputs in the state that it is about\";",
        "  system.u[1] = push_force_1 - u0[1];",
        "  way_distance_rate = system.y[2] + y0[2];",
    ] {
        assert!(model.lines().any(|own| own == line), "{line} in {model}");
    }
    let rows = model.split("A = [").nth(1).unwrap().split(']').next().unwrap();
    let a: Vec<f64> = rows.split([',', ';']).map(|own| own.trim().parse().unwrap()).collect();
    assert!(a.iter().zip([0.0, 1.0, -100.0, -2.0]).all(|(own, exact)| (own - exact).abs() < 1e-9), "{a:?}");
}

/// A run that begins with the mode shows the pole to what its steps and its amplitude leave: 2e-5 of the midpoint rule
/// with 400 steps in a period.
#[test]
fn a_run_checks_the_softest_vibration() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("slider.toml"), SLIDER).unwrap();
    let output = ancf14(directory.path(), &["linearize", "slider.toml", "--check", "--json"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let run = [0, 1].map(|part| document["check"]["run"][part].as_f64().unwrap());
    let difference = document["check"]["difference"].as_f64().unwrap();
    println!("{run:?}, {difference:.1e}");
    assert!((run[0] + 1.0).abs() < 1e-3 && (run[1] - 99.0_f64.sqrt()).abs() < 1e-3 && difference < 1e-4);
    let output = ancf14(directory.path(), &["linearize", "slider.toml", "--check"]);
    assert!(text(&output.stdout).contains("check: the softest vibration has the pole -1.00000 ± 9.94987i rad/s"));
    let moving = ancf14(directory.path(), &["linearize", &model("pendulum"), "--at", "0.01", "--check"]);
    assert!(moving.status.code() == Some(2) && text(&moving.stderr).contains("--check is for a state at rest"));
}

/// A cantilever is at rest about its equilibrium; as drawn it is not, which is told with the remedy.
#[test]
fn the_state_is_that_of_at() {
    let directory = tempfile::tempdir().unwrap();
    let cantilever = model("cantilever");
    let at = |arguments: &[&str]| {
        let mut all = vec!["linearize", cantilever.as_str()];
        all.extend(arguments);
        let output = ancf14(directory.path(), &all);
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stderr)
    };
    assert!(at(&[]).contains("not in equilibrium") && at(&[]).contains("--at equilibrium"));
    assert!(!at(&["--at", "equilibrium"]).contains("not in equilibrium"));
    assert!(at(&["--at", "0.05"]).contains("the mechanism moves"));
}

#[test]
fn mistakes_are_told() {
    let directory = tempfile::tempdir().unwrap();
    let cantilever = model("cantilever");
    for (arguments, code, expected) in [
        (&["-o", "m.csv"][..], 2, "ends in .npz, .mat, .json, .mo or .fmu"),
        (&["-o", "m.npz", "--library", "l.so"], 2, "--library is for an FMU"),
        (&["--at", "-1"], 2, "equilibrium, start or a time from 0 on"),
        (&["--at", "1e9"], 2, "is after the end of the run"),
        (&["--outputs", "nothing"], 1, "no output `nothing`"),
        (&["--set", "arm.elements=200"], 1, "poles are found of at most 1500 states, and this mechanism has"),
    ] {
        let mut all = vec!["linearize", cantilever.as_str()];
        all.extend(arguments);
        let output = ancf14(directory.path(), &all);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
        assert!(text(&output.stderr).contains(expected), "{}", text(&output.stderr));
    }
}

/// Bode's diagram has a title, both axes and its frequencies; ends of the range that make none are refused.
#[test]
fn bode_diagrams_are_drawn() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("slider.toml"), SLIDER).unwrap();
    let arguments = ["linearize", "slider.toml", "--inputs", "push.force[1]", "--outputs", "way.distance"];
    let bode = |range: &str| {
        let more = ["--bode", "bode.svg", "--frequencies", range];
        ancf14(directory.path(), &[&arguments[..], &more].concat())
    };
    let output = bode("0.1:10");
    assert!(output.status.success(), "{}", text(&output.stderr));
    let picture = std::fs::read_to_string(directory.path().join("bode.svg")).unwrap();
    for words in ["Slider: way.distance by push.force[1]", "magnitude (dB)", "phase (degrees)", "frequency (Hz)"] {
        assert!(picture.contains(words), "{words}");
    }
    for range in ["10:1", "0:5", "1", "a:b"] {
        let output = bode(range);
        assert_eq!(output.status.code(), Some(2), "{range}");
        assert!(text(&output.stderr).contains("two frequencies above 0 in Hz were expected"), "{range}");
    }
}

/// The map has the kinds of the poles; a file that another picture has is refused.
#[test]
fn poles_are_drawn() {
    let directory = tempfile::tempdir().unwrap();
    std::fs::write(directory.path().join("slider.toml"), SLIDER).unwrap();
    let run = |more: &[&str]| ancf14(directory.path(), &[&["linearize", "slider.toml"], more].concat());
    let output = run(&["--pole-map", "poles.svg", "--poles=5"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    let picture = std::fs::read_to_string(directory.path().join("poles.svg")).unwrap();
    for words in ["Slider: poles", "real part (rad/s)", "imaginary part (rad/s)", "oscillating"] {
        assert!(picture.contains(words), "{words}");
    }
    let output = run(&["--pole-map", "a.svg", "--bode", "a.svg"]);
    assert!(text(&output.stderr).contains("--pole-map and --bode name the same file"), "{}", text(&output.stderr));
}
