//! `[gear.NAME]`: the coordinates of two joints are proportional, or the first one follows the second one by a law.

use super::Parts;
use super::drive::check_coordinate;
use super::joint::{self, Coordinate, JointSpec};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("a", Role::Name("joint"), "the joint that follows"),
    Key::word("a_coordinate", &words_of(&Coordinate::WORDS), "the coordinate of joint a"),
    Key::name("b", Role::Name("joint"), "the joint that leads"),
    Key::word("b_coordinate", &words_of(&Coordinate::WORDS), "the coordinate of joint b"),
    Key::number(&[&RATIO, &RATIO_ANGLE_DISTANCE, &RATIO_DISTANCE_ANGLE]),
    Key::number(&[&LAW_OF_ANGLE, &LAW_OF_DISTANCE]),
];

const RATIO: Rule = Rule::new("ratio", "coordinate of joint a over that of joint b", "");
const RATIO_ANGLE_DISTANCE: Rule = Rule::new("ratio", "angle of joint a over the distance of joint b", "rad/m");
const RATIO_DISTANCE_ANGLE: Rule = Rule::new("ratio", "distance of joint a over the angle of joint b", "m/rad");
const LAW_OF_ANGLE: Rule =
    Rule::new("law", "angle of joint a, by the coordinate x of joint b", "rad").over_coordinate();
const LAW_OF_DISTANCE: Rule =
    Rule::new("law", "distance of joint a, by the coordinate x of joint b", "m").over_coordinate();

/// A section `[gear.NAME]`.
#[derive(Clone, Debug)]
pub struct GearSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The two joints, by their numbers, each with a coordinate that it has.
    pub sides: [(usize, Coordinate); 2],
    /// How the first coordinate follows the second one.
    pub relation: Relation,
}

/// How the coordinate of the first joint of a gear follows that of the second one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Relation {
    /// It is so many times as large; 1, rad/m or m/rad. Not 0.
    Ratio(Number),
    /// It is this function of it, rad or m.
    Law(Number),
}

/// The keys of a side: the joint, its coordinate.
const SIDES: [(&str, &str); 2] = [("a", "a_coordinate"), ("b", "b_coordinate")];

impl GearSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let [a, b] = SIDES.map(|keys| side(&mut reader, keys, &parts.joints));
        let (Some(a), Some(b)) = (a, b) else {
            // Without the coordinates nobody knows what the ratio is.
            reader.abandon();
            return None;
        };
        if a == b {
            let place = reader.place;
            let message = format!("{} connects a coordinate with itself", reader.title);
            reader.context.report.error(place, &message, "`a` and `b` are the same", "name two joints");
        }
        let relation = if reader.has("law") {
            reader.exclude("ratio", "law");
            Relation::Law(reader.number(match a.1 {
                Coordinate::Angle => &LAW_OF_ANGLE,
                Coordinate::Distance => &LAW_OF_DISTANCE,
            }))
        } else {
            Relation::Ratio(reader.number(rule(a.1, b.1)))
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, sides: [a, b], relation })
    }
}

/// A joint and its coordinate, which need not be given where the joint has one only.
fn side(
    reader: &mut Reader<'_, '_>,
    (key, coordinate_key): (&'static str, &'static str),
    joints: &[JointSpec],
) -> Option<(usize, Coordinate)> {
    let named_at = reader.place_of(key);
    let joint = reader.reference(key, Kind::Joint);
    let known = joint.and_then(|joint| reader.context.names.name(Kind::Joint, joint));
    let known = joints.iter().find(|joint| Some(joint.name.as_str()) == known);
    let place = reader.place_of(coordinate_key);
    let only = match known.map(|joint| joint.kind.coordinates()) {
        Some([only]) => Some(*only),
        _ => None,
    };
    if let (Some(known), false) = (known, reader.has(coordinate_key)) {
        if known.kind.coordinates().is_empty() {
            let message = format!("the {} joint {} has no coordinate", known.kind.word(), known.name);
            reader.context.report.error(named_at, &message, "a gear connects coordinates", joint::COORDINATES);
            return None;
        }
    } else if known.is_none() {
        reader.set_aside(coordinate_key);
        return None;
    }
    let coordinate = reader.word(coordinate_key, &Coordinate::WORDS, only)?;
    if let Some(known) = known {
        check_coordinate(reader, coordinate, place, known);
    }
    Some((joint?, coordinate))
}

/// The rule of the ratio of two coordinates.
fn rule(a: Coordinate, b: Coordinate) -> &'static Rule {
    match (a, b) {
        (Coordinate::Angle, Coordinate::Distance) => &RATIO_ANGLE_DISTANCE,
        (Coordinate::Distance, Coordinate::Angle) => &RATIO_DISTANCE_ANGLE,
        _ => &RATIO,
    }
}
