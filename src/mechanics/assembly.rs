//! Puts a machine together: beams as drawn become nodes, elements and reference frames; points of them become markers.

use super::beam::coordinates::{NODE, P, THETA, set_vec3};
use super::beam::element::Element;
use super::beam::frame::{NodeFrame, Triad};
use super::beam::strain::{Stiffness, Strain};
use super::joint::Joint;
use super::load::{Excitation, Load};
use super::marker::{Marker, Pose};
use super::material::Material;
use super::section::Section;
use super::sensor::Sensor;
use super::state::{State, Statistics};
use super::system::{Beam, System};
use crate::math::{Mat3, Vec3};

/// Saint-Venant stiffness is multiplied by this where torsion is suppressed (MECHANICS 3.6).
const SUPPRESSED_TORSION: f64 = 1e4;
/// How near to a node a place of a beam must be to be that node, in elements.
const AT_NODE: f64 = 1e-9;

/// Whether a beam may twist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Torsion {
    /// It may.
    Free,
    /// The section follows the Bishop frame, the paper's "torsional effects disregarded".
    Suppressed,
}

/// A straight beam as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamDesign {
    /// Name in the model file.
    pub name: String,
    /// Start, m.
    pub from: Vec3,
    /// End, m.
    pub to: Vec3,
    /// Direction of the section's y at the start; made perpendicular to the beam.
    pub y_axis: Vec3,
    /// Turn of the section from start to end, rad.
    pub pretwist: f64,
    /// Number of elements, at least 1.
    pub elements: usize,
    /// Material.
    pub material: Material,
    /// Cross-section.
    pub section: Section,
    /// Strain measure.
    pub strain: Strain,
    /// Whether it may twist.
    pub torsion: Torsion,
    /// Initial velocity of the start, m/s.
    pub velocity: Vec3,
    /// Initial angular velocity about the start, rad/s.
    pub angular_velocity: Vec3,
}

impl BeamDesign {
    fn stiffness(&self) -> Stiffness {
        let (material, section) = (&self.material, &self.section);
        let torsion_factor = match self.torsion {
            Torsion::Free => 1.0,
            Torsion::Suppressed => SUPPRESSED_TORSION,
        };
        let couples = self.strain != Strain::Small && self.torsion == Torsion::Free;
        Stiffness {
            strain: self.strain,
            axial: material.young * section.area,
            bending_y: material.young * section.second_moment_y,
            bending_z: material.young * section.second_moment_z,
            torsion: material.shear * section.torsion_constant * torsion_factor,
            wagner: if couples { material.young * section.polar_moment } else { 0.0 },
            fourth: match self.strain {
                Strain::Large => section.fourth_moments.map(|moment| material.young * moment),
                _ => [0.0; 3],
            },
            damping: 0.0,
        }
    }

    /// `tau_c = sqrt(4 G Jt A / (E Ip²))`, rad/m: above it the truncated energy has no lower bound (MECHANICS, trap 9).
    fn twist_limit(&self) -> f64 {
        let (material, section) = (&self.material, &self.section);
        match (self.strain, self.torsion) {
            (Strain::LargeTruncated, Torsion::Free) => (4.0 * material.shear * section.torsion_constant * section.area
                / (material.young * section.polar_moment.powi(2)))
            .sqrt(),
            _ => f64::INFINITY,
        }
    }
}

/// The node at the fraction `fraction` of a beam of `elements` equal elements, from 0; none where there is no node.
pub fn node_at(fraction: f64, elements: usize) -> Option<usize> {
    let place = fraction * elements as f64;
    let nearest = place.round();
    ((place - nearest).abs() <= AT_NODE).then(|| nearest.clamp(0.0, elements as f64) as usize)
}

/// A machine in the making.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    beams: Vec<Beam>,
    elements: Vec<Element>,
    q: Vec<f64>,
    velocity: Vec<f64>,
    triads: Vec<Triad>,
    joints: Vec<Joint>,
    loads: Vec<Load>,
    sensors: Vec<Sensor>,
}

impl Assembly {
    /// Adds a beam and returns its number. The design is sound: positive length, section and material, `y_axis` not along the beam.
    pub fn add_beam(&mut self, design: &BeamDesign) -> usize {
        let span = design.to - design.from;
        let (count, tangent) = (design.elements, span.normalize());
        let length = span.norm() / count as f64;
        let triad = Triad::new(&tangent, &design.y_axis);
        let first_node = self.triads.len();
        for node in 0..=count {
            let share = node as f64 / count as f64;
            let place = design.from + span * share;
            let mut q = [0.0; NODE];
            set_vec3(&mut q, 0, &place);
            set_vec3(&mut q, P, &tangent);
            q[THETA] = design.pretwist * share;
            let mut velocity = [0.0; NODE];
            let turning = design.angular_velocity;
            set_vec3(&mut velocity, 0, &(design.velocity + turning.cross(&(place - design.from))));
            set_vec3(&mut velocity, P, &turning.cross(&tangent));
            velocity[THETA] = turning.dot(&tangent);
            self.q.extend(q);
            self.velocity.extend(velocity);
            self.triads.push(triad);
        }
        let first_element = self.elements.len();
        let density =
            [design.material.density * design.section.area, design.material.density * design.section.polar_moment];
        for number in 0..count {
            let node = first_node + number;
            let reference = &self.q[NODE * node..NODE * (node + 2)];
            let frames = [NodeFrame::new(&reference[..NODE], &triad), NodeFrame::new(&reference[NODE..], &triad)];
            let element =
                Element::new(node, length, design.stiffness(), density, reference, [&frames[0], &frames[1]], 0.0);
            self.elements.push(element);
        }
        let twist_limit = design.twist_limit();
        self.beams.push(Beam { name: design.name.clone(), first_node, first_element, elements: count, twist_limit });
        self.beams.len() - 1
    }

