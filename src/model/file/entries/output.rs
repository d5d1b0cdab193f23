//! `[output.NAME]`: what is measured at a point, of a whole beam or body, at a body, a joint, a drive, an actuator, a gear, a spring, friction, a stop, a lock or a frame, or along a beam.

use super::actuator::ActuatorSpec;
use super::beam::BeamSpec;
use super::drive::DriveSpec;
use super::friction::FrictionSpec;
use super::gear::GearSpec;
use super::joint::{self, Coordinate, JointSpec};
use super::lock::LockSpec;
use super::namesakes::which;
use super::section::{SectionSpec, Shape};
use super::spring::SpringSpec;
use super::stop::StopSpec;
use crate::model::file::quantity::{QUANTITIES, Quantity, Row, Site};
use crate::model::file::reader::anchor::{Along, Anchor, OBSERVING, Spot, WATCHED};
use crate::model::file::reader::{Reader, either, listing};
use crate::model::file::schema::{Key, PLACES, Role, Rule};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, Named, Names, suggestion};
use crate::model::text::tree::{Item, Node};

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("at", Role::Part, "the point or the part where it measures"),
    Key::name("on", Role::Name(PLACES), "the beam along which it measures, instead of `at`"),
    Key::name("of", Role::Name(PLACES), "the beam or body that it measures as a whole, instead of `at`"),
    Key::number(&[&STATIONS]),
    Key::name("in", Role::Name(PLACES), "what the observer moves with"),
    Key::word("quantities", &[], "what it measures: a list of words"),
];

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
    /// What is measured, in the order of the file; all of it can be measured there.
    pub quantities: Vec<Quantity>,
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
    /// A joint, by its place in the list.
    Joint(usize),
    /// A drive, by its place in the list.
    Drive(usize),
    /// An actuator, by its place in the list.
    Actuator(usize),
    /// A gear, by its place in the list.
    Gear(usize),
    /// A spring, by its place in the list.
    Spring(usize),
    /// Friction, by its place in the list.
    Friction(usize),
    /// A stop, by its place in the list.
    Stop(usize),
    /// A lock, by its place in the list.
    Lock(usize),
    /// A whole beam.
    On {
        /// Place in the list of beams.
        beam: usize,
        /// Number of equally spaced points, both ends included.
        stations: usize,
    },
    /// All of a beam at once, by its place in the list.
    Beam(usize),
    /// All of a body at once, by its place in the list.
    Body(usize),
}

impl Target {
    /// What holds places together or acts on them; none: it is something else.
    fn of_connection(named: &Named) -> Option<Self> {
        let target = match named.kind {
            Kind::Joint => Self::Joint,
            Kind::Drive => Self::Drive,
            Kind::Actuator => Self::Actuator,
            Kind::Gear => Self::Gear,
            Kind::Spring => Self::Spring,
            Kind::Friction => Self::Friction,
            Kind::Stop => Self::Stop,
            Kind::Lock => Self::Lock,
            _ => return None,
        };
        Some(target(named.index))
    }

    /// The number of its sensors, which read what is not of a joint, a drive, an actuator, a gear, a spring, friction, a stop or a lock.
    pub fn sensors(&self) -> usize {
        match self {
            Self::At(_) => 1,
            Self::On { stations, .. } => *stations,
            _ => 0,
        }
    }
}

/// The things of the file that could be read and that outputs ask about.
#[derive(Clone, Copy, Debug)]
pub struct Things<'a> {
    /// Beams.
    pub beams: &'a [BeamSpec],
    /// Sections.
    pub sections: &'a [SectionSpec],
    /// Joints.
    pub joints: &'a [JointSpec],
    /// Drives.
    pub drives: &'a [DriveSpec],
    /// Actuators.
    pub actuators: &'a [ActuatorSpec],
    /// Gears.
    pub gears: &'a [GearSpec],
    /// Springs.
    pub springs: &'a [SpringSpec],
    /// Friction.
    pub frictions: &'a [FrictionSpec],
    /// Stops.
    pub stops: &'a [StopSpec],
    /// Locks.
    pub locks: &'a [LockSpec],
}

