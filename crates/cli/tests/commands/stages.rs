//! A motion in stages: `ancf14 run --save-state` and `--from-state`. A run in two parts must give the bits of one,
//! whatever is saved and read on the way; a second file with other loads and drives must begin where the first one has
//! ended; the state of another mechanism must be refused in words; and the commands of docs/command-line.md must work
//! as they are printed.

use crate::printed;
use ancf14_testing::root;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A clamped strip under a load, with a block on a spring at its end.
pub const MODEL: &str = r#"format = 1
[model]
name = "Strip"
gravity = [0, 0, -9.81]
[material.steel]
young = 210e9
poisson = 0.3
density = 7850
damping = 1e-4
[section.strip]
shape = "rectangle"
width = 0.02
height = 0.001
[beam.strip]
material = "steel"
section = "strip"
from = [0, 0, 0]
to = [0.3, 0, 0]
elements = 4
[joint.clamp]
type = "weld"
a = "ground"
b = "strip.start"
[body.block]
mass = 0.01
position = [0.3, 0, 0.1]
inertia = [1e-6, 1e-6, 1e-6]
[joint.rail]
type = "prismatic"
a = "ground"
b = "block"
axis = [0, 0, 1]
[spring.tie]
a = "strip.end"
b = "block"
stiffness = 50
length = 0.1
[load.finger]
at = "strip.end"
force = [0, 0, "-2*t/0.1"]
[output.tip]
at = "strip.end"
quantities = ["displacement", "velocity", "acceleration"]
[output.rail]
at = "rail"
quantities = ["distance"]
[simulation]
stop = 0.2
output_step = 0.005
totals = ["energy", "work", "statistics"]
"#;

pub fn run(folder: &Path, model: &str, out: &str, arguments: &[&str]) -> Output {
    fs::write(folder.join("m.toml"), model).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ancf14"));
    command.current_dir(folder).args(["run", "m.toml", "-o", out]).args(arguments);
    command.output().unwrap()
}

pub fn rows(folder: &Path, out: &str) -> Vec<String> {
    fs::read_to_string(folder.join(out).join("results.csv")).unwrap().lines().map(str::to_owned).collect()
}

/// The columns of a name, row by row.
pub fn column(rows: &[String], name: &str) -> Vec<f64> {
    let place = rows[0].split(',').position(|own| own == name).unwrap_or_else(|| panic!("no column {name}"));
    rows[1..].iter().map(|row| row.split(',').nth(place).unwrap().parse().unwrap()).collect()
}

