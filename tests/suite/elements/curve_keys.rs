//! Does a `curve` of the file become the beam that is meant? Arc lengths and fractions against closed forms, the
//! numbers that are and are not parameters, changes of them, what acts along the beam, and how it sets off. A fraction
//! of the parameter taken for a fraction of the length, a weight by element instead of by meter, or a velocity by node
//! number fails here.

use crate::curves::Curves;
use crate::running::{run, start, value, vector};
use ancf14::fmi::{Model, Value};
use ancf14::math::Vec3;
use ancf14::model::document::Document;
use ancf14::model::drawing::Drawing;
use ancf14::model::shape::Lines;
use ancf14::model::simulation::Simulation;

/// A model with a beam `arm` along `line`, clamped at its start, with `more` sections.
fn model(line: &str, more: &str, simulation: &str) -> String {
    format!(
        r#"format = 1
[model]
name = "Curves"
gravity = [0, 0, 0]
[parameters]
R = {{ value = 2.0, unit = "m" }}
rise = 0.5
unused = 1.0
[material.steel]
young = 2e11
shear = 8e10
density = 7800
[section.bar]
shape = "rectangle"
width = 0.03
height = 0.02
[beam.arm]
material = "steel"
section = "bar"
{line}
{more}
[simulation]
stop = 1.0
{simulation}
"#
    )
}

const STATIC: &str = "analysis = \"static\"\nstep = 1.0\noutput_step = 1.0";
const ROOT: &str = "[joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"";
const HELIX: &str = "elements = 16\ny_axis = [0, 0, 1]\ncurve = { x = \"R*cos(s)\", y = \"R*sin(s)\", z = \"rise*s\", s = [0, \"2*pi\"] }";
/// A parabola, whose parameter runs three times faster along it at its end than at its start.
const PARABOLA: &str = "elements = 6\ncurve = { x = \"s\", y = 0, z = \"s^2*1.5\", s = [0, 1] }";

/// Arc length of the parabola `(s, 1.5 s²)` up to s, by hand.
fn parabola(s: f64) -> f64 {
    let slope = 3.0 * s;
    (slope * slope.hypot(1.0) + slope.asinh()) / 6.0
}

/// Lengths of the elements of the first beam.
fn lengths(simulation: &Simulation) -> Vec<f64> {
    simulation.system().mesh.elements.iter().map(|element| element.length()).collect()
}

#[test]
fn lengths_and_fractions_are_those_of_the_arc() {
    let outputs = "[output.shape]\non = \"arm\"\nstations = 13\nquantities = [\"position\", \"twist\"]";
    let helix = start(&model(HELIX, outputs, "step = 1.0"));
    let whole = std::f64::consts::TAU * 2.0_f64.hypot(0.5);
    assert!(lengths(&helix).iter().all(|length| (length / (whole / 16.0) - 1.0).abs() < 1e-13));
    // Every fourth station is on a node: exact there, an interpolation between.
    for k in 0..=12 {
        let angle = std::f64::consts::TAU * f64::from(k) / 12.0;
        let expected = Vec3::new(2.0 * angle.cos(), 2.0 * angle.sin(), 0.5 * angle);
        let found = Vec3::from_fn(|i, _| value(&helix, &format!("shape.position[{},{}]", k + 1, i + 1)));
        let bound = if k % 3 == 0 { 1e-13 } else { 2e-4 };
        assert!((found - expected).norm() < bound, "{k}: {found}");
    }
    let arcs = start(&model(PARABOLA, "", "step = 1.0"));
    assert!(lengths(&arcs).iter().all(|length| (length / (parabola(1.0) / 6.0) - 1.0).abs() < 1e-13));
    let steps = start(&model(&format!("{PARABOLA}\nspacing = \"s\""), "", "step = 1.0"));
    for (k, length) in lengths(&steps).iter().enumerate() {
        let [from, to] = [k, k + 1].map(|k| parabola(k as f64 / 6.0));
        assert!((length / (to - from) - 1.0).abs() < 1e-12);
        let fraction = steps.system().beams[0].division.fraction(k).unwrap();
        assert!((fraction - from / parabola(1.0)).abs() < 1e-14);
    }
    // A joint finds the node at its fraction, and the point of an output lies between nodes in proportion to the
    // length.
    let third = parabola(0.5) / parabola(1.0);
    let more = format!(
        "[joint.pin]\ntype = \"spherical\"\na = \"ground\"\nb = \"arm@{third}\"\n[output.pin_at]\nat = \"arm@{third}\"\nquantities = [\"position\"]"
    );
    let pinned = start(&model(&format!("{PARABOLA}\nspacing = \"s\""), &more, "step = 1.0"));
    assert!((vector(&pinned, "pin_at.position") - Vec3::new(0.5, 0.0, 0.375)).norm() < 1e-14);
}

