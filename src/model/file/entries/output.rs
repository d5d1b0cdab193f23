//! `[output.NAME]`: what is measured at a point, of a whole beam or body, at a body, a joint, a drive, an actuator, a
//! gear, a spring, friction, a stop, a lock or a frame, or along a beam.

use super::Parts;
use super::acting::Acting;
use super::joint::{self, Coordinate, JointKind, JointSpec};
use super::namesakes::which;
use super::section::Shape;
use super::summary::{self, FROM, SUMMARIES};
use crate::mechanics::marker::sensor::Facing;
use crate::model::file::number::Number;
use crate::model::file::quantity::{QUANTITIES, Quantity, Row, Site};
use crate::model::file::reader::anchor::{Along, Anchor, OBSERVING, Spot, WATCHED};
use crate::model::file::reader::{Reader, either, listing};
use crate::model::file::schema::{Key, PLACES, Role, Rule, words_of};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, Names, suggestion};
use crate::model::text::tree::{Item, Node};

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("at", Role::Part, "the point or the part where it measures"),
    Key::name("on", Role::Name(PLACES), "the beam along which it measures, instead of `at`"),
    Key::name("of", Role::Name(PLACES), "the beam or body that it measures as a whole, instead of `at`"),
    Key::number(&[&STATIONS]),
    Key::name("in", Role::Name(PLACES), "what the observer moves with"),
    Key::word("side", &words_of(&SIDES), "the side of a section at which something acts"),
    Key::word("quantities", &[], "what it measures: a list of words"),
    Key::word("summary", &words_of(&SUMMARIES), "what its stations give instead of columns"),
    Key::number(&[&FROM]),
];

/// The sides of a section, as seen from the start of the beam.
const SIDES: [(&str, Facing); 2] = [("before", Facing::Before), ("after", Facing::After)];

/// More stations than this are a slip of the finger: each is a row of the table of variables.
const MOST_STATIONS: f64 = 1e4;
/// A count that is no parameter.
const STATIONS: Rule =
    Rule::new("stations", "number of equally spaced points of the beam", "").from(2.0).to(MOST_STATIONS).count();

/// A section `[output.NAME]`.
#[derive(Clone, Debug)]
pub struct OutputSpec {
    /// Its name: the first part of the names of its variables.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it looks at.
    pub target: Target,
    /// Who measures it, if not somebody at rest who sees global axes.
    pub observer: Option<ObserverSpec>,
    /// The side of its sections that is measured where something acts on them.
    pub side: Facing,
    /// What is measured, in the order of the file; all of it can be measured there.
    pub quantities: Vec<Quantity>,
    /// When the range over time begins that its stations give instead of columns, s; none: they give columns.
    pub range: Option<Number>,
}

/// Somebody who moves with a part, the key `in`.
#[derive(Clone, Debug, PartialEq)]
pub struct ObserverSpec {
    /// What the observer moves with.
    pub anchor: Anchor,
    /// As it is written.
    pub name: String,
}

/// What an output looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point of a beam, a body or a frame.
    At(Anchor),
    /// A connection, which holds places together or acts on them: its kind, and its index among that kind.
    Connection(Kind, usize),
    /// A whole beam.
    On {
        /// Place in the list of beams.
        beam: usize,
        /// Number of equally spaced points, both ends included.
        stations: usize,
    },
    /// All of a beam or a body at once: its kind, and its index among that kind.
    Whole(Kind, usize),
}

impl Target {
    /// The place that it looks at; none: it looks at something else.
    pub fn anchor(&self) -> Option<&Anchor> {
        if let Self::At(anchor) = self { Some(anchor) } else { None }
    }

    /// The beam that it looks at, or a point of it, by its place in the list of beams.
    pub fn beam(&self) -> Option<usize> {
        match *self {
            Self::At(Anchor { spot: Spot::Beam { beam, .. }, .. }) | Self::On { beam, .. } => Some(beam),
            _ => None,
        }
    }

    /// The number of its sensors, which read what is not of a connection or of a whole part.
    pub fn sensors(&self) -> usize {
        match self {
            Self::At(_) => 1,
            Self::On { stations, .. } => *stations,
            _ => 0,
        }
    }
}

/// Default of `stations`.
const USUAL_STATIONS: usize = 21;

