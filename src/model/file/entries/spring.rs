//! `[spring.NAME]`: a spring and a damper along the line between two points, or on a free coordinate of a joint.

use super::actuator::{Action, between, on_joint};
use super::joint::{Coordinate, JointSpec};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::Anchor;
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;

/// A section `[spring.NAME]`.
#[derive(Clone, Debug)]
pub struct SpringSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it acts on; the ground is the origin of the global axes.
    pub action: Action,
    /// Its law.
    pub law: SpringLaw,
    /// Unstretched length, m; default: the distance of the ends as drawn. On a joint the value of the coordinate, m or rad; default 0.
    pub rest: Option<Number>,
}

/// The law of a spring.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SpringLaw {
    /// Stiffness and damping.
    Linear {
        /// N/m or N m/rad.
        stiffness: Number,
        /// N s/m or N m s/rad.
        damping: Number,
        /// The only side on which it acts; none: both.
        only: Option<Only>,
    },
    /// A tension as a function of elongation and rate, N or N m.
    Function(Number),
}

/// The side of the free length on which a spring acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Only {
    /// It is longer.
    Tension,
    /// It is shorter.
    Compression,
}

const ONLY: [(&str, Only); 2] = [("tension", Only::Tension), ("compression", Only::Compression)];

impl SpringSpec {
    /// Its two ends; none: it acts on a joint.
    pub fn ends(&self) -> Option<[Anchor; 2]> {
        match self.action {
            Action::Between { a, b } => Some([a, b]),
            Action::Joint { .. } => None,
        }
    }

    /// Reads a section; `joints` are those of the file that could be read.
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>, joints: &[JointSpec]) -> Option<Self> {
        let is_on_joint = (reader.has("joint") || reader.has("coordinate")) && !reader.has("a") && !reader.has("b");
        let (action, coordinate) = if is_on_joint { on_joint(&mut reader, joints, ON) } else { between(&mut reader) };
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let law = law(&mut reader, coordinate, is_on_joint);
        let rest = if is_on_joint {
            let message = "`length` belongs to a spring between two points";
            reader.refuse("length", message, "on a joint, `rest` is the coordinate without force");
            reader.optional(match coordinate {
                Coordinate::Angle => &schema::REST_ANGLE,
                Coordinate::Distance => &schema::REST_DISTANCE,
            })
        } else {
            let message = "`rest` belongs to a spring on a joint";
            reader.refuse("rest", message, "between two points, `length` is the length without force");
            reader.optional(&schema::SPRING_LENGTH)
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, law, rest })
    }
}

const ON: &str = "the joint that the spring acts on, or `a` and `b`, its two ends";

fn law(reader: &mut Reader<'_, '_>, coordinate: Coordinate, is_on_joint: bool) -> SpringLaw {
    let [force, stiffness, damping] = match (coordinate, is_on_joint) {
        (Coordinate::Angle, _) => [&schema::SPRING_TORQUE, &schema::ANGLE_STIFFNESS, &schema::ANGLE_DAMPING],
        (_, true) => [&schema::SPRING_FORCE, &schema::DISTANCE_STIFFNESS, &schema::DISTANCE_DAMPING],
        (_, false) => [&schema::SPRING_FORCE, &schema::SPRING_STIFFNESS, &schema::SPRING_DAMPING],
    };
    if is_on_joint {
        let message = "`only` belongs to a spring between two points";
        reader.refuse("only", message, "a joint is held on one side by `force`, for instance max(x, 0)");
    }
    if reader.has("force") {
        ["stiffness", "damping", "only"].into_iter().for_each(|key| reader.exclude(key, "force"));
        return SpringLaw::Function(reader.number(force));
    }
    let stiffness = reader.number(stiffness);
    let damping = reader.number_or(damping, 0.0);
    let only = if reader.has("only") { reader.word("only", &ONLY, None) } else { None };
    SpringLaw::Linear { stiffness, damping, only }
}
