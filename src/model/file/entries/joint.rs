//! `[joint.NAME]`: holds two points together, all but some relative motions.

use super::Parts;
use super::switch::{ACTIVE, SwitchSpec};
use crate::mechanics::marker::relative_coordinate::Measure;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Anchor, SIDES, Spot};
use crate::model::file::schema::{Key, PLACES, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::word("type", &words_of(&KINDS), "the motions that it leaves free"),
    Key::name("a", Role::Name(PLACES), "the first side: the axis is fixed in it"),
    Key::name("b", Role::Name(PLACES), "the second side"),
    Key::global(&[&AT], Role::Position),
    Key::global(&[&AXIS], Role::Direction),
    Key::global(&[&AXIS2], Role::Direction),
    Key::on_axes(&[&DISTANCE_STIFFNESS, &ANGLE_STIFFNESS, &BUSHING_STIFFNESS]),
    Key::on_axes(&[&DISTANCE_DAMPING, &ANGLE_DAMPING, &BUSHING_DAMPING]),
    Key::on_axes(&[&ROTATIONAL_STIFFNESS]),
    Key::on_axes(&[&ROTATIONAL_DAMPING]),
    Key::number(&[&ACTIVE]),
    Key::flag("input", "true: the host gives `active`"),
];

const AT: Rule = Rule::new("at", "place of the joint as drawn, global", "m");
const AXIS: Rule = Rule::new("axis", "axis of the joint as drawn, global", "");
const AXIS2: Rule = Rule::new("axis2", "second axis of the joint as drawn, global", "");
pub(super) const ANGLE_STIFFNESS: Rule =
    Rule::new("stiffness", "stiffness of the angle", "N.m/rad").from(0.0).tunable();
pub(super) const ANGLE_DAMPING: Rule = Rule::new("damping", "damping of the angle", "N.m.s/rad").from(0.0).tunable();
pub(super) const DISTANCE_STIFFNESS: Rule =
    Rule::new("stiffness", "stiffness of the distance", "N/m").from(0.0).tunable();
pub(super) const DISTANCE_DAMPING: Rule = Rule::new("damping", "damping of the distance", "N.s/m").from(0.0).tunable();
const BUSHING_STIFFNESS: Rule =
    Rule::new("stiffness", "stiffness along the global axis as drawn", "N/m").from(0.0).tunable();
const BUSHING_DAMPING: Rule =
    Rule::new("damping", "damping along the global axis as drawn", "N.s/m").from(0.0).tunable();
const ROTATIONAL_STIFFNESS: Rule =
    Rule::new("rotational_stiffness", "stiffness against turning", "N.m/rad").from(0.0).tunable();
const ROTATIONAL_DAMPING: Rule =
    Rule::new("rotational_damping", "damping of the turning", "N.m.s/rad").from(0.0).tunable();

/// A section `[joint.NAME]`.
#[derive(Clone, Debug)]
pub struct JointSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it leaves free.
    pub kind: JointKind,
    /// The first side: an axis is fixed in it.
    pub a: Anchor,
    /// The second side.
    pub b: Anchor,
    /// Its position as drawn, global, m; default: that of b, of a where b is the ground.
    pub at: Option<[Number; 3]>,
    /// Its axis as drawn, global; there exactly where the kind has one. Of an inplane joint the normal of the plane.
    pub axis: Option<[Number; 3]>,
    /// The axis that is fixed in b, as drawn, global; there exactly for a universal joint.
    pub axis2: Option<[Number; 3]>,
    /// Spring and damper on its angle; there exactly where the kind has one.
    pub angle: Option<SpringDamper>,
    /// Spring and damper on its distance; there exactly where the kind has one.
    pub distance: Option<SpringDamper>,
    /// What holds the sides of a bushing together; there exactly for a bushing.
    pub bushing: Option<Bushing>,
    /// What engages and releases it; none: it always holds.
    pub switch: Option<SwitchSpec>,
}

/// A spring and a damper on a free coordinate, at rest as drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpringDamper {
    /// N m/rad, or N/m.
    pub stiffness: Number,
    /// N m s/rad, or N s/m.
    pub damping: Number,
}

/// Springs and dampers along the global axes as drawn, fixed in a, and about them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bushing {
    /// Against displacement, N/m.
    pub stiffness: [Number; 3],
    /// Against velocity, N s/m.
    pub damping: [Number; 3],
    /// Against turning, N m/rad.
    pub rotational_stiffness: [Number; 3],
    /// Against angular velocity, N m s/rad.
    pub rotational_damping: [Number; 3],
}

