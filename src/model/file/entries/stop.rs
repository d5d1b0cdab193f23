//! `[stop.NAME]`: elastic stops of a free coordinate of a joint.

use super::Parts;
use super::actuator::{Action, on_joint};
use super::joint::Coordinate;
use super::spring::Strength;
use crate::mechanics::force::law::Law;
use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("joint", Role::Name("joint"), "the joint that it limits"),
    Key::word("coordinate", &words_of(&Coordinate::WORDS), "the coordinate of the joint"),
    Key::number(&[&LOWER_ANGLE, &LOWER_DISTANCE]),
    Key::number(&[&UPPER_ANGLE, &UPPER_DISTANCE]),
    Key::number(&[&ANGLE_STOP_STIFFNESS, &STOP_STIFFNESS]),
    Key::number(&[&ANGLE_STOP_DAMPING, &STOP_DAMPING]),
];

const LOWER_ANGLE: Rule = Rule::new("lower", "least angle without contact", "rad").tunable();
const UPPER_ANGLE: Rule = Rule::new("upper", "largest angle without contact", "rad").tunable();
const LOWER_DISTANCE: Rule = Rule::new("lower", "least distance without contact", "m").tunable();
const UPPER_DISTANCE: Rule = Rule::new("upper", "largest distance without contact", "m").tunable();
const ANGLE_STOP_STIFFNESS: Rule = Rule::new("stiffness", "stiffness of the stop", "N.m/rad").above(0.0).tunable();
const STOP_STIFFNESS: Rule = Rule::new("stiffness", "stiffness of the stop", "N/m").above(0.0).tunable();
const ANGLE_STOP_DAMPING: Rule =
    Rule::new("damping", "share of the elastic torque per rate of penetration", "s/rad").from(0.0).tunable();
const STOP_DAMPING: Rule =
    Rule::new("damping", "share of the elastic force per rate of penetration", "s/m").from(0.0).tunable();

/// A section `[stop.NAME]`.
#[derive(Clone, Debug)]
pub struct StopSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it acts on: a joint.
    pub action: Action,
    /// The least value of the coordinate without contact, m or rad; none: it has no limit.
    pub lower: Option<Number>,
    /// The largest one.
    pub upper: Option<Number>,
    /// Stiffness of the contact, N/m or N m/rad.
    pub stiffness: Number,
    /// By how much the force is larger for each unit of the speed of penetration, s/m or s/rad.
    pub damping: Number,
}

impl StopSpec {
    /// Its force.
    pub(super) fn strength(&self, numbers: &Numbers) -> Strength {
        let limit = |number: Option<Number>, none: f64| number.map_or(none, |number| numbers.value(number));
        let limits = [limit(self.lower, f64::NEG_INFINITY), limit(self.upper, f64::INFINITY)];
        let [stiffness, damping] = [self.stiffness, self.damping].map(|number| numbers.value(number));
        Strength::by(Law::Stop { limits, stiffness, damping })
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let (action, coordinate) = on_joint(&mut reader, &parts.joints, "the joint that the stop limits");
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let [lower, upper, stiffness, damping] = match coordinate {
            Coordinate::Angle => [&LOWER_ANGLE, &UPPER_ANGLE, &ANGLE_STOP_STIFFNESS, &ANGLE_STOP_DAMPING],
            Coordinate::Distance => [&LOWER_DISTANCE, &UPPER_DISTANCE, &STOP_STIFFNESS, &STOP_DAMPING],
        };
        let (lower, upper) = (reader.optional(lower), reader.optional(upper));
        if lower.is_none() && upper.is_none() {
            reader.missing("upper", "the largest value of the coordinate, or `lower`, the least one, or both");
        }
        let stiffness = reader.number(stiffness);
        let damping = reader.number_or(damping, 0.0);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, lower, upper, stiffness, damping })
    }
}
