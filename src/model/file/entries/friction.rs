//! `[friction.NAME]`: friction on a free coordinate of a joint.

use super::actuator::{Action, on_joint};
use super::joint::{Coordinate, JointSpec};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;

/// A section `[friction.NAME]`.
#[derive(Clone, Debug)]
pub struct FrictionSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it acts on: a joint.
    pub action: Action,
    /// Friction at high speed, N or N m.
    pub coulomb: Number,
    /// What grows with the rate, N s/m or N m s/rad.
    pub viscous: Number,
    /// The rate at which it has 71 % of `coulomb`, m/s or rad/s.
    pub speed: Number,
}

/// Default of `speed`, m/s or rad/s.
const SPEED: f64 = 1e-3;

impl FrictionSpec {
    /// Reads a section; `joints` are those of the file that could be read.
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>, joints: &[JointSpec]) -> Option<Self> {
        let (action, coordinate) = on_joint(&mut reader, joints, "the joint that the friction acts on");
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let [coulomb, viscous, speed] = match coordinate {
            Coordinate::Angle => [&schema::COULOMB_TORQUE, &schema::VISCOUS_TORQUE, &schema::FRICTION_ANGLE_RATE],
            Coordinate::Distance => [&schema::COULOMB_FORCE, &schema::VISCOUS_FORCE, &schema::FRICTION_RATE],
        };
        let coulomb = reader.number(coulomb);
        let viscous = reader.number_or(viscous, 0.0);
        let speed = reader.number_or(speed, SPEED);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, coulomb, viscous, speed })
    }
}
