//! `[spring.NAME]`: a spring and a damper along the line between two points, or on a free coordinate of a joint.

use super::Parts;
use super::actuator::{Action, between, on_joint};
use super::joint::{ANGLE_DAMPING, ANGLE_STIFFNESS, Coordinate, DISTANCE_DAMPING, DISTANCE_STIFFNESS};
use crate::mechanics::force::law::Law;
use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::Anchor;
use crate::model::file::schema::{Key, PLACES, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use std::sync::Arc;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("a", Role::Name(PLACES), "the first end"),
    Key::name("b", Role::Name(PLACES), "the second end"),
    Key::name("joint", Role::Name("joint"), "the joint that it acts on, instead of two ends"),
    Key::word("coordinate", &words_of(&Coordinate::WORDS), "the coordinate of the joint"),
    Key::number(&[&SPRING_STIFFNESS, &DISTANCE_STIFFNESS, &ANGLE_STIFFNESS]),
    Key::number(&[&SPRING_DAMPING, &DISTANCE_DAMPING, &ANGLE_DAMPING]),
    Key::number(&[&SPRING_LENGTH]),
    Key::number(&[&REST_DISTANCE, &REST_ANGLE]),
    Key::word("only", &words_of(&ONLY), "the only side of the free length on which it acts"),
    Key::number(&[&SPRING_FORCE, &SPRING_TORQUE]),
];

const SPRING_STIFFNESS: Rule = Rule::new("stiffness", "stiffness of the spring", "N/m").from(0.0).tunable();
const SPRING_DAMPING: Rule = Rule::new("damping", "damping along the spring", "N.s/m").from(0.0).tunable();
const SPRING_LENGTH: Rule = Rule::new("length", "unstretched length of the spring", "m").from(0.0).tunable();
const REST_ANGLE: Rule = Rule::new("rest", "angle at which the spring is free of torque", "rad").tunable();
const REST_DISTANCE: Rule = Rule::new("rest", "distance at which the spring is free of force", "m").tunable();
const SPRING_FORCE: Rule =
    Rule::new("force", "tension of the spring, by its elongation x and the rate v", "N").tunable().over_elongation();
const SPRING_TORQUE: Rule =
    Rule::new("force", "torque of the spring against the angle, by its elongation x and the rate v", "N.m")
        .tunable()
        .over_elongation();

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
    /// Unstretched length, m; default: the distance of the ends as drawn. On a joint the value of the coordinate, m or
    /// rad; default 0.
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

/// The force of a spring of the system: linear, or by a law.
#[derive(Debug)]
pub struct Strength {
    /// N/m or N m/rad.
    pub stiffness: f64,
    /// N s/m or N m s/rad.
    pub damping: f64,
    /// The law that takes the place of both.
    pub law: Option<Law>,
    /// The value of the coordinate without force, m or rad; none: as drawn.
    pub rest: Option<f64>,
}

impl Strength {
    /// Linear, free of force as drawn.
    pub fn linear(stiffness: f64, damping: f64) -> Self {
        Self { stiffness, damping, law: None, rest: None }
    }

    /// A force by a law.
    pub(super) fn by(law: Law) -> Self {
        Self { law: Some(law), ..Self::linear(0.0, 0.0) }
    }
}

impl Parts {
    /// The springs of the system that the file has, in the order in which they are built: springs, friction, stops.
    /// `size` is the size of the mechanism, m.
    pub fn springs_in_system<'a>(
        &'a self,
        numbers: &'a Numbers,
        size: f64,
    ) -> impl Iterator<Item = (&'a str, Action, Strength)> {
        let springs = self.springs.iter().map(|own| (own.name.as_str(), own.action, own.strength(numbers)));
        let frictions =
            self.frictions.iter().map(move |own| (own.name.as_str(), own.action, own.strength(numbers, size)));
        let stops = self.stops.iter().map(|own| (own.name.as_str(), own.action, own.strength(numbers)));
        springs.chain(frictions).chain(stops)
    }
}

impl SpringSpec {
    /// Its force.
    pub fn strength(&self, numbers: &Numbers) -> Strength {
        let strength = match self.law {
            SpringLaw::Linear { stiffness, damping, only } => {
                let [stiffness, damping] = [stiffness, damping].map(|number| numbers.value(number));
                let sided = |sign| Strength::by(Law::OneSided { sign, stiffness, damping });
                match only {
                    None => Strength::linear(stiffness, damping),
                    Some(Only::Tension) => sided(1.0),
                    Some(Only::Compression) => sided(-1.0),
                }
            }
            SpringLaw::Function(force) => {
                let function = numbers.function(force);
                let has_rate = function.has_rate();
                let function = Arc::new(move |x, v| function.with_rate(x, v));
                Strength::by(Law::Function { function, has_rate })
            }
        };
        Strength { rest: self.rest.map(|rest| numbers.value(rest)), ..strength }
    }

    /// Its two ends; none: it acts on a joint.
    pub fn ends(&self) -> Option<[Anchor; 2]> {
        match self.action {
            Action::Between { a, b } => Some([a, b]),
            Action::Joint { .. } => None,
        }
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let is_on_joint = (reader.has("joint") || reader.has("coordinate")) && !reader.has("a") && !reader.has("b");
        let (action, coordinate) =
            if is_on_joint { on_joint(&mut reader, &parts.joints, ON) } else { between(&mut reader) };
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
                Coordinate::Angle => &REST_ANGLE,
                Coordinate::Distance => &REST_DISTANCE,
            })
        } else {
            let message = "`rest` belongs to a spring on a joint";
            reader.refuse("rest", message, "between two points, `length` is the length without force");
            reader.optional(&SPRING_LENGTH)
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, action: action?, law, rest })
    }
}

const ON: &str = "the joint that the spring acts on, or `a` and `b`, its two ends";

fn law(reader: &mut Reader<'_, '_>, coordinate: Coordinate, is_on_joint: bool) -> SpringLaw {
    let [force, stiffness, damping] = match (coordinate, is_on_joint) {
        (Coordinate::Angle, _) => [&SPRING_TORQUE, &ANGLE_STIFFNESS, &ANGLE_DAMPING],
        (_, true) => [&SPRING_FORCE, &DISTANCE_STIFFNESS, &DISTANCE_DAMPING],
        (_, false) => [&SPRING_FORCE, &SPRING_STIFFNESS, &SPRING_DAMPING],
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
