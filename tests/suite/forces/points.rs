//! Points hold on to places off the centers of mass and off the axes of beams. A force at a point has its moment, a
//! point moves with the kinematics of a rigid arm, a joint or a spring at a point is the one at the same place written
//! otherwise. A lost arm, an arm in wrong axes, or a centripetal term that is missing shows in full.

use crate::random::Random;
use crate::running::{run, start, value, vector};
use crate::support::marker_oracle::{All, COUNT, Dual, Machine, ROUNDING, any_marker, deep};
use ancf14::math::Vec3;
use ancf14::mechanics::marker::sensor::Sensor;
use ancf14::model::document::Document;
use ancf14::model::run::levels::Level;
use nalgebra::SVector;

/// A body that turns about its z axis and moves, with a point on it.
const SPINNING: &str = r#"
format = 1
[model]
name = "Spinning"
[body.disk]
mass = 2
position = [0.3, -0.2, 0.5]
inertia = [0.05, 0.05, 0.09]
axes = [[0, 0, 1], [1, 0, 0], [0, 1, 0]]
velocity = [1, 0, 0.5]
angular_velocity = [0, 3, 0]
[point.rim]
on = "disk"
offset = [0.25, 0.1, -0.4]
axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]
[output.at_rim]
at = "rim"
quantities = ["position", "displacement", "velocity", "acceleration", "rotation", "quaternion", "angular_velocity"]
[simulation]
stop = 1
step = 1e-3
"#;

/// A point of a body that turns evenly goes round in a circle: closed forms of all its quantities. The body's z axis is
/// the global y axis.
#[test]
fn a_point_of_a_spinning_body_goes_round() {
    let mut simulation = start(SPINNING);
    let (spin, center, velocity) = (3.0, Vec3::new(0.3, -0.2, 0.5), Vec3::new(1.0, 0.0, 0.5));
    // Rows of `axes` are the global directions of the body's axes.
    let arm = Vec3::z() * 0.25 + Vec3::x() * 0.1 - Vec3::y() * 0.4;
    let turned = |angle: f64| nalgebra::Rotation3::from_axis_angle(&Vec3::y_axis(), angle);
    // The midpoint rule at 0.003 rad a step: the phase is off by (0.003)^2/12 of the angle, 2e-6 rad at the end.
    let bound = 1e-5;
    let check = |simulation: &ancf14::model::simulation::Simulation, time: f64, bound: f64| {
        let now = turned(spin * time) * arm;
        let omega = Vec3::y() * spin;
        let (global, across) = (center + velocity * time, omega.cross(&now));
        for (quantity, expected) in [
            ("position", global + now),
            ("displacement", velocity * time + now - arm),
            ("velocity", velocity + across),
            ("acceleration", omega.cross(&across)),
            ("rotation", omega * time),
            ("angular_velocity", omega),
        ] {
            let found = vector(simulation, &format!("at_rim.{quantity}"));
            assert!((found - expected).norm() < bound * expected.norm().max(1.0), "{quantity}: {found} {expected}");
        }
        // The axes of the point are the global ones as drawn.
        let half = 0.5 * spin * time;
        for (component, expected) in [half.cos(), 0.0, half.sin(), 0.0].into_iter().enumerate() {
            let found = value(simulation, &format!("at_rim.quaternion[{}]", component + 1));
            assert!((found - expected).abs() < bound, "quaternion {component}: {found} {expected}");
        }
    };
    check(&simulation, 0.0, 1e-12);
    run(&mut simulation, 0.5, 1.0, |_| {});
    check(&simulation, 1.0, bound);
}

/// The acceleration of every kind of marker, with arms on nodes, sections, bodies and moving frames, against automatic
/// differentiation.
#[test]
fn accelerations_of_points() {
    deep(check_accelerations);
}

