//! Puts a system together: beams as drawn become nodes, elements and reference frames; points of them become markers.

mod driving;
mod foundations;
mod heating;
pub mod ropes;
mod sliding;
mod touching;
mod watching;

use super::System;
use super::joint_parts::JointParts;
use crate::math::elementary::sin_cos;
use crate::math::jet::Jet;
use crate::math::vectors::vec3;
use crate::math::{Mat3, Vec3};
use crate::mechanics::beam::Beam;
use crate::mechanics::beam::ancf14;
use crate::mechanics::beam::ancf14::frame::NodeFrame;
use crate::mechanics::beam::ancf24;
use crate::mechanics::beam::centerline::Station;
use crate::mechanics::beam::configuration::BeamConfiguration;
use crate::mechanics::beam::design::{BeamDesign, Elements};
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::beam::node::Node;
use crate::mechanics::body::rigid_body::{BodyDesign, RigidBody};
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::constraint::rigidity;
use crate::mechanics::constraint::weld;
use crate::mechanics::force::actuator::Actuator;
use crate::mechanics::force::load::{Load, Site};
use crate::mechanics::force::spring::Spring;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::geometry::triad::Triad;
use crate::mechanics::input::excitation::{HostEffort, HostWrench};
use crate::mechanics::input::guide::{FrameGuide, MovingFrame};
use crate::mechanics::input::host_motion::{Departure, Targets};
use crate::mechanics::input::prescribed::Prescribed;
use crate::mechanics::input::switch::Hold;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::{Measure, RelativeCoordinate};
use crate::mechanics::state::State;
use crate::mechanics::state::lists::Lists;
use std::ops::Range;

/// A system in the making.
///
/// Beams come first, then bodies: coordinates are in this order. Drives come after all joints.
#[derive(Clone, Debug, Default)]
pub struct SystemBuilder {
    /// Its parts so far; joints without inner ones, bodies' and drives'.
    system: System,
    start: f64,
    /// When moving frames are where the file draws them, s.
    drawing: f64,
    q: Vec<f64>,
    velocity: Vec<f64>,
    triads: Vec<Triad>,
    /// Frames of nodes and holonomies of elements as drawn: parts of the file ask for a point again and again.
    frames: Vec<NodeFrame>,
    holonomy: Vec<f64>,
    /// Welds of corners, rigidity of tied sections.
    inner_joints: Vec<Joint>,
    /// Whether the section of a node has been made rigid, by its number; beyond the end: not.
    stiff_nodes: Vec<bool>,
    drive_joints: Vec<Joint>,
    lock_joints: Vec<Joint>,
    /// Both sides of each gear.
    gear_joints: Vec<Joint>,
    prescribed: Prescribed,
    targets: Targets,
    /// How many numbers forces remember.
    memory: usize,
}

impl SystemBuilder {
    /// That is drawn as it is at the time `start`, s.
    pub fn new(start: f64) -> Self {
        let departure = Departure { time: start, ..Departure::default() };
        Self {
            start,
            drawing: start,
            targets: Targets { end: start, departure, ..Targets::default() },
            ..Self::default()
        }
    }

    /// Takes the drawing at `time`, s, instead of at the start: joints tie frames as they are then.
    #[must_use]
    pub fn drawn_at(self, time: f64) -> Self {
        Self { drawing: time, ..self }
    }

    /// Adds a beam and returns its number. The design is sound: section and material, `y_axis` not along the tangent at
    /// the start.
    pub fn add_beam(&mut self, design: &BeamDesign) -> usize {
        let line = &design.line;
        let start = line.nodes[0];
        let first_node = self.system.mesh.nodes.len();
        let first_frame = self.triads.len();
        let mut triad = Triad::new(&start.tangent, &design.y_axis);
        let mut tangent = start.tangent;
        for station in &line.nodes {
            // Straight on, the triad stays as it is to the last bit.
            if station.tangent != tangent {
                triad = triad.carried(&station.tangent);
                tangent = station.tangent;
            }
            let velocity = design.velocity + design.angular_velocity.cross(&(station.place - start.place));
            self.add_node(design, station, &triad, &velocity);
        }
        let first_element = self.system.mesh.elements.len();
        for span in &line.spans {
            let (node, frame) = (first_node + span.node, first_frame + span.node);
            let fractions = [span.node, span.node + 1].map(|node| line.nodes[node].fraction);
            let element = self.element(design, node, frame, span.length, fractions);
            self.system.mesh.elements.push(element);
        }
        self.system.beams.push(Beam {
            name: design.name.clone(),
            first_node,
            first_element,
            division: line.division.clone(),
            corners: line.corners(),
            section: design.section,
            profile: design.profile.clone(),
            mass_damping: design.mass_damping,
            young: design.material.young,
            twist_limit: design.twist_limit(),
        });
        self.weld_corners(self.system.beams.len() - 1);
        self.system.beams.len() - 1
    }

