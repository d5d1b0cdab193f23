//! Steady rotation about a fixed axis: `v = ω × (r − r₀)` and `a = ω × (ω × (r − r₀))` of positions, `ω × d` and
//! `ω × (ω × d)` of slopes and directors, the spin `ω·t` of sections about their tangents, and no acceleration of it.

use super::System;
use super::frame_cache::FrameCache;
use super::variation::follow;
use crate::math::blocks::{Block, Blocks};
use crate::math::rotation::rotation_matrix;
use crate::math::vectors::{set_vec3, vec3};
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::ancf14::coordinates::{P, THETA};
use crate::mechanics::beam::node::Node;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::constraint::joint::{Joint, JointGradient};
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::state::State;
use std::ops::Range;

/// Rates under a rotation by 1 rad/s that are none: of lengths over the system's size, 1/s.
const ALLOWED: f64 = 1e-6;
/// Numbers of a vector.
const VECTOR: usize = 3;

/// Gravity beside the axis by more than this share of it turns with respect to the mechanism.
const ALONG: f64 = 1e-9;

/// Why a drive turns nothing steadily.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoRotation {
    /// It prescribes no angle.
    NotAnAngle,
    /// Joints hold what it turns to what it turns against.
    Held,
}

/// A vector among the coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Vector {
    first: usize,
    is_position: bool,
    turns: bool,
}

/// A rotation of a part of a system about a fixed axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Rotation {
    /// Direction of the axis.
    pub axis: Vec3,
    /// A point of the axis, m.
    pub center: Vec3,
    /// Angular velocity about the axis, the rate of the drive, rad/s.
    pub speed: f64,
    drive: usize,
    /// All vectors, by their first coordinates.
    vectors: Vec<Vector>,
    /// First coordinates of the nodes that have a twist angle and turn.
    twisted: Vec<usize>,
    /// Whether the node of each frame turns.
    frames: Vec<bool>,
}

impl NoRotation {
    /// Why the drive `name` turns nothing steadily, in a sentence.
    pub fn of_drive(self, name: &str) -> String {
        match self {
            Self::NotAnAngle => format!(
                "drive {name} does not prescribe an angle, and a steady rotation needs one; name a drive with \
                 coordinate = \"angle\""
            ),
            Self::Held => format!(
                "drive {name} does not turn the mechanism as a whole: joints hold its part to the ground, or let it \
                 turn about another axis only"
            ),
        }
    }
}

impl System {
    /// The parts that move as a whole: 0 is the ground with all frames, then come beams and bodies.
    fn part_of(&self, marker: &Marker) -> usize {
        let beam =
            |contains: &dyn Fn(&Beam) -> bool| self.beams.iter().position(contains).map_or(0, |number| number + 1);
        match *marker {
            Marker::Ground(_) | Marker::Frame { .. } => 0,
            Marker::Node { node, .. } => beam(&|beam| beam.node_range().contains(&node)),
            Marker::Section { element, .. } => beam(&|beam| beam.element_range().contains(&element)),
            Marker::Body { start, .. } => {
                let body = self.bodies.iter().position(|body| body.start == start);
                body.map_or(0, |number| number + 1 + self.beams.len())
            }
        }
    }

    /// The first coordinate of the vector that coordinate `index` belongs to; none: it is a twist angle.
    pub fn vector_of(&self, index: usize) -> Option<usize> {
        let nodes = self.mesh.coordinates();
        let (start, is_twisted) = if index < nodes {
            let node = self.mesh.nodes[self.mesh.node_of(index)];
            (node.coordinates().start, matches!(node, Node::Ancf14 { .. }))
        } else {
            (nodes + (index - nodes) / BODY * BODY, false)
        };
        let local = index - start;
        (!is_twisted || local != THETA).then_some(start + local / VECTOR * VECTOR)
    }