fn check_accelerations() {
    let mut random = Random(41);
    for kind in 0..10 {
        let machine = Machine::new(&mut random);
        let marker = any_marker(&mut random, kind);
        let c = machine.configuration();
        let acceleration = SVector::<f64, COUNT>::from_fn(|_, _| random.signed());
        let mut along = All::<f64>::zeros();
        along.fixed_rows_mut::<COUNT>(0).copy_from(&machine.velocity);
        along[COUNT] = 1.0;
        let sensor = Sensor::new(&[], &c, marker, None);
        let (velocity, _) = sensor.motion(&c, machine.velocity.as_slice());
        let found = sensor.acceleration(&c, machine.velocity.as_slice(), acceleration.as_slice());
        for axis in 0..3 {
            let place = |q: All<Dual>| machine.pose(&marker, q.as_slice())[0][axis];
            let (_, by_q, by_qq) = num_dual::hessian(place, &machine.all());
            let size = by_qq.amax().max(1.0) * 10.0;
            assert!((velocity[axis] - by_q.dot(&along)).abs() < ROUNDING * size, "velocity of kind {kind}");
            let expected = by_q.fixed_rows::<COUNT>(0).dot(&acceleration) + along.dot(&(by_qq * along));
            assert!((found[axis] - expected).abs() < ROUNDING * size, "kind {kind}: {found} {expected}");
        }
    }
}

/// A beam clamped at the origin along x and twisted as drawn, with a load on it.
fn cantilever(load: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Cantilever\"\n\
         [material.m]\nyoung = 2e9\npoisson = 0.3\ndensity = 1000\n\
         [section.s]\nshape = \"rectangle\"\nwidth = 0.01\nheight = 0.02\n\
         [beam.arm]\nmaterial = \"m\"\nsection = \"s\"\nfrom = [0, 0, 0]\nto = [1, 0, 0]\nelements = 4\ny_axis = [0, 1, 1]\npretwist = 0.4\n\
         [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"arm.start\"\n{load}\n\
         [output.tip]\nat = \"arm.end\"\nquantities = [\"displacement\", \"rotation\"]\n\
         [simulation]\nanalysis = \"static\"\nstop = 1\nstep = 0.25\n"
    )
}

fn bent(load: &str) -> Vec3 {
    let mut simulation = start(&cantilever(load));
    run(&mut simulation, 1.0, 1.0, |_| {});
    vector(&simulation, "tip.displacement") + vector(&simulation, "tip.rotation")
}

/// A force at a point is the force at what the point is on, with the moment of its arm: for follower loads in the same
/// axes, at nodes and inside elements.
#[test]
fn a_force_at_a_point_has_its_moment() {
    let (arm, force) = (Vec3::new(0.02, 0.1, -0.05), Vec3::new(1.0, 0.4, 0.3));
    let moment = arm.cross(&force);
    let list = |v: Vec3| format!("[{}, {}, {}]", v[0], v[1], v[2]);
    let ramp = |v: Vec3| format!("[\"{}*t\", \"{}*t\", \"{}*t\"]", v[0], v[1], v[2]);
    for on in ["arm.end", "arm@0.5", "arm@0.6"] {
        let at_point = format!(
            "[point.stub]\non = \"{on}\"\noffset = {}\n[load.push]\nat = \"stub\"\nfollower = true\nforce = {}\n",
            list(arm),
            ramp(force)
        );
        let on_axis = format!(
            "[load.push]\nat = \"{on}\"\nfollower = true\nforce = {}\nmoment = {}\n",
            ramp(force),
            ramp(moment)
        );
        let (found, expected) = (bent(&at_point), bent(&on_axis));
        // The tolerance of equilibria is 1e-8 of the length.
        assert!(expected.norm() > 5e-3 && (found - expected).norm() < 1e-7, "{on}: {found} {expected}");
    }
}

/// Results of the last row at equal steps of a model's text.
fn last(text: &str, names: &[&str]) -> Vec<f64> {
    let mut simulation = start(text);
    run(&mut simulation, 0.01, 0.5, |_| {});
    names.iter().flat_map(|name| vector(&simulation, name).iter().copied().collect::<Vec<_>>()).collect()
}