/// Default of `stations`.
const USUAL_STATIONS: usize = 21;

impl OutputSpec {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>, things: Things<'_>) -> Option<Self> {
        let target = target(&mut reader);
        let observed = reader.has("in");
        let observer = observed.then(|| ObserverSpec::read(&mut reader)).flatten();
        let quantities = match reader.take("quantities") {
            None => {
                reader.missing("quantities", "a list like [\"position\", \"twist\"]");
                Vec::new()
            }
            Some(entry) => quantities(&mut reader, &entry.item, target, things, observed),
        };
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, target: target?, observer, quantities })
    }

    /// The number of its sensors: also what a joint transmits is seen from one, if somebody sees it who moves.
    pub fn sensors(&self) -> usize {
        match self.target {
            Target::Joint(_) => usize::from(self.observer.is_some()),
            _ => self.target.sensors(),
        }
    }

    /// What one of its quantities is, with its axes.
    pub fn meaning(&self, quantity: Quantity) -> String {
        let meaning = match (quantity, self.target) {
            (Quantity::Power, Target::Gear(_)) => "power that the gear takes from joint b and gives to joint a",
            (Quantity::Effort, Target::Gear(_)) => "torque or force of the gear on side b of joint a",
            (Quantity::Power, Target::Spring(_)) => "power that the damper of the spring takes",
            (Quantity::Power, Target::Friction(_)) => "power that the friction takes",
            (Quantity::Power, Target::Stop(_)) => "power that the damping of the stop takes",
            (Quantity::Effort, Target::Friction(_)) => "torque or force of the friction on side b",
            (Quantity::Effort, Target::Stop(_)) => "torque or force of the stop on side b",
            (Quantity::Effort, Target::Lock(_)) => "torque or force of the lock on side b",
            (Quantity::Energy, Target::Joint(_)) => "elastic energy of the joint's own springs",
            (Quantity::Distance, Target::Spring(_)) => "distance of b from a; on a joint along the axis, 0 as drawn",
            _ => quantity.row().meaning,
        };
        let Some(ObserverSpec { name, .. }) = &self.observer else { return String::from(meaning) };
        match quantity {
            Quantity::Quaternion => format!("{meaning}, relative to {name}"),
            _ if quantity.is_transmitted() => meaning.replace("global axes", &format!("the axes of {name}")),
            _ => meaning.replace("in global axes", &format!("relative to {name}, in its axes")),
        }
    }

    /// Unit label of one of its quantities, by the `things` of the file: an effort is a torque or a force.
    pub fn unit(&self, quantity: Quantity, things: Things<'_>) -> &'static str {
        let coordinate = match self.target {
            Target::Joint(joint) => {
                let drive = things.drives.iter().find(|drive| drive.joint == joint).map(|drive| drive.coordinate);
                let actuator = || things.actuators.iter().find(|actuator| actuator.joint() == Some(joint));
                drive.or_else(|| actuator().map(ActuatorSpec::coordinate))
            }
            target => things.coordinates().find(|(own, ..)| *own == target).map(|(.., coordinate)| coordinate),
        };
        match coordinate {
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
        let (kind, index) = reader.reference_among("of", &[Kind::Beam, Kind::Body])?;
        return Some(if kind == Kind::Beam { Target::Beam(index) } else { Target::Body(index) });
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
    if let Some(target) = meant.as_ref().and_then(Target::of_connection) {
        reader.take("at");
        return Some(target);
    }
    match meant.map(|named| named.kind) {
        Some(kind) if kind.is_place() => Anchor::read(reader, "at", &OBSERVING).map(Target::At),
        _ => Anchor::read(reader, "at", &WATCHED).map(Target::At),
    }
}

/// The quantities that a list names; `observed`: somebody who moves measures them.
fn quantities(
    reader: &mut Reader<'_, '_>,
    item: &Item,
    target: Option<Target>,
    things: Things<'_>,
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
        if let Some(mistake) = target.and_then(|target| things.objection(row, target, names)) {
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
    /// Kind, place in the list and word of what acts on a coordinate.
    fn acting(self) -> Option<(Kind, usize, &'static str)> {
        match self {
            Self::Drive(index) => Some((Kind::Drive, index, "drive")),
            Self::Actuator(index) => Some((Kind::Actuator, index, "actuator")),
            Self::Gear(index) => Some((Kind::Gear, index, "gear")),
            Self::Spring(index) => Some((Kind::Spring, index, "spring")),
            Self::Friction(index) => Some((Kind::Friction, index, "friction")),
            Self::Stop(index) => Some((Kind::Stop, index, "stop")),
            Self::Lock(index) => Some((Kind::Lock, index, "lock")),
            Self::At(_) | Self::Joint(_) | Self::On { .. } | Self::Beam(_) | Self::Body(_) => None,
        }
    }

    /// What kind of thing it is.
    pub fn site(self) -> Site {
        match self {
            Self::At(Anchor { point: Some(_), .. }) => Site::Point,
            Self::At(Anchor { spot: Spot::Body(_), .. }) => Site::Body,
            Self::At(Anchor { spot: Spot::Frame(_), .. }) => Site::Frame,
            Self::At(_) | Self::On { .. } => Site::Beam,
            Self::Joint(_) => Site::Joint,
            Self::Drive(_) => Site::Drive,
            Self::Actuator(_) => Site::Actuator,
            Self::Gear(_) => Site::Gear,
            Self::Spring(_) => Site::Spring,
            Self::Friction(_) => Site::Friction,
            Self::Stop(_) => Site::Stop,
            Self::Lock(_) => Site::Lock,
            Self::Beam(_) => Site::WholeBeam,
            Self::Body(_) => Site::WholeBody,
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

impl<'a> Things<'a> {
    /// Why a quantity cannot be measured at a target; none: it can, or what it depends on is reported already.
    fn objection(&self, row: &Row, target: Target, names: &Names) -> Option<Mistake> {
        let site = target.site();
        let measurable = |row: &&Row| row.sites.contains(&site);
        if let (false, Target::At(anchor @ Anchor { point: Some(_), .. })) = (measurable(&row), target)
            && row.sites == [Site::Beam]
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
            let sites: Vec<_> = row.sites.iter().map(|site| site.words()).collect();
            let whole = row.sites.contains(&Site::WholeBeam) && matches!(site, Site::Beam | Site::Body);
            let help = if whole { "write `of` instead of `at` and `on`, in an output of its own; " } else { "" };
            return Some(Mistake {
                message: format!("\"{}\" cannot be measured at {}", row.word, site.words()),
                label: format!("it belongs to {}", either(&sites)),
                help: format!("{help}possible here: {}", listing(words)),
            });
        }
        match (row.quantity, target) {
            (Quantity::Stress, _) => self.without_outline(target, names),
            (Quantity::Angle | Quantity::AngleRate | Quantity::AngleAcceleration, _) => {
                self.without_coordinate(Coordinate::Angle, target, names)
            }
            (Quantity::Distance | Quantity::DistanceRate | Quantity::DistanceAcceleration, _) => {
                self.without_coordinate(Coordinate::Distance, target, names)
            }
            (Quantity::Effort, Target::Joint(joint)) => self.without_one_effort(joint, names),
            _ => None,
        }
    }

    /// A stress needs the outline of the section.
    fn without_outline(&self, target: Target, names: &Names) -> Option<Mistake> {
        let beam = match target {
            Target::On { beam, .. } | Target::At(Anchor { spot: Spot::Beam { beam, .. }, .. }) => {
                self.beams.get(beam)?
            }
            _ => return None,
        };
        let name = names.name(Kind::Section, beam.section)?;
        let section = self.sections.iter().find(|section| section.name == name)?;
        (section.shape == Shape::General || section.has_material()).then(|| Mistake {
            message: format!("the stress of beam {} is not known", beam.name),
            label: format!(
                "section {name} is {}: it has no outline",
                if section.has_material() { "given by rigidities" } else { "general" }
            ),
            help: String::from("section_force and section_moment can be measured"),
        })
    }

    /// Drives, actuators, gears (by their first joint), springs, friction, stops and locks with their names and what they act on, by their places in the lists.
    fn coordinates(self) -> impl Iterator<Item = (Target, &'a str, Coordinate)> {
        let drives = self.drives.iter().map(|own| (own.name.as_str(), own.coordinate)).enumerate();
        let actuators = self.actuators.iter().map(|own| (own.name.as_str(), own.coordinate())).enumerate();
        let gears = self.gears.iter().map(|own| (own.name.as_str(), own.sides[0].1)).enumerate();
        let springs = self.springs.iter().map(|own| (own.name.as_str(), own.action.coordinate())).enumerate();
        let frictions = self.frictions.iter().map(|own| (own.name.as_str(), own.action.coordinate())).enumerate();
        let stops = self.stops.iter().map(|own| (own.name.as_str(), own.action.coordinate())).enumerate();
        let drives = drives.map(|(number, (name, coordinate))| (Target::Drive(number), name, coordinate));
        let actuators = actuators.map(|(number, (name, coordinate))| (Target::Actuator(number), name, coordinate));
        let gears = gears.map(|(number, (name, coordinate))| (Target::Gear(number), name, coordinate));
        let springs = springs.map(|(number, (name, coordinate))| (Target::Spring(number), name, coordinate));
        let frictions = frictions.map(|(number, (name, coordinate))| (Target::Friction(number), name, coordinate));
        let stops = stops.map(|(number, (name, coordinate))| (Target::Stop(number), name, coordinate));
        let locks = self.locks.iter().enumerate();
        let locks = locks.map(|(number, own)| (Target::Lock(number), own.name.as_str(), own.coordinate));
        drives.chain(actuators).chain(gears).chain(springs).chain(frictions).chain(stops).chain(locks)
    }

    fn without_coordinate(&self, coordinate: Coordinate, target: Target, names: &Names) -> Option<Mistake> {
        let (known, what) = match target {
            Target::Joint(joint) => {
                let joint = self.joint(joint, names)?;
                (joint.kind.coordinates().to_vec(), format!("the {} joint {}", joint.kind.word(), joint.name))
            }
            target => {
                let (kind, index, word) = target.acting()?;
                let name = names.name(kind, index)?;
                let mut all = self.coordinates();
                let (.., coordinate) =
                    all.find(|(own, own_name, _)| own.acting().is_some_and(|own| own.0 == kind) && *own_name == name)?;
                (vec![coordinate], format!("the {word} {name}"))
            }
        };
        (!known.contains(&coordinate)).then(|| Mistake {
            message: format!("{what} has no {}", coordinate.word()),
            label: Coordinate::listing(&known),
            help: String::from(joint::COORDINATES),
        })
    }

    /// The effort of a joint is that of its only drive or actuator.
    fn without_one_effort(&self, joint: usize, names: &Names) -> Option<Mistake> {
        let written = names.of(Kind::Drive).chain(names.of(Kind::Actuator)).count();
        if self.drives.len() + self.actuators.len() < written {
            return None;
        }
        let joint = names.name(Kind::Joint, joint)?;
        let is_own = |number: usize| names.name(Kind::Joint, number) == Some(joint);
        let drives = self.drives.iter().filter(|drive| is_own(drive.joint)).map(|drive| drive.name.as_str());
        let actuators = self.actuators.iter().filter(|actuator| actuator.joint().is_some_and(is_own));
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

    fn joint(&self, joint: usize, names: &Names) -> Option<&'a JointSpec> {
        let name = names.name(Kind::Joint, joint)?;
        self.joints.iter().find(|joint| joint.name == name)
    }
}