impl OutputSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, parts: &Parts) -> Option<Self> {
        let target = target(&mut reader);
        let observed = reader.has("in");
        let observer = observed.then(|| ObserverSpec::read(&mut reader)).flatten();
        let quantities = match reader.take("quantities") {
            None => {
                reader.missing("quantities", "a list like [\"position\", \"twist\"]");
                Vec::new()
            }
            Some(entry) => quantities(&mut reader, &entry.item, target, parts, observed),
        };
        if !quantities.iter().any(|quantity| quantity.has_sides()) {
            let message = "`side` belongs to section forces, section moments and strains";
            reader.refuse("side", message, "no quantity of this output has sides");
        }
        let side = reader.word("side", &SIDES, Some(Facing::default())).unwrap_or_default();
        if !matches!(target, None | Some(Target::On { .. })) {
            summary::refuse(&mut reader);
        }
        let range = summary::read(&mut reader);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, target: target?, observer, side, quantities, range })
    }

    /// The number of its sensors: also what a joint transmits is seen from one, if somebody sees it who moves.
    pub fn sensors(&self) -> usize {
        match self.target {
            Target::Connection(Kind::Joint, _) => usize::from(self.observer.is_some()),
            _ => self.target.sensors(),
        }
    }

    /// What one of its quantities is, with its axes.
    pub fn meaning(&self, quantity: Quantity) -> String {
        let meaning = match (quantity, self.target) {
            (Quantity::Power, Target::Connection(Kind::Gear, _)) => {
                "power that the gear takes from joint b and gives to joint a"
            }
            (Quantity::Effort, Target::Connection(Kind::Gear, _)) => "torque or force of the gear on side b of joint a",
            (Quantity::Power, Target::Connection(Kind::Spring, _)) => "power that the damper of the spring takes",
            (Quantity::Power, Target::Connection(Kind::Friction, _)) => "power that the friction takes",
            (Quantity::Power, Target::Connection(Kind::Stop, _)) => "power that the damping of the stop takes",
            (Quantity::Effort, Target::Connection(Kind::Friction, _)) => "torque or force of the friction on side b",
            (Quantity::Effort, Target::Connection(Kind::Stop, _)) => "torque or force of the stop on side b",
            (Quantity::Effort, Target::Connection(Kind::Lock, _)) => "torque or force of the lock on side b",
            (Quantity::ReactionForce, Target::Connection(Kind::Contact, _)) => {
                "force on the beams by what they touch, in global axes"
            }
            (Quantity::ReactionMoment, Target::Connection(Kind::Contact, _)) => {
                "moment on the beams by what they touch, about the origin of the surface, in global axes"
            }
            (Quantity::AppliedForce, Target::Connection(Kind::Contact, _)) => {
                "force of the beams on what they touch, in global axes"
            }
            (Quantity::AppliedMoment, Target::Connection(Kind::Contact, _)) => {
                "moment of the beams on what they touch, about the origin of the surface, in global axes"
            }
            (Quantity::Energy, Target::Connection(Kind::Contact, _)) => "elastic energy of the penetration",
            (Quantity::ReactionForce, Target::Connection(Kind::Foundation, _)) => {
                "force of the foundation on the beam, in global axes"
            }
            (Quantity::ReactionMoment, Target::Connection(Kind::Foundation, _)) => {
                "moment of the foundation on the beam, about the global origin, in global axes"
            }
            (Quantity::AppliedForce, Target::Connection(Kind::Foundation, _)) => {
                "force of the beam on the foundation, in global axes"
            }
            (Quantity::AppliedMoment, Target::Connection(Kind::Foundation, _)) => {
                "moment of the beam on the foundation, about the global origin, in global axes"
            }
            (Quantity::Energy, Target::Connection(Kind::Foundation, _)) => "elastic energy of the foundation",
            (Quantity::Energy, Target::Connection(Kind::Rope, _)) => "elastic energy of the rope",
            (Quantity::WrapAngle, Target::Connection(Kind::Rope, _)) => "angle that the rope runs along each sheave",
            (Quantity::Energy, Target::Connection(Kind::Joint, _)) => "elastic energy of the joint's own springs",
            (Quantity::Distance, Target::Connection(Kind::Spring, _)) => {
                "distance of b from a; on a joint along the axis, 0 as drawn"
            }
            _ => quantity.row().meaning,
        };
        let Some(ObserverSpec { name, .. }) = &self.observer else { return String::from(meaning) };
        match quantity {
            Quantity::Quaternion | Quantity::Tilt => format!("{meaning}, relative to {name}"),
            _ if quantity.is_transmitted() => meaning.replace("global axes", &format!("the axes of {name}")),
            _ => meaning.replace("in global axes", &format!("relative to {name}, in its axes")),
        }
    }

    /// Unit label of one of its quantities, by the `parts` of the file: an effort is a torque or a force.
    pub fn unit(&self, quantity: Quantity, parts: &Parts) -> &'static str {
        if !matches!(quantity, Quantity::Effort | Quantity::Force) {
            return quantity.row().unit;
        }
        let mut acting = parts.acting();
        let found = match self.target {
            // The effort of a joint is that of its only drive or actuator.
            Target::Connection(Kind::Joint, joint) => {
                let moves = |own: &Acting<'_>| matches!(own.kind, Kind::Drive | Kind::Actuator);
                acting.find(|own| moves(own) && own.action.joint() == Some(joint))
            }
            Target::Connection(kind, index) => acting.find(|own| (own.kind, own.index) == (kind, index)),
            Target::At(_) | Target::On { .. } | Target::Whole(..) => None,
        };
        match found.map(|own| own.action.coordinate()) {
            Some(Coordinate::Distance) if quantity == Quantity::Effort => "N",
            Some(Coordinate::Angle) if quantity == Quantity::Force => "N.m",
            _ => quantity.row().unit,
        }
    }
}

