//! Bodies, frames, joints of all kinds, drives, springs and their outputs: do they arrive as they were written, with
//! the right numbers as parameters and inputs? `tests/everything.toml` has them all.

use ancf14::fmi::Value;
use ancf14::fmi::variable::{Causality, Variability, Variable};
use ancf14::model::document::Document;
use ancf14::model::drawing::{ArrowKind, Drawing, LineKind, MarkKind};
use ancf14::model::entries::actuator::Action;
use ancf14::model::entries::anchor::{Anchor, Spot};
use ancf14::model::entries::body::Inertia;
use ancf14::model::entries::drive::Motion;
use ancf14::model::entries::frame::Orientation;
use ancf14::model::entries::joint::{Coordinate, JointKind, JointSpec};
use ancf14::model::entries::load;
use ancf14::model::entries::output::Target;
use ancf14::model::entries::simulation::{Initial, IntegratorSpec};
use ancf14::model::entries::spring::{SpringLaw, SpringSpec};
use ancf14::model::names::Kind;
use ancf14::model::quantity::{QUANTITIES, Quantity, Site};

pub const EVERYTHING: &str = include_str!("../../everything.toml");

fn parse(overrides: &[(&str, &str)]) -> Document {
    let overrides: Vec<_> = overrides.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned())).collect();
    Document::parse("everything.toml", EVERYTHING, &overrides).unwrap_or_else(|diagnostics| panic!("{diagnostics}"))
}

fn refused(key: &str, value: &str) -> String {
    let overrides = [(key.to_owned(), value.to_owned())];
    Document::parse("everything.toml", EVERYTHING, &overrides).expect_err(key).to_string()
}

fn row<'d>(document: &'d Document, name: &str) -> &'d Variable {
    let found = document.parameters().iter().find(|parameter| parameter.variable.name == name);
    &found.unwrap_or_else(|| panic!("no parameter {name}")).variable
}

fn joint<'d>(document: &'d Document, name: &str) -> &'d JointSpec {
    document.joints.iter().find(|joint| joint.name == name).unwrap_or_else(|| panic!("no joint {name}"))
}

/// Three numbers are principal values, six a tensor; axes are no parameters but follow from some.
#[test]
fn bodies_arrive_as_written() {
    let document = parse(&[]);
    let [disk, bob, _] = document.bodies.as_slice() else { panic!("three bodies") };
    assert_eq!((document.value(disk.mass), document.vector(disk.position)), (3.0, [1.0, 0.0, 0.0]));
    let Inertia::Principal(moments) = disk.inertia else { panic!("principal values") };
    assert_eq!(document.vector(moments), [0.02, 0.01, 0.01]);
    assert_eq!((document.vector(disk.velocity), disk.axes), ([0.0, 1.0, 0.0], None));
    let Inertia::Tensor(tensor) = bob.inertia else { panic!("a tensor") };
    assert_eq!(tensor.map(|number| document.value(number)), [0.02, 0.03, 0.04, 1e-3, -3e-3, 0.0]);
    let axes = bob.axes.expect("axes").map(|row| document.vector(row));
    assert_eq!(axes, [[0.5_f64.cos(), 0.5_f64.sin(), 0.0], [-0.5_f64.sin(), 0.5_f64.cos(), 0.0], [0.0, 0.0, 1.0]]);
    let moment = row(&document, "bob.inertia[4]");
    assert_eq!((moment.quantity.unit.as_str(), moment.variability), ("kg.m2", Variability::Fixed));
    assert_eq!(row(&document, "turn").variability, Variability::Fixed, "it feeds axes and motions");
    assert!(document.parameters().iter().all(|parameter| !parameter.variable.name.contains("axes")));
}

/// A frame moves by expressions, or the host moves it: then it has a quaternion instead of a rotation vector.
#[test]
fn frames_are_functions_or_inputs() {
    let document = parse(&[]);
    let [hand, foot] = document.frames.as_slice() else { panic!("two frames") };
    let Orientation::Rotation(rotation) = foot.orientation else { panic!("a rotation vector") };
    let angle = document.function(rotation[2]);
    assert_eq!((angle.value(0.5), angle.value(2.0), foot.input), (0.25, 0.5, false));
    assert_eq!(document.function(foot.position[1]).jet(0.0).first, 10.0);
    assert_eq!(row(&document, "foot.position[1]").variability, Variability::Fixed);

    let Orientation::Quaternion(quaternion) = hand.orientation else { panic!("a quaternion") };
    let start = quaternion.map(|number| document.value(number));
    let half = std::f64::consts::FRAC_PI_4;
    let expected = [half.cos(), 0.0, 0.0, half.sin()];
    assert!(start.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-15), "{start:?}");
    assert!(hand.input);
    for name in ["hand.position[3]", "hand.quaternion[1]", "hand.quaternion[4]"] {
        let input = row(&document, name);
        assert_eq!((input.causality, input.variability), (Causality::Input, Variability::Continuous));
        assert!(input.description.contains("reached at the end of the communication step, smoothly"), "{input:?}");
    }
    assert!(document.parameters().iter().all(|parameter| !parameter.variable.name.starts_with("hand.rotation")));
    let turned = parse(&[("hand.rotation[3]", "0"), ("hand.position[1]", "2")]);
    assert_eq!(row(&turned, "hand.quaternion[1]").start, Value::Real(1.0), "the file's rotation is where it starts");
    assert_eq!(row(&turned, "hand.position[1]").start, Value::Real(2.0));
}

