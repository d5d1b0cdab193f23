//! Physics has no preferred direction: every model in models/, turned and shifted as a whole, must give the turned
//! result. A formula that mixes up axes, or a joint that only works along one, fails here at once.

use crate::random::Random;
use ancf14::fmi::Model;
use ancf14::fmi::variable::Causality;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::element::AnyElement;
use ancf14::model::document::Document;
use ancf14::model::simulation::Simulation;
use toml::{Table, Value};

/// A component in one of its pieces, as text: numbers and expressions alike.
fn component(value: &Value, piece: usize) -> String {
    match value {
        Value::String(text) => format!("({text})"),
        Value::Integer(number) => format!("({number})"),
        Value::Float(number) => format!("({number})"),
        Value::Array(pieces) => component(&pieces[piece]["is"], 0),
        other => panic!("no number: {other}"),
    }
}

/// A list of three, turned (and shifted where it is a place), as the text of an override. Piecewise components share
/// their limits.
fn turned(list: &Value, turn: &Mat3, shift: &Vec3) -> String {
    let list = list.as_array().unwrap();
    let limits: Vec<Option<&Value>> = match list.iter().find_map(Value::as_array) {
        Some(pieces) => pieces.iter().map(|piece| piece.get("until")).collect(),
        None => vec![None],
    };
    let expression = |row: usize, piece: usize| {
        let terms = (0..3).map(|column| format!("({:e})*{}", turn[(row, column)], component(&list[column], piece)));
        format!("\"{} + ({:e})\"", terms.collect::<Vec<_>>().join(" + "), shift[row])
    };
    let rows = (0..3).map(|row| {
        if limits.len() == 1 {
            return expression(row, 0);
        }
        let pieces = limits.iter().enumerate().map(|(piece, limit)| match limit {
            Some(limit) => format!("{{ until = {limit}, is = {} }}", expression(row, piece)),
            None => format!("{{ is = {} }}", expression(row, piece)),
        });
        format!("[{}]", pieces.collect::<Vec<_>>().join(", "))
    });
    format!("[{}]", rows.collect::<Vec<_>>().join(", "))
}

/// Overrides that turn the whole model: places, directions, gravity, loads.
fn overrides(model: &Table, turn: &Mat3, shift: &Vec3) -> Vec<(String, String)> {
    let none = Vec3::zeros();
    let mut list = Vec::new();
    let y_axis = Value::Array(vec![Value::Float(0.0), Value::Float(1.0), Value::Float(0.0)]);
    let each = |kind: &str| model.get(kind).and_then(Value::as_table).cloned().unwrap_or_default();
    for (name, beam) in each("beam") {
        // A curve is a table, which no override sets: see `turned_text`.
        for (key, default) in
            [("from", None), ("to", None), ("y_axis", Some(&y_axis)), ("velocity", None), ("angular_velocity", None)]
        {
            if let Some(value) = beam.get(key).or(default) {
                let moves = if matches!(key, "from" | "to") { shift } else { &none };
                list.push((format!("{name}.{key}"), turned(value, turn, moves)));
            }
        }
    }
    for (name, body) in each("body") {
        assert!(body.get("axes").is_none(), "axes are turned from the global ones: extend this test");
        let rows = (0..3).map(|axis| format!("[{:e}, {:e}, {:e}]", turn[(0, axis)], turn[(1, axis)], turn[(2, axis)]));
        list.push((format!("{name}.axes"), format!("[{}]", rows.collect::<Vec<_>>().join(", "))));
        for (key, moves) in [("position", shift), ("velocity", &none), ("angular_velocity", &none)] {
            if let Some(value) = body.get(key) {
                list.push((format!("{name}.{key}"), turned(value, turn, moves)));
            }
        }
    }
    for (name, frame) in each("frame") {
        for (key, moves) in [("position", shift), ("rotation", &none)] {
            if let Some(value) = frame.get(key) {
                list.push((format!("{name}.{key}"), turned(value, turn, moves)));
            }
        }
    }
    let is_fixed = |part: &Value| part.get("on").is_none_or(|on| on.as_str() == Some("ground"));
    for (kind, vectors) in [("point", &["offset"][..]), ("surface", &["offset", "axis", "normal"])] {
        for (name, part) in each(kind) {
            for key in vectors {
                let is_place = *key == "offset";
                match part.get(*key) {
                    Some(value) if !is_place => list.push((format!("{name}.{key}"), turned(value, turn, &none))),
                    Some(value) if is_fixed(&part) => list.push((format!("{name}.{key}"), turned(value, turn, shift))),
                    // The axes of a body turn with it.
                    _ => assert!(!is_place || !is_fixed(&part), "{name}: the origin is not moved: extend this test"),
                }
            }
        }
    }
    for (_, spring) in each("spring") {
        let on_ground = ["a", "b"].iter().any(|side| spring[*side].as_str() == Some("ground"));
        assert!(!on_ground, "the ground of a spring is the origin, which is not moved: extend this test");
    }
    for (name, joint) in each("joint") {
        assert_ne!(
            joint["type"].as_str(),
            Some("bushing"),
            "the axes of bushings are the global ones: extend this test"
        );
        for (key, moves) in [("at", shift), ("axis", &none), ("axis2", &none)] {
            if let Some(value) = joint.get(key) {
                list.push((format!("{name}.{key}"), turned(value, turn, moves)));
            }
        }
    }
    for (name, load) in each("load") {
        assert!(load.get("follower").is_none(), "the components of followers must not be turned: extend this test");
        for key in ["force", "moment"] {
            if let Some(value) = load.get(key) {
                list.push((format!("{name}.{key}"), turned(value, turn, &none)));
            }
        }
    }
    if let Some(gravity) = model["model"].get("gravity") {
        list.push(("gravity".into(), turned(gravity, turn, &none)));
    }
    list
}

