//! `[stop.NAME]`: elastic stops of a free coordinate of a joint.

use super::actuator::{Action, on_joint};
use super::joint::{Coordinate, JointSpec};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;

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
    /// Reads a section; `joints` are those of the file that could be read.
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>, joints: &[JointSpec]) -> Option<Self> {
        let (action, coordinate) = on_joint(&mut reader, joints, "the joint that the stop limits");
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let [lower, upper, stiffness, damping] = match coordinate {
            Coordinate::Angle => {
                [&schema::LOWER_ANGLE, &schema::UPPER_ANGLE, &schema::ANGLE_STOP_STIFFNESS, &schema::ANGLE_STOP_DAMPING]
            }
            Coordinate::Distance => {
                [&schema::LOWER_DISTANCE, &schema::UPPER_DISTANCE, &schema::STOP_STIFFNESS, &schema::STOP_DAMPING]
            }
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
