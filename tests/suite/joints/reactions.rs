//! Reactions must be the forces of Newton's and Euler's laws: of a body in general motion under gravity, loads,
//! springs, a bushing, joints and a drive, `m a` is the sum of all forces, and the derivative of its angular momentum
//! the sum of all moments, to round-off. A wrong sign, a moment about the wrong place, a forgotten part shows in full.
//! The multipliers that a step finds belong to its middle: they must come to those of the instant as the step shrinks.

use crate::random::Random;
use crate::running::{run, start, vector};
use crate::support::parts::{KINDS, Pair, Part, beam, body, connect};
use ancf14::math::Vec3;
use ancf14::math::vectors::vec3;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::geometry::pose::{Pose, axis_place};
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::marker::configuration::Passage;
use ancf14::mechanics::output::joint_loads::JointLoads;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use ancf14::mechanics::system::joint_parts::JointParts;
use ancf14::solve::dynamics::midpoint::Midpoint;
use ancf14::solve::dynamics::start;
use ancf14::solve::step::integrator::Integrator;
use ancf14::solve::step::response::{Responder, Response};

fn respond(system: &System, state: &State) -> Response {
    let mut response = Response::default();
    Responder::new(system).respond(system, state, &mut response).unwrap();
    response
}

/// Force and moment about the center of mass that body `number` needs for its acceleration.
fn needed(system: &System, state: &State, response: &Response, number: usize) -> (Vec3, Vec3) {
    let body = &system.bodies[number];
    let acceleration = |place: usize| vec3(&response.acceleration, body.start + place);
    let moment = (0..3).map(|axis| {
        let place = axis_place(axis);
        vec3(&state.q, body.start + place).cross(&acceleration(place)) * body.director_inertia[axis]
    });
    (acceleration(0) * body.mass, moment.sum())
}

/// `block` is b of two joints and of the drive, a of a bushing and of a joint, and carries a spring, a force and a
/// follower moment.
const BLOCK: &str = r#"
format = 1
[model]
name = "Block"
gravity = [1, -2, -9]

[material.soft]
young = 2e9
poisson = 0.3
density = 2000
damping = 1e-4

[section.bar]
shape = "rectangle"
width = 0.02
height = 0.03

[beam.arm]
material = "soft"
section = "bar"
from = [0, 0, 0]
to = [0.6, 0.2, 0.1]
elements = 3

[body.block]
mass = 1.7
position = [0.8, 0.4, 0.1]
inertia = [0.05, 0.07, 0.09, 0.004, -0.006, 0.008]
axes = [[0.6, 0.8, 0], [-0.8, 0.6, 0], [0, 0, 1]]
angular_velocity = [1, 2, -1]

[body.tail]
mass = 0.9
position = [1.3, 0.1, 0.4]
inertia = [0.02, 0.03, 0.04]

[frame.hand]
position = ["0.1*sin(3*t)", 0.9, "0.4 + 0.05*t"]
rotation = [0, "0.2*t", "0.3*sin(2*t)"]

[joint.root]
type = "weld"
a = "ground"
b = "arm.start"

[joint.wrist]
type = "revolute"
a = "arm.end"
b = "block"
at = [0.7, 0.25, 0.15]
axis = [0.3, 1, -0.5]
stiffness = 4.0
damping = 0.2

[joint.tow]
type = "inplane"
a = "hand"
b = "block"
at = [0.6, 0.7, 0.2]
axis = [0.2, 1, 0.4]

[joint.hook]
type = "universal"
a = "block"
b = "tail"
at = [1.0, 0.3, 0.2]
axis = [1, 0, 0]
axis2 = [0, 0, 1]

[joint.pad]
type = "bushing"
a = "block"
b = "tail"
at = [1.1, 0.2, 0.3]
stiffness = [30, 50, 70]
damping = [0.3, 0.5, 0.7]
rotational_stiffness = [1, 2, 3]
rotational_damping = [0.01, 0.02, 0.03]

[drive.turn]
joint = "wrist"
coordinate = "angle"
rate = "2*sin(4*t)"

[spring.tie]
a = "hand"
b = "block"
stiffness = 60
damping = 1.5
length = 0.4

[load.push]
at = "block"
force = ["3*cos(5*t)", -2, "t"]
moment = [0.1, 0.2, "0.3*t"]
follower = true

[load.pull]
at = "block"
force = [1, "2*t", 3]
moment = ["0.2*t", 0.1, -0.1]

[output.place]
at = "block"
quantities = ["acceleration", "angular_velocity"]

[simulation]
stop = 1
step = 1e-3
output_step = 1e-2
"#;

