//! May one word name a material, a section, a beam, a load, an output and a parameter at once? Every reference and
//! every variable must still mean one thing. A wrong code refuses natural files, or sets the damping of a spring where
//! that of a material was meant.

use crate::running::{run, start, value};
use ancf14::fmi::Model;
use ancf14::model::simulation::Simulation;
use std::collections::BTreeSet;

const ROPE: &str = r#"format = 1
model.name = "Rope"
[parameters]
rope = 2
[material.rope]
young = 1e9
poisson = 0.3
density = 1000
damping = 1e-4
[section.rope]
shape = "circle"
radius = 0.01
[beam.rope]
material = "rope"
section = "rope"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
[joint.s]
type = "weld"
a = "ground"
b = "rope.start"
[spring.e]
a = "ground"
b = "rope.end"
stiffness = "100*rope"
length = 0.9
[load.rope]
at = "rope.end"
force = [0, 0, 1]
[output.rope]
at = "rope@0.5"
quantities = ["position"]
[output.max]
at = "s"
quantities = ["reaction_force"]
[simulation]
stop = 0.01
step = 0.001
"#;

/// The file with every name of its own: what ROPE says, under the rule of names unique in the whole file.
fn apart() -> String {
    let lines = ROPE.lines().map(|line| {
        let line = match line {
            "[material.rope]" | "material = \"rope\"" => line.replace("rope", "hemp"),
            "[section.rope]" | "section = \"rope\"" => line.replace("rope", "round"),
            "[load.rope]" => String::from("[load.pull]"),
            "[output.rope]" => String::from("[output.middle]"),
            "rope = 2" => String::from("share = 2"),
            "stiffness = \"100*rope\"" => String::from("stiffness = \"100*share\""),
            "[joint.s]" => String::from("[joint.root]"),
            "at = \"s\"" => String::from("at = \"root\""),
            "[spring.e]" => String::from("[spring.tie]"),
            "[output.max]" => String::from("[output.most]"),
            _ => line.to_owned(),
        };
        line + "\n"
    });
    lines.collect()
}

fn results(text: &str) -> Vec<u64> {
    let mut simulation = start(text);
    run(&mut simulation, 0.001, 0.01, |_| ());
    (0..simulation.variables().len()).map(|place| simulation.value(place).number().to_bits()).collect()
}

/// Values of all variables after a run: names that are shared mean the same things as names of their own.
#[test]
fn shared_names_mean_the_things_that_are_meant() {
    assert_eq!(results(ROPE), results(&apart()));
}

/// The FMU, the results and `--set` find a variable by its name.
#[test]
fn every_variable_has_a_name_of_its_own() {
    let simulation = start(ROPE);
    let names: BTreeSet<&str> = simulation.variables().iter().map(|variable| variable.name.as_str()).collect();
    assert_eq!(names.len(), simulation.variables().len());
    for name in ["rope", "rope.young", "rope.radius", "rope.elements", "rope.force[3]", "rope.position[3]", "e.length"]
    {
        assert!(names.contains(name), "{name}");
    }
}

fn set(key: &str, value: &str) -> Result<Simulation, String> {
    let overrides = [(key.to_owned(), value.to_owned())];
    Simulation::load("m.toml", ROPE, &overrides).map_err(|failure| failure.message)
}

/// `--set NAME.key` means the thing that has the key, or else the only one that can have it; SECTION.NAME.key always
/// says which.
#[test]
fn an_override_finds_the_thing_with_its_key() {
    for (key, number, variable) in [
        ("rope", 3.0, "rope"),
        ("rope.young", 2e9, "rope.young"),
        ("material.rope.young", 2e9, "rope.young"),
        ("rope.radius", 0.02, "rope.radius"),
        ("rope.elements", 4.0, "rope.elements"),
        ("beam.rope.elements", 4.0, "rope.elements"),
        ("rope.force[3]", 4.0, "rope.force[3]"),
        ("e.length", 0.8, "e.length"),
        ("spring.e.length", 0.8, "e.length"),
    ] {
        let simulation = set(key, &number.to_string()).unwrap_or_else(|message| panic!("{key}: {message}"));
        assert_eq!(value(&simulation, variable), number, "{key}");
    }
    // Not written: no variable, but only a beam can have it.
    for (key, word) in [("rope.pretwist", "0.1"), ("rope.twist", "quadratic"), ("rope.moment[1]", "2")] {
        assert!(set(key, word).is_ok(), "{key}: {:?}", set(key, word).err());
    }
}

/// Where it is not clear what an override means, the message has the way to say it.
#[test]
fn an_unclear_override_is_refused_with_the_way_out() {
    for (key, word, expected) in [
        ("rope.at", "rope.start", "`rope.at` can be a key of [load.rope] and [output.rope]"),
        ("rope.at", "rope.start", "write the section too: load.rope.at"),
        ("rope.elemnts", "4", "did you mean `elements`?"),
        ("joint.rope.type", "weld", "nothing in the file is named `joint`"),
        ("material.rope.yuong", "1", "did you mean `young`?"),
    ] {
        let message = set(key, word).err().unwrap_or_else(|| panic!("{key} was taken"));
        assert!(message.contains(expected), "{key}: {message}");
        assert_eq!(message.matches("error: ").count(), 1, "{key}: {message}");
    }
    assert!(set("output.rope.at", "rope.start").is_ok());
    let pair = |key: &str| (key.to_owned(), String::from("2e9"));
    let twice = Simulation::load("m.toml", ROPE, &[pair("rope.young"), pair("material.rope.young")]);
    let message = twice.map(|_| ()).map_err(|failure| failure.message).expect_err("set twice");
    assert!(message.contains("`material.rope.young` is set twice"), "{message}");
}