/// Each kind of joint has its axes and the springs and dampers of its coordinates, and no others.
#[test]
fn joints_have_what_their_kind_has() {
    let document = parse(&[]);
    for (name, kind, axes, coordinates) in [
        ("pivot", JointKind::Revolute, 1, &[Coordinate::Angle][..]),
        ("clamp", JointKind::Weld, 0, &[]),
        ("screw", JointKind::Cylindrical, 1, &[Coordinate::Angle, Coordinate::Distance]),
        ("slot", JointKind::Prismatic, 1, &[Coordinate::Distance]),
        ("cross", JointKind::Universal, 2, &[]),
        ("rail", JointKind::Inline, 1, &[Coordinate::Distance]),
        ("floor", JointKind::Inplane, 1, &[]),
        ("ball", JointKind::Spherical, 0, &[]),
        ("bush", JointKind::Bushing, 0, &[]),
    ] {
        let joint = joint(&document, name);
        let springs = [(joint.angle, Coordinate::Angle), (joint.distance, Coordinate::Distance)];
        let sprung: Vec<_> = springs.iter().filter(|(spring, _)| spring.is_some()).map(|(_, own)| *own).collect();
        assert_eq!((joint.kind, sprung.as_slice()), (kind, coordinates), "{name}");
        assert_eq!(usize::from(joint.axis.is_some()) + usize::from(joint.axis2.is_some()), axes, "{name}");
        assert_eq!(joint.bushing.is_some(), kind == JointKind::Bushing, "{name}");
    }
    let value = |number| document.value(number);
    let screw = joint(&document, "screw");
    let (angle, distance) = (screw.angle.expect("an angle"), screw.distance.expect("a distance"));
    assert_eq!(
        [distance.stiffness, distance.damping, angle.stiffness, angle.damping].map(value),
        [10.0, 0.0, 0.0, 0.1]
    );
    let bushing = joint(&document, "bush").bushing.expect("a bushing");
    assert_eq!(document.vector(bushing.stiffness), [100.0, 200.0, 300.0]);
    assert_eq!(document.vector(bushing.rotational_damping), [1.0, 2.0, 3.0]);
    assert_eq!(document.vector(bushing.damping), [0.0; 3]);
    assert_eq!((joint(&document, "ball").b.spot, screw.a.spot), (Spot::Frame(0), Spot::Body(0)));
    for (name, unit) in [
        ("pivot.damping", "N.m.s/rad"),
        ("screw.stiffness", "N/m"),
        ("screw.rotational_damping", "N.m.s/rad"),
        ("bush.stiffness[2]", "N/m"),
        ("rail.damping", "N.s/m"),
    ] {
        let row = row(&document, name);
        assert_eq!((row.quantity.unit.as_str(), row.variability), (unit, Variability::Tunable), "{name}");
    }
}

/// A drive prescribes a value or a rate, by an expression or by the host; its unit is that of the coordinate.
#[test]
fn drives_are_functions_or_inputs() {
    let document = parse(&[]);
    let [crank, push, spin, feed] = document.drives.as_slice() else { panic!("four drives") };
    let Motion::Value(value) = crank.motion else { panic!("a value") };
    assert_eq!((document.function(value).value(0.5), document.function(value).value(3.0)), (0.125, 0.5));
    assert_eq!((crank.joint, crank.coordinate, crank.input), (0, Coordinate::Angle, false));
    assert!(matches!(spin.motion, Motion::Rate(rate) if document.value(rate) == 10.0));
    assert!(matches!(push.motion, Motion::Rate(rate) if document.value(rate) == 0.0) && push.input);
    assert!(matches!(feed.motion, Motion::Value(value) if document.value(value) == 0.25) && feed.input);
    for (name, unit, causality) in [
        ("push.rate", "m/s", Causality::Input),
        ("feed.value", "m", Causality::Input),
        ("spin.rate", "rad/s", Causality::Parameter),
    ] {
        let row = row(&document, name);
        assert_eq!((row.quantity.unit.as_str(), row.causality), (unit, causality));
        let told = row.description.contains("reached at the end of the communication step, smoothly");
        assert_eq!(told, causality == Causality::Input, "{}", row.description);
    }
}

