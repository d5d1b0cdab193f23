//! Does a model file arrive as it was written? Values, parameters and their kinds, functions of time, overrides, and
//! what changes when a parameter is set.

use ancf14::fmi::Value;
use ancf14::fmi::variable::{Causality, Variability, Variable};
use ancf14::mechanics::beam::ancf14::energy::quadratic_twist::Twist;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::design::{Elements, Torsion};
use ancf14::model::document::Document;
use ancf14::model::drawing::{ArrowKind, Drawing, LineKind, MarkKind};
use ancf14::model::entries::anchor::{Along, Spot};
use ancf14::model::entries::curve::Line;
use ancf14::model::entries::load::Target;
use ancf14::model::entries::section::Shape;

const PRINCETON: &str = include_str!("../../../models/princeton_beam.toml");
const MODELS: [(&str, &str); 5] = [
    ("princeton_beam.toml", PRINCETON),
    ("pendulum.toml", include_str!("../../../models/pendulum.toml")),
    ("cantilever.toml", include_str!("../../../models/cantilever.toml")),
    ("helical_spring.toml", include_str!("../../../models/helical_spring.toml")),
    ("bend_45.toml", include_str!("../../../models/bend_45.toml")),
];

fn parse(text: &str, overrides: &[(&str, &str)]) -> Document {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Document::parse("m.toml", text, &overrides).unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
}

fn index(document: &Document, name: &str) -> usize {
    let found = document.parameters().iter().position(|parameter| parameter.variable.name == name);
    found.unwrap_or_else(|| panic!("no parameter {name}"))
}

fn row<'d>(document: &'d Document, name: &str) -> &'d Variable {
    &document.parameters()[index(document, name)].variable
}

/// Start and end of the first beam, which is straight.
fn ends(document: &Document) -> [[f64; 3]; 2] {
    let Some(Line::Straight { from, to }) = document.beams[0].line else { panic!("a straight beam") };
    [from, to].map(|end| document.vector(end))
}

#[test]
fn shipped_models_are_legal() {
    for (name, text) in MODELS {
        let document = Document::parse(name, text, &[]).unwrap_or_else(|diagnostics| panic!("{diagnostics}"));
        assert!(!document.outputs.is_empty() && !document.beams.is_empty(), "{name}");
    }
}

/// Typed data: references, points and words are what the file says.
#[test]
fn the_princeton_beam_arrives_as_written() {
    let document = parse(PRINCETON, &[]);
    let arm = &document.beams[0];
    assert_eq!(document.model.identifier, "PrincetonBeam");
    assert_eq!(ends(&document), [[0.0; 3], [0.508, 0.0, 0.0]]);
    assert_eq!((arm.material, arm.section), (Some(0), 0));
    assert_eq!(arm.formulation, crate::support::machines::ancf14(Strain::Small, Twist::Linear));
    assert_eq!(document.value(arm.elements), 8.0);
    assert!(matches!(document.sections[0].shape, Shape::Rectangle { width, .. } if document.value(width) == 3.2024e-3));
    assert_eq!(document.sections[0].torsion_constant.map(|number| document.value(number)), Some(113.3872e-12));
    assert_eq!(document.joints[0].a.spot, Spot::Ground);
    assert_eq!(document.joints[0].b.spot, Spot::Beam { beam: 0, along: Along::Start });
    let Target::At(anchor) = document.loads[0].target else { panic!("a point load") };
    assert_eq!(anchor.spot, Spot::Beam { beam: 0, along: Along::End });
    let words: Vec<_> = document.outputs[0].quantities.iter().map(|quantity| quantity.row().word).collect();
    assert_eq!(words, ["displacement", "twist", "rotation"]);
}

/// The load grows to P in the time `ramp`, then stays; at the limit the later piece is valid.
#[test]
fn piecewise_loads_have_values_and_derivatives() {
    let document = parse(PRINCETON, &[("angle_deg", "30")]);
    let force = document.loads[0].force.map(|number| document.function(number));
    assert!(force[0].is_constant() && !force[1].is_constant());
    let sin = 30.0_f64.to_radians().sin();
    for (t, value, slope) in
        [(0.0, 0.0, 8.896 * sin), (0.25, 2.224 * sin, 8.896 * sin), (1.0, 8.896 * sin, 0.0), (9.0, 8.896 * sin, 0.0)]
    {
        let jet = force[1].jet(t);
        assert!((jet.value - value).abs() < 1e-14 && (jet.first - slope).abs() < 1e-14, "{t}: {jet:?}");
    }
    assert_eq!(document.name(document.loads[0].force[1]), "weight.force[2]");
}