/// What a joint leaves free.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// Nothing.
    Weld,
    /// All turns.
    Spherical,
    /// The turn about its axis.
    Revolute,
    /// The turn about its axis and the way along it.
    Cylindrical,
    /// The way along its axis.
    Prismatic,
    /// The turns about its two axes.
    Universal,
    /// All turns, and the way along its axis.
    Inline,
    /// All turns, and the ways in the plane normal to its axis.
    Inplane,
    /// All turns, and the way along a beam.
    Slide,
    /// Everything, against springs and dampers.
    Bushing,
}

/// A coordinate that a joint leaves free: 0 as drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Coordinate {
    /// Of b relative to a, right-handed about the axis, rad.
    Angle,
    /// Of b's place from a's along the axis, m.
    Distance,
}

/// The kinds: word, kind.
const KINDS: [(&str, JointKind); 10] = [
    ("weld", JointKind::Weld),
    ("spherical", JointKind::Spherical),
    ("revolute", JointKind::Revolute),
    ("cylindrical", JointKind::Cylindrical),
    ("prismatic", JointKind::Prismatic),
    ("universal", JointKind::Universal),
    ("inline", JointKind::Inline),
    ("inplane", JointKind::Inplane),
    ("slide", JointKind::Slide),
    ("bushing", JointKind::Bushing),
];

impl JointKind {
    /// The word of the file.
    pub fn word(self) -> &'static str {
        KINDS.iter().find(|(_, kind)| *kind == self).map_or("", |(word, _)| word)
    }

    /// Whether the joint has an axis.
    pub fn has_axis(self) -> bool {
        !matches!(self, Self::Weld | Self::Spherical | Self::Slide | Self::Bushing)
    }

    /// Whether it has a second axis.
    pub fn has_second_axis(self) -> bool {
        self == Self::Universal
    }

    /// The coordinates that can be driven and measured.
    pub fn coordinates(self) -> &'static [Coordinate] {
        match self {
            Self::Revolute => &[Coordinate::Angle],
            Self::Cylindrical => &[Coordinate::Angle, Coordinate::Distance],
            Self::Prismatic | Self::Inline => &[Coordinate::Distance],
            Self::Weld | Self::Spherical | Self::Universal | Self::Inplane | Self::Slide | Self::Bushing => &[],
        }
    }
}

impl Coordinate {
    /// The words of the file.
    pub(super) const WORDS: [(&str, Self); 2] = [("angle", Self::Angle), ("distance", Self::Distance)];

    /// The word of the file.
    pub fn word(self) -> &'static str {
        match self {
            Self::Angle => "angle",
            Self::Distance => "distance",
        }
    }

    /// What there is instead of a coordinate that there is not, for messages.
    pub(super) fn listing(known: &[Self]) -> String {
        match known.iter().map(|coordinate| coordinate.word()).collect::<Vec<_>>().as_slice() {
            [] => String::from("it has no coordinate"),
            words => format!("it has: {}", words.join(", ")),
        }
    }
}

/// The kinds of joints that have a coordinate, for messages.
pub(super) const COORDINATES: &str = "angle: revolute, cylindrical; distance: cylindrical, prismatic, inline";

impl JointSpec {
    /// Its springs, with what they measure, their stiffness and their damping, in the order in which they are built.
    pub fn springs(&self) -> Vec<(Measure, [Number; 2])> {
        let coordinates = [(Measure::Angle(0), self.angle), (Measure::Distance(0), self.distance)];
        let on_coordinates = coordinates.into_iter();
        let mut springs: Vec<_> = on_coordinates
            .filter_map(|(measure, own)| own.map(|own| (measure, [own.stiffness, own.damping])))
            .collect();
        if let Some(own) = self.bushing {
            springs.extend([0, 1, 2].map(|axis| (Measure::Distance(axis), [own.stiffness[axis], own.damping[axis]])));
            let turns = [own.rotational_stiffness, own.rotational_damping];
            springs.extend([0, 1, 2].map(|axis| (Measure::Rotation(axis), turns.map(|numbers| numbers[axis]))));
        }
        springs
    }