#[test]
fn reactions_are_what_newton_and_euler_demand() {
    let mut simulation = start(BLOCK);
    let mut worst = [0.0_f64; 2];
    let mut check = |system: &System, state: &State| {
        let response = respond(system, state);
        let mut snapshot = FrameCache::default();
        let c = snapshot.of(system, state);
        let passage = Passage::with_velocity(&state.velocity);
        let loads = JointLoads::new((system, state), (&c, &passage), &response.multipliers);
        let center = vec3(&state.q, system.bodies[0].start);
        let own = system.bodies[0].start;
        let is_own = |marker: &Marker| matches!(marker, Marker::Body { start, .. } if *start == own);
        let (mut force, mut moment) = (system.gravity * system.bodies[0].mass, Vec3::zeros());
        let (mut size, mut moment_size) = (force.norm(), 0.0_f64);
        let mut add = |place: Vec3, own_force: Vec3, own_moment: Vec3| {
            force += own_force;
            moment += own_moment + (place - center).cross(&own_force);
            size = size.max(own_force.norm());
            moment_size = moment_size.max(own_moment.norm() + (place - center).cross(&own_force).norm());
        };
        let mut seen = 0;
        for parts in &system.joint_parts {
            let (on_b, about_b) = loads.reaction(parts);
            let (a, b) = match parts.joint {
                Some(joint) => (system.joints[joint].a, system.joints[joint].b),
                None => {
                    let coordinate = &system.relative_coordinates[system.springs[parts.springs[0]].coordinate];
                    (coordinate.a, coordinate.b)
                }
            };
            // What b receives acts at b's place; a gets the opposite at the same place.
            let place = b.pose(&c).place;
            if is_own(&b) {
                add(place, on_b, about_b);
                seen += 1;
            }
            if is_own(&a) {
                add(place, -on_b, -about_b);
                seen += 1;
            }
        }
        assert_eq!(seen, 4);
        // The spring between two points: a pull towards the other end.
        let tie = &system.springs[0];
        let (a, b) = (
            system.relative_coordinates[tie.coordinate].a.pose(&c).place,
            system.relative_coordinates[tie.coordinate].b.pose(&c).place,
        );
        let tension = tie.tension(&system.relative_coordinates[tie.coordinate], &c, &passage);
        add(b, (a - b).normalize() * tension, Vec3::zeros());
        let axes = system.bodies[0].marker().pose(&c).axes;
        for (number, turn) in [axes, ancf14::math::Mat3::identity()].into_iter().enumerate() {
            let wrench = system.loads[number].at(state.time, &state.targets.loads[number]);
            add(center, turn * wrench.force, turn * wrench.moment);
        }
        let (force_needed, moment_needed) = needed(system, state, &response, 0);
        worst[0] = worst[0].max((force - force_needed).norm() / size);
        worst[1] = worst[1].max((moment - moment_needed).norm() / moment_size);
    };
    check(simulation.system(), simulation.state());
    run(&mut simulation, 1e-2, 0.5, |simulation| check(simulation.system(), simulation.state()));
    println!("Newton {:.1e}, Euler {:.1e} of the largest part", worst[0], worst[1]);
    // Round-off through a matrix whose entries differ by the inertia of slopes against that of the body: 1e4.
    assert!(worst[0] < 1e-9 && worst[1] < 1e-9, "{worst:?}");
}

/// The joint of a body that hangs still bears its weight, at every place in the file: its number counts past the
/// rigidity of bodies.
#[test]
fn regression_reactions_of_joints_of_bodies() {
    let body = |name: &str, mass: f64, x: f64| {
        format!("[body.{name}]\nmass = {mass}\nposition = [{x}, 0, 0]\ninertia = [0.1, 0.1, 0.1]\n")
    };
    let joint = |name: &str, a: &str, b: &str, x: f64| {
        format!("[joint.{name}]\ntype = \"weld\"\na = \"{a}\"\nb = \"{b}\"\nat = [{x}, 0, 0]\n")
    };
    let output = |joint: &str| {
        format!("[output.on_{joint}]\nat = \"{joint}\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n")
    };
    let text = [
        String::from("format = 1\n[model]\nname = \"Hung\"\ngravity = [0, 0, -10]\n"),
        body("first", 2.0, 1.0) + &body("second", 3.0, 3.0),
        joint("inner", "ground", "first", 0.0) + &joint("outer", "first", "second", 2.0),
        output("inner") + &output("outer"),
        String::from("[simulation]\nstop = 1\nstep = 0.1\noutput_step = 0.1\n"),
    ]
    .concat();
    for text in [text.clone(), text.replace("stop = 1", "stop = 1\nanalysis = \"static\"")] {
        let simulation = start(&text);
        for (name, force, moment) in [("on_inner", 50.0, -110.0), ("on_outer", 30.0, -30.0)] {
            let found = vector(&simulation, &format!("{name}.reaction_force"));
            assert!((found - Vec3::z() * force).norm() < 1e-10, "{name}: {found}");
            let found = vector(&simulation, &format!("{name}.reaction_moment"));
            assert!((found - Vec3::y() * moment).norm() < 1e-10, "{name}: {found}");
        }
    }
}