/// The rows of a whole run, of its first half and of its second one, which begins with the state of the first.
fn halves(settings: &str, model: &str) -> [Vec<String>; 3] {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let arguments = |more: &[&'static str]| settings.split_whitespace().chain(more.iter().copied()).collect::<Vec<_>>();
    printed(&run(folder, model, "whole", &arguments(&[])));
    printed(&run(folder, model, "first", &arguments(&["--set", "simulation.stop=0.1", "--save-state", "state"])));
    printed(&run(folder, model, "second", &arguments(&["--from-state", "state"])));
    ["whole", "first", "second"].map(|out| rows(folder, out))
}

/// Two runs, the second one from the state of the first, have the rows of one run, byte by byte: of both integrators
/// and in statics.
#[test]
fn two_parts_are_one_run() {
    let equilibria = MODEL.replace("\"work\", ", "");
    for (settings, model) in [
        ("--set simulation.step=1e-3", MODEL),
        (
            "--set simulation.step=1e-3 --set simulation.integrator=generalized_alpha --set simulation.spectral_radius=0.8",
            MODEL,
        ),
        ("--set simulation.analysis=static", &equilibria),
    ] {
        let [whole, first, second] = halves(settings, model);
        assert_eq!(first[..], whole[..22], "{settings}");
        assert_eq!(second[0], whole[0]);
        assert_eq!(second[1..], whole[21..], "{settings}");
    }
}

/// Both parts of a run tell their own counts, which make up those of the whole; results count on.
#[test]
fn each_part_tells_its_own_steps() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let steps = |out: &str, arguments: &[&str]| {
        let output = run(folder, MODEL, out, &[&["--set", "simulation.step=1e-3"], arguments].concat());
        let summary = fs::read_to_string(folder.join(out).join("summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        let steps = summary["steps"].as_u64().unwrap();
        let said = printed(&output);
        assert!(said.contains(&format!(": {steps} steps, ")), "{said}");
        [steps, summary["iterations"].as_u64().unwrap()]
    };
    let whole = steps("whole", &[]);
    let first = steps("first", &["--set", "simulation.stop=0.1", "--save-state", "state"]);
    let second = steps("second", &["--from-state", "state"]);
    assert_eq!(first[0], 100);
    assert_eq!([first[0] + second[0], first[1] + second[1]], whole);
    let counted = column(&rows(folder, "second"), "statistics.steps");
    assert_eq!((counted.first(), counted.last()), (Some(&100.0), Some(&200.0)));
}

/// Steps that the solver chooses depend on how long the run is to be: two runs are one within the accuracy of the
/// steps, and the second one begins with the last row of the first.
#[test]
fn chosen_steps_go_on_too() {
    let [whole, first, second] = halves("--set simulation.accuracy=1e-5", MODEL);
    assert_eq!(first.last(), second.get(1));
    let [whole, second] = [whole, second].map(|rows| column(&rows, "tip.displacement[3]"));
    let range = whole.iter().fold(0.0_f64, |most, own| most.max(own.abs()));
    let error = second.iter().zip(&whole[20..]).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    println!("{error:e} of {range}");
    assert!(error < 1e-3 * range, "{error:e} of {range}");
}

/// A static path draws the strip, and a second file without its load lets it go: the motion begins where the path has
/// ended, at rest, and its energy is that of the path.
#[test]
fn another_file_begins_where_the_first_one_has_ended() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let drawn = ["--set", "simulation.analysis=static", "--set", "simulation.stop=0.1", "--save-state", "state"];
    let model = MODEL.replace("\"work\", ", "");
    printed(&run(folder, &model, "drawn", &drawn));
    let free = model.replace("-2*t/0.1", "0").replace("damping = 1e-4", "");
    printed(&run(folder, &free, "free", &["--from-state", "state"]));
    let [drawn, free] = ["drawn", "free"].map(|out| rows(folder, out));
    assert_eq!(column(&free, "time")[0], 0.1);
    for name in ["tip.displacement[3]", "rail.distance", "energy.elastic"] {
        let (last, first) = (*column(&drawn, name).last().unwrap(), column(&free, name)[0]);
        assert!((last - first).abs() < 1e-12 * last.abs().max(1e-3), "{name}: {last} {first}");
    }
    assert_eq!(column(&free, "tip.velocity[3]")[0], 0.0);
    let total = column(&free, "energy.total");
    let kinetic = column(&free, "energy.kinetic").iter().fold(0.0_f64, |most, own| most.max(*own));
    // The load is gone: nothing works on the strip any more. Chosen steps keep the energy to 1e-3 of it.
    let drift = total.iter().fold(0.0_f64, |most, own| most.max((own - total[0]).abs()));
    assert!(kinetic > 0.02 && drift < 1e-3 * total[0], "{kinetic} {drift}");
}

/// Each mistake is told, and nothing is computed.
#[test]
fn other_states_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    printed(&run(folder, MODEL, "first", &["--set", "simulation.stop=0.1", "--save-state", "state"]));
    let refused = |model: &str, arguments: &[&str], text: &str| {
        let ran = run(folder, model, "refused", arguments);
        let message = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(2), "{message}");
        assert!(message.contains(text), "{message}");
        assert!(!folder.join("refused/results.csv").exists());
    };
    let from = ["--from-state", "state"];
    refused(&MODEL.replace("elements = 4", "elements = 5"), &from, "the state has beam strip with 4 elements");
    refused(&MODEL.replace("[0.3, 0, 0.1]", "[0.3, 0, 0.2]"), &from, "the parts are drawn elsewhere");
    refused(&MODEL.replace("spring.tie", "spring.bond"), &from, "the state has spring tie");
    refused(MODEL, &["--from-state", "state", "--set", "simulation.stop=0.1"], "give a later end");
    refused(MODEL, &["--from-state", "m.toml"], "is not a state written by");
    refused(MODEL, &["--from-state", "missing"], "cannot read missing");
    refused(MODEL, &["--from-state", "state", "--save-state", "state"], "choose another name to write to");
    refused(MODEL, &["--save-state", "refused/results.csv"], "is a file of the results");
    let ran = run(folder, MODEL, "refused", &["--save-state", "missing/state"]);
    assert_eq!(ran.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&ran.stderr).contains("cannot write missing/state"));
    assert!(!folder.join("refused/results.part.csv").exists());
    let mut damaged = fs::read(folder.join("state")).unwrap();
    *damaged.last_mut().unwrap() ^= 1;
    fs::write(folder.join("state"), damaged).unwrap();
    refused(MODEL, &from, "checksum");
}

