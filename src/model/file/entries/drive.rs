//! `[drive.NAME]`: prescribes a free coordinate of a joint.

use super::Parts;
use super::joint::{self, Coordinate, JointKind, JointSpec};
use super::switch::{ACTIVE, SwitchSpec};
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::input::{REACHED, make_input};
use crate::model::file::schema::{Key, Role, Rule, words_of};
use crate::model::text::diagnostic::{Place, Report};
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("joint", Role::Name("joint"), "the joint that it moves"),
    Key::word("coordinate", &words_of(&Coordinate::WORDS), "the coordinate of the joint"),
    Key::number(&[&ANGLE, &DISTANCE]),
    Key::number(&[&ANGLE_RATE, &DISTANCE_RATE]),
    Key::number(&[&ACTIVE]),
    Key::word("input", &words_of(&INPUTS), "what the host gives"),
];

const ANGLE: Rule = Rule::new("value", "angle that the drive prescribes", "rad").in_time();
const DISTANCE: Rule = Rule::new("value", "distance that the drive prescribes", "m").in_time();
const ANGLE_RATE: Rule = Rule::new("rate", "rate of the angle that the drive prescribes", "rad/s").in_time();
const DISTANCE_RATE: Rule = Rule::new("rate", "rate of the distance that the drive prescribes", "m/s").in_time();

/// A section `[drive.NAME]`.
#[derive(Clone, Debug)]
pub struct DriveSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Place in the list of joints.
    pub joint: usize,
    /// The coordinate of the joint: the joint has it.
    pub coordinate: Coordinate,
    /// What is prescribed.
    pub motion: Motion,
    /// true: the host gives it; the number is the start value.
    pub input: bool,
    /// What engages and releases it; none: it always drives.
    pub switch: Option<SwitchSpec>,
}

/// What a drive prescribes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// The coordinate itself, rad or m; may change in time.
    Value(Number),
    /// Its rate, rad/s or m/s; may change in time. The coordinate is its integral, from 0 at t = 0.
    Rate(Number),
}

impl Motion {
    /// The number of either.
    pub fn number(self) -> Number {
        let (Self::Value(number) | Self::Rate(number)) = self;
        number
    }
}

/// What the host gives, a word of `input`.
#[derive(Clone, Copy, PartialEq)]
enum Word {
    Value,
    Rate,
    Active,
}

const INPUTS: [(&str, Word); 3] = [("value", Word::Value), ("rate", Word::Rate), ("active", Word::Active)];

impl Word {
    /// The rule of the key of this word.
    fn rule(self, coordinate: Coordinate) -> &'static Rule {
        match (self, coordinate) {
            (Self::Value, Coordinate::Angle) => &ANGLE,
            (Self::Value, Coordinate::Distance) => &DISTANCE,
            (Self::Rate, Coordinate::Angle) => &ANGLE_RATE,
            (Self::Rate, Coordinate::Distance) => &DISTANCE_RATE,
            (Self::Active, _) => &ACTIVE,
        }
    }
}

impl DriveSpec {
    /// Whether it prescribes an angle, not a distance.
    pub fn is_angle(&self) -> bool {
        self.coordinate == Coordinate::Angle
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let joint = reader.reference("joint", Kind::Joint);
        let place = reader.place_of("coordinate");
        let coordinate = reader.word("coordinate", &Coordinate::WORDS, None);
        // Without the coordinate nobody knows what the numbers are.
        let Some(coordinate) = coordinate else {
            reader.abandon();
            return None;
        };
        let driven = joint.and_then(|joint| reader.context.names.name(Kind::Joint, joint));
        if let Some(driven) = parts.joints.iter().find(|joint| Some(joint.name.as_str()) == driven) {
            check_coordinate(&mut reader, coordinate, place, driven);
        }
        let has_input = reader.has("input");
        let word = if has_input { reader.word("input", &INPUTS, None) } else { None };
        let switch = SwitchSpec::read(&mut reader, word == Some(Word::Active));
        let motion = match word {
            None if has_input => unclear(&mut reader, coordinate),
            None | Some(Word::Active) => written(&mut reader, coordinate),
            Some(word) => Some(given(&mut reader, coordinate, word)),
        };
        let input = matches!(word, Some(Word::Value | Word::Rate));
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, joint: joint?, coordinate, motion: motion?, input, switch })
    }

    /// Reports every drive of a coordinate that another one before it drives already.
    pub(in crate::model) fn report_doubles(drives: &[Self], report: &mut Report<'_>) {
        for (k, drive) in drives.iter().enumerate() {
            // Of two that let go one may follow the other.
            let same = |other: &&Self| {
                let may_alternate = drive.switch.is_some() && other.switch.is_some();
                (other.joint, other.coordinate) == (drive.joint, drive.coordinate) && !may_alternate
            };
            let Some(first) = drives[..k].iter().find(same) else { continue };
            let message = format!("two drives prescribe the {} of the same joint", drive.coordinate.word());
            let label = format!("line {} has the drive {}", report.source.line(first.place), first.name);
            report.error(drive.place, &message, &label, "");
        }
    }
}

/// Reports a coordinate that a joint does not have.
pub(super) fn check_coordinate(reader: &mut Reader<'_, '_>, coordinate: Coordinate, place: Place, joint: &JointSpec) {
    let known = joint.kind.coordinates();
    if known.contains(&coordinate) {
        return;
    }
    let message = format!("the {} joint {} has no {}", joint.kind.word(), joint.name, coordinate.word());
    let help = match joint.kind {
        JointKind::Slide => "to move it along the beam, join b to a moving [frame.NAME] by a joint of type inplane",
        _ => joint::COORDINATES,
    };
    reader.context.report.error(place, &message, &Coordinate::listing(known), help);
}

/// `value` or `rate`, as the file has it.
fn written(reader: &mut Reader<'_, '_>, coordinate: Coordinate) -> Option<Motion> {
    if let Some(value) = reader.optional(Word::Value.rule(coordinate)) {
        reader.exclude("rate", "value");
        return Some(Motion::Value(value));
    }
    let rate = reader.optional(Word::Rate.rule(coordinate)).map(Motion::Rate);
    if rate.is_none() {
        reader.missing("value", "or `rate`, or input = \"value\" or \"rate\": the host gives it");
    }
    rate
}

/// Which of `value` and `rate` belongs here is unknown: neither is reported.
fn unclear(reader: &mut Reader<'_, '_>, coordinate: Coordinate) -> Option<Motion> {
    for word in [Word::Value, Word::Rate] {
        reader.optional(word.rule(coordinate));
    }
    None
}

/// `value` or `rate`, as the host gives it: the file has its start value, default 0.
fn given(reader: &mut Reader<'_, '_>, coordinate: Coordinate, word: Word) -> Motion {
    let number = reader.number_or(word.rule(coordinate), 0.0);
    for other in [Word::Value, Word::Rate].into_iter().filter(|other| *other != word) {
        let other = other.rule(coordinate).key;
        let own = word.rule(coordinate).key;
        let message = format!("{} has an input and a {other}", reader.title);
        reader.refuse(
            other,
            &message,
            &format!("with input = \"{own}\", only `{own}` is allowed; it sets the start value"),
        );
    }
    make_input(reader.context, number);
    reader.context.numbers.slots[number.0].meta.description.push_str(&format!(", {REACHED}"));
    match word {
        Word::Rate => Motion::Rate(number),
        Word::Value | Word::Active => Motion::Value(number),
    }
}