/// A body that hangs on something.
fn hanging(what: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Hanging\"\ngravity = [0, 0, -9.81]\n\
         [body.bob]\nmass = 2\nposition = [0.5, 0, -0.25]\ninertia = [0.05, 0.06, 0.07]\n{what}\n\
         [output.at_bob]\nat = \"bob\"\nquantities = [\"position\", \"rotation\"]\n\
         [simulation]\nstop = 0.5\nstep = 1e-3\noutput_step = 0.01\n"
    )
}

const RESULTS: [&str; 2] = ["at_bob.position", "at_bob.rotation"];

/// The same mechanism written with `at`, with a frame that does not move, and with points gives the same bits: the
/// numbers are sums of powers of 2.
#[test]
fn points_replace_places_of_joints_and_fixed_frames() {
    let joint = "[joint.pin]\ntype = \"spherical\"\n";
    let at = last(&hanging(&format!("{joint}a = \"ground\"\nb = \"bob\"\nat = [0.25, 0.5, 0.5]\n")), &RESULTS);
    let eye = "[point.eye]\non = \"bob\"\noffset = [-0.25, 0.5, 0.75]\n";
    let hook = "[point.hook]\noffset = [0.25, 0.5, 0.5]\n";
    let by_points = [
        format!("{joint}a = \"ground\"\nb = \"eye\"\n{eye}"),
        format!("{joint}a = \"eye\"\nb = \"ground\"\n{eye}"),
        format!("{joint}a = \"bob\"\nb = \"hook\"\n{hook}"),
        format!("{joint}a = \"hook\"\nb = \"eye\"\n{hook}{eye}"),
    ];
    assert!((at[2] + 0.25).abs() > 0.01, "it swings: {at:?}");
    for other in by_points {
        // Sides that change places change the order of sums.
        let found = last(&hanging(&other), &RESULTS);
        let off = found.iter().zip(&at).map(|(found, at)| (found - at).abs()).fold(0.0, f64::max);
        assert!(off < 1e-10, "{other}: {off}");
    }
    let spring = "[spring.tie]\na = \"hook\"\nb = \"bob\"\nstiffness = 300\n";
    let frame = last(&hanging(&format!("{spring}[frame.hook]\nposition = [0.25, 0.5, 0.5]\n")), &RESULTS);
    assert_eq!(last(&hanging(&format!("{spring}{hook}")), &RESULTS), frame);
    let far = last(&hanging(&format!("{spring}[point.hook]\noffset = [0.25, 0.5, 0.75]\n")), &RESULTS);
    assert_ne!(far, frame);
}

/// Two bodies that turn far on a spring between points off their centers of mass: the largest change of the momenta,
/// and of the energy, J.
fn changes_of_a_pair(step: f64) -> [f64; 2] {
    let text = format!(
        "format = 1\n[model]\nname = \"Pair\"\n\
         [body.one]\nmass = 2\nposition = [0, 0, 0]\ninertia = [0.05, 0.06, 0.07]\nangular_velocity = [1, 2, 3]\n\
         [body.two]\nmass = 1\nposition = [1, 0, 0]\ninertia = [0.02, 0.03, 0.04]\nvelocity = [0, 3, 0]\n\
         [point.eye]\non = \"one\"\noffset = [0.2, 0.1, -0.1]\n[point.ear]\non = \"two\"\noffset = [-0.1, 0.2, 0.3]\n\
         [spring.tie]\na = \"eye\"\nb = \"ear\"\nstiffness = 200\n\
         [simulation]\nstop = 2\nstep = {step}\nspectral_radius = 1\ntolerance = 1e-12\n"
    );
    let mut simulation = start(&text);
    let linear = vector(&simulation, "momentum.linear");
    let angular = vector(&simulation, "momentum.angular");
    let energy = value(&simulation, "energy.total");
    let (mut changes, mut elastic) = ([0.0_f64; 2], 0.0_f64);
    run(&mut simulation, step, 2.0, |simulation| {
        elastic = elastic.max(value(simulation, "energy.elastic"));
        let by = [
            (vector(simulation, "momentum.linear") - linear).norm()
                + (vector(simulation, "momentum.angular") - angular).norm(),
            (value(simulation, "energy.total") - energy).abs(),
        ];
        changes = [0, 1].map(|k| changes[k].max(by[k]));
    });
    assert!(elastic > 0.05, "the spring is stretched: {elastic} J");
    changes
}