    /// A kind of part that steady rotations do not take into account; none: it has none.
    pub fn part_against_steady_rotation(&self) -> Option<&'static str> {
        let parts = [
            (!self.winches.is_empty(), "a winch"),
            (self.is_in_fluid(), "water or air"),
            (!self.foundations.is_empty(), "a foundation"),
            (!self.ropes.is_empty(), "a rope over sheaves"),
        ];
        parts.into_iter().find_map(|(is_there, what)| is_there.then_some(what))
    }

    /// The gravity across the axis of `rotation`, m/s²: it turns with respect to what rotates. None: gravity is along
    /// the axis.
    pub fn gravity_across(&self, rotation: &Rotation) -> Option<f64> {
        let across = self.gravity.cross(&rotation.axis).norm();
        (across > ALONG * self.gravity.norm()).then_some(across)
    }

    /// The rotation with `speed` rad/s that drive `drive` makes of what it turns, at `state`.
    ///
    /// # Errors
    /// It prescribes no angle, or joints hold what it turns.
    pub fn rotation(&self, state: &State, drive: usize, speed: f64) -> Result<Rotation, NoRotation> {
        let driven = self.drives[drive].coordinate.map(|number| &self.relative_coordinates[number]);
        let driven = driven.filter(|own| matches!(own.measure, Measure::Angle(_)));
        let Some(driven) = driven else { return Err(NoRotation::NotAnAngle) };
        let mut turning = state.clone();
        turning.prescribed.stop();
        turning.prescribed.drives[drive].first = 1.0;
        let mut frames = FrameCache::default();
        let c = frames.of(self, &turning);
        let against = driven.a.pose(&c);
        let axis = if let Measure::Angle(axis) = driven.measure { against.axis(axis) } else { against.axis(0) };
        let [from, to] = [&driven.a, &driven.b].map(|side| self.part_of(side));
        // The ground stands, on whichever side it is.
        let (axis, stands, mover) = if to == 0 { (-axis, to, from) } else { (axis, from, to) };
        let everything = self.turned_parts((axis, against.place), drive, &|_| true);
        let velocity = everything.velocity(&c);
        let turns = self.turning_parts(&c, &velocity, [stands, mover]).ok_or(NoRotation::Held)?;
        let found = self.turned_parts((axis, against.place), drive, &|part| turns[part]);
        Ok(Rotation { speed, ..found })
    }

    /// The rotation by 1 rad/s of the parts that `turns` picks.
    fn turned_parts(&self, (axis, center): (Vec3, Vec3), drive: usize, turns: &dyn Fn(usize) -> bool) -> Rotation {
        let (mut vectors, mut twisted, mut frames) = (Vec::new(), Vec::new(), Vec::new());
        let mut push = |start: usize, count: usize, turns: bool| {
            let own = (0..count).map(|number| (start + VECTOR * number, number == 0));
            vectors.extend(own.map(|(first, is_position)| Vector { first, is_position, turns }));
        };
        for (number, node) in self.mesh.nodes.iter().enumerate() {
            let turns =
                turns(self.part_of(&Marker::Node { node: number, offset: Vec3::zeros(), axes: Mat3::identity() }));
            let Range { start, end } = node.coordinates();
            push(start, (end - start) / VECTOR, turns);
            if let Node::Ancf14 { start, frame } = *node {
                frames.resize(frames.len().max(frame + 1), false);
                frames[frame] = turns;
                twisted.extend(turns.then_some(start));
            }
        }
        for (number, body) in self.bodies.iter().enumerate() {
            push(body.start, BODY / VECTOR, turns(number + 1 + self.beams.len()));
        }
        Rotation { axis, center, speed: 1.0, drive, vectors, twisted, frames }
    }

    /// Whether each part turns with part `mover` while part `stands` and the ground stand; `velocity` is that of a
    /// rotation of everything. None: joints hold both together.
    fn turning_parts(&self, c: &Configuration, velocity: &[f64], [stands, mover]: [usize; 2]) -> Option<Vec<bool>> {
        let mut groups: Vec<usize> = (0..=self.beams.len() + self.bodies.len()).collect();
        let mut loose = Vec::new();
        for joint in self.joints.iter().filter(|joint| joint.gear.is_none() && !joint.is_released(c)) {
            let pair = [&joint.a, &joint.b].map(|side| self.part_of(side));
            if pair[0] == pair[1] {
                continue;
            }
            if self.lets_turn(c, velocity, joint) {
                loose.push(pair);
            } else {
                let [one, other] = pair.map(|part| groups[part]);
                groups.iter_mut().filter(|own| **own == one.max(other)).for_each(|own| *own = one.min(other));
            }
        }
        let mut turns = vec![None; groups.len()];
        turns[groups[0]] = Some(false);
        turns[groups[stands]] = Some(false);
        if turns[groups[mover]].replace(true).is_some() {
            return None;
        }
        // Springs that a rotation of one side alone would stretch, then bearings.
        let springs = self.springs.iter().filter(|spring| !spring.is_idle()).map(|spring| spring.coordinate);
        let springs = springs.filter(|coordinate| {
            let sides = self.sides(*coordinate).map(|side| side.coordinates(&self.mesh));
            sides.into_iter().filter(|side| !side.is_empty()).all(|side| {
                let rate = self.relative_coordinates[*coordinate].rate(c, &only(velocity, side));
                rate.abs() > ALLOWED * self.size.max(1.0)
            })
        });
        let springs = springs.map(|coordinate| self.sides(coordinate).map(|side| self.part_of(side))).collect();
        for pairs in [springs, loose] {
            for _ in 0..groups.len() {
                for pair in &pairs {
                    let [one, other] = pair.map(|part: usize| groups[part]);
                    match (turns[one], turns[other]) {
                        (None, Some(own)) => turns[one] = Some(own),
                        (Some(own), None) => turns[other] = Some(own),
                        _ => {}
                    }
                }
            }
        }
        Some(groups.iter().map(|group| turns[*group] == Some(true)).collect())
    }

    /// Whether `joint` allows one of its sides to turn while the other one stands.
    fn lets_turn(&self, c: &Configuration, velocity: &[f64], joint: &Joint) -> bool {
        let mut gradient = JointGradient::default();
        joint.phi_q(c, &mut gradient);
        // The ground has no coordinates: whether it holds the other side is a matter of that side.
        let sides = [&joint.a, &joint.b].map(|side| side.coordinates(&self.mesh)).into_iter();
        sides.filter(|side| !side.is_empty()).any(|side| {
            let mut rates = vec![0.0; joint.rows()];
            joint.phi_t(c, &mut rates);
            self.add_joint_rates(joint, &gradient, &only(velocity, side), &mut rates);
            rates.iter().all(|rate| rate.abs() <= ALLOWED * self.size.max(1.0))
        })
    }
}

