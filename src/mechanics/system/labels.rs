//! What the unknowns of a system are, in words: for messages.

use crate::mechanics::beam::Beam;
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::beam::section::Section;
use crate::mechanics::body::kinematics::BODY;
use crate::mechanics::constraint::joint::Joint;
use crate::mechanics::constraint::primitive::Primitive;
use crate::mechanics::input::excitation::{HostEffort, HostWrench};
use crate::mechanics::marker::configuration::Configuration;
use crate::mechanics::marker::relative_coordinate::RelativeCoordinate;
use crate::mechanics::system::System;

impl System {
    /// What unknown `index` of the linear system is, in words: coordinates first, then constraint conditions.
    pub fn describe_unknown(&self, index: usize) -> String {
        let axis = |place: usize| ["x", "y", "z"][place];
        if index < self.mesh.coordinates() {
            let number = self.mesh.node_of(index);
            let (name, node) = (self.describe_node(number), &self.mesh.nodes[number]);
            return match index - node.coordinates().start {
                place @ 0..3 => format!("{name} (along {})", axis(place)),
                local => format!("{name} ({})", node.describe(local)),
            };
        }
        if index < self.coordinates() {
            let local = index - self.mesh.coordinates();
            let body = &self.bodies[local / BODY].name;
            return match local % BODY {
                place @ 0..3 => format!("{body} (along {})", axis(place)),
                _ => format!("{body} (turning)"),
            };
        }
        let condition = index - self.coordinates();
        let found = self.joints_with_rows().find(|(_, rows)| rows.contains(&condition));
        found.map_or_else(|| String::from("an unknown"), |(joint, _)| self.describe_joint(joint))
    }

    /// Whether unknown `index` is a spin that no result shows: that of a chain, which has no stiffness against torsion,
    /// or that of a rope about itself, which bends alike in all planes and is straight when free of stress.
    pub fn is_hidden_spin(&self, index: usize) -> bool {
        if index >= self.mesh.coordinates() {
            return false;
        }
        let number = self.mesh.node_of(index);
        let is_spin = self.mesh.nodes[number].is_spin(index);
        let owner = self.beams.iter().find(|beam| beam.node_range().contains(&number));
        let rolls = |beam: &Beam| {
            let Section { second_moment_y, second_moment_z, product_moment, .. } = beam.section;
            let is_straight = |element: &AnyElement| match element {
                AnyElement::Ancf14(element) => element.is_straight_without_stress(),
                AnyElement::PaidOut(_) | AnyElement::Ancf24(_) => false,
            };
            let alike = second_moment_y == second_moment_z && product_moment == 0.0;
            alike && self.mesh.elements[beam.element_range()].iter().all(is_straight)
        };
        is_spin && owner.is_some_and(|beam| beam.section.limp.torsion || rolls(beam))
    }

    /// A joint's name. The rigidity of a body is nobody's choice: in its stead stand the joints of the body.
    fn describe_joint(&self, joint: &Joint) -> String {
        let is_rigidity = |joint: &Joint| joint.primitives.iter().all(|part| matches!(part, Primitive::Rigid(..)));
        let own = joint.b.coordinates(&self.mesh);
        let holds = |other: &&Joint| [&other.a, &other.b].iter().any(|side| side.coordinates(&self.mesh) == own);
        let others = self.joints.iter().filter(|other| is_rigidity(joint) && !is_rigidity(other)).filter(holds);
        let names: Vec<&str> = others.map(|other| other.name.as_str()).collect();
        if names.is_empty() { joint.name.clone() } else { names.join(" or ") }
    }

    /// A node's name: `arm.start`, `arm.node[3]`, `arm.end`.
    pub fn describe_node(&self, node: usize) -> String {
        for beam in &self.beams {
            if beam.node_range().contains(&node) {
                let end = beam.end_of(node);
                return match end {
                    0 => format!("{}.start", beam.name),
                    _ if end == beam.elements() => format!("{}.end", beam.name),
                    _ => format!("{}.node[{end}]", beam.name),
                };
            }
        }
        format!("node {node}")
    }