impl ObserverSpec {
    fn read(reader: &mut Reader<'_, '_>) -> Option<Self> {
        let name = reader.text_of("in").unwrap_or_default().to_owned();
        Anchor::read(reader, "in", &OBSERVING).map(|anchor| Self { anchor, name })
    }
}

fn target(reader: &mut Reader<'_, '_>) -> Option<Target> {
    if reader.has("of") {
        ["at", "on"].into_iter().for_each(|key| reader.exclude(key, "of"));
        reader.refuse(
            "stations",
            "`stations` belong to points along a beam",
            "they need on = \"BEAM\" instead of `of`",
        );
        return reader.reference_among("of", &[Kind::Beam, Kind::Body]).map(|(kind, index)| Target::Whole(kind, index));
    }
    if reader.has("on") {
        reader.exclude("at", "on");
        let stations = reader.count_or(&STATIONS, USUAL_STATIONS);
        return reader.reference("on", Kind::Beam).map(|beam| Target::On { beam, stations });
    }
    reader.refuse("stations", "`stations` belong to a whole beam", "they need on = \"BEAM\" instead of `at`");
    let names = &reader.context.names;
    let name = reader.text_of("at").filter(|name| !names.is_unclear(name));
    let [connection, place] =
        [Kind::is_connection, Kind::is_place].map(|is_meant| names.find_of(name?, is_meant).cloned());
    let meant = match (connection, place) {
        (Some(connection), Some(place)) => Some(which(reader, connection, place)?),
        (connection, place) => connection.or(place),
    };
    match meant.map(|named| (named.kind, named.index)) {
        Some((kind, index)) if kind.is_connection() => {
            reader.take("at");
            Some(Target::Connection(kind, index))
        }
        Some((kind, _)) if kind.is_place() => Anchor::read(reader, "at", &OBSERVING).map(Target::At),
        _ => Anchor::read(reader, "at", &WATCHED).map(Target::At),
    }
}

/// The quantities that a list names; `observed`: somebody who moves measures them.
fn quantities(
    reader: &mut Reader<'_, '_>,
    item: &Item,
    target: Option<Target>,
    parts: &Parts,
    observed: bool,
) -> Vec<Quantity> {
    let known = || QUANTITIES.iter().map(|row| row.word);
    let items = match &item.node {
        Node::Array(items) if !items.is_empty() => items,
        Node::Text(word) => {
            let message = format!("`quantities` is {}", item.node.describe());
            reader.context.report.error(item.place, &message, &format!("[\"{word}\"] was expected"), "");
            return Vec::new();
        }
        _ => {
            reader.context.wrong_type("quantities", item, "a list of at least one word");
            return Vec::new();
        }
    };
    let mut quantities = Vec::new();
    for item in items {
        let Node::Text(word) = &item.node else {
            reader.context.wrong_type("quantities", item, "a word in quotes");
            continue;
        };
        let names = &reader.context.names;
        let report = &mut reader.context.report;
        let Some(row) = QUANTITIES.iter().find(|row| row.word == word) else {
            let message = format!("unknown quantity \"{word}\"");
            let near = suggestion(word, known());
            report.error(item.place, &message, &near, &format!("known here: {}", listing(known())));
            continue;
        };
        if quantities.contains(&row.quantity) {
            report.error(item.place, &format!("quantity \"{word}\" is listed twice"), "the second one", "");
            continue;
        }
        if let Some(mistake) = target.and_then(|target| objection(parts, row, target, names)) {
            report.error(item.place, &mistake.message, &mistake.label, &mistake.help);
        } else if observed && !row.quantity.has_axes() {
            let message = format!("\"{word}\" does not depend on `in`");
            let help = "list it in another output, without `in`";
            report.error(item.place, &message, "it is the same for every observer", help);
        }
        quantities.push(row.quantity);
    }
    quantities
}