/// The numbers of a curve are no parameters, those of [parameters] in it are, fixed; changing them changes the curve,
/// by `--set` and by a host.
#[test]
fn parameters_inside_a_curve_shape_it() {
    let text = model(HELIX, ROOT, STATIC);
    let document = Document::parse("m.toml", &text, &[]).unwrap();
    let names: Vec<_> = document.parameters().iter().map(|parameter| parameter.variable.name.as_str()).collect();
    assert!(names.contains(&"R") && names.contains(&"arm.elements") && names.contains(&"arm.y_axis[3]"));
    assert!(!names.iter().any(|name| name.contains("curve") || name.contains("spacing")), "{names:?}");
    let radius = document.parameters().iter().find(|parameter| parameter.variable.name == "R").unwrap();
    assert_eq!(radius.variable.variability, ancf14::fmi::variable::Variability::Fixed);
    let wide = [
        ("R".to_owned(), "3".to_owned()),
        ("arm.elements".to_owned(), "20".to_owned()),
        ("arm.spacing".to_owned(), "s".to_owned()),
    ];
    let line = Lines::of(&Document::parse("m.toml", &text, &wide).unwrap());
    let line = line.line(0).unwrap();
    assert!((line.place(0.25) - Vec3::new(0.0, 3.0, 0.125 * std::f64::consts::TAU)).norm() < 1e-13);
    assert_eq!(line.spans.len(), 20);
    // A host sets the radius before it initializes: the machine is built anew.
    let mut simulation = Simulation::load("m.toml", &text, &[]).unwrap();
    let place =
        |simulation: &Simulation, name: &str| simulation.variables().iter().position(|own| own.name == name).unwrap();
    let (radius, elements) = (place(&simulation, "R"), place(&simulation, "arm.elements"));
    simulation.set_value(radius, Value::Real(4.0)).unwrap();
    simulation.set_value(elements, Value::Integer(8)).unwrap();
    simulation.initialize(0.0).unwrap();
    assert!((lengths(&simulation)[7] - std::f64::consts::TAU * 4.0_f64.hypot(0.5) / 8.0).abs() < 1e-13);
    // Too few to follow the curve: refused when the host initializes, in words.
    let mut simulation = Simulation::load("m.toml", &text, &[]).unwrap();
    simulation.set_value(elements, Value::Integer(3)).unwrap();
    let failure = simulation.initialize(0.0).expect_err("three elements");
    assert!(
        failure.message.contains("an element of beam arm turns by") && failure.message.contains("take elements = 4"),
        "{}",
        failure.message
    );
}

/// Weight and loads along the beam are per meter of it: what the root carries is their sum, and its moment that of the
/// center of mass.
#[test]
fn loads_along_a_curve_are_per_meter() {
    let half = "elements = 12\nspacing = \"s\"\ny_axis = [0, 0, 1]\ncurve = { x = \"R*sin(s^2*pi)\", y = \"R*(1 - cos(s^2*pi))\", z = 0, s = [0.2, 1] }";
    let load = "[load.wind]\non = \"arm\"\nforce = [0, \"1e-3*t\", 0]\n[output.root_joint]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]";
    let text =
        model(half, &format!("{ROOT}\n{load}"), STATIC).replace("gravity = [0, 0, 0]", "gravity = [0, 0, -1e-6]");
    let curves = Curves::run(&text, &[("simulation.tolerance", "1e-12")]);
    let force = |i: usize| curves.last(&format!("root_joint.reaction_force[{i}]")).abs();
    let (from, to) = (0.04 * std::f64::consts::PI, std::f64::consts::PI);
    let length = 2.0 * (to - from);
    let weight = 7800.0 * 0.03 * 0.02 * length * 1e-6;
    println!("weight {:.1e}, wind {:.1e} off", force(3) / weight - 1.0, force(2) / (1e-3 * length) - 1.0);
    // The mass of an element is that of its arc length, and so is what a load sees of it: both to the tolerance of the
    // equilibrium.
    assert!((force(3) / weight - 1.0).abs() < 1e-9);
    assert!((force(2) / (1e-3 * length) - 1.0).abs() < 1e-9);
    // The center of the arc: integrals of the places by the angle.
    let x = 4.0 * (from.cos() - to.cos()) / length - 2.0 * from.sin();
    let moment = curves.last("root_joint.reaction_moment[2]").abs();
    assert!((moment / (weight * x) - 1.0).abs() < 1e-3, "{moment} {}", weight * x);
}

