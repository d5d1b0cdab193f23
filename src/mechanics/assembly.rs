//! Puts a machine together: beams as drawn become nodes, elements and reference frames; points of them become markers.

use super::beam::coordinates::{NODE, P, THETA, set_vec3};
use super::beam::element::{BendingPoint, Element};
use super::beam::frame::{NodeFrame, Triad};
use super::beam::quadratic_twist::Twist;
use super::beam::strain::{Stiffness, Strain};
use super::centreline::Centreline;
use super::configuration::Configuration;
use super::gauge::{Gauge, Measure};
use super::joint::Joint;
use super::joint::driven::Driven;
use super::joint::weld;
use super::load::{Excitation, Load};
use super::marker::Marker;
use super::material::Material;
use super::pose::Pose;
use super::prescribed::{Drive, FrameGuide, Guide, MovingFrame, Prescribed, Targets};
use super::rigid_body::{BodyDesign, RigidBody};
use super::section::Section;
use super::sensor::Sensor;
use super::spring::Spring;
use super::state::{Accelerations, State, Statistics};
use super::system::{Beam, System};
use super::transmission::Transmission;
use crate::math::jet::Jet;
use crate::math::{Mat3, Vec3};

/// Saint-Venant stiffness is multiplied by this where torsion is suppressed (MECHANICS 3.6).
const SUPPRESSED_TORSION: f64 = 1e4;

/// Whether a beam may twist.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Torsion {
    /// It may.
    Free,
    /// The section follows the Bishop frame, the paper's "torsional effects disregarded".
    Suppressed,
}

/// A beam as drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct BeamDesign {
    /// Name in the model file.
    pub name: String,
    /// Its nodes and elements.
    pub line: Centreline,
    /// Direction of the section's y at the start; made perpendicular to the tangent, then carried along without twist.
    pub y_axis: Vec3,
    /// Additional turn of the section from start to end, rad.
    pub pretwist: f64,
    /// Material.
    pub material: Material,
    /// Cross-section.
    pub section: Section,
    /// Strain measure.
    pub strain: Strain,
    /// How the twist runs inside an element.
    pub twist: Twist,
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
            twist: self.twist,
            axial: material.young * section.area,
            bending_y: material.young * section.second_moment_y,
            bending_z: material.young * section.second_moment_z,
            torsion: material.shear * section.torsion_constant * torsion_factor,
            wagner: if couples { material.young * section.polar_moment } else { 0.0 },
            fourth: match self.strain {
                Strain::Large => section.fourth_moments.map(|moment| material.young * moment),
                _ => [0.0; 3],
            },
            damping: material.damping,
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

/// A machine in the making.
///
/// Beams come first, then bodies: coordinates are in this order. Drives come after all joints.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    /// Its parts so far; joints without those of corners, bodies and drives.
    system: System,
    start: f64,
    q: Vec<f64>,
    velocity: Vec<f64>,
    triads: Vec<Triad>,
    corner_joints: Vec<Joint>,
    drive_joints: Vec<Joint>,
    prescribed: Prescribed,
    targets: Targets,
}

impl Assembly {
    /// That is drawn as it is at the time `start`, s.
    pub fn new(start: f64) -> Self {
        Self { start, targets: Targets { end: start, ..Targets::default() }, ..Self::default() }
    }

