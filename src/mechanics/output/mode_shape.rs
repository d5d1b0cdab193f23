//! What a small motion of the system does at its nodes and bodies, and where it is largest.

use crate::math::vectors::{set_vec3, vec3};
use crate::math::{Mat3, Vec3};
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::geometry::marker_jacobian::MarkerVector;
use crate::mechanics::geometry::pose::axis_place;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::system::System;
use crate::mechanics::system::mass::MassAt;
use std::ops::Range;

/// Components that are larger than this share of the largest one are named with it.
const ALSO: f64 = 0.5;
/// Components that differ by less are equal: the first is named.
const EQUAL: f64 = 1e-6;

/// A small motion at one position, global axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceMotion {
    /// Displacement, m.
    pub displacement: Vec3,
    /// Turn, rad.
    pub turn: Vec3,
}

/// What a motion moves most.
#[derive(Clone, Debug, PartialEq)]
pub struct Extreme {
    /// Where and which way, in words: `arm.end, along y`, `disk, turning about x`.
    pub what: String,
    /// The largest component there, m or rad.
    pub amount: f64,
}

impl System {
    /// What the small change `motion` of the coordinates does at all nodes, then at all bodies.
    pub fn place_motions(&self, c: &Configuration, motion: &[f64]) -> Vec<PlaceMotion> {
        let (offset, axes) = (Vec3::zeros(), Mat3::identity());
        let nodes = (0..self.mesh.nodes.len()).map(|node| Marker::Node { node, offset, axes });
        let markers = nodes.chain(self.bodies.iter().map(|body| body.marker()));
        let moved = |marker: Marker| {
            let by_coordinates = marker.jacobian(c);
            let mut sum = PlaceMotion { displacement: Vec3::zeros(), turn: Vec3::zeros() };
            for (local, index) in marker.coordinates(&self.mesh).enumerate() {
                sum.displacement += by_coordinates.place_q.column(local) * motion[index];
                sum.turn += by_coordinates.turn_q.column(local) * motion[index];
            }
            sum
        };
        markers.map(moved).collect()
    }

    /// The small motion `motion` about `from`, seen about `to`: positions move and parts turn alike. Coordinates that are
    /// directions fixed to a part, of bodies and of sections that are not turned by an angle, turn with the part from
    /// one to the other.
    pub fn motion_about(&self, motion: &[f64], from: &Configuration, to: &Configuration) -> Vec<f64> {
        let mut carried = motion.to_vec();
        let (offset, axes) = (Vec3::zeros(), Mat3::identity());
        let mut carry = |marker: Marker, directors: Range<usize>| {
            let [before, after] = [from, to].map(|c| marker.pose(c).axes);
            let range = marker.coordinates(&self.mesh);
            let own =
                MarkerVector::from_fn(|local, _| if local < range.len() { motion[range.start + local] } else { 0.0 });
            let (turn, turned): (Vec3, Mat3) = (marker.jacobian(from).turn_q * own, after * before.transpose());
            for place in directors.step_by(3) {
                let strain = vec3(motion, place) - turn.cross(&vec3(from.beams.q, place));
                set_vec3(&mut carried, place, &(turn.cross(&vec3(to.beams.q, place)) + turned * strain));
            }
        };
        for (number, node) in self.mesh.nodes.iter().enumerate() {
            if !node.directors().is_empty() {
                carry(Marker::Node { node: number, offset, axes }, node.directors());
            }
        }
        for body in &self.bodies {
            carry(Marker::Body { start: body.start, offset, axes }, body.start + axis_place(0)..body.start + BODY);
        }
        carried
    }

    /// What `motion` moves most: by displacement, or by turning where most of its kinetic energy is in that.
    pub fn most_moved(&self, c: &Configuration, motion: &[f64]) -> Extreme {
        let turns = self.turning_share(c, motion) > 0.5;
        let mut largest = (Vec3::zeros(), 0, 0.0);
        for (index, moved) in self.place_motions(c, motion).into_iter().enumerate() {
            let vector = if turns { moved.turn } else { moved.displacement };
            if vector.amax() > (1.0 + EQUAL) * largest.2 {
                largest = (vector, index, vector.amax());
            }
        }
        let (vector, index, size) = largest;
        let where_ = match index.checked_sub(self.mesh.nodes.len()) {
            None => self.describe_node(index),
            Some(body) => self.bodies.get(body).map_or_else(String::new, |body| body.name.clone()),
        };
        let axes: Vec<&str> = ["x", "y", "z"]
            .into_iter()
            .zip(&vector)
            .filter(|(_, v)| v.abs() > ALSO * size)
            .map(|(axis, _)| axis)
            .collect();
        let way = if turns { "turning about" } else { "along" };
        let first = vector.iter().find(|value| value.abs() > (1.0 - EQUAL) * size);
        Extreme { what: format!("{where_}, {way} {}", axes.join(" and ")), amount: first.copied().unwrap_or(0.0) }
    }

    /// Share of the kinetic energy of velocities `motion` that is in the spin of sections and the turning of bodies, 0
    /// to 1.
    fn turning_share(&self, c: &Configuration, motion: &[f64]) -> f64 {
        let mut momentum = vec![0.0; motion.len()];
        self.mass_times(MassAt::from(c), motion, &mut momentum);
        let (mut turning, mut whole) = (0.0, 0.0);
        let mut count = |index: usize, is_turn: bool| {
            let energy = motion[index] * momentum[index];
            whole += energy;
            turning += if is_turn { energy } else { 0.0 };
        };
        for node in &self.mesh.nodes {
            node.coordinates().enumerate().for_each(|(local, index)| count(index, node.is_turn(local)));
        }
        for body in &self.bodies {
            (0..BODY).for_each(|local| count(body.start + local, local >= axis_place(0)));
        }
        if whole > 0.0 { turning / whole.max(f64::MIN_POSITIVE) } else { 0.0 }
    }
}
