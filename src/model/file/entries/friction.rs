//! `[friction.NAME]`: friction on a free coordinate of a joint.

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
    Key::name("joint", Role::Name("joint"), "the joint that it acts on"),
    Key::word("coordinate", &words_of(&Coordinate::WORDS), "the coordinate of the joint"),
    Key::number(&[&COULOMB_TORQUE, &COULOMB_FORCE]),
    Key::number(&[&VISCOUS_TORQUE, &VISCOUS_FORCE]),
    Key::number(&[&FRICTION_ANGLE_RATE, &FRICTION_RATE]),
];

const COULOMB_TORQUE: Rule = Rule::new("coulomb", "torque of dry friction", "N.m").from(0.0).tunable();
const COULOMB_FORCE: Rule = Rule::new("coulomb", "force of dry friction", "N").from(0.0).tunable();
const VISCOUS_TORQUE: Rule = Rule::new("viscous", "friction torque per rate", "N.m.s/rad").from(0.0).tunable();
const VISCOUS_FORCE: Rule = Rule::new("viscous", "friction force per rate", "N.s/m").from(0.0).tunable();
const FRICTION_ANGLE_RATE: Rule =
    Rule::new("speed", "rate at which dry friction has 71 % of its torque", "rad/s").above(0.0).tunable();
const FRICTION_RATE: Rule =
    Rule::new("speed", "rate at which dry friction has 71 % of its force", "m/s").above(0.0).tunable();

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
    /// Its force.
    pub(super) fn strength(&self, numbers: &Numbers) -> Strength {
        let [coulomb, viscous, speed] = [self.coulomb, self.viscous, self.speed].map(|number| numbers.value(number));
        Strength::by(Law::Friction { coulomb, viscous, speed })
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let (action, coordinate) = on_joint(&mut reader, &parts.joints, "the joint that the friction acts on");
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let [coulomb, viscous, speed] = match coordinate {
            Coordinate::Angle => [&COULOMB_TORQUE, &VISCOUS_TORQUE, &FRICTION_ANGLE_RATE],
            Coordinate::Distance => [&COULOMB_FORCE, &VISCOUS_FORCE, &FRICTION_RATE],
        };
        let coulomb = reader.number(coulomb);
        let viscous = reader.number_or(viscous, 0.0);
        let speed = reader.number_or(speed, SPEED);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, coulomb, viscous, speed })
    }
}