/// A strip that has been paid out goes on with the length that it has, by another rate; a file that begins at another
/// length, or pays out the other end, is refused.
#[test]
fn winches_go_on_from_their_length() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let winch = |at: &str, law: &str| format!("{MODEL}[winch.reel]\nat = \"strip.{at}\"\n{law}\n");
    let first = winch("start", "length = \"0.05*smoothstep(0, 0.1, t)\"");
    printed(&run(folder, &first, "first", &["--set", "simulation.stop=0.1", "--save-state", "state"]));
    let from = ["--from-state", "state"];
    let (whole, second) =
        (run(folder, &first, "whole", &[]), run(folder, &winch("start", "rate = 0"), "second", &from));
    printed(&whole);
    printed(&second);
    let [whole, second] = ["whole", "second"].map(|out| rows(folder, out));
    for name in ["tip.displacement[3]", "energy.elastic"] {
        let (own, other) = (column(&second, name), column(&whole, name));
        let (own, other) = (own[own.len() - 1], other[other.len() - 1]);
        // Both choose their steps.
        assert!((own - other).abs() < 1e-2 * other.abs(), "{name}: {own} {other}");
    }
    for (model, text) in [
        (winch("start", "length = 0"), "winch reel has paid out 0.050000 m in the state, but begins at 0.000000 m"),
        (winch("end", "rate = 0"), "the state has winch reel at strip.start"),
    ] {
        let ran = run(folder, &model, "refused", &from);
        let message = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert!(!ran.status.success() && message.contains(text), "{message}");
    }
}

/// A frame that moves is drawn where it is at t = 0 in every part of the motion: another file takes the strip over from
/// it, and a run of that file in two parts has the bits of one.
#[test]
fn moving_frames_go_on() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let clamp = "a = \"ground\"\nb = \"strip.start\"";
    let frame = "[frame.table]\nposition = [0, 0, \"2*t^2\"]\nrotation = [0, \"5*t^2\", 0]\n[joint.clamp]";
    let first = MODEL.replace(clamp, "a = \"table\"\nb = \"strip.start\"").replace("[joint.clamp]", frame);
    let first = first.replace("stop = 0.2", "stop = 0.2\nstep = 1e-3");
    let other = first.replace("stiffness = 50", "stiffness = 60");
    printed(&run(folder, &first, "first", &["--set", "simulation.stop=0.1", "--save-state", "state"]));
    printed(&run(folder, &other, "whole", &["--from-state", "state"]));
    let half = ["--set", "simulation.stop=0.15", "--from-state", "state", "--save-state", "then"];
    printed(&run(folder, &other, "second", &half));
    printed(&run(folder, &other, "third", &["--from-state", "then"]));
    let [first, whole, third] = ["first", "whole", "third"].map(|out| rows(folder, out));
    let [last, begin] = [&first, &whole].map(|rows| column(rows, "tip.displacement[3]"));
    assert!((last.last().unwrap() - begin[0]).abs() < 1e-12, "{last:?} {begin:?}");
    assert_eq!(third[1..], whole[11..]);
}

