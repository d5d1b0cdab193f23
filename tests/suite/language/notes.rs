//! Does a model that is legal but hardly ever meant so get a note, and a sound one none? A wrong code is silent about a part that falls
//! away, or cries wolf.

use ancf14::model::document::Document;
use ancf14::model::notes::notes;

const BEAMS: &str = r#"format = 1
model.name = "Notes"
[material.steel]
young = 2.1e11
poisson = 0.3
density = 7850
[section.strip]
shape = "circle"
radius = 0.01
[beam.left]
material = "steel"
section = "strip"
from = [0, 0, 0]
to = [1, 0, 0]
elements = 2
[beam.right]
material = "steel"
section = "strip"
from = [1, 0, 0]
to = [2, 0, 0]
elements = 2
[body.bob]
mass = 1
position = [3, 0, 0]
inertia = [1, 1, 1]
[simulation]
stop = 1
step = 0.1
"#;
const ROOT: &str = "[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"left.start\"\n";
const MIDDLE: &str = "[joint.middle]\ntype = \"weld\"\na = \"left.end\"\nb = \"right.start\"\n";
const ROPE: &str = "[spring.rope]\na = \"right.end\"\nb = \"bob\"\nstiffness = 1\n";
const HAND: &str =
    "[frame.hand]\nposition = [0, 0, 0]\n[joint.grip]\ntype = \"weld\"\na = \"hand\"\nb = \"left.start\"\n";

fn of(text: &str) -> Vec<String> {
    notes(&Document::parse("m.toml", text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}")))
}

/// Joints, springs and frames hold, the ground at the end of the chain; what is left loose is named.
#[test]
fn regression_loose_parts_are_named() {
    let all =
        "nothing holds the mechanism: no joint or spring connects it to the ground or to a frame, and it moves freely";
    for (parts, expected) in [
        (vec![ROOT, MIDDLE, ROPE], None),
        (vec![HAND, MIDDLE, ROPE], None),
        (vec![ROOT, MIDDLE], Some("body bob is connected to nothing: it moves freely")),
        (
            vec![ROOT, ROPE],
            Some("no joint or spring connects beam right and body bob to the ground or to a frame: they move freely"),
        ),
        (vec![MIDDLE, ROPE], Some(all)),
        (vec![], Some(all)),
    ] {
        let found = of(&format!("{BEAMS}{}", parts.concat()));
        assert_eq!(found.iter().map(String::as_str).collect::<Vec<_>>(), Vec::from_iter(expected), "{parts:?}");
    }
}

/// Moduli in MPa and densities in g/cm³ or t/mm³ are told, those of rubber and foam are not; statics do not ask for the density.
#[test]
fn regression_materials_in_other_units_are_told() {
    let held = format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}");
    for (from, to, expected) in [
        ("young = 2.1e11", "young = 210000", "line 4: steel.young = 210000 Pa"),
        ("density = 7850", "density = 7.85", "line 6: steel.density = 7.85 kg/m3"),
        ("density = 7850", "density = 7.85e-9", "line 6: steel.density"),
    ] {
        let found = of(&held.replace(from, to));
        assert!(found.len() == 1 && found[0].starts_with(expected), "{found:?}");
    }
    let set = [("steel.density".to_owned(), "7.85".to_owned())];
    let found = notes(&Document::parse("m.toml", &held, &set).unwrap());
    assert!(found.len() == 1 && found[0].starts_with("--set: steel.density"), "{found:?}");
    for sound in [
        held.clone(),
        held.replace("young = 2.1e11", "young = 1e6"),
        held.replace("density = 7850", "density = 30"),
        held.replace("density = 7850", "density = 1").replace("step = 0.1", "step = 0.1\nanalysis = \"static\""),
    ] {
        assert!(of(&sound).is_empty());
    }
}

/// The models that come along are sound.
#[test]
fn models_have_no_notes() {
    for entry in std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/models")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "toml") {
            let found = of(&std::fs::read_to_string(&path).unwrap());
            assert!(found.is_empty(), "{}: {found:?}", path.display());
        }
    }
}

/// A drive that comes to rest at 90 or that ends there in statics means degrees; a shaft that turns on, and any other angle, does not.
#[test]
fn angles_in_degrees_are_told() {
    let hinge = "[joint.root]\ntype = \"revolute\"\na = \"ground\"\nb = \"left.start\"\naxis = [0, 0, 1]\n\
                 [drive.crank]\njoint = \"root\"\ncoordinate = \"angle\"\n";
    let text = |motion: &str| format!("{BEAMS}{hinge}{motion}\n{MIDDLE}{ROPE}");
    let still = "value = [{ until = 0.5, is = \"180*t\" }, { is = 90 }]";
    for told in [
        text(still),
        text("value = \"45*(1 - cos(pi*t))\""),
        text("value = \"-90*t\"").replace("step = 0.1", "analysis = \"static\""),
    ] {
        let found = of(&told);
        assert!(
            found.len() == 1 && found[0].contains("rad, 14.3 turns: angles are in radians, 90 degrees"),
            "{found:?}"
        );
    }
    for sound in [
        text("value = \"90*t\""),
        text("rate = 90"),
        text("value = \"31*t\"").replace("step = 0.1", "analysis = \"static\""),
        text("value = \"0.25*pi*(1 - cos(pi*t))\""),
        text("value = [{ until = 0.5, is = \"20*pi*t\" }, { is = \"10*pi\" }]"),
    ] {
        assert_eq!(of(&sound), Vec::<String>::new());
    }
}

/// A step that is longer than a tenth of the motion is told, a tenth and an increment of statics are not.
#[test]
fn long_steps_are_told() {
    let held = format!("{BEAMS}{ROOT}{MIDDLE}{ROPE}");
    let found = of(&held.replace("step = 0.1", "step = 0.11"));
    assert!(found.len() == 1 && found[0].contains("simulation.step = 0.11 s is longer than a tenth"), "{found:?}");
    assert_eq!(of(&held), Vec::<String>::new());
    assert_eq!(of(&held.replace("step = 0.1", "step = 1\nanalysis = \"static\"")), Vec::<String>::new());
}