    /// Adds a beam and returns its number. The design is sound: section and material, `y_axis` not along the tangent at the start.
    pub fn add_beam(&mut self, design: &BeamDesign) -> usize {
        let line = &design.line;
        let start = line.nodes[0];
        let first_node = self.triads.len();
        let mut triad = Triad::new(&start.tangent, &design.y_axis);
        let mut tangent = start.tangent;
        for station in &line.nodes {
            // Straight on, the triad stays as it is to the last bit.
            if station.tangent != tangent {
                triad = triad.carried(&station.tangent);
                tangent = station.tangent;
            }
            let mut q = [0.0; NODE];
            set_vec3(&mut q, 0, &station.place);
            set_vec3(&mut q, P, &tangent);
            q[THETA] = design.pretwist * station.fraction + station.turn;
            let mut velocity = [0.0; NODE];
            let turning = design.angular_velocity;
            set_vec3(&mut velocity, 0, &(design.velocity + turning.cross(&(station.place - start.place))));
            set_vec3(&mut velocity, P, &turning.cross(&tangent));
            velocity[THETA] = turning.dot(&tangent);
            self.q.extend(q);
            self.velocity.extend(velocity);
            self.triads.push(triad);
        }
        let first_element = self.system.elements.len();
        let density =
            [design.material.density * design.section.area, design.material.density * design.section.polar_moment];
        for span in &line.spans {
            let node = first_node + span.node;
            let reference = &self.q[NODE * node..NODE * (node + 2)];
            let [first, second] = [&self.triads[node], &self.triads[node + 1]];
            let frames = [NodeFrame::new(&reference[..NODE], first), NodeFrame::new(&reference[NODE..], second)];
            // The holonomy of the drawing is 0: triads go from node to node by one minimal rotation.
            let element =
                Element::new(node, span.length, design.stiffness(), density, reference, [&frames[0], &frames[1]], 0.0);
            self.system.elements.push(element);
        }
        self.system.beams.push(Beam {
            name: design.name.clone(),
            first_node,
            first_element,
            division: line.division.clone(),
            corners: line.corners(),
            outline: design.section.outline,
            young: design.material.young,
            twist_limit: design.twist_limit(),
        });
        self.weld_corners(self.system.beams.len() - 1);
        self.system.beams.len() - 1
    }

    /// Welds the two nodes at each corner of a beam.
    fn weld_corners(&mut self, beam: usize) {
        let beam = &self.system.beams[beam];
        let welds = beam.corners.iter().map(|end| {
            let node = beam.node(*end);
            let [a, b] = [node, node + 1].map(|node| {
                let frame = NodeFrame::new(&self.q[NODE * node..NODE * (node + 1)], &self.triads[node]);
                // The global axes as drawn, as the section sees them.
                Marker::Node { node, offset: Vec3::zeros(), axes: frame.section.transpose() }
            });
            let name = format!("the corner {}.node[{end}]", beam.name);
            Joint { name, a, b, primitives: weld::PRIMITIVES, drive: None }
        });
        self.corner_joints.extend(welds);
    }

    /// The node of beam `beam` at the fraction `fraction` of its length, if there is one; at a corner the side towards the start.
    pub fn node_at(&self, beam: usize, fraction: f64) -> Option<usize> {
        let beam = &self.system.beams[beam];
        beam.division.end_at(fraction).map(|end| beam.node(end))
    }

    /// The section of beam `beam` at the fraction `fraction` (0 to 1) of its length: at a node or inside an element.
    pub fn section_at(&self, beam: usize, fraction: f64) -> Marker {
        if let Some(node) = self.node_at(beam, fraction) {
            return Marker::Node { node, offset: Vec3::zeros(), axes: Mat3::identity() };
        }
        let beam = &self.system.beams[beam];
        let (element, xi) = beam.division.place(fraction);
        Marker::Section { element: beam.first_element + element, xi }
    }

    /// The quadrature points of a whole beam with their weights `w l`, m: where a load per length acts.
    ///
    /// Of the arc length, as mass and weight are: not `w l J0`, the length of the interpolated curve, which strains have.
    pub fn sections_of(&self, beam: usize) -> Vec<(Marker, f64)> {
        let beam = &self.system.beams[beam];
        beam.element_range()
            .flat_map(|number| {
                let points = self.system.elements[number].bending.iter();
                let arc = |point: &BendingPoint| point.weight / point.reference_stretch;
                points.map(move |point| (Marker::Section { element: number, xi: point.xi }, arc(point)))
            })
            .collect()
    }