/// An actuator acts on a coordinate of a joint or between two points; its effort is a torque or a force, and may be the
/// host's.
#[test]
fn actuators_arrive_as_written() {
    let document = parse(&[]);
    let [motor, winch, cylinder] = document.actuators.as_slice() else { panic!("three actuators") };
    let screw = document.joints.iter().position(|joint| joint.name == "screw").expect("a screw");
    assert_eq!(motor.action, Action::Joint { joint: screw, coordinate: Coordinate::Angle });
    assert_eq!((winch.coordinate(), winch.input, document.value(winch.effort)), (Coordinate::Distance, true, 0.0));
    let Action::Between { a, b } = cylinder.action else { panic!("between two points") };
    assert_eq!((a.spot, b.spot, document.value(cylinder.effort)), (Spot::Frame(0), Spot::Body(0), 200.0));
    let winch = row(&document, "winch.effort");
    assert_eq!((winch.quantity.unit.as_str(), winch.causality), ("N", Causality::Input));
    assert!(winch.description.ends_with("held during a communication step"), "{}", winch.description);
    assert!(
        document.parameters().iter().all(|parameter| parameter.variable.name != "motor.effort"),
        "it changes in time"
    );
}

#[test]
fn springs_materials_and_the_simulation_arrive_as_written() {
    let document = parse(&[]);
    let [tie, rope, line] = document.springs.as_slice() else { panic!("three springs") };
    let ends = |spring: &SpringSpec| spring.ends().expect("two points");
    let linear = |spring: &SpringSpec| match spring.law {
        SpringLaw::Linear { stiffness, damping, only: None } => [document.value(stiffness), document.value(damping)],
        other => panic!("{other:?}"),
    };
    assert_eq!((ends(tie)[0].spot, linear(tie)[0]), (Spot::Ground, 100.0));
    assert_eq!((tie.rest.map(|length| document.value(length)), rope.rest), (Some(0.2), None));
    assert_eq!((ends(rope).map(|end| end.spot), linear(rope)[1]), ([Spot::Frame(0), Spot::Body(1)], 0.0));
    // A point stands for what it is on, and says which one it is.
    assert_eq!(ends(line).map(|end| (end.spot, end.point)), [(Spot::Ground, Some(0)), (Spot::Body(1), Some(1))]);
    assert_eq!(row(&document, "tie.length").variability, Variability::Tunable);
    assert_eq!(document.materials[0].damping.coefficients(|number| document.value(number)), [1e-4, 0.0]);
    assert_eq!(document.simulation.initial, Initial::Equilibrium);
    assert!(document.simulation.verify);
    let IntegratorSpec::GeneralizedAlpha { spectral_radius } = document.simulation.integrator else { panic!("alpha") };
    assert_eq!(document.value(spectral_radius), 0.8);
    let load::Target::At(Anchor { spot, .. }) = document.loads[0].target else { panic!("at a body") };
    assert_eq!(spot, Spot::Body(0));
    assert_eq!(row(&document, "push_disk.force[1]").description, "Force of load push_disk along the body's x");
}

/// What an output looks at, and the unit of an effort, which is a force along a distance.
#[test]
fn outputs_look_at_everything() {
    let document = parse(&[]);
    let sites: Vec<_> = document.outputs.iter().map(|output| output.target.site()).collect();
    assert_eq!(
        sites,
        [
            Site::At(Kind::Beam),
            Site::At(Kind::Beam),
            Site::At(Kind::Beam),
            Site::At(Kind::Body),
            Site::At(Kind::Frame),
            Site::At(Kind::Joint),
            Site::At(Kind::Joint),
            Site::At(Kind::Drive),
            Site::At(Kind::Point),
            Site::At(Kind::Actuator)
        ]
    );
    assert_eq!(document.outputs[1].target, Target::On { beam: 0, stations: 5 });
    assert_eq!(document.outputs[2].target, Target::On { beam: 0, stations: 21 });
    assert_eq!(
        (document.outputs[5].target, document.outputs[7].target),
        (Target::Connection(Kind::Joint, 0), Target::Connection(Kind::Drive, 1))
    );
    let unit = |output: usize| document.outputs[output].unit(Quantity::Effort, &document);
    assert_eq!((unit(5), unit(7), unit(9)), ("N.m", "N", "N"));
    assert_eq!(document.outputs[9].target, Target::Connection(Kind::Actuator, 2));
    assert!(document.parameters().iter().all(|parameter| !parameter.variable.name.ends_with("stations")));
    assert_eq!(parse(&[("line.stations", "3")]).outputs[2].target, Target::On { beam: 0, stations: 3 });
    assert!(QUANTITIES.iter().all(|row| !row.sites.is_empty() && row.components > 0));
}