    /// Adds a node; its section is turned from `triad` as `station` and the pretwist say.
    fn add_node(&mut self, design: &BeamDesign, station: &Station, triad: &Triad, velocity: &Vec3) {
        let (start, spin) = (self.q.len(), design.angular_velocity);
        let theta = design.pretwist * station.fraction + station.turn + design.section_at(station.fraction).twist;
        let mut push = |place: &Vec3, velocity: &Vec3| {
            self.q.extend(place);
            self.velocity.extend(velocity);
        };
        push(&station.place, velocity);
        push(&station.tangent, &spin.cross(&station.tangent));
        self.system.mesh.nodes.push(match design.elements {
            Elements::Ancf14 { .. } => {
                self.q.push(theta);
                self.velocity.push(spin.dot(&station.tangent));
                self.triads.push(*triad);
                self.frames.push(NodeFrame::new(&self.q[start..], triad));
                self.system.mesh.framed.push(start);
                Node::Ancf14 { start, frame: self.triads.len() - 1 }
            }
            Elements::Ancf24 { .. } => {
                let (sin, cos) = sin_cos(theta);
                let v = triad.t.cross(&triad.u);
                for axis in [triad.u * cos + v * sin, v * cos - triad.u * sin] {
                    push(&axis, &spin.cross(&axis));
                }
                Node::Ancf24 { start }
            }
        });
    }

    /// The element of length `length`, m, between two `fractions` of the beam, that begins at node `node`; where nodes
    /// have frames, with number `frame`.
    fn element(
        &mut self,
        design: &BeamDesign,
        node: usize,
        frame: usize,
        length: f64,
        fractions: [f64; 2],
    ) -> AnyElement {
        let mesh = &mut self.system.mesh;
        let start = mesh.nodes[node].coordinates().start;
        let reference = &self.q[start..mesh.nodes[node + 1].coordinates().end];
        match design.elements {
            Elements::Ancf14 { strain, twist, torsion } => {
                let place = ancf14::element::Place { start, frame, branch: mesh.branches };
                mesh.branches += 1;
                self.holonomy.push(0.0);
                let stiffness = design.stiffness(strain, twist, torsion);
                let (densities, frames) = (design.densities(), [frame, frame + 1].map(|frame| &self.frames[frame]));
                // The holonomy of the drawing is 0: triads go from node to node by one minimal rotation.
                let element =
                    ancf14::element::Element::new(place, length, stiffness, densities, reference, frames, 0.0);
                let element = match design.along(fractions, strain, twist, torsion) {
                    Some(along) => element.with_sections(along, reference, frames, 0.0),
                    None => element.with_rotary_inertia(design.mass_moments()),
                };
                let mut element = element.prestressed(&design.prestress);
                element.tension_damping = design.tension_damping;
                if let Some(AnyElement::Ancf14(before)) = mesh.elements.last() {
                    element.share(before);
                }
                AnyElement::Ancf14(element)
            }
            Elements::Ancf24 { poisson, shear } => {
                let properties = design.properties(poisson, shear);
                let reference = std::array::from_fn(|index| reference[index]);
                AnyElement::Ancf24(Box::new(ancf24::element::Element::new(start, length, properties, &reference)))
            }
        }
    }

    /// Makes the section of a marker at a node rigid, if it is not by its formulation: what acts there acts on all of
    /// it.
    pub fn stiffen(&mut self, marker: &Marker) {
        let Marker::Node { node, .. } = marker else { return };
        let Node::Ancf24 { start } = self.system.mesh.nodes[*node] else { return };
        if self.stiff_nodes.len() <= *node {
            self.stiff_nodes.resize(node + 1, false);
        }
        if !std::mem::replace(&mut self.stiff_nodes[*node], true) {
            let name = format!("the section at {}", self.system.describe_node(*node));
            self.inner_joints.push(rigidity::section_rigidity(name, start));
        }
    }