    /// The node of beam `beam` at the fraction `fraction` of its length, if there is one.
    pub fn node_at(&self, beam: usize, fraction: f64) -> Option<usize> {
        let beam = &self.beams[beam];
        node_at(fraction, beam.elements).map(|node| beam.first_node + node)
    }

    /// The section of beam `beam` at the fraction `fraction` (0 to 1) of its length: at a node or inside an element.
    pub fn section_at(&self, beam: usize, fraction: f64) -> Marker {
        if let Some(node) = self.node_at(beam, fraction) {
            return Marker::Node { node, offset: Vec3::zeros(), axes: Mat3::identity() };
        }
        let beam = &self.beams[beam];
        let place = fraction * beam.elements as f64;
        let element = (place.floor() as usize).min(beam.elements - 1);
        Marker::Section { element: beam.first_element + element, xi: place - element as f64 }
    }

    /// The quadrature points of a whole beam with their weights, m: where a load per length acts.
    pub fn sections_of(&self, beam: usize) -> Vec<(Marker, f64)> {
        let beam = &self.beams[beam];
        let elements = beam.first_element..beam.first_element + beam.elements;
        elements
            .flat_map(|number| {
                let points = self.elements[number].bending.iter();
                points.map(move |point| (Marker::Section { element: number, xi: point.xi }, point.weight))
            })
            .collect()
    }

    /// A marker at `place` with the axes `axes`, both in space as drawn, tied to node `node`.
    pub fn marker_on_node(&self, node: usize, place: &Vec3, axes: &Mat3) -> Marker {
        let q = &self.q[NODE * node..NODE * (node + 1)];
        let section = NodeFrame::new(q, &self.triads[node]).section;
        let arm = place - super::beam::coordinates::vec3(q, 0);
        Marker::Node { node, offset: section.tr_mul(&arm), axes: section.tr_mul(axes) }
    }

    /// Place and section axes of a marker as drawn.
    pub fn drawn(&self, marker: &Marker) -> Pose {
        let mut frames = Vec::new();
        frames.extend(self.q.chunks_exact(NODE).zip(&self.triads).map(|(q, triad)| NodeFrame::new(q, triad)));
        let holonomy = vec![0.0; self.elements.len()];
        marker.pose(&super::marker::Configuration {
            q: &self.q,
            frames: &frames,
            holonomy: &holonomy,
            elements: &self.elements,
        })
    }

    /// Adds a joint.
    pub fn add_joint(&mut self, joint: Joint) {
        self.joints.push(joint);
    }

    /// Adds a load.
    pub fn add_load(&mut self, load: Load) {
        self.loads.push(load);
    }

    /// Adds a sensor on the section of beam `beam` at `fraction` and returns its number.
    pub fn add_sensor(&mut self, beam: usize, fraction: f64) -> usize {
        let marker = self.section_at(beam, fraction);
        let drawn = self.drawn(&marker);
        self.sensors.push(Sensor { marker, drawn, beam, fraction });
        self.sensors.len() - 1
    }

    /// The machine and its state as drawn at the time `start`, s: velocities as given, momenta and multipliers still zero.
    pub fn finish(self, gravity: Vec3, start: f64) -> (System, State) {
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        for q in self.q.chunks_exact(NODE) {
            let place = super::beam::coordinates::vec3(q, 0);
            low = low.inf(&place);
            high = high.sup(&place);
        }
        let size = if self.q.is_empty() { 1.0 } else { (high - low).norm() };
        let holonomy = vec![0.0; self.elements.len()];
        let rotations = vec![Vec3::zeros(); self.sensors.len()];
        let system = System::new(self.beams, self.elements, self.joints, self.loads, self.sensors, gravity, size);
        let state = State {
            time: start,
            momentum: vec![0.0; self.q.len()],
            q: self.q,
            velocity: self.velocity,
            multipliers: vec![0.0; system.constraints()],
            triads: self.triads,
            holonomy,
            excitation: Excitation::default(),
            rotations,
            halving: 0,
            good_steps: 0,
            statistics: Statistics::default(),
        };
        (system, state)
    }
}
