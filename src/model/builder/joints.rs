//! Joints, drives, actuators, gears and springs of the file as conditions, relative coordinates, actuators and springs
//! of the system.

use super::tune;
use super::{Builder, signal, vector};
use crate::math::Mat3;
use crate::math::rotation::{triad_along, triad_of};
use crate::mechanics::constraint::cylindrical;
use crate::mechanics::constraint::driven::Driven;
use crate::mechanics::constraint::gear::CamLaw;
use crate::mechanics::constraint::inline;
use crate::mechanics::constraint::inplane;
use crate::mechanics::constraint::joint::{self, Held, Holding};
use crate::mechanics::constraint::primitive::Primitive;
use crate::mechanics::constraint::prismatic;
use crate::mechanics::constraint::revolute;
use crate::mechanics::constraint::spherical;
use crate::mechanics::constraint::universal;
use crate::mechanics::constraint::weld;
use crate::mechanics::force::actuator::{Actuator, EffortGuide};
use crate::mechanics::force::effort_law::{self, EffortLaw};
use crate::mechanics::force::spring;
use crate::mechanics::geometry::pose::Pose;
use crate::mechanics::input::guide::Guide;
use crate::mechanics::input::signal::Signal;
use crate::mechanics::input::switch::{Switch, SwitchGuide};
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::mechanics::system::joint_parts::JointParts;
use crate::model::file::entries::actuator::{Action, ActuatorSpec};
use crate::model::file::entries::drive::{DriveSpec, Motion};
use crate::model::file::entries::gear::{GearSpec, Relation};
use crate::model::file::entries::joint::{Coordinate, JointKind, JointSpec};
use crate::model::file::entries::reading::Reading;
use crate::model::file::entries::spring::{SpringLaw, Strength};
use crate::model::file::entries::winch::WinchSpec;
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::{Anchor, Spot};
use std::sync::Arc;

/// How far the law of a gear may be from 0 as drawn, rad or m: below the tolerance of the constraints, above the
/// round-off of an expression.
const AS_DRAWN: f64 = 1e-9;