    /// Welds the two nodes at each corner of a beam.
    fn weld_corners(&mut self, beam: usize) {
        for place in 0..self.system.beams[beam].corners.len() {
            let beam = &self.system.beams[beam];
            let end = beam.corners[place];
            let (name, node) = (format!("the corner {}.node[{end}]", beam.name), beam.node(end));
            let [a, b] = [node, node + 1].map(|node| {
                let section = self.node(node);
                self.stiffen(&section);
                // The global axes as drawn, as the section sees them.
                let axes = self.drawn(&section).axes.transpose();
                Marker::Node { node, offset: Vec3::zeros(), axes }
            });
            self.inner_joints.push(Joint {
                name,
                a,
                b,
                primitives: weld::PRIMITIVES,
                drive: None,
                gear: None,
                slide: None,
                holding: None,
            });
        }
    }

    /// The first element of beam `beam` whose undeformed shape has no meaning, if there is one.
    pub fn impossible_element(&self, beam: usize) -> Option<usize> {
        let elements = &self.system.mesh.elements[self.system.beams[beam].element_range()];
        elements.iter().position(|element| !element.is_possible())
    }

    /// The node of beam `beam` at the fraction `fraction` of its length, if there is one; at a corner the side towards
    /// the start.
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
        Marker::section(beam.first_element + element, xi)
    }

    /// Along a whole beam: where a load per length acts.
    pub fn along(&self, beam: usize) -> Site {
        Site::Line(self.system.beams[beam].element_range())
    }

    /// Adds a rigid body and returns its number. The design is sound: positive mass, a possible inertia, orthonormal
    /// axes.
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
        self.prescribed.frames.push(frame.start(self.drawing, &target));
        self.targets.frames.push(target);
        self.system.moving_frames.push(frame);
        self.system.moving_frames.len() - 1
    }

    /// The marker at a node, with the section's axes.
    pub fn node(&self, node: usize) -> Marker {
        Marker::Node { node, offset: Vec3::zeros(), axes: Mat3::identity() }
    }

    /// The marker at the center of mass of body `body`, with the body's axes.
    pub fn body(&self, body: usize) -> Marker {
        self.system.bodies[body].marker()
    }

    /// The marker at the origin of frame `frame`, with its axes.
    pub fn frame(&self, frame: usize) -> Marker {
        Marker::Frame { frame, offset: Vec3::zeros(), axes: Mat3::identity() }
    }

    /// The marker at `pose`, in space as drawn, that is tied to whatever `anchor` is tied to: a node, a body, a frame,
    /// the ground.
    ///
    /// What is tied to a node makes its section rigid.
    pub fn tied(&mut self, anchor: &Marker, pose: &Pose) -> Marker {
        self.stiffen(anchor);
        let own = self.drawn(&anchor.bare());
        let (offset, axes) = own.relative(pose);
        match anchor.bare() {
            Marker::Node { node, .. } => Marker::Node { node, offset, axes },
            Marker::Body { start, .. } => Marker::Body { start, offset, axes },
            Marker::Frame { frame, .. } => Marker::Frame { frame, offset, axes },
            Marker::Ground(_) | Marker::Section { .. } => Marker::Ground(*pose),
        }
    }

    /// Position and axes of a marker as drawn.
    pub fn drawn(&self, marker: &Marker) -> Pose {
        marker.pose(&self.configuration())
    }

    /// Adds a joint and returns its number.
    pub fn add_joint(&mut self, joint: Joint) -> usize {
        self.system.joints.push(joint);
        self.system.joints.len() - 1
    }

    /// Adds a relative coordinate and returns its number.
    pub fn add_relative_coordinate(&mut self, a: Marker, b: Marker, measure: Measure) -> usize {
        self.system.relative_coordinates.push(RelativeCoordinate { a, b, measure });
        self.system.relative_coordinates.len() - 1
    }

    /// Adds a spring and returns its number.
    pub fn add_spring(&mut self, spring: Spring) -> usize {
        let remembers = spring.law.as_ref().is_some_and(|law| law.dry().is_some());
        let memory = remembers.then_some(self.memory);
        self.memory += usize::from(remembers);
        self.system.springs.push(Spring { memory, ..spring });
        self.system.springs.len() - 1
    }

    /// Adds what a joint of the model file consists of.
    pub fn add_joint_parts(&mut self, parts: JointParts) {
        self.system.joint_parts.push(parts);
    }

    /// What the joints of the model file consist of so far, in file order.
    pub fn joint_parts(&self) -> &[JointParts] {
        &self.system.joint_parts
    }

    /// Adds spring `spring` to what joint `joint` of the model file consists of.
    pub fn add_spring_of(&mut self, joint: usize, spring: usize) {
        self.system.joint_parts[joint].springs.push(spring);
    }

    /// Adds an actuator and returns its number.
    pub fn add_actuator(&mut self, actuator: Actuator) -> usize {
        self.system.actuators.push(actuator);
        self.targets.efforts.push(HostEffort::default());
        self.system.actuators.len() - 1
    }

    /// Adds actuator `actuator` to what joint `joint` of the model file consists of.
    pub fn add_actuator_of(&mut self, joint: usize, actuator: usize) {
        self.system.joint_parts[joint].actuators.push(actuator);
    }

    /// The elements of beam `beam`.
    pub fn elements_of(&self, beam: usize) -> Range<usize> {
        self.system.beams[beam].element_range()
    }

    /// Adds a load.
    pub fn add_load(&mut self, load: Load) {
        self.system.loads.push(load);
        self.targets.loads.push(HostWrench::default());
    }

    /// Largest extent of nodes, bodies and joints as drawn, m, or of a body's own size; 1 of nothing at all.
    fn extent(&self) -> f64 {
        let configuration = self.configuration();
        let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        let nodes = self.system.mesh.nodes.iter().map(|node| node.place(&self.q));
        let bodies = self.system.bodies.iter().map(|body| vec3(&self.q, body.start));
        let joints = self.system.joints.iter().map(|joint| joint.b.pose(&configuration).place);
        for place in nodes.chain(bodies).chain(joints) {
            low = low.inf(&place);
            high = high.sup(&place);
        }
        let gyration = |body: &RigidBody| (body.director_inertia.iter().sum::<f64>() / body.mass).sqrt();
        let size = self.system.bodies.iter().map(gyration).fold((high - low).norm(), f64::max);
        if size.is_finite() && size > 0.0 { size } else { 1.0 }
    }

    fn configuration(&self) -> Configuration<'_> {
        let (frames, holonomy) = (&self.frames[..], &self.holonomy[..]);
        Configuration {
            beams: BeamConfiguration { q: &self.q, frames, holonomy, heats: &self.prescribed.heats, drives: &[] },
            relative_values: &[],
            accepted: (&self.q, &self.prescribed),
            memory: &[],
            prescribed: &self.prescribed,
            mesh: &self.system.mesh,
        }
    }

    /// The system and its state as drawn: velocities as given, momenta and multipliers still zero, drives at zero.
    pub fn finish(self, gravity: Vec3) -> (System, State) {
        let size = self.extent();
        let Self {
            mut system,
            start,
            q,
            velocity,
            triads,
            inner_joints,
            drive_joints,
            lock_joints,
            gear_joints,
            mut prescribed,
            mut targets,
            memory,
            ..
        } = self;
        system.size = size;
        system.gravity = gravity;
        // A list that doubled as it grew may be half empty.
        system.mesh.shrink_to_fit();
        // Behind the joints of the file, which keep their numbers.
        system.joints.extend(inner_joints);
        system.joints.extend(system.bodies.iter().map(RigidBody::rigidity));
        system.joints.extend(drive_joints);
        system.joints.extend(lock_joints);
        system.joints.extend(gear_joints);
        let mut memory = vec![0.0; memory];
        system.set_stations(&mut memory);
        system.collect_breaks();
        system.find_held_nodes();
        system.find_inner_parts();
        system.set_spread(&q);
        system.set_masses();
        // As drawn, every drive is at zero: what it prescribes at the start is for the start to reach.
        prescribed.drives = vec![Jet::constant(0.0); system.drives.len()];
        prescribed.holds = system.holds_at(start, &targets).map(Hold::drawn).collect();
        targets.depart(start, &prescribed);
        let (coordinates, conditions) = (q.len(), system.constraints());
        let lists = Lists {
            q,
            velocity,
            momentum: vec![0.0; coordinates],
            multipliers: vec![0.0; conditions],
            constraint_momenta: vec![0.0; conditions],
            memory,
            strain_rates: vec![0.0; system.mesh.strains() + system.relative_coordinates.len()],
            ..Lists::default()
        };
        let mut state = State {
            time: start,
            lists,
            triads,
            holonomy: vec![0.0; system.mesh.branches],
            rotations: vec![Vec3::zeros(); system.sensors.len()],
            prescribed,
            targets,
            ..State::default()
        };
        state.relative_values = system.drawn_values(&state);
        (system, state)
    }
}
