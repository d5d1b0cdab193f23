//! What tests of joints put together: the ground, a moving frame, bodies and beams at random, every kind of joint
//! between two of them, and the motions that a kind leaves free, from its definition.

use crate::random::Random;
use crate::support::machines::design;
use ancf14::math::jet::Jet;
use ancf14::math::vectors::{set_vec3, vec3};
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::coordinates::{P, R, THETA};
use ancf14::mechanics::beam::ancf24::coordinates as ancf24;
use ancf14::mechanics::beam::ancf24::law::Shear;
use ancf14::mechanics::beam::centerline::Centerline;
use ancf14::mechanics::beam::design::{BeamDesign, Elements};
use ancf14::mechanics::beam::material::Material;
use ancf14::mechanics::beam::node::Node;
use ancf14::mechanics::beam::section::Section;
use ancf14::mechanics::body::rigid_body::BodyDesign;
use ancf14::mechanics::constraint::cylindrical;
use ancf14::mechanics::constraint::inline;
use ancf14::mechanics::constraint::inplane;
use ancf14::mechanics::constraint::joint::Joint;
use ancf14::mechanics::constraint::primitive::Primitive;
use ancf14::mechanics::constraint::prismatic;
use ancf14::mechanics::constraint::revolute;
use ancf14::mechanics::constraint::spherical;
use ancf14::mechanics::constraint::universal;
use ancf14::mechanics::constraint::weld;
use ancf14::mechanics::force::spring::Spring;
use ancf14::mechanics::geometry::pose::{Pose, axis_place};
use ancf14::mechanics::input::guide::FrameGuide;
use ancf14::mechanics::input::signal::Signal;
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::marker::relative_coordinate::Measure;
use ancf14::mechanics::state::State;
use ancf14::mechanics::system::System;
use ancf14::mechanics::system::builder::SystemBuilder;
use ancf14::mechanics::system::frame_cache::FrameCache;
use std::sync::Arc;

/// A kind of joint and what it leaves free, in the axes of a: along which b may slide, about which it may turn.
pub struct Kind {
    pub name: &'static str,
    /// None: a bushing.
    pub primitives: Option<&'static [Primitive]>,
    pub slides: &'static [usize],
    pub turns: &'static [usize],
}

const fn kind(
    name: &'static str,
    primitives: &'static [Primitive],
    slides: &'static [usize],
    turns: &'static [usize],
) -> Kind {
    Kind { name, primitives: Some(primitives), slides, turns }
}

pub const KINDS: [Kind; 9] = [
    kind("weld", weld::PRIMITIVES, &[], &[]),
    kind("spherical", spherical::PRIMITIVES, &[], &[0, 1, 2]),
    kind("revolute", revolute::PRIMITIVES, &[], &[0]),
    kind("cylindrical", cylindrical::PRIMITIVES, &[0], &[0]),
    kind("prismatic", prismatic::PRIMITIVES, &[0], &[]),
    kind("universal", universal::PRIMITIVES, &[], &[0, 1]),
    kind("inline", inline::PRIMITIVES, &[0], &[0, 1, 2]),
    kind("inplane", inplane::PRIMITIVES, &[1, 2], &[0, 1, 2]),
    Kind { name: "bushing", primitives: None, slides: &[0, 1, 2], turns: &[0, 1, 2] },
];

/// What a joint holds on to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Ground,
    /// It moves with [`FRAME_VELOCITY`] and does not turn.
    Frame,
    Body,
    /// One of the three nodes of a beam.
    Beam,
    /// The same, of ANCF24.
    Ancf24,
}

impl Part {
    pub fn is_beam(self) -> bool {
        matches!(self, Self::Beam | Self::Ancf24)
    }
}

pub const FRAME_VELOCITY: Vec3 = Vec3::new(0.7, -0.4, 0.5);

/// A rigid motion: velocity at a place, and angular velocity.
#[derive(Clone, Copy, Debug)]
pub struct Twist {
    pub place: Vec3,
    pub linear: Vec3,
    pub angular: Vec3,
}

impl Twist {
    pub fn at(&self, point: &Vec3) -> Vec3 {
        self.linear + self.angular.cross(&(point - self.place))
    }

    fn plus(&self, other: &Self) -> Self {
        Self { place: self.place, linear: self.linear + other.at(&self.place), angular: self.angular + other.angular }
    }