/// A key that is not written anywhere finds the one section that can have it.
#[test]
fn an_override_of_a_shared_name_adds_a_key() {
    for key in ["poisson", "torsion_constant", "polar_moment", "y_axis", "velocity", "moment", "follower", "stations"] {
        let message = set(&format!("rope.{key}"), "[[]]").err().unwrap_or_else(|| panic!("{key} was taken"));
        assert!(!message.contains("unknown key"), "{message}");
    }
}

/// A bar on a pin: the body, its point and the joint at it, and what is asked of them.
fn pinned(point: &str, outputs: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Pinned\"\ngravity = [0, 0, -9.81]\n\
         [joint.pin]\ntype = \"revolute\"\na = \"ground\"\nb = \"bar\"\nat = [0, 0, 0]\naxis = [0, 1, 0]\n\
         [body.bar]\nmass = 2\nposition = [0.5, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n\
         [point.{point}]\non = \"bar\"\noffset = [-0.4, 0, 0]\n{outputs}\
         [simulation]\nstop = 0.1\nstep = 1e-2\n"
    )
}

fn try_load(text: &str) -> Result<Simulation, String> {
    Simulation::load("m.toml", text, &[]).map_err(|failure| failure.message)
}

/// A point and the joint at it may have one name: an `a` means the point, a `joint` the joint, and an output the one
/// that has its quantities.
#[test]
fn a_place_and_a_connection_may_have_one_name() {
    let output = |name: &str, quantities: &str| format!("[output.{name}]\nat = \"pin\"\nquantities = {quantities}\n");
    let rest = "[spring.coil]\njoint = \"pin\"\ncoordinate = \"angle\"\nstiffness = 1\n[spring.tie]\na = \"ground\"\nb = \"pin\"\nstiffness = 3\nlength = 0.1\n";
    let text =
        pinned("pin", &(output("seen", "[\"position\"]") + &output("held", "[\"reaction_force\", \"angle\"]") + rest));
    let simulation = try_load(&text).unwrap_or_else(|message| panic!("{message}"));
    for variable in ["seen.position[1]", "held.reaction_force[3]", "held.angle", "pin.offset[1]"] {
        assert!(simulation.variables().iter().any(|own| own.name == variable), "{variable}");
    }
    // A beam and a joint, of which the joint stands first: `arm.end` is a point of the beam.
    let beams = "format = 1\n[model]\nname = \"Arm\"\n[joint.arm]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n\
        [material.m]\nyoung = 2e11\npoisson = 0.3\ndensity = 7800\n[section.s]\nshape = \"circle\"\nradius = 0.01\n\
        [beam.arm]\nmaterial = \"m\"\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 2\n\
        [output.end]\nat = \"arm.end\"\nquantities = [\"position\"]\n[output.root]\nat = \"arm\"\nquantities = [\"reaction_force\"]\n\
        [simulation]\nstop = 0.1\n";
    assert!(try_load(beams).is_ok(), "{:?}", try_load(beams).err());
    // In copies too: the point is the one outside, the joint that of the copy.
    let copied = "format = 1\n[model]\nname = \"Copies\"\n[point.pin]\noffset = [0, 0, 1]\n\
        [copy.all]\ncount = 2\n[copy.all.body.bob]\nmass = 1\nposition = [\"k\", 0, 0]\ninertia = [1, 1, 1]\n\
        [copy.all.joint.pin]\ntype = \"spherical\"\na = \"ground\"\nb = \"bob\"\n\
        [copy.all.spring.tie]\na = \"pin\"\nb = \"bob\"\nstiffness = 1\n[simulation]\nstop = 0.1\n";
    let simulation = try_load(copied).unwrap_or_else(|message| panic!("{message}"));
    assert_eq!(simulation.document().text().matches("a = \"pin\"").count(), 2, "{}", simulation.document().text());
}

/// Where both could be meant, and where two variables would have one name, the message proposes a name that is free.
#[test]
fn messages_about_names_propose_one() {
    let refused = |text: &str| try_load(text).map(|_| ()).unwrap_err();
    let frame = "[frame.pin]\nposition = [0, 0, 0]\n[output.held]\nat = \"pin\"\nquantities = [\"reaction_force\"]\n";
    let message = refused(&pinned("hole", frame));
    assert!(
        message.contains("`pin` is a frame and a joint") && message.contains("call the joint `pin_joint`"),
        "{message}"
    );
    let output = "[output.bar]\nat = \"bar\"\nquantities = [\"position\"]\n";
    let message = refused(&pinned("hole", output));
    assert!(message.contains("both have a variable `bar.position`") && message.contains("`bar_output`"), "{message}");
    let message = refused(&pinned("bar", ""));
    assert!(message.contains("the name `bar` is used twice") && message.contains("`bar_point`"), "{message}");
    let twice = "[drive.pin]\njoint = \"pin\"\ncoordinate = \"angle\"\nvalue = 0\n[body.pin_drive]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n";
    let message = refused(&pinned("hole", twice));
    assert!(message.contains("`pin_drive_`"), "{message}");
}