/// Overrides reach the new sections: long lists too, tables as a whole only.
#[test]
fn overrides_reach_every_section() {
    let document = parse(&[
        ("disk.mass", "4"),
        ("bob.inertia[6]", "1e-3"),
        ("bob.axes", "[[0,1,0],[-1,0,0],[0,0,1]]"),
        ("bush.stiffness[3]", "7"),
        ("simulation.initial", "as_drawn"),
        ("rope.length", "0.1"),
    ]);
    assert_eq!(document.value(document.bodies[0].mass), 4.0);
    assert!(matches!(document.bodies[1].inertia, Inertia::Tensor(tensor) if document.value(tensor[5]) == 1e-3));
    assert_eq!(document.bodies[1].axes.map(|axes| document.vector(axes[1])), Some([-1.0, 0.0, 0.0]));
    assert_eq!(document.springs[1].rest.map(|length| document.value(length)), Some(0.1));
    for (key, value, expected) in [
        ("disk.inertia[4]", "1", "`disk.inertia[4]` has no such component"),
        ("bob.inertia[7]", "1", "`bob.inertia[7]` has no such component"),
        ("bob.axes[1]", "[1, 0, 0]", "`axes` is a table: its components cannot be set one by one"),
        ("disk.axes[1]", "1", "`axes` is a table"),
        ("hand.quaternion[1]", "1", "unknown key `quaternion`"),
        ("hand.position[1]", "t", "is an input and an expression"),
        ("hand.position[1]", "k", "is an input and an expression"),
        ("disk.velocity[4]", "1", "an index from 1 to 3 was expected"),
        ("feed.value", "2*m", "is an input and an expression"),
        ("crank.vlaue", "2", "did you mean `value`?"),
        ("bob.inertia[1]", "5", "the inertia of body bob is not physically possible"),
        ("turn", "t", "time is known in loads, drives, frames, efforts of actuators, temperatures and `active` only"),
    ] {
        let message = refused(key, value);
        assert!(message.contains(expected), "{key}={value}: {message}");
    }
}

/// A parameter that a host sets may make a table of axes or an inertia that no body has: the builder asks again.
#[test]
fn geometry_is_checked_with_the_parameters_of_now() {
    let mut document = parse(&[]);
    let m = document.parameters().iter().position(|parameter| parameter.variable.name == "m").expect("m");
    assert!(ancf14::model::validate::mistakes(&document).is_empty());
    document.set_parameter(m, Value::Real(1000.0)).expect("a number");
    let mistakes = ancf14::model::validate::mistakes(&document);
    assert_eq!(mistakes.len(), 1);
    assert_eq!(mistakes[0].message, "the inertia of body bob is not positive");
}

/// The picture has everything at its place; what hangs on nothing is at the origin.
#[test]
fn drawings_show_everything() {
    let drawing = Drawing::new(&parse(&[]));
    let mark = |name: &str, kind: MarkKind| {
        let found = drawing.marks.iter().find(|mark| mark.name == name && mark.kind == kind);
        found.unwrap_or_else(|| panic!("{name} is not drawn")).at
    };
    assert_eq!(mark("disk", MarkKind::Body), [1.0, 0.0, 0.0]);
    assert_eq!(mark("hand", MarkKind::Frame), [0.0, 0.0, 0.5]);
    let push = drawing.arrows.iter().find(|arrow| arrow.kind == ArrowKind::Drive).expect("a drive of a distance");
    assert_eq!((push.name.as_str(), push.at), ("push", [1.5, 0.0, 0.5]));
    assert_eq!(mark("ball", MarkKind::Joint), [0.0, 0.0, 0.5]);
    assert_eq!(mark("floor", MarkKind::Support), [2.0, 0.0, 2.0]);
    assert_eq!(mark("thrust", MarkKind::Output), [1.5, 0.0, 0.5]);
    assert_eq!(mark("shape", MarkKind::Output), [0.5, 0.0, 0.0]);
    let springs: Vec<_> = drawing.lines.iter().filter(|line| line.kind == LineKind::Spring).collect();
    assert_eq!((springs[0].name.as_str(), springs[0].points.as_slice()), ("tie", &[[0.0; 3], [0.3, 0.0, 0.0]][..]));
    let axes = drawing.arrows.iter().filter(|arrow| arrow.name == "cross" && arrow.kind == ArrowKind::Axis);
    assert_eq!(axes.count(), 2);
}