    /// Adds a rigid body and returns its number. The design is sound: positive mass, a possible inertia, orthonormal axes.
    pub fn add_body(&mut self, design: &BodyDesign) -> usize {
        let (body, q, velocity) = RigidBody::new(design, self.q.len());
        self.q.extend(q);
        self.velocity.extend(velocity);
        self.system.bodies.push(body);
        self.system.bodies.len() - 1
    }

    /// Adds a moving frame and returns its number; `target` is its pose at the start, where a host gives it.
    pub fn add_frame(&mut self, name: &str, guide: FrameGuide, target: Pose) -> usize {
        let frame = MovingFrame { name: name.into(), guide };
        self.prescribed.frames.push(frame.start(self.start, &target));
        self.targets.frames.push(target);
        self.system.moving_frames.push(frame);
        self.system.moving_frames.len() - 1
    }

    /// The marker at a node, with the section's axes.
    pub fn node(&self, node: usize) -> Marker {
        Marker::Node { node, offset: Vec3::zeros(), axes: Mat3::identity() }
    }

    /// The marker at the centre of mass of body `body`, with the body's axes.
    pub fn body(&self, body: usize) -> Marker {
        self.system.bodies[body].marker()
    }

    /// The marker at the origin of frame `frame`, with its axes.
    pub fn frame(&self, frame: usize) -> Marker {
        Marker::Frame { frame, offset: Vec3::zeros(), axes: Mat3::identity() }
    }

    /// The marker at `pose`, in space as drawn, that is tied to whatever `anchor` is tied to: a node, a body, a frame, the ground.
    pub fn tied(&self, anchor: &Marker, pose: &Pose) -> Marker {
        let own = self.drawn(&anchor.bare());
        let (offset, axes) = own.relative(pose);
        match anchor.bare() {
            Marker::Node { node, .. } => Marker::Node { node, offset, axes },
            Marker::Body { start, .. } => Marker::Body { start, offset, axes },
            Marker::Frame { frame, .. } => Marker::Frame { frame, offset, axes },
            Marker::Ground(_) | Marker::Section { .. } => Marker::Ground(*pose),
        }
    }

    /// Place and axes of a marker as drawn.
    pub fn drawn(&self, marker: &Marker) -> Pose {
        let holonomy = vec![0.0; self.system.elements.len()];
        marker.pose(&self.configuration(&self.frames(), &holonomy))
    }

    /// Adds a joint and returns its number.
    pub fn add_joint(&mut self, joint: Joint) -> usize {
        self.system.joints.push(joint);
        self.system.joints.len() - 1
    }

    /// Adds a gauge and returns its number.
    pub fn add_gauge(&mut self, a: Marker, b: Marker, measure: Measure) -> usize {
        self.system.gauges.push(Gauge { a, b, measure });
        self.system.gauges.len() - 1
    }

    /// Adds a drive of b against a along or about their first axis and returns its number; `target` is its value or rate at the
    /// start, where a host gives it.
    pub fn add_drive(&mut self, name: &str, [a, b]: [Marker; 2], driven: Driven, guide: Guide, target: f64) -> usize {
        let number = self.system.drives.len();
        let gauge = self.add_gauge(a, b, driven.measure());
        let primitives = driven.primitives();
        self.drive_joints.push(Joint { name: format!("drive {name}"), a, b, primitives, drive: Some(number) });
        self.system.drives.push(Drive { name: name.into(), gauge, guide });
        self.targets.drives.push(target);
        number
    }

    /// Adds a spring and returns its number.
    pub fn add_spring(&mut self, spring: Spring) -> usize {
        self.system.springs.push(spring);
        self.system.springs.len() - 1
    }

    /// Adds what a joint of the model file consists of.
    pub fn add_transmission(&mut self, transmission: Transmission) {
        self.system.transmissions.push(transmission);
    }

    /// Adds drive `drive` to what joint `joint` of the model file consists of.
    pub fn add_drive_of(&mut self, joint: usize, drive: usize) {
        self.system.transmissions[joint].drives.push(drive);
    }