/// The text of the model with its curves turned and shifted.
fn turned_text(mut model: Table, turn: &Mat3, shift: &Vec3) -> String {
    let value = |text: String| format!("value = {text}").parse::<Table>().unwrap()["value"].clone();
    let beams = model.get_mut("beam").and_then(Value::as_table_mut).into_iter().flatten();
    for (_, beam) in beams {
        let Some(curve) = beam.get_mut("curve").and_then(Value::as_table_mut) else { continue };
        if let Some(points) = curve.get_mut("points").and_then(Value::as_array_mut) {
            for point in points {
                *point = value(turned(point, turn, shift));
            }
            continue;
        }
        let plain = Value::Array(["x", "y", "z"].map(|key| curve[key].clone()).to_vec());
        let other = value(turned(&plain, turn, shift));
        for (key, component) in ["x", "y", "z"].into_iter().zip(other.as_array().unwrap()) {
            curve[key] = component.clone();
        }
    }
    model.to_string()
}

/// A strain: places of some meters in doubles, over elements of a tenth, leave strains uncertain by 1e-14. So the size
/// of a force is at least that of the force at this strain: 1e-8 of it are the round-off of stiff beams.
const STRAIN: f64 = 1e-6;

/// The smallest size that a quantity is compared with: 1 in its unit, of forces and moments that of a small strain.
fn least_size(quantity: &str, [rigidity, young]: [f64; 2]) -> f64 {
    match quantity {
        "stress" => young * STRAIN,
        "reaction_force" | "reaction_moment" | "effort" => f64::max(1.0, rigidity * STRAIN),
        _ if quantity.starts_with("section_") => f64::max(1.0, rigidity * STRAIN),
        _ => 1.0,
    }
}

/// All outputs at `count` output steps, by name.
fn results(text: &str, overrides: &[(String, String)], count: u32) -> (Vec<Vec<(String, f64)>>, [f64; 2]) {
    let mut simulation =
        Simulation::load("model.toml", text, overrides).unwrap_or_else(|failure| panic!("{}", failure.message));
    simulation.initialize(0.0).unwrap();
    let step = simulation.about().output_step;
    let all = |simulation: &Simulation| {
        let rows = simulation.variables().iter().enumerate();
        rows.filter(|(_, variable)| variable.causality == Causality::Output)
            .map(|(reference, variable)| (variable.name.clone(), simulation.value(reference).number()))
            .collect()
    };
    let mut rows = vec![all(&simulation)];
    for number in 1..=count {
        simulation.advance(f64::from(number) * step).unwrap();
        rows.push(all(&simulation));
    }
    let system = simulation.system();
    let axial = |element: &AnyElement| match element {
        AnyElement::Ancf14(element) => element.stiffness.axial,
        AnyElement::PaidOut(element) => element.drawn().stiffness.axial,
        AnyElement::Ancf24(element) => element.properties.law[(0, 0)] * element.properties.fibers.area,
    };
    let rigidity = system.mesh.elements.iter().map(axial).fold(0.0, f64::max);
    let young = system.beams.iter().map(|beam| beam.young).fold(0.0, f64::max);
    (rows, [rigidity, young])
}

