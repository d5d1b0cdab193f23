//! `[friction.NAME]`: friction on a free coordinate of a joint.

use super::Parts;
use super::actuator::{Action, on_joint};
use super::joint::Coordinate;
use super::spring::Strength;
use crate::mechanics::force::dry_friction::DryFriction;
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
    Key::number(&[&FRICTION_TORSION, &FRICTION_STIFFNESS]),
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
const FRICTION_TORSION: Rule =
    Rule::new("friction_stiffness", "stiffness of dry friction while it holds", "N.m/rad").above(0.0).tunable();
const FRICTION_STIFFNESS: Rule =
    Rule::new("friction_stiffness", "stiffness of dry friction while it holds", "N/m").above(0.0).tunable();

/// The elastic way of dry friction before it slides where its stiffness is not given: an angle, rad, and a share of the
/// size of the mechanism.
const STICKING_ANGLE: f64 = 1e-4;
const STICKING_SHARE: f64 = 1e-5;

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
    /// How dry friction grows to `coulomb`.
    pub growth: Growth,
}

/// How dry friction grows from rest.
#[derive(Clone, Copy, Debug)]
pub enum Growth {
    /// With the elastic way of sides that stick: stiffness, N/m or N m/rad; none: as the size of the mechanism asks
    /// for.
    Sticking(Option<Number>),
    /// With the rate: that at which it has 71 % of `coulomb`, m/s or rad/s. It creeps instead of holding.
    Rate(Number),
}

impl FrictionSpec {
    /// Its force in a mechanism of the size `size`, m.
    pub(super) fn strength(&self, numbers: &Numbers, size: f64) -> Strength {
        let [limit, viscous] = [self.coulomb, self.viscous].map(|number| numbers.value(number));
        let dry = match self.growth {
            Growth::Rate(speed) => {
                return Strength::by(Law::SmoothFriction { coulomb: limit, viscous, speed: numbers.value(speed) });
            }
            Growth::Sticking(Some(stiffness)) => DryFriction::with_stiffness(limit, numbers.value(stiffness)),
            Growth::Sticking(None) => {
                let is_angle = matches!(self.action, Action::Joint { coordinate: Coordinate::Angle, .. });
                DryFriction { limit, largest: if is_angle { STICKING_ANGLE } else { STICKING_SHARE * size } }
            }
        };
        Strength::by(Law::Friction { dry, viscous })
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let (action, coordinate) = on_joint(&mut reader, &parts.joints, "the joint that the friction acts on");
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let [coulomb, viscous, speed, stiffness] = match coordinate {
            Coordinate::Angle => [&COULOMB_TORQUE, &VISCOUS_TORQUE, &FRICTION_ANGLE_RATE, &FRICTION_TORSION],
            Coordinate::Distance => [&COULOMB_FORCE, &VISCOUS_FORCE, &FRICTION_RATE, &FRICTION_STIFFNESS],
        };
        let coulomb = reader.number(coulomb);
        let viscous = reader.number_or(viscous, 0.0);
        let growth = match reader.optional(speed) {
            Some(speed) => {
                reader.exclude("friction_stiffness", "speed");
                Growth::Rate(speed)
            }
            None => Growth::Sticking(reader.optional(stiffness)),
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, coulomb, viscous, growth })
    }
}