    fn minus(&self) -> Self {
        Self { place: self.place, linear: -self.linear, angular: -self.angular }
    }
}

impl Kind {
    /// The motions of b against a that it leaves free, at the poses of its two sides.
    pub fn free(&self, a: &Pose, b: &Pose) -> Vec<Twist> {
        let (none, place) = (Vec3::zeros(), b.place);
        let slides = self.slides.iter().map(|axis| Twist { place, linear: a.axis(*axis), angular: none });
        let turns = self.turns.iter().map(|axis| {
            // The second axis of a universal joint is fixed in b.
            let second = self.name == "universal" && *axis == 1;
            let angular = if second { b.axis(1) } else { a.axis(*axis) };
            Twist { place, linear: none, angular }
        });
        slides.chain(turns).collect()
    }
}

/// An asymmetric body whose axes, inertia and directors have three different orientations.
pub fn body(name: &str, random: &mut Random) -> BodyDesign {
    let turn = random.rotation();
    BodyDesign {
        name: name.into(),
        mass: 1.5 + 0.5 * random.signed(),
        position: random.vector(),
        inertia: turn * Mat3::from_diagonal(&Vec3::new(0.1, 0.15, 0.2)) * turn.transpose(),
        axes: random.rotation(),
        velocity: Vec3::zeros(),
        angular_velocity: Vec3::zeros(),
    }
}

/// A soft beam of 0.8 m.
pub fn beam(name: &str, random: &mut Random) -> BeamDesign {
    let from = random.vector();
    let to = from + random.direction() * 0.8;
    let material = Material { young: 2e8, shear: 8e7, density: 1000.0, damping: 0.0 };
    let section = Section::rectangle(0.04, 0.06);
    BeamDesign {
        line: Centerline::straight(from, to, 2),
        y_axis: random.direction(),
        material,
        section,
        ..design(name, 2)
    }
}

/// Adds a part that moves by `twist`; returns what to tie to.
fn add(builder: &mut SystemBuilder, name: &str, part: Part, twist: &Twist, random: &mut Random) -> Marker {
    match part {
        Part::Ground => Marker::Ground(Pose::default()),
        Part::Frame => {
            let (start, turn) = (random.vector(), random.vector());
            let place = [0, 1, 2].map(|i| {
                let (start, first) = (start[i], FRAME_VELOCITY[i]);
                Signal::Function(Arc::new(move |time| Jet { value: start + first * time, first, second: 0.0 }))
            });
            let rotation = [0, 1, 2].map(|i| Signal::Constant(turn[i]));
            let frame = builder.add_frame(name, FrameGuide::Signals { place, rotation }, Pose::default());
            builder.frame(frame)
        }
        Part::Body => {
            let still = body(name, random);
            let velocity = twist.at(&still.position);
            let body = builder.add_body(&BodyDesign { velocity, angular_velocity: twist.angular, ..still });
            builder.body(body)
        }
        Part::Beam | Part::Ancf24 => {
            let mut still = beam(name, random);
            if part == Part::Ancf24 {
                still.elements = Elements::Ancf24 { poisson: false, shear: Shear::Section };
            }
            let velocity = twist.at(&still.line.nodes[0].place);
            let beam = builder.add_beam(&BeamDesign { velocity, angular_velocity: twist.angular, ..still });
            let node = ((random.signed() + 1.0) * 1.5).floor();
            builder.section_at(beam, 0.5 * node)
        }
    }
}

/// Adds a joint of `primitives` between what `a` and `b` are tied to, at `pose` as drawn.
pub fn connect(
    builder: &mut SystemBuilder,
    name: &str,
    sides: [Marker; 2],
    pose: &Pose,
    primitives: &'static [Primitive],
) {
    let [a, b] = sides.map(|side| builder.tied(&side, pose));
    builder.add_joint(Joint {
        name: format!("joint {name}"),
        a,
        b,
        primitives,
        drive: None,
        gear: None,
        slide: None,
        holding: None,
    });
}

/// Adds the six springs and dampers of a bushing between two markers: against displacement and turning.
pub fn cushion(
    builder: &mut SystemBuilder,
    [a, b]: [Marker; 2],
    stiffness: [f64; 3],
    rotational: [f64; 3],
    damping_time: f64,
) {
    let measures = [0, 1, 2].map(Measure::Distance).into_iter().chain([0, 1, 2].map(Measure::Rotation));
    for (measure, stiffness) in measures.zip(stiffness.into_iter().chain(rotational)) {
        let coordinate = builder.add_relative_coordinate(a, b, measure);
        let damping = stiffness * damping_time;
        let name = String::from("cushion");
        builder.add_spring(Spring {
            name,
            coordinate,
            stiffness,
            damping,
            rest: 0.0,
            mobility: 0.0,
            law: None,
            memory: None,
        });
    }
}