/// A load along a quarter circle in a single element that is opposite to its weight leaves it at rest: both have the
/// same arc length and the same shape functions, and nothing but round-off is left. Along the interpolated curve the
/// load would be 0.8 % too small.
#[test]
fn regression_a_load_against_the_weight_of_a_curve_cancels_it() {
    let quarter = "elements = 1\ny_axis = [0, 0, 1]\ncurve = { x = \"R*sin(s)\", y = \"R*(1 - cos(s))\", z = 0, s = [0, \"0.4999*pi\"] }";
    let load = "[load.lift]\non = \"arm\"\nforce = [0, 0, \"7800*0.03*0.02\"]\n[output.root_joint]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]";
    let text =
        model(quarter, &format!("{ROOT}\n{load}"), STATIC).replace("gravity = [0, 0, 0]", "gravity = [0, 0, -1]");
    let curves = Curves::run(&text, &[]);
    let weight = 7800.0 * 0.03 * 0.02 * std::f64::consts::PI;
    for name in ["force", "moment"] {
        for i in 1..=3 {
            let left = curves.last(&format!("root_joint.reaction_{name}[{i}]")).abs() / weight;
            assert!(left < 1e-12, "{name} {i}: {left:e}");
        }
    }
}

/// A coil that is thrown, turning: every point moves as `v + w x (x - start)`, the section turns with w, and the flight
/// keeps the momenta.
#[test]
fn a_thrown_coil_moves_as_a_rigid_body() {
    let line = format!("{HELIX}\npretwist = 3\nvelocity = [1, -2, 3]\nangular_velocity = [2, 1, -3]");
    let outputs = "[output.P]\nat = \"arm@0.5\"\nquantities = [\"velocity\", \"angular_velocity\", \"position\"]\n[output.Q]\nat = \"arm@0.33\"\nquantities = [\"velocity\", \"angular_velocity\", \"position\"]";
    let mut simulation = start(&model(&line, outputs, "step = 1e-3\noutput_step = 1e-2"));
    let (v, w) = (Vec3::new(1.0, -2.0, 3.0), Vec3::new(2.0, 1.0, -3.0));
    for point in ["P", "Q"] {
        let place = vector(&simulation, &format!("{point}.position"));
        let expected = v + w.cross(&(place - Vec3::new(2.0, 0.0, 0.0)));
        assert!((vector(&simulation, &format!("{point}.velocity")) - expected).norm() < 1e-9);
        // The spin is interpolated linearly between nodes, the turning of the tangent is not: at a node both are exact.
        let error = (vector(&simulation, &format!("{point}.angular_velocity")) - w).norm();
        assert!(error < if point == "P" { 1e-9 } else { 2e-2 }, "{point}: {error:e}");
    }
    let begin = [vector(&simulation, "momentum.linear"), vector(&simulation, "momentum.angular")];
    let energy = value(&simulation, "energy.total");
    run(&mut simulation, 1e-2, 0.3, |_| {});
    let drift = value(&simulation, "energy.total") / energy - 1.0;
    println!("thrown coil, energy: {drift:.1e}");
    // The coil stretches by its own turning and swings with that: of the kinetic energy a step leaves the square of its
    // size.
    assert!(drift.abs() < 1e-3, "{drift:e}");
    for (name, begin) in ["momentum.linear", "momentum.angular"].into_iter().zip(begin) {
        let off = (vector(&simulation, name) - begin).norm() / begin.norm();
        println!("thrown coil, {name}: {off:.1e}");
        assert!(off < 1e-10, "{name}: {off:e}");
    }
}