/// Every kind of joint, alone: what a receives is what b receives, and each part obeys Newton and Euler with it alone.
#[test]
fn every_kind_of_joint_acts_and_reacts() {
    let mut random = Random(121);
    for kind in &KINDS {
        let Pair { system, mut state, sides } = Pair::new(&mut random, [Part::Body, Part::Body], kind);
        let parts = JointParts {
            joint: kind.primitives.map(|_| 0),
            springs: if kind.primitives.is_some() { Vec::new() } else { (0..6).collect() },
            ..JointParts::default()
        };
        crate::support::machines::integrate(&system, &mut state, 1.0, (2e-3, 100), |_| {}).unwrap();
        let response = respond(&system, &state);
        let mut snapshot = FrameCache::default();
        let c = snapshot.of(&system, &state);
        let passage = Passage::with_velocity(&state.velocity);
        let loads = JointLoads::new((&system, &state), (&c, &passage), &response.multipliers);
        let (force, moment) = loads.reaction(&parts);
        let place = sides[1].pose(&c).place;
        for (number, sign) in [(0, -1.0), (1, 1.0)] {
            let (needed_force, needed_moment) = needed(&system, &state, &response, number);
            let arm = place - vec3(&state.q, system.bodies[number].start);
            let about_center = (moment + arm.cross(&force)) * sign;
            let errors = [(needed_force - force * sign).norm(), (needed_moment - about_center).norm()];
            let size = f64::max(force.norm(), moment.norm());
            assert!(size > 1e-2, "{}: nothing acts", kind.name);
            assert!(
                errors[0] < 1e-12 * size.max(1.0) && errors[1] < 1e-12 * size.max(1.0),
                "{}: {errors:?}",
                kind.name
            );
        }
    }
}

/// Largest difference between the multipliers of steps and the mean of those of the instants where these begin and end,
/// relative: they belong to the middle of the step. Of order 1, not 2: what the projection takes out of the momentum
/// after a step, of second order, the multipliers of the next step no longer have to.
fn multiplier_error(system: &System, start: &State, step: f64, count: u32) -> f64 {
    let mut state = start.clone();
    let mut midpoint = Midpoint::new(system, 1.0, 1.0, 1e-10);
    start::set_motion(system, &mut midpoint, &mut state).unwrap();
    let (mut error, mut size) = (0.0_f64, 0.0_f64);
    let mut before = respond(system, &state).multipliers;
    for number in 1..=count {
        midpoint.step(system, &mut state, step, f64::from(number) * step).unwrap();
        let after = respond(system, &state).multipliers;
        for (found, (before, after)) in state.multipliers.iter().zip(before.iter().zip(&after)) {
            let expected = 0.5 * (before + after);
            error = error.max((found - expected).abs());
            size = size.max(expected.abs());
        }
        before = after;
    }
    error / size
}

fn order(what: &str, system: &System, state: &State, step: f64, duration: f64) -> ([f64; 2], f64) {
    let errors = [step, 0.5 * step].map(|step| multiplier_error(system, state, step, (duration / step).round() as u32));
    let order = (errors[0] / errors[1]).log2();
    println!("{what}: multipliers off by {:.2e}, {:.2e}, order {order:.2}", errors[0], errors[1]);
    (errors, order)
}

#[test]
fn multipliers_of_steps_come_to_those_of_instants() {
    let mut random = Random(122);
    let mut builder = SystemBuilder::default();
    let mut design = |name: &str| body(name, &mut random);
    let (first, second) = (design("first"), design("second"));
    let bodies = [first, second].map(|design| builder.add_body(&design)).map(|body| builder.body(body));
    let mut pose = || Pose { place: random.vector(), axes: random.rotation() };
    connect(&mut builder, "hook", [Marker::Ground(Pose::default()), bodies[0]], &pose(), revolute::PRIMITIVES);
    connect(&mut builder, "elbow", bodies, &pose(), spherical::PRIMITIVES);
    let (system, state) = builder.finish(Vec3::new(1.0, -2.0, -9.0));
    let (errors, order) = order("two bodies", &system, &state, 2e-3, 0.4);
    assert!(errors[1] < 1e-3 && order > 0.8, "{errors:?}");
}

/// On a beam that is set in motion by its own sudden weight the multipliers of steps follow those of the instants as
/// well, although the step is far from resolving its axial vibration (up to 1e4 rad/s).
#[test]
fn multipliers_on_beams() {
    let mut random = Random(123);
    let mut builder = SystemBuilder::default();
    let design = beam("arm", &mut random);
    let arm = builder.add_beam(&design);
    let [start, end] = [0.0, 1.0].map(|fraction| builder.section_at(arm, fraction));
    let block = builder.add_body(&body("block", &mut random));
    let block = builder.body(block);
    let axes = random.rotation();
    let root = Pose { place: design.line.nodes[0].place, axes };
    let tip = Pose { place: design.line.place(1.0), axes };
    connect(&mut builder, "root", [Marker::Ground(Pose::default()), start], &root, weld::PRIMITIVES);
    connect(&mut builder, "wrist", [end, block], &tip, revolute::PRIMITIVES);
    let (system, state) = builder.finish(Vec3::new(1.0, -2.0, -9.0));
    for step in [2e-3, 5e-4, 1.25e-4] {
        let (errors, order) = order(&format!("h = {step}"), &system, &state, step, 0.03);
        assert!(errors[1] < 1e-3 && order > 0.8, "{errors:?}");
    }
}