fn vector(row: &[(String, f64)], name: &str) -> Option<Vec3> {
    let component = |i: usize| row.iter().find(|entry| entry.0 == format!("{name}[{i}]")).map(|entry| entry.1);
    Some(Vec3::new(component(1)?, component(2)?, component(3)?))
}

#[test]
fn turned_models_give_turned_results() {
    let mut random = Random(12);
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/models");
    let mut files: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    assert!(files.len() >= 3);
    for file in files {
        let (name, text) = (file.display().to_string(), std::fs::read_to_string(&file).unwrap());
        // Without copies: what is in them is turned too.
        let document = Document::parse(&name, &text, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        // The surface of the water and the seabed are level.
        if document.text().parse::<Table>().unwrap().contains_key("water") {
            continue;
        }
        // The lengths of steps that the solver chooses follow components, by a few percent.
        let chosen = !document.text().contains("\nstep = ");
        let given = [("simulation.step".to_owned(), document.output_step().to_string())];
        check(&mut random, &name, document.text(), if chosen { &given } else { &[] }, 10);
    }
}

/// With elements of ANCF24, alone and beside those of ANCF14: a shaft, a mechanism, a curve.
#[test]
fn turned_models_of_ancf24_give_turned_results() {
    let mut random = Random(13);
    let models: [(&str, &str, &[&str]); 3] = [
        ("rotating_shaft", include_str!("../../../models/rotating_shaft.toml"), &["shaft"]),
        ("lateral_buckling", include_str!("../../../models/lateral_buckling.toml"), &["strip", "crank"]),
        ("bend_45", include_str!("../../../models/bend_45.toml"), &["arc"]),
    ];
    for (name, text, beams) in models {
        let elements: Vec<_> = beams.iter().map(|beam| (format!("{beam}.element"), "ancf24".to_owned())).collect();
        check(&mut random, name, text, &elements, 10);
    }
}

/// Runs a model with these overrides for `count` output steps, as it is and turned.
fn check(random: &mut Random, name: &str, text: &str, more: &[(String, String)], count: u32) {
    let (turn, shift) = (random.rotation(), random.vector());
    let more = [more, &[("simulation.tolerance".to_owned(), "1e-12".to_owned())]].concat();
    let (plain, rigidity) = results(text, &more, count);
    let model: Table = text.parse().unwrap();
    let o = [overrides(&model, &turn, &shift), more].concat();
    let (other, _) = results(&turned_text(model, &turn, &shift), &o, count);
    let mut compared = 0;
    let mut largest = (0.0_f64, String::new());
    for (row, turned_row) in plain.iter().zip(&other) {
        for name in row.iter().filter_map(|entry| entry.0.strip_suffix("[1]")) {
            let quantity = name.rsplit('.').next().unwrap();
            let moves = match quantity {
                "position" => shift,
                "displacement" | "velocity" | "rotation" | "angular_velocity" | "linear" | "acceleration"
                | "reaction_force" | "reaction_moment" => Vec3::zeros(),
                _ => continue,
            };
            let (own, turned) = (vector(row, name).unwrap(), vector(turned_row, name).unwrap());
            let difference = (turn * own + moves - turned).norm() / own.norm().max(least_size(quantity, rigidity));
            if difference > largest.0 {
                largest = (difference, name.to_owned());
            }
            compared += 1;
        }
        for (name, own) in row {
            let same = [
                "twist",
                "axial_strain",
                "torsion",
                "kinetic",
                "elastic",
                "curvature[1]",
                "curvature[2]",
                "angle",
                "distance",
                "effort",
                "section_force[1]",
                "section_force[2]",
                "section_force[3]",
                "section_moment[1]",
                "section_moment[2]",
                "section_moment[3]",
                "stress",
            ];
            if same.iter().any(|end| name.ends_with(end)) {
                let turned = turned_row.iter().find(|entry| entry.0 == *name).unwrap().1;
                let size = least_size(name.rsplit('.').next().unwrap(), rigidity);
                let difference = (own - turned).abs() / own.abs().max(size);
                if difference > largest.0 {
                    largest = (difference, name.clone());
                }
                compared += 1;
            }
        }
    }
    println!("{name}: {compared} values, largest difference {:.1e} in {}", largest.0, largest.1);
    assert!(compared > 20 && largest.0 < 1e-8, "{name}: {largest:?}");
}
