//! May one word name a material, a section, a beam, a load, an output and a parameter at once? Every reference and every variable must still
//! mean one thing. A wrong code refuses natural files, or sets the damping of a spring where that of a material was meant.

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

/// `--set NAME.key` means the thing that has the key, or else the only one that can have it; SECTION.NAME.key always says which.
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