/// The values of `range` among zeros.
fn only(values: &[f64], range: Range<usize>) -> Vec<f64> {
    let mut own = vec![0.0; values.len()];
    own[range.clone()].copy_from_slice(&values[range]);
    own
}

impl Rotation {
    /// The same with another speed, rad/s.
    #[must_use]
    pub fn with_speed(&self, speed: f64) -> Self {
        Self { speed, ..self.clone() }
    }

    /// The angular velocity, rad/s.
    fn spin(&self) -> Vec3 {
        self.axis * self.speed
    }

    /// Sets velocities of coordinates and of the drive in `state`.
    pub fn set_motion(&self, system: &System, state: &mut State) {
        state.prescribed.stop();
        state.prescribed.drives[self.drive].first = self.speed;
        let mut frames = FrameCache::default();
        state.velocity = self.velocity(&frames.of(system, state));
        system.set_momentum(state);
    }

    /// The velocities of all coordinates.
    fn velocity(&self, c: &Configuration) -> Vec<f64> {
        let spin = self.spin();
        let mut velocity = vec![0.0; c.beams.q.len()];
        for own in self.vectors.iter().filter(|own| own.turns) {
            set_vec3(&mut velocity, own.first, &spin.cross(&self.arm(*own, c.beams.q)));
        }
        for start in &self.twisted {
            velocity[start + THETA] = spin.dot(&vec3(c.beams.q, start + P).normalize());
        }
        velocity
    }

    fn arm(&self, own: Vector, q: &[f64]) -> Vec3 {
        let vector = vec3(q, own.first);
        if own.is_position { vector - self.center } else { vector }
    }

    /// The accelerations of all coordinates at `q`.
    pub fn acceleration(&self, q: &[f64]) -> Vec<f64> {
        let spin = self.spin();
        let mut acceleration = vec![0.0; q.len()];
        for own in self.vectors.iter().filter(|own| own.turns) {
            set_vec3(&mut acceleration, own.first, &spin.cross(&spin.cross(&self.arm(*own, q))));
        }
        acceleration
    }