/// The rows are the numbers written in the file, in its order, and step and tolerance; stop and output_step are none.
#[test]
fn parameters_are_the_numbers_of_the_file() {
    let document = parse(PRINCETON, &[]);
    let names: Vec<_> = document.parameters().iter().map(|parameter| parameter.variable.name.as_str()).collect();
    assert_eq!(
        names,
        [
            "P",
            "angle_deg",
            "angle",
            "ramp",
            "aluminium.young",
            "aluminium.poisson",
            "aluminium.density",
            "strip.width",
            "strip.height",
            "strip.torsion_constant",
            "arm.from[1]",
            "arm.from[2]",
            "arm.from[3]",
            "arm.to[1]",
            "arm.to[2]",
            "arm.to[3]",
            "arm.y_axis[1]",
            "arm.y_axis[2]",
            "arm.y_axis[3]",
            "arm.elements",
            "weight.force[1]",
            "simulation.step",
            "simulation.tolerance",
        ]
    );
    let angle = row(&document, "angle");
    assert_eq!((angle.causality, angle.variability), (Causality::CalculatedParameter, Variability::Tunable));
    assert_eq!(angle.display_unit.as_deref(), Some("deg"));
    assert_eq!(angle.start, Value::Real(45.0 * std::f64::consts::PI / 180.0));
    assert_eq!(row(&document, "arm.elements").start, Value::Integer(8));
    assert_eq!(row(&document, "simulation.tolerance").start, Value::Real(1e-8));
    let load = row(&document, "P");
    assert_eq!((load.min, load.max, load.description.as_str()), (Some(0.0), Some(20.0), "Load at the tip"));
    assert_eq!((load.quantity.name, load.quantity.unit.as_str()), ("Force", "N"));
}

/// A parameter is tunable exactly if everything that it feeds is.
#[test]
fn tunable_follows_the_use() {
    let text = PRINCETON.replace("density = 2740", "density = \"2740 + 0*ramp\"");
    let document = parse(&text, &[]);
    let variability = |name: &str| row(&document, name).variability;
    assert_eq!(variability("P"), Variability::Tunable);
    assert_eq!(variability("angle_deg"), Variability::Tunable, "through `angle`");
    assert_eq!(variability("ramp"), Variability::Fixed, "it feeds a load, but a density too");
    assert_eq!(variability("weight.force[1]"), Variability::Tunable);
    assert_eq!(variability("aluminium.young"), Variability::Fixed);
}

/// Setting one number moves what follows from it; reset brings all back.
#[test]
fn setting_a_parameter_resolves_what_depends_on_it() {
    let mut document = parse(PRINCETON, &[]);
    let angle = index(&document, "angle_deg");
    document.set_parameter(angle, Value::Real(90.0)).expect("in range");
    assert_eq!(document.parameter_value(index(&document, "angle")), Value::Real(std::f64::consts::FRAC_PI_2));
    assert!((document.function(document.loads[0].force[1]).value(2.0) - 8.896).abs() < 1e-15);
    let refused = document.clone();
    let calculated = index(&document, "angle");
    let elements = index(&document, "arm.elements");
    for (place, value, expected) in [
        (angle, Value::Real(200.0), "must be at least -180 and at most 180"),
        (angle, Value::Real(f64::NAN), "must be a finite number"),
        (angle, Value::Integer(3), "is a Real"),
        (elements, Value::Real(3.0), "is an Integer"),
        (elements, Value::Integer(0), "must be at least 1"),
        (calculated, Value::Real(0.0), "cannot be set"),
    ] {
        let reason = document.set_parameter(place, value).expect_err(expected);
        assert!(reason.contains(expected), "{reason}");
        assert_eq!(document.parameter_value(place), refused.parameter_value(place), "a refused value changes nothing");
    }
    document.reset();
    assert_eq!(document.parameter_value(angle), Value::Real(45.0));
    assert_eq!(document.parameter_value(calculated), Value::Real(45.0 * std::f64::consts::PI / 180.0));
}

/// A parameter may be legal and what follows from it not: `check` says so, with the name of what is wrong.
#[test]
fn check_finds_what_follows() {
    let text = PRINCETON.replace("elements = 8", "elements = \"angle_deg/5\"");
    let mut document = parse(&text, &[]);
    assert_eq!(document.check(), Ok(()));
    document.set_parameter(index(&document, "angle_deg"), Value::Real(47.0)).expect("in range");
    assert_eq!(document.check(), Err("`arm.elements` must be a whole number, this is 9.4".to_owned()));
}

/// Written or not, number, list, component, word or expression: an override is as good as the file.
#[test]
fn overrides_reach_every_key() {
    let document = parse(
        PRINCETON,
        &[
            ("gravity[3]", "-9.81"),
            ("arm.pretwist", "0.1"),
            ("arm.to", "[\"P\", 0, 0.5]"),
            ("arm.strain", "large_truncated"),
            ("arm.torsion", "false"),
            ("weight.force[1]", "2*P*t"),
            ("P", "2"),
            ("simulation.integrator", "generalized_alpha"),
        ],
    );
    let arm = &document.beams[0];
    assert_eq!(document.vector(document.model.gravity), [0.0, 0.0, -9.81]);
    assert_eq!(document.value(arm.pretwist), 0.1);
    assert_eq!(ends(&document), [[0.0; 3], [2.0, 0.0, 0.5]]);
    let torsion = Torsion::Suppressed;
    assert_eq!(arm.formulation, Elements::Ancf14 { strain: Strain::LargeTruncated, twist: Twist::Linear, torsion });
    assert_eq!(document.function(document.loads[0].force[0]).value(3.0), 12.0);
    assert_eq!(row(&document, "P").max, Some(20.0), "the table around a value stays");
    let names: Vec<_> = document.parameters().iter().map(|parameter| parameter.variable.name.as_str()).collect();
    assert!(!names.contains(&"gravity[3]") && !names.contains(&"arm.pretwist"), "not written in the file");
    assert_eq!(names[0], "P", "an override does not change the order");
}

