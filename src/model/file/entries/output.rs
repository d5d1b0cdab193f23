//! `[output.NAME]`: what is measured at a point, a body, a joint, a drive, an actuator or a frame, or along a beam.

use super::actuator::ActuatorSpec;
use super::beam::BeamSpec;
use super::drive::DriveSpec;
use super::joint::{self, Coordinate, JointSpec};
use super::section::{SectionSpec, Shape};
use crate::model::file::quantity::{QUANTITIES, Quantity, Row, Site};
use crate::model::file::reader::anchor::{Along, Anchor, OBSERVING, Spot, WATCHED};
use crate::model::file::reader::{Reader, either, listing};
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, Names, suggestion};
use crate::model::text::tree::{Item, Node};

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
    /// A whole beam.
    On {
        /// Place in the list of beams.
        beam: usize,
        /// Number of equally spaced points, both ends included.
        stations: usize,
    },
}

impl Target {
    /// The number of its sensors, which read what is not of a joint, a drive or an actuator.
    pub fn sensors(&self) -> usize {
        match self {
            Self::At(_) => 1,
            Self::On { stations, .. } => *stations,
            Self::Joint(_) | Self::Drive(_) | Self::Actuator(_) => 0,
        }
    }
}

/// The things of the file that could be read and that outputs ask about.
#[derive(Clone, Copy, Debug)]
pub(in crate::model) struct Things<'a> {
    pub beams: &'a [BeamSpec],
    pub sections: &'a [SectionSpec],
    pub joints: &'a [JointSpec],
    pub drives: &'a [DriveSpec],
    pub actuators: &'a [ActuatorSpec],
}

/// Default of `stations`.
const STATIONS: usize = 21;

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
        let meaning = quantity.row().meaning;
        let Some(ObserverSpec { name, .. }) = &self.observer else { return String::from(meaning) };
        match quantity {
            Quantity::Quaternion => format!("{meaning}, relative to {name}"),
            _ if quantity.is_transmitted() => meaning.replace("global axes", &format!("the axes of {name}")),
            _ => meaning.replace("in global axes", &format!("relative to {name}, in its axes")),
        }
    }

    /// Unit label of one of its quantities: an effort is a torque or a force.
    pub fn unit(&self, quantity: Quantity, drives: &[DriveSpec], actuators: &[ActuatorSpec]) -> &'static str {
        let coordinate = match self.target {
            Target::Drive(drive) => drives.get(drive).map(|drive| drive.coordinate),
            Target::Actuator(actuator) => actuators.get(actuator).map(ActuatorSpec::coordinate),
            Target::Joint(joint) => {
                let drive = drives.iter().find(|drive| drive.joint == joint).map(|drive| drive.coordinate);
                let actuator = || actuators.iter().find(|actuator| actuator.joint() == Some(joint));
                drive.or_else(|| actuator().map(ActuatorSpec::coordinate))
            }
            Target::At(_) | Target::On { .. } => None,
        };
        match coordinate {
            Some(Coordinate::Distance) if quantity == Quantity::Effort => "N",
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
    if reader.has("on") {
        reader.exclude("at", "on");
        let stations = reader.count_or(&schema::STATIONS, STATIONS);
        return reader.reference("on", Kind::Beam).map(|beam| Target::On { beam, stations });
    }
    reader.refuse("stations", "`stations` belong to a whole beam", "they need on = \"BEAM\" instead of `at`");
    let names = &reader.context.names;
    let whole = reader.text_of("at").filter(|name| !names.is_unclear(name));
    let whole = whole.and_then(|name| names.find_among(name, WATCHED.kinds));
    match whole.map(|named| (named.kind, named.index)) {
        Some((Kind::Joint, index)) => {
            reader.take("at");
            Some(Target::Joint(index))
        }
        Some((Kind::Drive, index)) => {
            reader.take("at");
            Some(Target::Drive(index))
        }
        Some((Kind::Actuator, index)) => {
            reader.take("at");
            Some(Target::Actuator(index))
        }
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
            return Some(Mistake {
                message: format!("\"{}\" cannot be measured at {}", row.word, site.words()),
                label: format!("it belongs to {}", either(&sites)),
                help: format!("possible here: {}", listing(words)),
            });
        }
        match (row.quantity, target) {
            (Quantity::Stress, _) => self.without_outline(target, names),
            (Quantity::Angle | Quantity::AngleRate, _) => self.without_coordinate(Coordinate::Angle, target, names),
            (Quantity::Distance | Quantity::DistanceRate, _) => {
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
        (section.shape == Shape::General).then(|| Mistake {
            message: format!("the stress of beam {} is not known", beam.name),
            label: format!("section {name} is general: it has no outline"),
            help: String::from("section_force and section_moment can be measured"),
        })
    }

    fn without_coordinate(&self, coordinate: Coordinate, target: Target, names: &Names) -> Option<Mistake> {
        let (known, what) = match target {
            Target::Joint(joint) => {
                let joint = self.joint(joint, names)?;
                (joint.kind.coordinates().to_vec(), format!("the {} joint {}", joint.kind.word(), joint.name))
            }
            Target::Drive(drive) => {
                let name = names.name(Kind::Drive, drive)?;
                let drive = self.drives.iter().find(|drive| drive.name == name)?;
                (vec![drive.coordinate], format!("the drive {name}"))
            }
            Target::Actuator(actuator) => {
                let name = names.name(Kind::Actuator, actuator)?;
                let actuator = self.actuators.iter().find(|actuator| actuator.name == name)?;
                (vec![actuator.coordinate()], format!("the actuator {name}"))
            }
            _ => return None,
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