impl Builder<'_> {
    pub(super) fn add_joint(&mut self, written: &JointSpec) {
        if written.kind == JointKind::Slide {
            self.add_slide(written);
            return;
        }
        let sides = self.sides(written);
        let switch = written.switch.map(|own| self.add_switch(format!("joint {}", written.name), own, None));
        self.joint_switches.push(switch);
        let holding = switch.map(|switch| Holding { switch, held: Held::Pose });
        let joint = conditions(written.kind).map(|primitives| {
            let [a, b] = sides;
            let name = format!("joint {}", written.name);
            self.system.add_joint(joint::Joint {
                name,
                a,
                b,
                primitives,
                drive: None,
                gear: None,
                slide: None,
                holding,
            })
        });
        let mut coordinate = |present: bool, measure| {
            let [a, b] = sides;
            present.then(|| self.system.add_relative_coordinate(a, b, measure))
        };
        let angle = coordinate(written.angle.is_some(), Measure::Angle(0));
        let distance = coordinate(written.distance.is_some(), Measure::Distance(0));
        let mut parts = JointParts { joint, angle, distance, ..JointParts::default() };
        for (measure, numbers) in written.springs() {
            let [a, b] = sides;
            let coordinate = match measure {
                Measure::Angle(_) => angle,
                Measure::Distance(_) if distance.is_some() => distance,
                _ => None,
            };
            let coordinate = coordinate.unwrap_or_else(|| self.system.add_relative_coordinate(a, b, measure));
            // As drawn, joints are at rest.
            let [stiffness, damping] = numbers.map(|number| self.document.value(number));
            let strength = Strength::linear(stiffness, damping);
            parts.springs.push(self.spring(&written.name, coordinate, strength, 0.0));
        }
        self.system.add_joint_parts(parts);
    }

    /// A joint that slides: b is tied to the point of the beam where it begins.
    fn add_slide(&mut self, written: &JointSpec) {
        self.joint_switches.push(None);
        let Spot::Beam { beam, along } = written.a.spot else { unreachable!("a slide is on a beam") };
        let station = self.lines.fraction(self.document, beam, along).expect("a checked place on a beam");
        let place = self.system.drawn(&self.system.section_at(beam, station)).place;
        let anchored = self.anchored(&written.b);
        let b = self.system.tied(&anchored, &Pose { place, axes: Mat3::identity() });
        let joint = self.system.add_slide(&format!("joint {}", written.name), (beam, station), b);
        self.system.add_joint_parts(JointParts { joint: Some(joint), ..JointParts::default() });
    }

    /// The two sides of a joint: at its position, with its axes.
    pub(super) fn sides(&mut self, written: &JointSpec) -> [Marker; 2] {
        let document = self.document;
        let own = if written.b.is_ground() { &written.a } else { &written.b };
        let place = written.at.map_or_else(|| self.system.drawn(&self.anchored(own)).place, |at| self.position(at));
        let axis = written.axis.map(|axis| vector(document, axis));
        let axes = match (axis, written.axis2.map(|axis| vector(document, axis))) {
            (None, _) => Mat3::identity(),
            (Some(axis), None) => triad_along(&axis),
            (Some(axis), Some(axis2)) => triad_of(&axis, &axis2),
        };
        [&written.a, &written.b].map(|anchor| {
            let anchored = self.anchored(anchor);
            self.system.tied(&anchored, &Pose { place, axes })
        })
    }

    pub(super) fn add_drive(&mut self, written: &DriveSpec) {
        let document = self.document;
        let sides = self.sides(&document.joints[written.joint]);
        let driven = match written.coordinate {
            Coordinate::Angle => Driven::Angle,
            Coordinate::Distance => Driven::Distance,
        };
        let guide = self.guide(written.motion, written.input);
        let within = self.joint_switch(written.joint);
        let switch = match (written.switch, within) {
            (Some(own), _) => Some(self.add_switch(format!("drive {}", written.name), own, within)),
            (None, Some(_)) => {
                let guide = SwitchGuide::Signal(Signal::Constant(1.0));
                Some(self.system.add_switch(Switch { name: format!("drive {}", written.name), guide, within }, 0.0))
            }
            (None, None) => None,
        };
        let drive = self.system.add_drive(&written.name, sides, driven, guide, switch);
        self.system.add_drive_of(written.joint, drive);
    }

    /// Where a drive or a winch has its motion from, and its value or rate at the start, where a host gives it.
    fn guide(&self, motion: Motion, is_input: bool) -> (Guide, f64) {
        let document = self.document;
        match (motion, is_input) {
            (Motion::Value(number), false) => (Guide::Value(signal(document, number)), 0.0),
            (Motion::Rate(number), false) => (Guide::Rate(signal(document, number)), 0.0),
            (Motion::Value(number), true) => (Guide::HostValue, document.value(number)),
            (Motion::Rate(number), true) => (Guide::HostRate, document.value(number)),
        }
    }

    pub(super) fn add_winch(&mut self, written: &WinchSpec) {
        let guide = self.guide(written.motion, written.input);
        self.system.add_winch(&written.name, (written.beam, written.at_end), guide);
    }

    pub(super) fn add_actuator(&mut self, written: &ActuatorSpec) {
        let coordinate = match &written.action {
            Action::Joint { joint, coordinate } => self.coordinate(*joint, *coordinate),
            Action::Between { a, b } => self.between([a, b], &format!("actuator {}", written.name)).0,
        };
        let guide = match written.input {
            true => EffortGuide::Host,
            false => self.effort(written.effort),
        };
        let actuator = self.system.add_actuator(Actuator { name: written.name.clone(), coordinate, guide });
        if let Some(joint) = written.joint() {
            self.system.add_actuator_of(joint, actuator);
        }
    }

    /// The switch of a joint.
    pub(super) fn joint_switch(&self, joint: usize) -> Option<usize> {
        self.joint_switches.get(joint).copied().flatten()
    }

    /// The effort of an actuator, a function of time and of coordinates.
    fn effort(&self, number: Number) -> EffortGuide {
        let (own, function) = (signal(self.document, number), tune::effort(self.document, number));
        let reading = |number: usize| {
            let Reading { joint, coordinate, is_rate } = Reading::of(number);
            effort_law::Reading { coordinate: self.coordinate(joint, coordinate), is_rate }
        };
        let readings: Vec<_> = self.document.function(number).readings().into_iter().map(reading).collect();
        if readings.is_empty() {
            EffortGuide::Signal(own)
        } else {
            let has_corners = self.document.function(number).has_corners();
            EffortGuide::Law(EffortLaw { signal: own, function, readings, has_corners })
        }
    }

    /// The relative coordinate that is a coordinate of a joint.
    fn coordinate(&self, joint: usize, coordinate: Coordinate) -> usize {
        let parts = &self.system.joint_parts()[joint];
        let known = match coordinate {
            Coordinate::Angle => parts.angle,
            Coordinate::Distance => parts.distance,
        };
        known.expect("the file is refused: the joint leaves no such coordinate free")
    }

    pub(super) fn add_gear(&mut self, written: &GearSpec) {
        let coordinates = written.sides.map(|(joint, coordinate)| self.coordinate(joint, coordinate));
        let (ratio, law) = match written.relation {
            Relation::Ratio(ratio) => (self.document.value(ratio), None),
            Relation::Law(number) => (1.0, Some(self.cam_law(&written.name, number))),
        };
        let gear = self.system.add_gear(&written.name, coordinates, ratio, law);
        for ((joint, _), is_second) in written.sides.into_iter().zip([false, true]) {
            self.system.add_gear_of(joint, gear, is_second);
        }
    }

    /// The law of a gear, which must agree with the drawing.
    fn cam_law(&mut self, name: &str, number: Number) -> CamLaw {
        let function = self.document.function(number);
        let drawn = function.value(0.0);
        if drawn.is_nan() || drawn.abs() > AS_DRAWN {
            let message = format!("the law of gear {name} is {drawn} at x = 0");
            let label = "0 was expected: both coordinates are 0 as drawn";
            let help = "subtract that value from the law, or draw the mechanism where the law is 0";
            self.mistakes.push(self.document.diagnostic(self.document.place(number), &message, label, help));
        }
        CamLaw(Arc::new(move |x| function.jet(x)))
    }

    /// The distance between two points that must be apart, as a relative coordinate with its value as drawn, m.
    fn between(&mut self, [a, b]: [&Anchor; 2], title: &str) -> (usize, f64) {
        let place = b.place;
        let [a, b] = [a, b].map(|end| {
            let marker = self.anchored(end);
            self.stiffen_below(&marker);
            marker
        });
        let length = (self.system.drawn(&b).place - self.system.drawn(&a).place).norm();
        if length == 0.0 {
            let message = format!("the ends of {title} are at the same place at the start");
            let label = "another place was expected: a force along a line needs a direction";
            self.mistakes.push(self.document.diagnostic(place, &message, label, ""));
        }
        (self.system.add_relative_coordinate(a, b, Measure::Length), length)
    }

    /// Adds a spring, friction or a stop.
    pub(super) fn add_spring(&mut self, name: &str, action: Action, strength: Strength) {
        let (coordinate, drawn) = match &action {
            Action::Between { a, b } => self.between([a, b], &format!("spring {name}")),
            // A coordinate of its own: springs of the file come before joints. As drawn, joints are at 0.
            Action::Joint { joint, coordinate } => {
                let [a, b] = self.sides(&self.document.joints[*joint]);
                let measure = match coordinate {
                    Coordinate::Angle => Measure::Angle(0),
                    Coordinate::Distance => Measure::Distance(0),
                };
                (self.system.add_relative_coordinate(a, b, measure), 0.0)
            }
        };
        self.spring(name, coordinate, strength, drawn);
    }

    /// Adds the springs, friction and stops of the file that act on joints to what the joints transmit.
    pub(super) fn join_springs(&mut self) {
        let document = self.document;
        for (number, (_, action, _)) in document.springs_in_system(&document.numbers, 1.0).enumerate() {
            if let Action::Joint { joint, .. } = action {
                self.system.add_spring_of(joint, number);
            }
        }
    }

    fn spring(&mut self, name: &str, coordinate: usize, strength: Strength, drawn: f64) -> usize {
        let Strength { stiffness, damping, law, rest } = strength;
        if let Some(own) = &law
            && !own.at(0.0, 0.0).elastic.is_finite()
        {
            self.refuse_law(name);
        }
        let rest = rest.unwrap_or(drawn);
        let spring = spring::Spring {
            name: name.to_owned(),
            coordinate,
            stiffness,
            damping,
            rest,
            mobility: 0.0,
            law,
            memory: None,
        };
        self.system.add_spring(spring)
    }

    /// A law of a spring without a value as drawn.
    fn refuse_law(&mut self, name: &str) {
        let spring = self.document.springs.iter().find(|spring| spring.name == name);
        let Some(SpringLaw::Function(force)) = spring.map(|spring| spring.law) else { return };
        let message = format!("the force of spring {name} is not a finite number at x = 0");
        let label = "its energy is counted from there";
        let help = "x is the elongation: choose `length` or `rest` such that the law has a value at x = 0";
        self.mistakes.push(self.document.diagnostic(self.document.place(force), &message, label, help));
    }
}

/// The conditions of a kind of joint; a bushing has none.
fn conditions(kind: JointKind) -> Option<&'static [Primitive]> {
    match kind {
        JointKind::Weld => Some(weld::PRIMITIVES),
        JointKind::Spherical => Some(spherical::PRIMITIVES),
        JointKind::Revolute => Some(revolute::PRIMITIVES),
        JointKind::Cylindrical => Some(cylindrical::PRIMITIVES),
        JointKind::Prismatic => Some(prismatic::PRIMITIVES),
        JointKind::Universal => Some(universal::PRIMITIVES),
        JointKind::Inline => Some(inline::PRIMITIVES),
        JointKind::Inplane => Some(inplane::PRIMITIVES),
        JointKind::Slide | JointKind::Bushing => None,
    }
}