    /// The sides that it holds at nodes of beams: a slide is anywhere on its beam.
    pub fn held(&self) -> impl Iterator<Item = Anchor> + use<> {
        let a = (self.kind != JointKind::Slide).then_some(self.a);
        a.into_iter().chain([self.b])
    }

    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let kind = reader.word("type", &KINDS, None);
        let a = Anchor::read(&mut reader, "a", &SIDES);
        let b = Anchor::read(&mut reader, "b", &SIDES);
        let at = if kind == Some(JointKind::Slide) { None } else { reader.optional_vector(&AT) };
        // Without the kind nobody knows which keys belong here.
        let Some(kind) = kind else {
            reader.abandon();
            return None;
        };
        Anchor::expect_motion(&mut reader, a, b);
        if kind == JointKind::Slide {
            expect_beam(&mut reader, a);
        }
        let axis = kind.has_axis().then(|| reader.vector(&AXIS));
        let axis2 = kind.has_second_axis().then(|| reader.vector(&AXIS2));
        let [angle, distance] = free_coordinates(&mut reader, kind);
        let bushing = (kind == JointKind::Bushing).then(|| Bushing::read(&mut reader));
        let switch = if matches!(kind, JointKind::Bushing | JointKind::Slide) {
            refuse_switch(&mut reader, kind);
            None
        } else {
            let input = reader.boolean("input", false);
            SwitchSpec::read(&mut reader, input)
        };
        refuse_rest(&mut reader, kind);
        let place = reader.place;
        reader.finish();
        let [a, b] = [a?, b?];
        Some(Self { name: name.to_owned(), place, kind, a, b, at, axis, axis2, angle, distance, bushing, switch })
    }
}

/// A slide is on a beam, and where it begins there.
fn expect_beam(reader: &mut Reader<'_, '_>, a: Option<Anchor>) {
    if let Some(anchor) = a.filter(|anchor| !matches!(anchor, Anchor { spot: Spot::Beam { .. }, point: None, .. })) {
        let message = format!("{} slides along no beam", reader.title);
        let label = "a place on a beam was expected, where it begins";
        reader.context.report.error(anchor.place, &message, label, "as in a = \"cable@0.3\", b = \"trolley\"");
    }
    let message = format!("{} has no `at`: it begins at a, a place on a beam", reader.title);
    reader.refuse("at", &message, "b is held where it meets the beam");
}

/// Spring and damper on the angle and on the distance.
fn free_coordinates(reader: &mut Reader<'_, '_>, kind: JointKind) -> [Option<SpringDamper>; 2] {
    let mut pair = |stiffness: &Rule, damping: &Rule| {
        let (stiffness, damping) = (reader.number_or(stiffness, 0.0), reader.number_or(damping, 0.0));
        Some(SpringDamper { stiffness, damping })
    };
    let mut distance = None;
    if kind.coordinates().contains(&Coordinate::Distance) {
        distance = pair(&DISTANCE_STIFFNESS, &DISTANCE_DAMPING);
    }
    let angle = match (kind.coordinates().contains(&Coordinate::Angle), distance) {
        (false, _) => None,
        (true, None) => pair(&ANGLE_STIFFNESS, &ANGLE_DAMPING),
        (true, Some(_)) => pair(&ROTATIONAL_STIFFNESS, &ROTATIONAL_DAMPING),
    };
    [angle, distance]
}

impl Bushing {
    fn read(reader: &mut Reader<'_, '_>) -> Self {
        Self {
            stiffness: reader.uniform_or_vector(&BUSHING_STIFFNESS, [0.0; 3]),
            damping: reader.uniform_or_vector(&BUSHING_DAMPING, [0.0; 3]),
            rotational_stiffness: reader.uniform_or_vector(&ROTATIONAL_STIFFNESS, [0.0; 3]),
            rotational_damping: reader.uniform_or_vector(&ROTATIONAL_DAMPING, [0.0; 3]),
        }
    }
}

/// A bushing holds by springs, which nothing releases, and a slide would engage anywhere.
fn refuse_switch(reader: &mut Reader<'_, '_>, kind: JointKind) {
    for key in ["active", "input"] {
        let message = format!("{} is a {}, which has no `{key}`", reader.title, kind.word());
        reader.refuse(key, &message, "other joints with constraints have it: take a weld, or another type");
    }
}

/// Keys of other kinds of joints: what is left of them does not belong to this one.
fn refuse_rest(reader: &mut Reader<'_, '_>, kind: JointKind) {
    let turns = "cylindrical joints and bushings have it";
    let moves = "revolute, cylindrical, prismatic and inline joints and bushings have it";
    for (key, what, label) in [
        ("axis", "axis", "all joints but welds, spherical joints, slides and bushings have one"),
        ("axis2", "second axis", "universal joints have one"),
        ("stiffness", "free coordinate for a stiffness", moves),
        ("damping", "free coordinate for a damping", moves),
        ("rotational_stiffness", "rotational stiffness", turns),
        ("rotational_damping", "rotational damping", turns),
    ] {
        let message = format!("{} has no {what}: its type is {}", reader.title, kind.word());
        reader.refuse(key, &message, label);
    }
}
