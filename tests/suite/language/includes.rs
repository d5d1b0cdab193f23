//! Is a model of several files what its parts are, each with the name of its include before its own? The files are
//! written into a folder of this test; paths are relative to the file that names them.

use ancf14::model::document::Document;
use ancf14::model::file::{Folder, Reach};
use ancf14::model::simulation::Simulation;
use std::fs;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// A folder with files, for one test.
fn folder(test: &str, files: &[(&str, &str)]) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("includes-{test}"));
    for (name, text) in files {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn parse(folder: &std::path::Path, overrides: &[(&str, &str)]) -> Result<Document, String> {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    let text = fs::read_to_string(folder.join("m.toml")).unwrap();
    Document::parse_in(Some(Folder::new(folder, Reach::Inside)), "m.toml", &text, &overrides)
        .map_err(|mistakes| mistakes.to_string())
}

const BLADE: &str = r#"format = 1
[parameters]
length = { value = 1.0, unit = "m", min = 0.1 }
half = "length/2"
pieces = 2
[material.grp]
young = 2e10
poisson = 0.3
density = 1800
[section.spar]
shape = "circle"
radius = 0.02
[copy.parts]
count = "pieces"
[copy.parts.beam.spar]
material = "grp"
section = "spar"
from = ["(k - 1)*half", 0, 0]
to = ["k*half", 0, 0]
elements = 2
[copy.parts.joint.flange]
when = "k > 1"
type = "weld"
a = "spar[k - 1].end"
b = "spar.start"
"#;

const ROTOR: &str = r#"format = 1
[model]
name = "Rotor"
[parameters]
L = 3
[body.hub]
mass = 1
position = [0, 0, 0]
inertia = [1, 1, 1]
[joint.axle]
type = "revolute"
a = "ground"
b = "hub"
axis = [0, 0, 1]
[copy.blades]
count = 3
turn = { axis = [0, 0, 1], angle = "2*pi*(k - 1)/3" }
[copy.blades.include.blade]
file = "parts/blade.toml"
set = { length = "L*k" }
[copy.blades.joint.root]
type = "weld"
a = "hub"
b = "blade_spar_1.start"
[output.tip]
at = "blade_3_spar_2.end"
quantities = ["position"]
[simulation]
stop = 0.01
step = 0.001
"#;

#[test]
fn an_included_blade_is_copied() {
    let folder = folder("rotor", &[("m.toml", ROTOR), ("parts/blade.toml", BLADE)]);
    let document = parse(&folder, &[("blade_2_spar.radius", "0.03")]).unwrap_or_else(|message| panic!("{message}"));
    let names: Vec<_> = document.beams.iter().map(|beam| beam.name.as_str()).collect();
    let expected =
        ["blade_1_spar_1", "blade_1_spar_2", "blade_2_spar_1", "blade_2_spar_2", "blade_3_spar_1", "blade_3_spar_2"];
    assert_eq!(names, expected);
    let names: Vec<_> = document.joints.iter().map(|joint| joint.name.as_str()).collect();
    assert_eq!(
        names,
        ["axle", "blade_1_flange_2", "root_1", "blade_2_flange_2", "root_2", "blade_3_flange_2", "root_3"]
    );
    assert!(document.text().contains("blade_2_length = { value = \"L*2\", unit = \"m\", min = 0.1 }"));
    assert!(document.text().contains("blade_2_half = \"blade_2_length/2\""));
    let text = fs::read_to_string(folder.join("m.toml")).unwrap();
    let simulation = Simulation::load_in(Some(Folder::new(&folder, Reach::Inside)), "m.toml", &text, &[])
        .unwrap_or_else(|failure| panic!("{}", failure.message));
    // The third blade has the length 9 and points to -120 degrees.
    let tip = ancf14_testing::running::vector(&simulation, "tip.position");
    assert!((tip - ancf14::math::Vec3::new(-4.5, -4.5 * 3.0_f64.sqrt(), 0.0)).norm() < 1e-12, "{tip}");
    // The flat text needs no other file.
    let flat = simulation.document().text();
    assert_eq!(Document::parse("m.toml", flat, &[]).unwrap_or_else(|message| panic!("{message}")).text(), flat);
}

/// A file whose copies get the names of their parts from a list is included as it is: names of ends and of coordinates
/// get the prefix of the include once. The flat model is that of the file by itself, with this prefix.
#[test]
fn included_copies_name_the_parts_of_their_own_file() {
    let machines = [
        ("robot", include_str!("../../machines/robot.toml"), "[copy.motors]"),
        ("prism", include_str!("../../machines/tensegrity_prism.toml"), "over"),
    ];
    for (name, text, word) in machines {
        assert!(text.contains(word));
        // All but the sections that only a model has.
        let sections: Vec<String> = text.split("\n[").map(str::to_owned).collect();
        let is_own = |section: &&String| !section.starts_with("model]") && !section.starts_with("simulation]");
        let part = sections.iter().filter(is_own).cloned().collect::<Vec<_>>().join("\n[");
        let shared: Vec<String> =
            sections.iter().filter(|section| !is_own(section)).map(|own| format!("[{own}\n")).collect();
        let model = format!("format = 1\n{}[include.q]\nfile = \"part.toml\"\n", shared.concat());
        let folder = folder(&format!("lists-{name}"), &[("m.toml", &model), ("part.toml", &part)]);
        let included = parse(&folder, &[]).unwrap_or_else(|message| panic!("{name}: {message}"));
        let alone = Document::parse("m.toml", text, &[]).unwrap_or_else(|message| panic!("{message}"));
        let names = |document: &Document, prefix: &str| -> Vec<String> {
            let joints = document
                .joints
                .iter()
                .map(|joint| format!("{prefix}{} {:?} {:?}", joint.name, joint.a.spot, joint.b.spot));
            let springs = document.springs.iter().map(|spring| format!("{prefix}{}", spring.name));
            joints.chain(springs).collect()
        };
        assert_eq!(names(&included, ""), names(&alone, "q_"), "{name}");
    }
}

/// Rows of a list in a list, the ground of an included file that is moved, and a point on a frame: each name is that of
/// the scope in which it is written.
#[test]
fn rows_of_lists_mean_what_they_mean_where_they_stand() {
    let part = "format = 1\n[parameters]\narm = 0.3\n[frame.hand]\nposition = [0, 0, 0]\n\
                [body.block]\nmass = 1\nposition = [1, 0, 0]\ninertia = [1, 1, 1]\n\
                [copy.outer]\nindex = \"i\"\nover = [{ end = \"ground\" }, { end = \"hand\" }]\n\
                [copy.outer.copy.inner]\nover = [{ tie = \"end\", far = \"arm\" }]\n\
                [copy.outer.copy.inner.spring.band]\na = \"tie\"\nb = \"block\"\nstiffness = \"far\"\nlength = 1\n";
    let model = "format = 1\n[model]\nname = \"Rows\"\n[include.q]\nfile = \"part.toml\"\nmove = [0, 0, 2]\n\
                 [simulation]\nstop = 1\n";
    let folder = folder("rows", &[("m.toml", model), ("part.toml", part)]);
    let document = parse(&folder, &[]).unwrap_or_else(|message| panic!("{message}"));
    let text = document.text();
    for line in ["a = \"q_band_ground_1_1\"", "a = \"q_hand\"", "b = \"q_block\"", "stiffness = \"q_arm\""] {
        assert!(text.contains(line), "{line} is not in\n{text}");
    }
}

/// Messages name the included file with its line, and which of its copies is meant.
#[test]
fn mistakes_in_included_files_are_told_there() {
    let case = |test: &str, files: &[(&str, &str)], expected: &[&str]| {
        let message = parse(&folder(test, files), &[]).err().unwrap_or_else(|| panic!("{test} was taken"));
        for expected in expected {
            assert!(message.contains(expected), "{test}: {expected} is not in\n{message}");
        }
    };
    let rotor = ("m.toml", ROTOR);
    let wrong = BLADE.replace("0.02", "-0.02");
    case(
        "radius",
        &[rotor, ("parts/blade.toml", &wrong)],
        &[
            "`blade_1_spar.radius` must be greater than 0",
            "blade.toml:12:10, included as blade_1, in copy 1 of blades (and in 2 other copies)",
        ],
    );
    let wrong = BLADE.replace("\"spar.start\"", "\"hub\"");
    case(
        "inside",
        &[rotor, ("parts/blade.toml", &wrong)],
        &["nothing in the file is named `blade_1_hub`", "blade.toml:25:5"],
    );
    let wrong = BLADE.replace("young = 2e10", "young = 2e10 Pa");
    case("syntax", &[rotor, ("parts/blade.toml", &wrong)], &["numbers are written without units", "blade.toml:7:"]);
    let wrong = format!("{BLADE}[model]\nname = \"Blade\"\n");
    case(
        "model",
        &[rotor, ("parts/blade.toml", &wrong)],
        &["an included file has a section [model]", "blade.toml:26:2"],
    );
    let wrong = BLADE.replace("format = 1", "");
    case("format", &[rotor, ("parts/blade.toml", &wrong)], &["does not say its format"]);
    let wrong = ROTOR.replace("length = \"L*k\"", "lenght = 2");
    case(
        "set",
        &[("m.toml", &wrong), ("parts/blade.toml", BLADE)],
        &["blade.toml has no parameter `lenght`", "did you mean `length`?", "m.toml:20:9"],
    );
    let wrong = ROTOR.replace("parts/blade", "parts/balde");
    case("missing", &[("m.toml", &wrong)], &["cannot read", "balde.toml", "m.toml:19:8"]);
    let wrong = format!("{BLADE}[include.tip]\nfile = \"tip.toml\"\n");
    let tip = "format = 1\n[include.blade]\nfile = \"../parts/blade.toml\"\n";
    case("circle", &[rotor, ("parts/blade.toml", &wrong), ("parts/tip.toml", tip)], &["includes itself"]);
}

/// The turn of an include needs its angle, which is in radians: 90 is told.
#[test]
fn the_turn_of_an_include_has_its_angle() {
    let main = |turn: &str| {
        format!(
            "format = 1\nmodel.name = \"M\"\n[include.left]\nfile = \"blade.toml\"\nturn = {{ {turn} }}\n[joint.root]\ntype = \"weld\"\na = \"ground\"\n\
             b = \"left_spar_1.start\"\n[simulation]\nstop = 1\nstep = 0.01\n"
        )
    };
    let notes_of = |turn: &str| {
        let folder = folder("angle", &[("m.toml", &main(turn)), ("blade.toml", BLADE)]);
        parse(&folder, &[]).map(|document| ancf14::model::notes::notes(&document))
    };
    assert_eq!(notes_of("axis = [0, 0, 1], angle = \"pi/2\""), Ok(Vec::new()));
    let note = "m.toml, line 5: [include.left] turns by 90 rad, 14.3 turns. Angles are in radians: 90 degrees are \"90*pi/180\"";
    assert_eq!(notes_of("axis = [0, 0, 1], angle = 90"), Ok(vec![note.to_owned()]));
    let message = notes_of("axis = [0, 0, 1]").unwrap_err();
    assert!(message.contains("`turn` needs an axis and an angle"), "{message}");
}

/// A model must not read files of the computer that are not its own, as their lines come back in messages and in packed
/// FMUs: neither by a path, nor through a link. Allowed explicitly, it reads them.
#[test]
fn files_outside_of_the_folder_are_refused() {
    let secret = "time,value\n0,1\n1,2\n";
    let model = |file: &str| {
        format!(
            "format = 1\n[model]\nname = \"M\"\n[function.f]\nfile = \"{file}\"\n[body.b]\nmass = 1\nposition = [0, 0, 0]\n\
             inertia = [1, 1, 1]\n[load.l]\nat = \"b\"\nforce = [\"f(t)\", 0, 0]\n[simulation]\nstop = 1\n"
        )
    };
    let around = folder(
        "outside",
        &[("secret.csv", secret), ("models/parts/inside.csv", secret), ("models-2/secret.csv", secret)],
    );
    let folder = around.join("models");
    let parse = |file: &str, reach: Reach| {
        let text = model(file);
        let parsed = Document::parse_in(Some(Folder::new(&folder, reach)), "m.toml", &text, &[]);
        parsed.map(|_| ()).map_err(|mistakes| mistakes.to_string())
    };
    assert_eq!(parse("parts/inside.csv", Reach::Inside), Ok(()));
    assert_eq!(parse("parts/../parts/inside.csv", Reach::Inside), Ok(()));
    let absolute = around.join("secret.csv").display().to_string();
    for file in ["../secret.csv", "../models-2/secret.csv", "parts/../../secret.csv", &absolute] {
        let message = parse(file, Reach::Inside).unwrap_err();
        let own = folder.canonicalize().unwrap().display().to_string();
        let says = [file, &own, "outside of the folder of the model file", "--allow-outside"];
        assert!(says.into_iter().all(|words| message.contains(words)), "{message}");
        assert!(!message.contains("time,value"), "{message}");
        assert_eq!(parse(file, Reach::Anywhere), Ok(()), "{file}");
    }
    // A file that is not there gives nothing away.
    let message = parse("../none.csv", Reach::Inside).unwrap_err();
    assert!(message.contains("outside of the folder"), "{message}");
    // An included file is no way out either: the folder is that of the model.
    fs::write(folder.join("parts/part.toml"), "format = 1\n[include.up]\nfile = \"../../part.toml\"\n").unwrap();
    let text = model("parts/inside.csv") + "[include.part]\nfile = \"parts/part.toml\"\n";
    let parsed = Document::parse_in(Some(Folder::new(&folder, Reach::Inside)), "m.toml", &text, &[]);
    let message = parsed.map(|_| ()).map_err(|mistakes| mistakes.to_string()).unwrap_err();
    assert!(message.contains("`../../part.toml` is") && message.contains("outside of the folder"), "{message}");
    #[cfg(unix)]
    {
        let link = folder.join("link.csv");
        drop(fs::remove_file(&link));
        std::os::unix::fs::symlink("../secret.csv", &link).unwrap();
        let message = parse("link.csv", Reach::Inside).unwrap_err();
        assert!(message.contains("outside of the folder"), "{message}");
        assert_eq!(parse("link.csv", Reach::Anywhere), Ok(()));
    }
}

/// Files that include the next one twice make a million of the last: the depth, and without it the number, is told at
/// once.
#[test]
fn branches_of_includes_are_told_at_once() {
    let next = |number: usize| {
        format!("format = 1\n[include.a]\nfile = \"{number}.toml\"\n[include.b]\nfile = \"{number}.toml\"\n")
    };
    for (deepest, told) in
        [(21, "too many copies and includes stand in one another"), (18, "the copies make too many parts")]
    {
        let names: Vec<String> = (1..=deepest).map(|number| format!("{number}.toml")).collect();
        let texts: Vec<String> = (2..=deepest).map(next).chain([String::from("format = 1\n")]).collect();
        let model = next(1)
            + "[model]\nname = \"M\"\n[body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n[simulation]\nstop = 1\n";
        let files = names.iter().zip(&texts).map(|(name, text)| (name.as_str(), text.as_str()));
        let files: Vec<(&str, &str)> = files.chain([("m.toml", model.as_str())]).collect();
        let folder = folder(&format!("branches-{deepest}"), &files);
        let begin = Instant::now();
        let message = parse(&folder, &[]).map(|_| ()).unwrap_err();
        assert!(message.contains(told), "{message}");
        // Some ms; before, seconds.
        assert!(begin.elapsed() < Duration::from_secs(2), "{:?}", begin.elapsed());
    }
}

/// A pipe under the name of a table may never say anything: it is refused, not waited for.
#[cfg(unix)]
#[test]
fn a_pipe_is_no_table() {
    let folder = folder("pipe", &[]);
    fs::create_dir_all(&folder).unwrap();
    let pipe = folder.join("rows.csv");
    drop(fs::remove_file(&pipe));
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.is_ok_and(|status| status.success()), "mkfifo");
    let text = "format = 1\n[model]\nname = \"M\"\n[function.f]\nfile = \"rows.csv\"\n[body.b]\nmass = 1\nposition = [0, 0, 0]\n\
                inertia = [1, 1, 1]\n[simulation]\nstop = 1\n";
    for reach in [Reach::Inside, Reach::Anywhere] {
        let parsed = Document::parse_in(Some(Folder::new(&folder, reach)), "m.toml", text, &[]);
        let message = parsed.map(|_| ()).map_err(|mistakes| mistakes.to_string()).unwrap_err();
        assert!(message.contains("it is not a regular file"), "{message}");
    }
}