/// Two parts hung on each other at random pose, offset and axes, moving as the joint allows; its sides.
pub struct Pair {
    pub system: System,
    pub state: State,
    pub sides: [Marker; 2],
}

impl Pair {
    /// Beams come first: coordinates are in this order.
    pub fn new(random: &mut Random, parts: [Part; 2], kind: &Kind) -> Self {
        let mut builder = SystemBuilder::default();
        let pose = Pose { place: random.vector(), axes: random.rotation() };
        let place = pose.place;
        let free = kind.free(&pose, &pose);
        let still = Twist { place, linear: Vec3::zeros(), angular: Vec3::zeros() };
        let relative = free.into_iter().fold(still, |sum, motion| {
            let speed = 2.0 + random.signed();
            sum.plus(&Twist { place, linear: motion.linear * speed * 0.3, angular: motion.angular * speed })
        });
        let common = match parts {
            [Part::Ground, _] | [_, Part::Ground] => still,
            [Part::Frame, _] | [_, Part::Frame] => Twist { linear: FRAME_VELOCITY, ..still },
            _ => Twist { place, linear: random.vector(), angular: random.direction() * 2.0 },
        };
        let held = |part: Part| matches!(part, Part::Ground | Part::Frame);
        // The side that is not held moves against the other one.
        let twists = match held(parts[1]) {
            true => [common.plus(&relative.minus()), common],
            false => [common, common.plus(&relative)],
        };
        let mut sides = [Marker::Ground(Pose::default()); 2];
        for beams in [true, false] {
            for side in [0, 1] {
                if parts[side].is_beam() == beams {
                    let name = ["first", "second"][side];
                    sides[side] = add(&mut builder, name, parts[side], &twists[side], random);
                }
            }
        }
        let sides = sides.map(|side| builder.tied(&side, &pose));
        match kind.primitives {
            Some(primitives) => connect(&mut builder, kind.name, sides, &pose, primitives),
            None => cushion(&mut builder, sides, [200.0, 400.0, 700.0], [10.0, 16.0, 25.0], 0.0),
        }
        let gravity = if parts.into_iter().any(held) { Vec3::new(1.0, -2.0, -9.0) } else { Vec3::zeros() };
        let (system, state) = builder.finish(gravity);
        Self { system, state, sides }
    }
}

/// Velocities of all coordinates of what a marker is tied to when it moves by `twist`.
pub fn coordinate_velocity(system: &System, state: &State, marker: &Marker, twist: &Twist) -> Vec<f64> {
    let mut velocity = vec![0.0; state.q.len()];
    match marker {
        Marker::Body { start, .. } => {
            set_vec3(&mut velocity, *start, &twist.at(&vec3(&state.q, *start)));
            for axis in 0..3 {
                let place = start + axis_place(axis);
                set_vec3(&mut velocity, place, &twist.angular.cross(&vec3(&state.q, place)));
            }
        }
        Marker::Node { node, .. } => {
            let start = marker.coordinates(&system.mesh).start;
            let mut turn = |place: usize| set_vec3(&mut velocity, place, &twist.angular.cross(&vec3(&state.q, place)));
            turn(start + P);
            match system.mesh.nodes[*node] {
                Node::Ancf14 { .. } => {
                    velocity[start + THETA] = twist.angular.dot(&vec3(&state.q, start + P).normalize());
                }
                Node::Ancf24 { .. } => [ancf24::Y, ancf24::Z].into_iter().for_each(|place| turn(start + place)),
            }
            set_vec3(&mut velocity, start + R, &twist.at(&vec3(&state.q, start + R)));
        }
        _ => {}
    }
    velocity
}

/// The largest violation of a condition, m or 1.
pub fn gap(system: &System, state: &State) -> f64 {
    let mut snapshot = FrameCache::default();
    let mut g = vec![0.0; system.constraints()];
    system.constraint_conditions(&snapshot.of(system, state), &mut g);
    g.iter().fold(0.0, |gap, value| f64::max(gap, value.abs()))
}