/// Momenta stay to round-off: both ends of the spring act along one line. The energy at the ends of steps swings by
/// what the projection of velocities leaves, which falls fast with the step; a force that were no gradient would make
/// it drift, and with twice the step by a factor of 4.
#[test]
fn springs_between_points_keep_energy_and_momenta() {
    let [coarse, fine] = [4e-3, 2e-3].map(changes_of_a_pair);
    println!("momenta {:.1e} {:.1e}, energy {:.1e} {:.1e} J", coarse[0], fine[0], coarse[1], fine[1]);
    assert!(coarse[0] < 1e-10 && fine[0] < 1e-10, "{coarse:?} {fine:?}");
    assert!(coarse[1] < 1e-5 && fine[1] < coarse[1] / 8.0, "{coarse:?} {fine:?}");
}

/// The example of the page on the model file runs as it says: the energy of the swinging plate is what gravity, the
/// wind and the dampers make of it, and the corner is half an edge away from the center in both directions.
#[test]
fn the_example_of_the_page_runs() {
    let page = include_str!("../../../docs/language/joints.md");
    let (_, rest) = page.split_once("## Points\n").expect("the section");
    let example = rest.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next()).expect("the example");
    let mut simulation = start(example);
    assert_eq!(vector(&simulation, "corner_motion.position"), Vec3::new(-0.2, 0.2, 0.0));
    run(&mut simulation, 0.01, 1.0, |_| {});
    assert!(vector(&simulation, "corner_motion.position").z < -0.1, "it swings down");
    assert!(ancf14::fmi::Model::take_warnings(&mut simulation).is_empty());
}

/// A number of a point is a parameter, its carrier a word that can be set.
#[test]
fn numbers_of_points_are_parameters() {
    let text = cantilever(
        "[parameters]\nh = 0.1\n[point.stub]\non = \"arm.node[2]\"\noffset = [0, \"h\", 0.05]\n\
         [load.push]\nat = \"stub\"\nforce = [0, 0, 1]\n",
    );
    let simulation = start(&text);
    // The component that is an expression is none, the parameter in it is.
    assert_eq!(value(&simulation, "stub.offset[3]"), 0.05);
    assert_eq!(value(&simulation, "h"), 0.1);
    let set = |key: &str, number: &str| [(key.to_owned(), number.to_owned())];
    for (key, number) in [("stub.offset[2]", "0.3"), ("h", "0.2"), ("stub.on", "arm.end")] {
        let outcome = ancf14::model::simulation::Simulation::load("m.toml", &text, &set(key, number));
        assert!(outcome.is_ok(), "{key}: {:?}", outcome.err().map(|failure| failure.message));
    }
}

/// A run with other meshes holds on to the same material place: the node of the carrier changes its number, and what
/// refers to the point does not change.
#[test]
fn other_meshes_keep_the_places_of_points() {
    let text = cantilever(
        "[point.stub]\non = \"arm.node[2]\"\noffset = [0, 0.1, 0.05]\n[load.push]\nat = \"stub\"\nforce = [0, 0, 1]\n\
         [spring.tie]\na = \"ground\"\nb = \"stub\"\nstiffness = 1\n",
    );
    let document = Document::parse("m.toml", &text, &[]).expect("sound");
    let overrides = Level::DoubleElements.overrides(&document).expect("such a run");
    let places: Vec<_> = overrides.iter().filter(|(_, text)| text.contains("node")).collect();
    assert_eq!(places, [&(String::from("point.stub.on"), String::from("arm.node[4]"))]);
    assert!(Document::parse("m.toml", &text, &overrides).is_ok());
}
