//! Who copies a shipped model copies its warnings. Each one that runs with a warning does so for a reason that stands
//! here and in docs/gallery.md; --verify finds the errors that are told. A warning that is not in this list is a
//! mistake of the model or of the warning. The templates of `ancf14 new` have none
//! (crates/cli/tests/commands/new_command.rs).

use ancf14::fmi::{About, Model};
use ancf14::model::simulation::Simulation;
use std::fs;

/// The models that warn, with the words of each warning.
const WARNED_OF: [(&str, &[&str]); 8] = [
    // One element between two spokes: the top of the rim moves by a twentieth of the contact.
    ("bicycle_wheel", &["rim_top.displacement is off by about 1.3 % of its range because of the mesh"]),
    // A release from rest excites vibrations that steps of 1 ms do not resolve.
    (
        "cantilever",
        &[
            "tip.velocity is off by about 3.0 % of its range because of the length of the steps",
            "tip.velocity is off by about 0.65 % of its range because of the mesh",
        ],
    ),
    // The drive starts at once, which shakes the bars.
    ("four_bar", &["motor_side.effort is off by about 0.97 % of its range because of the length of the steps"]),
    // The step and the mesh of the paper, for a strip that kicks out by chance.
    (
        "lateral_buckling",
        &[
            "P.quaternion is off by about 6.0 % of its range because of the length of the steps",
            "P.quaternion is off by about 16 % of its range because of the mesh",
        ],
    ),
    // It shows how a path tells its limit points.
    ("lee_frame", &["t has a maximum of 0.926681", "t has a minimum of -0.468485"]),
    // A release from rest, as of the cantilever.
    ("pendulum", &["middle.axial_strain is off by about 27 % of its range because of the length of the steps"]),
    // It shows how an analysis tells where a ring buckles.
    ("ring", &["the equilibrium becomes unstable between t = 1.9 s and 1.92 s"]),
    // Short, with few elements and large steps: a host's first try.
    (
        "arm",
        &[
            "tip.velocity is off by about 6.3 % of its range because of the length of the steps",
            "tip.velocity is off by about 0.77 % of its range because of the mesh",
        ],
    ),
];

/// All that a run of the model at `path` to its end is told, the mesh error included.
fn told(path: &std::path::Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap();
    let mut simulation = Simulation::load(path.to_str().unwrap(), &text, &[]).unwrap();
    simulation.ask_for_mesh_error(|companion| Box::new(companion));
    let About { start, stop, output_step, .. } = *simulation.about();
    simulation.initialize(start).unwrap();
    for row in 1..=(stop / output_step).round() as u32 {
        simulation.advance(f64::from(row) * output_step).unwrap();
    }
    simulation.conclude();
    simulation.take_warnings()
}

#[test]
fn shipped_models_warn_as_listed() {
    let root = ancf14_testing::root();
    let models = fs::read_dir(root.join("models")).unwrap().map(|entry| entry.unwrap().path());
    let examples = ["c-examples/arm.toml", "python/examples/crane.toml"].map(|path| root.join(path));
    let mut warned = 0;
    for path in models.chain(examples).filter(|path| path.extension().is_some_and(|end| end == "toml")) {
        let name = path.file_stem().unwrap().to_str().unwrap();
        let (found, listed) = (told(&path), WARNED_OF.iter().find(|(own, _)| *own == name));
        let words = listed.map_or(&[][..], |(_, words)| words);
        let is_listed = |warning: &String| words.iter().any(|words| warning.contains(words));
        assert!(found.len() == words.len() && found.iter().all(is_listed), "{name}: {found:#?}");
        warned += usize::from(!words.is_empty());
    }
    assert_eq!(warned, WARNED_OF.len(), "a listed model is not there");
}