/// Settings of a path.
const PATH: &str = r#"[simulation]
analysis = "static"
follow = "arc_length"
step = 0.02"#;

/// The arc length of a path is not a time that another model could begin at.
#[test]
fn paths_are_continued_by_their_own_model_only() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let model = MODEL.replace("\"work\", ", "").replace("[simulation]", PATH).replace("output_step = 0.005\n", "");
    printed(&run(folder, &model, "path", &["--set", "simulation.stop=0.1", "--save-state", "state"]));
    let other = run(folder, &model.replace("stiffness = 50", "stiffness = 60"), "other", &["--from-state", "state"]);
    let message = String::from_utf8_lossy(&other.stderr).into_owned();
    assert_eq!(other.status.code(), Some(2), "{message}");
    assert!(message.contains("the state is at an arc length of a path"), "{message}");
    let same = printed(&run(folder, &model, "same", &["--from-state", "state"]));
    assert!(same.contains("continues the run that left state"), "{same}");
}

/// The order of overrides makes no other model; another override does, and the program says so.
#[test]
fn the_program_says_whether_it_continues() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let overrides = ["--set", "simulation.step=1e-3", "--set", "tie.stiffness=60"];
    let begin = |more: &[&'static str], out: &str| {
        let said = printed(&run(folder, MODEL, out, more));
        said.lines().next().unwrap_or_default().to_owned()
    };
    begin(&[&overrides[..], &["--set", "simulation.stop=0.01", "--save-state", "state"]].concat(), "first");
    let [a, b, c, d] = overrides;
    let from = ["--set", "simulation.stop=0.02", "--from-state", "state"];
    assert_eq!(begin(&[&from[..], &[c, d, a, b]].concat(), "same"), "continues the run that left state");
    let other = "begins with the state of state: the model file or its overrides differ";
    assert_eq!(begin(&[&from[..], &[a, b]].concat(), "other"), other);
}

/// A wheel on a torsion spring, which a motor winds up.
const WHEEL: &str = r#"format = 1
[model]
name = "Wheel"
gravity = [0, 0, 0]
[body.wheel]
mass = 1
position = [1, 0, 0]
inertia = [1, 1, 1]
[joint.hinge]
type = "revolute"
a = "ground"
b = "wheel"
axis = [0, 0, 1]
stiffness = 1
damping = 0.1
[output.hinge]
at = "hinge"
quantities = ["angle"]
[output.wheel]
at = "wheel"
quantities = ["rotation"]
"#;

/// Winds the spring by three turns, in steps of less than half a turn.
const WOUND: &str = r#"[actuator.motor]
joint = "hinge"
coordinate = "angle"
effort = "60*pi*t"
[simulation]
analysis = "static"
stop = 0.1
step = 0.005
totals = ["energy"]
"#;

/// Another actuator and another output in front of those that were there: lists of the state are longer.
const UNWOUND: &str = r#"[point.pin]
offset = [0, 0, 0]
[actuator.rope]
a = "pin"
b = "wheel"
effort = 0
[simulation]
stop = 0.101
step = 1e-4
totals = ["energy"]
"#;

/// A spring that the first run has wound up by three turns is wound up in the second one, which measures more. Where
/// the angle is not that of the state, a warning says so.
#[test]
fn angles_keep_their_turns() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    printed(&run(folder, &[WHEEL, WOUND].concat(), "wound", &["--save-state", "state"]));
    let more = "[output.center]\nat = \"wheel\"\nquantities = [\"position\"]\n[output.hinge]";
    let unwound = WHEEL.replace("[output.hinge]", more) + UNWOUND;
    let ran = run(folder, &unwound, "unwound", &["--from-state", "state"]);
    printed(&ran);
    assert!(!String::from_utf8_lossy(&ran.stderr).contains("half a turn"));
    let rows = rows(folder, "unwound");
    let turns = 6.0 * std::f64::consts::PI;
    // The tolerance of the equilibrium and the digits of the trigonometric functions.
    for (name, wanted) in
        [("hinge.angle", turns), ("wheel.rotation[3]", turns), ("energy.elastic", 0.5 * turns * turns)]
    {
        let found = column(&rows, name)[0];
        assert!((found - wanted).abs() < 1e-9 * wanted, "{name}: {found} {wanted}");
    }
    // The spring turns the wheel back: 18.8 N m on 1 kg m² for 1 ms.
    let angles = column(&rows, "hinge.angle");
    assert!(angles[0] - angles.last().unwrap() > 0.9 * 0.5 * turns * 1e-6, "{angles:?}");
    let flipped =
        run(folder, &unwound.replace("axis = [0, 0, 1]", "axis = [0, 0, -1]"), "flipped", &["--from-state", "state"]);
    printed(&flipped);
    let warning = "the state does not have the angle of joint hinge";
    assert!(String::from_utf8_lossy(&flipped.stderr).contains(warning));
}