    /// The name of coordinate `index` among the states of a linear system: `arm.node[3].slope[2]`. Directors of bodies
    /// have none.
    pub fn coordinate_name(&self, index: usize) -> String {
        if index >= self.mesh.coordinates() {
            let local = index - self.mesh.coordinates();
            return format!("{}.position[{}]", self.bodies[local / BODY].name, local % BODY + 1);
        }
        let number = self.mesh.node_of(index);
        let beam = self.beams.iter().find(|beam| beam.node_range().contains(&number));
        let label = beam.map_or_else(
            || format!("node[{number}]"),
            |beam| {
                let end = beam.end_of(number);
                // A corner has two nodes.
                let side = if beam.node(end) == number { "" } else { ".after" };
                format!("{}.node[{end}]{side}", beam.name)
            },
        );
        let node = &self.mesh.nodes[number];
        let local = index - node.coordinates().start;
        let component = local % 3 + 1;
        match local {
            0..3 => format!("{label}.position[{component}]"),
            3..6 => format!("{label}.slope[{component}]"),
            _ if node.directors().is_empty() => format!("{label}.twist"),
            _ => format!("{label}.gradient[{},{component}]", local / 3),
        }
    }

    /// The unit of that coordinate.
    pub fn coordinate_unit(&self, index: usize) -> &'static str {
        if self.is_place(index) {
            return "m";
        }
        let node = &self.mesh.nodes[self.mesh.node_of(index)];
        let is_angle = node.directors().is_empty() && node.is_turn(index - node.coordinates().start);
        if is_angle { "rad" } else { "1" }
    }

    /// The beam of element `number` and the element's number in it.
    pub fn beam_of(&self, number: usize) -> (&Beam, usize) {
        let after = self.beams.partition_point(|beam| beam.first_element <= number);
        let beam = &self.beams[after.saturating_sub(1)];
        (beam, number - beam.first_element)
    }

    /// The load, actuator, drive or frame that is not defined at `time` (s), in words, with the reason where it is
    /// known.
    pub fn undefined(&self, time: f64) -> Option<String> {
        let load = self.loads.iter().find(|load| !load.at(time, &HostWrench::default()).is_finite());
        let load = load.map(|load| format!("the force or moment of load {}", load.name));
        let actuator = self.actuators.iter().find(|actuator| !actuator.at(time, &HostEffort::default()).is_finite());
        let actuator = actuator.map(|actuator| format!("the effort of actuator {}", actuator.name));
        let heat = self.undefined_heat(time).map(|beam| format!("the temperature of beam {beam}"));
        let what = load.or(actuator).or(heat).or_else(|| self.undefined_motion(time))?;
        Some(match self.signals().find_map(|signal| signal.undefined(time)) {
            Some(reason) => format!("{what}, where {reason},"),
            None => what,
        })
    }

    /// The first spring or gear whose law is not defined at `c`, in words; `rate` is that of a coordinate, near its
    /// last accepted value.
    pub fn undefined_law(&self, c: &Configuration, rate: impl Fn(&RelativeCoordinate, f64) -> f64) -> Option<String> {
        let of_springs = self.undefined_spring(c, rate);
        of_springs.or_else(|| self.impossible_rope(c)).or_else(|| {
            self.joints.iter().find_map(|joint| {
                let side = joint.gear.as_ref().filter(|side| side.law.is_some())?;
                let x = self.relative_coordinates[side.coordinate].value(c, side.previous(c));
                (!side.part(x).is_finite())
                    .then(|| format!("the law of {} or its derivative, at x = {x:.5},", joint.name))
            })
        })
    }

    /// The first spring whose law is not defined at `c`, in words; `rate` is that of a coordinate, near its last
    /// accepted value.
    fn undefined_spring(&self, c: &Configuration, rate: impl Fn(&RelativeCoordinate, f64) -> f64) -> Option<String> {
        self.springs.iter().filter(|spring| spring.law.is_some()).find_map(|spring| {
            let coordinate = &self.relative_coordinates[spring.coordinate];
            spring.undefined(coordinate, c, rate(coordinate, c.relative_values[spring.coordinate]))
        })
    }

    /// What is not finite in the equations of `time` (s), in words.
    pub fn describe_not_finite(&self, time: f64) -> String {
        self.undefined(time).unwrap_or_else(|| String::from("a number in the equations"))
    }
}