    /// Adds a load.
    pub fn add_load(&mut self, load: Load) {
        self.system.loads.push(load);
    }

    /// Adds a sensor on the section of beam `beam` at `fraction` and returns its number.
    pub fn add_sensor(&mut self, beam: usize, fraction: f64) -> usize {
        self.watch(self.section_at(beam, fraction), Some((beam, fraction)))
    }

    /// Adds a sensor on `marker` and returns its number; `on_beam` is the beam and the fraction of its length where it is a point of one.
    pub fn watch(&mut self, marker: Marker, on_beam: Option<(usize, f64)>) -> usize {
        let holonomy = vec![0.0; self.system.elements.len()];
        let sensor = Sensor::new(&self.system, &self.configuration(&self.frames(), &holonomy), marker, on_beam);
        self.system.sensors.push(sensor);
        self.system.sensors.len() - 1
    }

    /// Largest extent of nodes, bodies and joints as drawn, m, or of a body's own size; 1 of nothing at all.
    fn extent(&self) -> f64 {
        let frames = self.frames();
        let holonomy = vec![0.0; self.system.elements.len()];
        let configuration = self.configuration(&frames, &holonomy);
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        let nodes = self.q[..NODE * self.triads.len()].chunks_exact(NODE).map(|q| super::beam::coordinates::vec3(q, 0));
        let bodies = self.system.bodies.iter().map(|body| super::beam::coordinates::vec3(&self.q, body.start));
        let joints = self.system.joints.iter().map(|joint| joint.b.pose(&configuration).place);
        for place in nodes.chain(bodies).chain(joints) {
            low = low.inf(&place);
            high = high.sup(&place);
        }
        let gyration = |body: &RigidBody| (body.director_inertia.iter().sum::<f64>() / body.mass).sqrt();
        let size = self.system.bodies.iter().map(gyration).fold((high - low).norm(), f64::max);
        if size.is_finite() && size > 0.0 { size } else { 1.0 }
    }

    fn frames(&self) -> Vec<NodeFrame> {
        self.q.chunks_exact(NODE).zip(&self.triads).map(|(q, triad)| NodeFrame::new(q, triad)).collect()
    }

    fn configuration<'a>(&'a self, frames: &'a [NodeFrame], holonomy: &'a [f64]) -> Configuration<'a> {
        Configuration {
            q: &self.q,
            frames,
            holonomy,
            readings: &[],
            prescribed: &self.prescribed,
            elements: &self.system.elements,
        }
    }

    /// The machine and its state as drawn: velocities as given, momenta and multipliers still zero, drives at zero.
    pub fn finish(self, gravity: Vec3) -> (System, State) {
        let size = self.extent();
        let Self { mut system, start, q, velocity, triads, corner_joints, drive_joints, mut prescribed, targets } =
            self;
        system.size = size;
        system.gravity = gravity;
        // Behind the joints of the file, which keep their numbers; drives come last.
        system.joints.extend(corner_joints);
        system.joints.extend(system.bodies.iter().map(RigidBody::rigidity));
        system.joints.extend(drive_joints);
        // As drawn, every drive is at zero: what it prescribes at the start is for the start to reach.
        prescribed.drives = vec![Jet::constant(0.0); system.drives.len()];
        let state = State {
            time: start,
            momentum: vec![0.0; q.len()],
            multipliers: vec![0.0; system.constraints()],
            strays: vec![0.0; system.constraints()],
            accelerations: Accelerations::default(),
            holonomy: vec![0.0; system.elements.len()],
            readings: vec![0.0; system.gauges.len()],
            rotations: vec![Vec3::zeros(); system.sensors.len()],
            q,
            velocity,
            triads,
            prescribed,
            targets,
            excitation: Excitation::default(),
            halving: 0,
            good_steps: 0,
            statistics: Statistics::default(),
        };
        (system, state)
    }
}