/// A run that begins with a state warns of its model as any run does: of dampers that steps do not resolve, and of
/// drives that jump.
#[test]
fn warnings_of_the_start_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let told = |first: &str, second: &str, warning: &str| {
        printed(&run(folder, first, "first", &["--set", "simulation.stop=0.1", "--save-state", "state"]));
        let arguments = ["--set", "simulation.stop=0.2", "--from-state", "state"];
        let message = String::from_utf8_lossy(&run(folder, second, "second", &arguments).stderr).into_owned();
        assert!(message.contains(warning), "{message}");
    };
    let moving = WHEEL.replace("mass = 1\n", "mass = 1\nangular_velocity = [0, 0, 1]\n");
    let moving = format!("{moving}[simulation]\nstop = 0.1\nstep = 1e-3\n");
    told(&moving, &moving.replace("damping = 0.1", "damping = 1e6"), "the damper of hinge stops what it holds");
    let driven = |value: &str| {
        format!(
            "{WHEEL}[drive.turn]\njoint = \"hinge\"\ncoordinate = \"angle\"\nvalue = {value}\n[simulation]\nstop = 0.1\nstep = 1e-3\n"
        )
    };
    told(&driven("0"), &driven("[{ until = 0.15, is = 0 }, { is = 0.1 }]"), "jumps by 0.1 at t = 0.15 s");
}

/// The page prints files and commands that work: the motion begins at rest where the load has drawn the strip, and
/// swings through to the other side.
#[test]
fn the_commands_of_the_page_work() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let page = fs::read_to_string(root().join("docs/command-line.md")).unwrap();
    let section = page.split("## A motion in stages").nth(1).unwrap().split("\n## ").next().unwrap();
    let listings = |language: &str| {
        let opening = format!("```{language}\n");
        let pieces = section.split(&opening).skip(1).map(|rest| rest.split("```").next().unwrap().to_owned());
        pieces.collect::<Vec<_>>()
    };
    for listing in listings("toml") {
        let name = listing.strip_prefix("# ").unwrap().split(':').next().unwrap();
        fs::write(folder.join(name), &listing).unwrap();
    }
    let commands = listings("sh");
    let commands: Vec<&str> = commands.iter().flat_map(|listing| listing.lines()).collect();
    assert_eq!(commands.len(), 2);
    for line in commands {
        let words = line.strip_prefix("ancf14 ").unwrap().split_whitespace();
        printed(&Command::new(env!("CARGO_BIN_EXE_ancf14")).current_dir(folder).args(words).output().unwrap());
    }
    let [drawn, released] = ["draw-results", "release-results"].map(|out| rows(folder, out));
    let [drawn, heights] = [drawn, released.clone()].map(|rows| column(&rows, "tip.displacement[3]"));
    let (last, first) = (*drawn.last().unwrap(), heights[0]);
    assert!((last - first).abs() < 1e-12 * last.abs(), "{last} {first}");
    assert_eq!(column(&released, "tip.velocity[3]")[0], 0.0);
    let highest = heights.iter().fold(0.0_f64, |most, own| most.max(*own));
    assert!(first < -0.03 && highest > 0.02, "{first} {highest}");
}
