//! `[actuator.NAME]`: a torque or a force on a free coordinate of a joint, or a force along the line between two
//! points.

use super::Parts;
use super::drive::check_coordinate;
use super::joint::{Coordinate, JointSpec};
use super::reading::Reading;
use crate::model::file::number::{Number, Written};
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Anchor, SIDES};
use crate::model::file::reader::input::{HELD, make_input};
use crate::model::file::schema::{Key, PLACES, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("joint", Role::Name("joint"), "the joint that it acts on"),
    Key::word("coordinate", &words_of(&Coordinate::WORDS), "the coordinate of the joint"),
    Key::name("a", Role::Name(PLACES), "the first of two points, instead of a joint"),
    Key::name("b", Role::Name(PLACES), "the second of two points"),
    Key::number(&[&TORQUE, &THRUST]),
    Key::flag("input", "true: the host gives the effort"),
];

const TORQUE: Rule =
    Rule::new("effort", "torque of the actuator on side b about the axis", "N.m").tunable().in_control();
const THRUST: Rule =
    Rule::new("effort", "force of the actuator on side b, away from side a", "N").tunable().in_control();

/// A section `[actuator.NAME]`.
#[derive(Clone, Debug)]
pub struct ActuatorSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it acts on.
    pub action: Action,
    /// Its torque, N m, or force, N; may change in time.
    pub effort: Number,
    /// true: the host gives it; the number is the start value.
    pub input: bool,
}

/// What an actuator acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// A free coordinate of a joint, which the joint has.
    Joint {
        /// Place in the list of joints.
        joint: usize,
        /// Which of its coordinates.
        coordinate: Coordinate,
    },
    /// The distance between two points: a positive effort pushes them apart.
    Between {
        /// The first point.
        a: Anchor,
        /// The second point.
        b: Anchor,
    },
}

impl Action {
    /// The coordinate that it is: a distance between two points.
    pub fn coordinate(self) -> Coordinate {
        match self {
            Self::Joint { coordinate, .. } => coordinate,
            Self::Between { .. } => Coordinate::Distance,
        }
    }

    /// The joint whose coordinate it is.
    pub fn joint(self) -> Option<usize> {
        match self {
            Self::Joint { joint, .. } => Some(joint),
            Self::Between { .. } => None,
        }
    }
}

impl ActuatorSpec {
    /// The coordinate that its effort works on: a distance between two points.
    pub fn coordinate(&self) -> Coordinate {
        self.action.coordinate()
    }

    /// The joint that it acts on.
    pub fn joint(&self) -> Option<usize> {
        self.action.joint()
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let (action, coordinate) = if reader.has("a") || reader.has("b") {
            between(&mut reader)
        } else {
            on_joint(&mut reader, &parts.joints, ON)
        };
        // Without the coordinate nobody knows what the effort is.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let rule = match coordinate {
            Coordinate::Angle => &TORQUE,
            Coordinate::Distance => &THRUST,
        };
        let input = reader.boolean("input", false);
        let effort = if input {
            let number = reader.number_or(rule, 0.0);
            make_input(reader.context, number);
            reader.context.numbers.slots[number.0].meta.description.push_str(&format!(", {HELD}"));
            number
        } else if let Some(number) = reader.optional(rule) {
            number
        } else {
            reader.missing(
                "effort",
                "a number, an expression in t and coordinates of joints, or input = true: the host gives it",
            );
            reader.finish();
            return None;
        };
        report_readings(&mut reader, effort, &parts.joints);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, effort, input })
    }
}

/// Reports coordinates in an effort that their joints do not have, or that mean nothing once these are released.
fn report_readings(reader: &mut Reader<'_, '_>, effort: Number, joints: &[JointSpec]) {
    let slot = &reader.context.numbers.slots[effort.0];
    let Written::Formula(formula) = &slot.written else { return };
    let place = slot.place;
    for reading in formula.readings().into_iter().map(Reading::of) {
        let known = reader.context.names.name(Kind::Joint, reading.joint);
        let Some(joint) = joints.iter().find(|joint| Some(joint.name.as_str()) == known) else { continue };
        check_coordinate(reader, reading.coordinate, place, joint);
        if joint.switch.is_some() {
            let message = format!("{} reads a coordinate of joint {}, which may be released", reader.title, joint.name);
            let label = "the coordinate means nothing once the joint is released";
            reader.context.report.error(place, &message, label, "");
        }
    }
}

const ON: &str = "the joint that the actuator acts on, or `a` and `b`, the points that it pushes apart";

/// The two points; the coordinate is known in any case.
pub(super) fn between(reader: &mut Reader<'_, '_>) -> (Option<Action>, Option<Coordinate>) {
    if reader.has("joint") {
        // One mistake: the coordinate belongs to the joint.
        reader.set_aside("coordinate");
    }
    reader.exclude("joint", "a");
    reader.exclude("coordinate", "a");
    let a = Anchor::read(reader, "a", &SIDES);
    let b = Anchor::read(reader, "b", &SIDES);
    Anchor::expect_way(reader, a, b);
    (a.zip(b).map(|(a, b)| Action::Between { a, b }), Some(Coordinate::Distance))
}

/// The joint and its coordinate; `wanted` says which joint belongs there.
pub(super) fn on_joint(
    reader: &mut Reader<'_, '_>,
    joints: &[JointSpec],
    wanted: &str,
) -> (Option<Action>, Option<Coordinate>) {
    if !reader.has("joint") {
        reader.missing("joint", wanted);
        return (None, None);
    }
    let joint = reader.reference("joint", Kind::Joint);
    let place = reader.place_of("coordinate");
    let Some(coordinate) = reader.word("coordinate", &Coordinate::WORDS, None) else { return (None, None) };
    let known = joint.and_then(|joint| reader.context.names.name(Kind::Joint, joint));
    if let Some(known) = joints.iter().find(|joint| Some(joint.name.as_str()) == known) {
        check_coordinate(reader, coordinate, place, known);
    }
    (joint.map(|joint| Action::Joint { joint, coordinate }), Some(coordinate))
}