    /// `ω × x` of all vectors of `values`, those that stand too: by what they change in a frame that turns, with the
    /// opposite sign. Twist angles have 0.
    pub fn cross(&self, values: &[f64]) -> Vec<f64> {
        let spin = self.spin();
        let mut product = vec![0.0; values.len()];
        self.vectors.iter().for_each(|own| set_vec3(&mut product, own.first, &spin.cross(&vec3(values, own.first))));
        product
    }

    /// Rate and second derivative of the directors, slopes and angles of `state` in a frame that turns, where their
    /// accelerations are `acceleration`.
    pub fn relative_motion(&self, state: &State, acceleration: &[f64]) -> [Vec<f64>; 2] {
        let [by_q, by_velocity] = [&state.q, &state.velocity].map(|own| self.cross(own));
        let again = self.cross(&by_q);
        let rate = state.velocity.iter().zip(&by_q).map(|(own, turned)| own - turned).collect();
        let parts = acceleration.iter().zip(&by_velocity).zip(&again);
        [rate, parts.map(|((own, coriolis), again)| own - 2.0 * coriolis + again).collect()]
    }

    /// The orientation of the frame after a turn by `angle`, rad.
    pub fn turn(&self, angle: f64) -> Mat3 {
        rotation_matrix(&(self.axis * angle))
    }

    /// Turns what turns in `state` by `angle` (rad), with its velocities.
    pub fn advance(&self, system: &System, angle: f64, state: &mut State) {
        let turn = self.turn(angle);
        for own in self.vectors.iter().filter(|own| own.turns) {
            let shift = if own.is_position { self.center } else { Vec3::zeros() };
            let moved = turn * (vec3(&state.q, own.first) - shift) + shift;
            set_vec3(&mut state.q, own.first, &moved);
        }
        for (triad, _) in state.triads.iter_mut().zip(&self.frames).filter(|(_, turns)| **turns) {
            (triad.t, triad.u) = (turn * triad.t, turn * triad.u);
        }
        state.prescribed.drives[self.drive].value += angle;
        follow(system, state, &mut FrameCache::default());
        self.set_motion(system, state);
    }

    /// Adds `by_velocity ∂v/∂q` to `target`, where the velocities follow the coordinates `q`. Both have the same
    /// blocks.
    pub fn add_velocity_part(&self, q: &[f64], by_velocity: &Blocks, target: &mut Blocks) {
        let mut entries = self.entries(self.spin().cross_matrix());
        for start in &self.twisted {
            let slope = vec3(q, start + P);
            let t = slope.normalize();
            let row = (self.spin() - t * t.dot(&self.spin())) / slope.norm();
            entries.extend((0..VECTOR).map(|axis| (start + THETA, start + P + axis, row[axis])));
        }
        entries.sort_unstable_by_key(|entry| entry.0);
        add_product(by_velocity, &entries, target);
    }

    /// Adds `by_acceleration ∂a/∂q` to `target` alike.
    pub fn add_acceleration_part(&self, by_acceleration: &Blocks, target: &mut Blocks) {
        let spin = self.spin().cross_matrix();
        add_product(by_acceleration, &self.entries(spin * spin), target);
    }

    /// The entries of a matrix with the block `matrix` at each vector that turns: row, column, value.
    fn entries(&self, matrix: Mat3) -> Vec<(usize, usize, f64)> {
        let turning = self.vectors.iter().filter(|own| own.turns);
        let own = turning.flat_map(|own| {
            (0..VECTOR * VECTOR).map(move |entry| {
                let (row, column) = (entry / VECTOR, entry % VECTOR);
                (own.first + row, own.first + column, matrix[(row, column)])
            })
        });
        own.collect()
    }
}

/// Adds `source · entries` to `target`, which has the same blocks; `entries` (row, column, value) by rising rows, each
/// inside the columns of a block or outside.
fn add_product(source: &Blocks, entries: &[(usize, usize, f64)], target: &mut Blocks) {
    for number in 0..source.layout().len() {
        let Block { column: first, rows, columns, .. } = source.layout()[number];
        let [begin, end] = [first, first + columns].map(|bound| entries.partition_point(|entry| entry.0 < bound));
        for (row, column, value) in &entries[begin..end] {
            let from = &source.block(number)[(row - first) * rows..(row - first + 1) * rows];
            let to = &mut target.block_mut(number)[(column - first) * rows..(column - first + 1) * rows];
            to.iter_mut().zip(from).for_each(|(to, from)| *to += value * from);
        }
    }
}