/// Springs and bodies along the curve, and the picture: a curved element is drawn with points between its nodes, a
/// straight one is not.
#[test]
fn curves_are_drawn_as_curves() {
    let more = format!(
        "{ROOT}\n[load.push]\non = \"arm\"\nforce = [1, 0, 0]\n[output.middle]\nat = \"arm@0.5\"\nquantities = [\"position\"]"
    );
    let document = Document::parse("m.toml", &model(HELIX, &more, STATIC), &[]).unwrap();
    let drawing = Drawing::new(&document);
    assert_eq!((drawing.lines[0].nodes.len(), drawing.lines[0].points.len()), (17, 16 * 8 + 1));
    let radii = drawing.lines[0].points.iter().map(|point| point[0].hypot(point[1]));
    // A Hermite element of 22.5 degrees: 2e-5 off the circle.
    assert!(radii.fold(0.0, |worst: f64, radius| worst.max((radius - 2.0).abs())) < 1e-3);
    assert_eq!(drawing.arrows.len(), 5);
    let middle = drawing.marks.iter().find(|mark| mark.name == "middle").unwrap();
    assert!((Vec3::from(middle.at) - Vec3::new(-2.0, 0.0, 0.25 * std::f64::consts::TAU)).norm() < 1e-13);
    let polyline = HELIX.replace("s = [0, \"2*pi\"]", "s = [0, \"2*pi\"], polyline = true");
    let drawing = Drawing::new(&Document::parse("m.toml", &model(&polyline, &more, STATIC), &[]).unwrap());
    assert_eq!((drawing.lines[0].nodes.len(), drawing.lines[0].points.len()), (32, 17));
}

/// Stress free as drawn, from the file: no energy, no force, no twist or strain at any station; and it stays so under
/// no load.
#[test]
fn an_unloaded_coil_shows_nothing() {
    let stations = "[output.all]\non = \"arm\"\nstations = 23\nquantities = [\"displacement\", \"twist\", \"axial_strain\", \"curvature\", \"torsion\", \"section_force\", \"section_moment\", \"stress\"]";
    for line in [
        HELIX.to_owned(),
        format!("{PARABOLA}\npretwist = 2"),
        format!("{PARABOLA}\nspacing = \"s\"\nstrain = \"small\""),
    ] {
        let curves = Curves::run(&model(&line, &format!("{ROOT}\n{stations}"), STATIC), &[]);
        let bound = |name: &str| match name {
            // Some round-offs of 1 in the axial strain, times EA or E. The round-off of a force on an arm of a meter
            // bends the section, whose modulus is some 1/300 m of its area.
            "section_force" => 1e-15 * 2e11 * 6e-4,
            "stress" => 300.0 * 1e-16 * 2e11,
            _ => 1e-13,
        };
        for (quantity, component) in
            [("twist", ""), ("axial_strain", ""), ("torsion", ""), ("section_force", ",1"), ("stress", "")]
        {
            for k in 1..=23 {
                let found = curves.last(&format!("all.{quantity}[{k}{component}]"));
                assert!(found.abs() <= bound(quantity), "{quantity} at {k}: {found:e}");
            }
        }
        assert!(curves.last("energy.elastic").abs() < 1e-20);
    }
}

/// A section of ANCF24 is solid: wound more sharply than its fibers, at 1/√12 of its width, are off the axis, it is
/// refused; just below, it is not. The line of ANCF14 has no fibers.
#[test]
fn a_solid_section_cannot_be_wound_more_sharply_than_it_is_wide() {
    // Elements of 5.6 degrees: linear between their ends a section is off the curve by less than 1e-3 of itself.
    let arc = "elements = 32\ny_axis = [1, 0, 0]\ncurve = { x = \"0.01*cos(s)\", y = \"0.01*sin(s)\", z = 0, s = [0, \"pi\"] }";
    let loaded = |width: f64, element: &str| {
        let line = format!("{arc}\nelement = \"{element}\"");
        let text = model(&line, ROOT, STATIC).replace("width = 0.03", &format!("width = {width}"));
        Simulation::load("wound.toml", &text, &[]).map(|_| ()).map_err(|failure| failure.message)
    };
    let limit = 0.01 * 12.0_f64.sqrt();
    loaded(0.98 * limit, "ancf24").unwrap();
    let message = loaded(1.02 * limit, "ancf24").unwrap_err();
    assert!(message.contains("beam arm is bent or pretwisted too sharply for a solid section"), "{message}");
    loaded(1.02 * limit, "ancf14").unwrap();
}