/// Every section shape and load on a beam, with the keys that only they have.
#[test]
fn shapes_and_line_loads() {
    let text = PRINCETON.replace("[load.weight]\nat = \"arm.end\"", "[load.weight]\non = \"arm\"\nfollower = true").replace(
        "shape = \"rectangle\"\nwidth = 3.2024e-3\nheight = 12.377e-3",
        "shape = \"general\"\narea = 1e-4\nsecond_moment_y = 1e-9\nsecond_moment_z = 2e-9\nfourth_moments = [1e-14, 2e-14, 3e-14]",
    );
    let document = parse(&text, &[]);
    let section = &document.sections[0];
    assert_eq!(section.shape, Shape::General);
    assert_eq!(section.second_moment_z.map(|number| document.value(number)), Some(2e-9));
    assert_eq!(section.fourth_moments.map(|numbers| document.vector(numbers)), Some([1e-14, 2e-14, 3e-14]));
    assert_eq!(section.polar_moment, None);
    assert_eq!(document.loads[0].target, Target::On(0));
    assert!(document.loads[0].follower);
    assert_eq!(row(&document, "weight.force[1]").quantity.unit, "N/m");
}

/// The picture shows things where they are: nodes along the beam, a joint at its default place, a load that begins at
/// zero as it first acts.
#[test]
fn drawings_are_made_of_the_file() {
    let drawing = Drawing::new(&parse(PRINCETON, &[("angle_deg", "90"), ("arm.elements", "4")]));
    assert_eq!(drawing.lines[0].points.len(), 5);
    assert_eq!(drawing.lines[0].points[2], [0.254, 0.0, 0.0]);
    let root = &drawing.marks[0];
    assert_eq!((root.name.as_str(), root.kind, root.at), ("root", MarkKind::Support, [0.0; 3]));
    let weight = &drawing.arrows[0];
    assert_eq!((weight.kind, weight.at), (ArrowKind::Force, [0.508, 0.0, 0.0]));
    assert!(weight.direction[1] > 0.0 && weight.direction[0] == 0.0, "{:?}", weight.direction);
    let pendulum = Drawing::new(&parse(MODELS[1].1, &[]));
    let axis = &pendulum.arrows[0];
    assert_eq!((axis.name.as_str(), axis.kind, axis.direction), ("elbow", ArrowKind::Axis, [0.0, 1.0, 0.0]));
}

/// A load that swings is drawn the way it acts first, not as it is at the end; a rigid arm reaches from a joint to its
/// body; what is infinitely far away is left out.
#[test]
fn regression_drawings_show_what_acts_and_what_is_near() {
    let text = r#"
format = 1
model.name = "Swing"
[body.bob]
mass = 1
position = [1, 0, 0]
inertia = [1, 1, 1]
[body.far]
mass = 1
position = [1e200, 0, 0]
inertia = [1, 1, 1]
[frame.hand]
position = ["1/t", 0, 0]
[joint.hinge]
type = "revolute"
a = "ground"
b = "bob"
at = [0, 0, 0]
axis = [0, 1, 0]
[load.push]
at = "bob"
force = [0, 0, "-2*sin(10*t)"]
[simulation]
stop = 1.0
step = 0.1
"#;
    let drawing = Drawing::new(&parse(text, &[]));
    let push = drawing.arrows.iter().find(|arrow| arrow.name == "push").expect("a load");
    assert!(push.direction[2] < 0.0, "{:?}", push.direction);
    let arms: Vec<_> = drawing.lines.iter().filter(|line| line.kind == LineKind::Arm).collect();
    assert_eq!(arms.len(), 1);
    assert_eq!(arms[0].points, [[0.0; 3], [1.0, 0.0, 0.0]]);
    assert!(drawing.marks.iter().all(|mark| !["hand", "far"].contains(&mark.name.as_str())));
}

/// Gravity goes by its bare name and can be changed while the model runs.
#[test]
fn gravity_is_a_parameter_without_a_section() {
    let document = parse(MODELS[1].1, &[]);
    let gravity = row(&document, "gravity[3]");
    assert_eq!((gravity.start, gravity.variability), (Value::Real(-9.81), Variability::Tunable));
    assert_eq!(gravity.description, "Acceleration of gravity in global axes, component 3");
    assert_eq!((gravity.quantity.unit.as_str(), gravity.quantity.name), ("m/s2", "Acceleration"));
}