/// Why a quantity cannot be measured.
struct Mistake {
    message: String,
    label: String,
    help: String,
}

impl Target {
    /// What kind of thing it is.
    pub fn site(self) -> Site {
        match self {
            Self::At(Anchor { point: Some(_), .. }) => Site::At(Kind::Point),
            Self::At(Anchor { spot: Spot::Body(_), .. }) => Site::At(Kind::Body),
            Self::At(Anchor { spot: Spot::Frame(_), .. }) => Site::At(Kind::Frame),
            Self::At(_) | Self::On { .. } => Site::At(Kind::Beam),
            Self::Connection(kind, _) => Site::At(kind),
            Self::Whole(kind, _) => Site::Whole(kind),
        }
    }
}

/// How a place on a beam is written; a fraction is as the file has it in the point.
fn beam_place(spot: Spot, names: &Names) -> Option<String> {
    let Spot::Beam { beam, along } = spot else { return None };
    let name = names.name(Kind::Beam, beam)?;
    Some(match along {
        Along::Start => format!("{name}.start"),
        Along::End => format!("{name}.end"),
        Along::Node(node) => format!("{name}.node[{node}]"),
        Along::Fraction(_) => format!("{name}@..."),
    })
}

/// Why a quantity cannot be measured at a target; none: it can, or what it depends on is reported already.
fn objection(parts: &Parts, row: &Row, target: Target, names: &Names) -> Option<Mistake> {
    let site = target.site();
    let measurable = |row: &&Row| row.sites.contains(&site);
    if let (false, Target::At(anchor @ Anchor { point: Some(_), .. })) = (measurable(&row), target)
        && row.sites == [Site::At(Kind::Beam)]
    {
        return Some(Mistake {
            message: format!("\"{}\" cannot be measured at {}", row.word, site.words()),
            label: String::from("it belongs to the section of a beam"),
            help: match beam_place(anchor.spot, names) {
                Some(place) => {
                    format!("write at = \"{place}\": the place that the point is on, in an output of its own")
                }
                None => String::from("the point is not on a beam"),
            },
        });
    }
    if !measurable(&row) {
        let words = QUANTITIES.iter().filter(measurable).map(|row| row.word);
        let sites: Vec<String> = row.sites.iter().map(|site| site.words()).collect();
        let sites: Vec<&str> = sites.iter().map(String::as_str).collect();
        let whole = row.sites.contains(&Site::Whole(Kind::Beam)) && matches!(site, Site::At(Kind::Beam | Kind::Body));
        let help = if whole { "write `of` instead of `at` and `on`, in an output of its own; " } else { "" };
        return Some(Mistake {
            message: format!("\"{}\" cannot be measured at {}", row.word, site.words()),
            label: format!("it belongs to {}", either(&sites)),
            help: format!("{help}possible here: {}", listing(words)),
        });
    }
    match (row.quantity, target) {
        (Quantity::Stress, _) => without_outline(parts, target, names),
        (Quantity::Angle | Quantity::AngleRate | Quantity::AngleAcceleration, _) => {
            without_coordinate(parts, Coordinate::Angle, target, names)
        }
        (Quantity::Distance | Quantity::DistanceRate, Target::Connection(Kind::Joint, joint))
            if joint_of(parts, joint, names).is_some_and(|joint| joint.kind == JointKind::Slide) =>
        {
            None
        }
        (Quantity::DistanceAcceleration, Target::Connection(Kind::Joint, joint))
            if joint_of(parts, joint, names).is_some_and(|joint| joint.kind == JointKind::Slide) =>
        {
            let name = names.name(Kind::Joint, joint)?;
            Some(Mistake {
                message: format!("the acceleration of the slide joint {name} cannot be measured"),
                label: String::from("it has: distance, distance_rate"),
                help: String::from(
                    "the acceleration of what slides can be measured: an output `at` it, with \"acceleration\"",
                ),
            })
        }
        (Quantity::Distance | Quantity::DistanceRate | Quantity::DistanceAcceleration, _) => {
            without_coordinate(parts, Coordinate::Distance, target, names)
        }
        (Quantity::Effort, Target::Connection(Kind::Joint, joint)) => without_one_effort(parts, joint, names),
        (Quantity::WrapAngle | Quantity::Slip, Target::Connection(Kind::Rope, rope)) => {
            without_sheaves(parts, rope, row.word, names)
        }
        _ => None,
    }
}

