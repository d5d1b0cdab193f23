//! Does modelDescription.xml of FMI 3.0 say the same as that of FMI 2.0, with arrays? The whole text of the toy is
//! golden, with its terminals.

use ancf14::fmi::arrays::{arrays, time_reference};
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::{Causality, Variable};
use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;
use ancf14_pack::{description, description_fmi3::xml, terminals};
use ancf14_testing::{golden, root, toy};

/// The toy with a whole vector of inputs, and an output that is found from two of its elements.
fn variables() -> Vec<Variable> {
    let mut list = toy::variables();
    let force = list[toy::FORCE as usize].clone();
    for component in 1..=3 {
        let name = format!("push.force[{component}]");
        let description = format!("push: force, global, component {component}");
        list.push(Variable { name, description, start: Value::Real(f64::from(component)), ..force.clone() });
    }
    let found_from = Some(vec![toy::LENGTH as usize, list.len() - 2, list.len() - 1]);
    list.push(Variable { name: "pushed.position".to_owned(), found_from, ..list[toy::POSITION as usize].clone() });
    list
}

/// An element of an array is known as the array.
#[test]
fn dependencies_are_references_of_arrays() {
    let text = xml(&toy::about(), &variables()).unwrap();
    let first = variables().iter().position(|variable| variable.name == "push.force[1]").unwrap();
    let expected =
        format!("<InitialUnknown valueReference=\"{}\" dependencies=\"{} {first}\"/>", first + 3, toy::LENGTH);
    assert!(text.contains(&expected), "{expected} in {text}");
}

/// The XML of the toy, as reviewed.
#[test]
fn golden_description_of_the_toy() {
    golden::assert_current("tests/golden/toy_fmi3.xml", &xml(&toy::about(), &variables()).unwrap());
    golden::assert_current("tests/golden/toy_terminals.xml", &terminals::xml(Standard::Fmi3, &variables()));
}

/// References in elements of ModelStructure.
fn references(text: &str, element: &str) -> Vec<usize> {
    let start = format!("<{element} valueReference=\"");
    text.split(&start).skip(1).map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect()
}

/// Of every shipped model: outputs are exactly the outputs, initial unknowns the outputs and calculated parameters, and
/// dependencies are references of parameters and inputs, never of an element inside an array.
#[test]
fn model_structure_is_exact() {
    for entry in std::fs::read_dir(root().join("models")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "toml") {
            continue;
        }
        let text = std::fs::read_to_string(&path).unwrap();
        let model = Simulation::load("model.toml", &text, &[]).unwrap();
        let variables = model.variables();
        let text = xml(model.about(), variables).unwrap();
        let of = |wanted: &[Causality]| -> Vec<usize> {
            let list = arrays(variables).into_iter().filter(|array| wanted.contains(&variables[array.first].causality));
            list.map(|array| array.first).collect()
        };
        assert_eq!(references(&text, "Output"), of(&[Causality::Output]));
        assert_eq!(references(&text, "InitialUnknown"), of(&[Causality::CalculatedParameter, Causality::Output]));
        let given = of(&[Causality::Parameter, Causality::Input]);
        for list in text.split("dependencies=\"").skip(1) {
            for reference in list.split('"').next().unwrap().split_whitespace() {
                assert!(given.contains(&reference.parse().unwrap()), "{reference} in {}", path.display());
            }
        }
        // Importers as CasADi do not know that no list means everything.
        let mut unknowns = text.split("<InitialUnknown ").skip(1).map(|rest| rest.split("/>").next().unwrap());
        assert!(unknowns.all(|unknown| unknown.contains(" dependencies=")), "{}", path.display());
        // The time stands first, with the reference behind the table.
        assert_eq!(time_reference(variables), variables.len());
        assert_eq!(text.matches("causality=\"independent\"").count(), 1);
        assert_eq!(text.matches(&format!("valueReference=\"{}\"", variables.len())).count(), 1);
    }
}

/// The description of an array is that of all its elements, and the time has a unit.
#[test]
fn regression_descriptions_of_arrays() {
    let (_, [_, text]) = described("[model]", "[model]");
    let described = |name: &str| {
        let element = text.split(&format!("name=\"{name}\"")).nth(1).unwrap_or_else(|| panic!("{name}: {text}"));
        element.split("description=\"").nth(1).unwrap().split('"').next().unwrap().to_owned()
    };
    assert_eq!(described("push.force"), "Force of load push along global x, y, z, held during a communication step");
    assert_eq!(described("push.moment"), "Moment of load push about global x, y, z, held during a communication step");
    let hand = described("hand.position");
    assert!(hand.starts_with("Position of frame hand along global x, y, z, reached at the end"), "{hand}");
    assert!(!text.contains("component 1") && !text.contains("station 1 of"));
    assert!(text.contains("variability=\"continuous\" unit=\"s\"/>") && text.contains("<Unit name=\"s\">"), "{text}");
}

