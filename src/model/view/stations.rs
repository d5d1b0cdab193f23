//! Stations along beams: sections at which a picture is swept, and whose forces, strains and stress it tells.

use crate::math::Vec3;
use crate::math::rotation::{quaternion_of_triad, rotation_matrix};
use crate::mechanics::beam::Beam;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::sensor::Sensor;
use crate::mechanics::output::joint_loads::JointLoads;
use crate::mechanics::output::section_loads::SectionLoads;
use crate::mechanics::system::System;
use nalgebra::Matrix3;
use std::ops::Range;

/// What is told of a station: its word, unit and meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StationResult {
    /// Its word, as that of an output where there is one.
    pub word: &'static str,
    /// Unit label; empty: dimensionless.
    pub unit: &'static str,
    /// What it is, in words.
    pub meaning: &'static str,
}

const fn result(word: &'static str, unit: &'static str, meaning: &'static str) -> StationResult {
    StationResult { word, unit, meaning }
}

/// What is told of a station, in this order.
pub const RESULTS: [StationResult; 12] = [
    result("stress", "Pa", "largest von Mises stress over the outline"),
    result("axial_force", "N", "axial force, tension positive"),
    result("shear_y", "N", "shear force along the section's y"),
    result("shear_z", "N", "shear force along the section's z"),
    result("torque", "N.m", "torque"),
    result("moment_y", "N.m", "bending moment about the section's y"),
    result("moment_z", "N.m", "bending moment about the section's z"),
    result("axial_strain", "", "axial strain, extension positive"),
    result("curvature_y", "1/m", "curvature about the section's y, minus the undeformed one"),
    result("curvature_z", "1/m", "curvature about the section's z, minus the undeformed one"),
    result("torsion", "rad/m", "twist rate, minus the undeformed one"),
    result("speed", "m/s", "speed of the axis"),
];

/// All beams together get about so many stations.
const STATIONS: usize = 400;
/// Most steps from station to station in an element: its axis is a cubic.
const MOST_STEPS: usize = 8;

/// The stations of one beam.
#[derive(Clone, Debug)]
pub struct Stations {
    /// Fraction of the beam's length at each, from 0 to 1.
    pub fractions: Vec<f64>,
    /// Which of them are nodes.
    pub nodes: Vec<usize>,
    sensors: Vec<Sensor>,
}

/// Steps from station to station in an element of `system`.
pub fn steps(system: &System) -> usize {
    (STATIONS / system.mesh.elements.len().max(1)).clamp(1, MOST_STEPS)
}

impl Stations {
    /// Of a beam, in the configuration `c` as drawn: all nodes, and places in each element, `steps` from node to node.
    /// At a corner, where two nodes meet, there is a station on each side.
    pub fn new(system: &System, c: &Configuration, beam: usize, steps: usize) -> Self {
        let own = &system.beams[beam];
        let mut stations = Self { fractions: Vec::new(), nodes: Vec::new(), sensors: Vec::new() };
        let mut add = |marker: Marker, fraction: f64| {
            if matches!(marker, Marker::Node { .. }) {
                stations.nodes.push(stations.fractions.len());
            }
            stations.fractions.push(fraction);
            stations.sensors.push(Sensor::new(&system.beams, c, marker, Some((beam, fraction))));
        };
        for element in 0..own.elements() {
            let span = [element, element + 1].map(|end| own.division.fraction(end).unwrap_or(1.0));
            let begins_anew = element == 0 || own.corners.binary_search(&element).is_ok();
            if begins_anew {
                add(node(first_node(own, element)), span[0]);
            }
            for step in 1..steps {
                let xi = step as f64 / steps as f64;
                let marker = Marker::section(own.first_element + element, xi);
                add(marker, span[0] + xi * (span[1] - span[0]));
            }
            add(node(own.node(element + 1)), span[1]);
        }
        stations
    }

    /// Number of stations.
    pub fn count(&self) -> usize {
        self.sensors.len()
    }

    /// Places (m, from the system's origin) and orientations (quaternions `w x y z`) as drawn, a station after the
    /// other.
    pub fn drawn(&self) -> impl Iterator<Item = ([f64; 3], [f64; 4])> {
        let pose = |sensor: &Sensor| (sensor.drawn.place.into(), quaternion(&sensor.drawn.axes));
        self.sensors.iter().map(pose).collect::<Vec<_>>().into_iter()
    }

    /// Pushes position and orientation of each station onto `places` and `turns`.
    pub fn push_poses(&self, c: &Configuration, places: &mut Vec<f64>, turns: &mut Vec<f64>) {
        for sensor in &self.sensors {
            places.extend(sensor.marker.pose(c).place.iter());
            // The section as strains have turned it, which is what outputs tell.
            let turn = rotation_matrix(&sensor.rotation(c, &Vec3::zeros()));
            turns.extend(quaternion(&(turn * sensor.drawn.axes)));
        }
    }

    /// The results of [`RESULTS`] at each station. Stress is 0 where the outline is not known.
    pub fn results<'a>(&'a self, loads: &'a SectionLoads) -> impl Iterator<Item = [f64; RESULTS.len()]> + 'a {
        let JointLoads { state, c, .. } = loads.joints;
        self.sensors.iter().map(move |sensor| {
            let section = sensor.section(loads).expect("stations are points of beams");
            let strains = section.strains();
            let stress = sensor.stress(loads).unwrap_or(0.0);
            let ([axial_force, shear_y, shear_z], [torque, moment_y, moment_z]) =
                (section.wrench.force, section.wrench.moment);
            let [curvature_y, curvature_z] = strains.curvature;
            let speed = sensor.motion(c, &state.velocity).0.norm();
            [
                stress,
                axial_force,
                shear_y,
                shear_z,
                torque,
                moment_y,
                moment_z,
                strains.axial,
                curvature_y,
                curvature_z,
                strains.torsion,
                speed,
            ]
        })
    }

    /// Displacement and turn of each station when the coordinates change by `shape`.
    pub fn motions<'a>(
        &'a self,
        c: &'a Configuration,
        shape: &'a [f64],
    ) -> impl Iterator<Item = ([f64; 3], [f64; 3])> + 'a {
        self.sensors.iter().map(move |sensor| {
            let (place, turn) = sensor.motion(c, shape);
            (place.into(), turn.into())
        })
    }
}

/// The node at which an element begins: at a corner the one behind it.
fn first_node(beam: &Beam, element: usize) -> usize {
    let node = beam.node(element);
    if beam.corners.binary_search(&element).is_ok() { node + 1 } else { node }
}

fn node(node: usize) -> Marker {
    Marker::Node { node, offset: Vec3::zeros(), axes: Matrix3::identity() }
}

/// An orientation as `w x y z`.
pub fn quaternion(axes: &Matrix3<f64>) -> [f64; 4] {
    let turn = quaternion_of_triad(axes);
    [turn.w, turn.i, turn.j, turn.k]
}

/// Where each beam's stations are among all of them.
pub fn ranges(beams: &[Stations]) -> Vec<Range<usize>> {
    let mut end = 0;
    let range = |stations: &Stations| {
        let begin = end;
        end += stations.count();
        begin..end
    };
    beams.iter().map(range).collect()
}