/// A stress needs the outline of the section.
fn without_outline(parts: &Parts, target: Target, names: &Names) -> Option<Mistake> {
    let beam = match target {
        Target::On { beam, .. } | Target::At(Anchor { spot: Spot::Beam { beam, .. }, .. }) => parts.beams.get(beam)?,
        _ => return None,
    };
    let name = names.name(Kind::Section, beam.section)?;
    let section = parts.sections.iter().find(|section| section.name == name)?;
    (section.shape == Shape::General || section.has_material()).then(|| Mistake {
        message: format!("the stress of beam {} is not known", beam.name),
        label: format!(
            "section {name} is {}: it has no outline",
            if section.has_material() { "given by rigidities" } else { "general" }
        ),
        help: String::from("section_force and section_moment can be measured"),
    })
}

fn without_coordinate(parts: &Parts, coordinate: Coordinate, target: Target, names: &Names) -> Option<Mistake> {
    let (known, what) = match target {
        Target::Connection(Kind::Joint, joint) => {
            let joint = joint_of(parts, joint, names)?;
            (joint.kind.coordinates().to_vec(), format!("the {} joint {}", joint.kind.word(), joint.name))
        }
        Target::Connection(kind, index) => {
            let name = names.name(kind, index)?;
            let own = parts.acting().find(|own| own.kind == kind && own.name == name)?;
            (vec![own.action.coordinate()], format!("the {} {name}", kind.word()))
        }
        Target::At(_) | Target::On { .. } | Target::Whole(..) => return None,
    };
    (!known.contains(&coordinate)).then(|| Mistake {
        message: format!("{what} has no {}", coordinate.word()),
        label: Coordinate::listing(&known),
        help: String::from(joint::COORDINATES),
    })
}

/// A wrap angle and a slip are those of sheaves.
fn without_sheaves(parts: &Parts, rope: usize, word: &str, names: &Names) -> Option<Mistake> {
    let name = names.name(Kind::Rope, rope)?;
    let own = parts.ropes.iter().find(|own| own.name == name)?;
    own.over.is_empty().then(|| Mistake {
        message: format!("\"{word}\" cannot be measured at rope {name}"),
        label: String::from("it has no sheaves between its ends"),
        help: String::from("possible are tension, span_length, length and energy"),
    })
}

/// The effort of a joint is that of its only drive or actuator.
fn without_one_effort(parts: &Parts, joint: usize, names: &Names) -> Option<Mistake> {
    let written = names.of(Kind::Drive).chain(names.of(Kind::Actuator)).count();
    if parts.drives.len() + parts.actuators.len() < written {
        return None;
    }
    let joint = names.name(Kind::Joint, joint)?;
    let is_own = |number: usize| names.name(Kind::Joint, number) == Some(joint);
    let drives = parts.drives.iter().filter(|drive| is_own(drive.joint)).map(|drive| drive.name.as_str());
    let actuators = parts.actuators.iter().filter(|actuator| actuator.joint().is_some_and(is_own));
    let own: Vec<_> = drives.chain(actuators.map(|actuator| actuator.name.as_str())).collect();
    let (message, label) = match own.as_slice() {
        [_] => return None,
        [] => (format!("joint {joint} has no effort"), String::from("no drive and no actuator acts on it")),
        many => (
            format!("joint {joint} has {} drives and actuators", many.len()),
            format!("at = one of them: {}", either(many)),
        ),
    };
    Some(Mistake { message, label, help: String::from("the effort is the torque or force of a drive or actuator") })
}

fn joint_of<'a>(parts: &'a Parts, joint: usize, names: &Names) -> Option<&'a JointSpec> {
    let name = names.name(Kind::Joint, joint)?;
    parts.joints.iter().find(|joint| joint.name == name)
}