/// What one unit reads is what another is given: the members have one name on both sides, whatever the variables are
/// called.
#[test]
fn members_match_by_name() {
    let model = root().join("tests/suite/fmi/fmi3/held.toml");
    let model = Simulation::load("held.toml", &std::fs::read_to_string(model).unwrap(), &[]).unwrap();
    let text = terminals::xml(Standard::Fmi3, model.variables());
    let terminal = |name: &str| -> Vec<(String, String)> {
        let inside =
            text.split(&format!("<Terminal name=\"{name}\"")).nth(1).unwrap_or_else(|| panic!("{name}: {text}"));
        let inside = inside.split("</Terminal>").next().unwrap();
        let word = |rest: &str, key: &str| {
            rest.split(&format!("{key}=\"")).nth(1).unwrap().split('"').next().unwrap().to_owned()
        };
        inside
            .split("<TerminalMemberVariable")
            .skip(1)
            .map(|rest| (word(rest, "memberName"), word(rest, "variableName")))
            .collect()
    };
    let pairs = |list: &[(&str, &str)]| -> Vec<(String, String)> {
        list.iter().map(|(member, name)| ((*member).to_owned(), (*name).to_owned())).collect()
    };
    assert_eq!(terminal("push"), pairs(&[("force", "push.force"), ("moment", "push.moment")]));
    assert_eq!(terminal("hand"), pairs(&[("position", "hand.position"), ("rotation", "hand.rotation")]));
    assert_eq!(terminal("hold"), pairs(&[("force", "hold.applied_force"), ("moment", "hold.applied_moment")]));
    let tip = [("position", "tip.position"), ("velocity", "tip.velocity"), ("quaternion", "tip.quaternion")];
    assert_eq!(terminal("tip"), pairs(&tip));
    assert_eq!(terminal("energy").len(), model.variables().iter().filter(|v| v.name.starts_with("energy.")).count());
    assert!(terminal("energy").contains(&(String::from("kinetic"), String::from("energy.kinetic"))));
    assert!(!text.contains("statistics"));
    let scalars = terminals::xml(Standard::Fmi2, model.variables());
    for (member, name) in [
        ("force[2]", "hold.applied_force[2]"),
        ("quaternion[4]", "tip.quaternion[4]"),
        ("displacement[2,3]", "line.displacement[2,3]"),
    ] {
        assert!(scalars.contains(&format!("variableName=\"{name}\" memberName=\"{member}\"")), "{member}: {scalars}");
    }
    assert!(!scalars.contains("Icon "));
}

const HELD: &str = "tests/suite/fmi/fmi3/held.toml";

/// A model file with a change, and its descriptions of FMI 2.0 and 3.0.
fn described(from: &str, to: &str) -> (Simulation, [String; 2]) {
    let text = std::fs::read_to_string(root().join(HELD)).unwrap().replace(from, to);
    let model = Simulation::load("held.toml", &text, &[]).unwrap_or_else(|failure| panic!("{}", failure.message));
    let texts = [description::xml, xml].map(|xml| xml(model.about(), model.variables()).unwrap());
    (model, texts)
}

/// Orders of magnitude follow from the mechanism as drawn: an arm of 0.5 m and 0.12 kg under 9.81 m/s², which falls
/// over its length in 0.23 s. Without gravity only lengths are known; of quaternions, strains and parameters nothing
/// is.
#[test]
fn nominals_follow_from_the_drawing() {
    let nominal = |text: &str, name: &str| -> Option<f64> {
        // FMI 2.0 has them in the element within.
        let (_, rest) = text.split_once(&format!("name=\"{name}\"")).unwrap();
        let end = rest
            .find("valueReference=\"")
            .map(|at| rest[at + 1..].find("valueReference=\"").map_or(rest.len(), |next| at + next));
        let (_, value) = rest[..end.unwrap()].split_once("nominal=\"")?;
        Some(value.split('"').next().unwrap().parse().unwrap())
    };
    // √(9.81 · 0.5) = 2.2 m/s and 0.12 · 9.81 = 1.2 N to the nearest powers of ten, by their logarithms: 0.5 m is
    // nearer to 1 m.
    let expected = [
        ("tip.position", Some(1.0)),
        ("tip.velocity", Some(1.0)),
        ("hold.applied_force", Some(1.0)),
        ("push.force", Some(1.0)),
        ("hand.position", Some(1.0)),
        ("tip.quaternion", None),
        ("line.axial_strain", None),
        ("rod.radius", None),
    ];
    let (_, [two, three]) = described("", "");
    let (_, [_, floating]) = described("gravity = [0.0, 0.0, -9.81]", "gravity = [0.0, 0.0, 0.0]");
    for (name, value) in expected {
        assert_eq!(nominal(&three, name), value, "{name}");
        let is_length = name.ends_with("position");
        assert_eq!(nominal(&floating, name), value.filter(|_| is_length), "{name} without gravity");
        let first = ["", "[1]", "[1,1]"].map(|index| format!("{name}{index}"));
        let first = first.iter().find(|name| two.contains(&format!("name=\"{name}\""))).unwrap();
        assert_eq!(nominal(&two, first), value, "{first}");
    }
    let (_, [_, long]) = described("to = [0.5, 0, 0]", "to = [500, 0, 0]");
    // 500 m, √(9.81 · 500) = 70 m/s, 120 · 9.81 = 1200 N.
    for (name, value) in [("tip.position", 1e3), ("tip.velocity", 1e2), ("hold.applied_force", 1e3)] {
        assert_eq!(nominal(&long, name), Some(value), "{name}");
    }
}
