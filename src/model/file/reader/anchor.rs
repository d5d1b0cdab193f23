//! What joints, springs, loads and outputs hold on to: `ground`, `arm.start`, `arm.end`, `arm@0.5`, `arm.node[3]`, a
//! body, a frame, a point.

use super::{Context, Reader, either};
use crate::model::expression::Variable;
use crate::model::expression::function::Formula;
use crate::model::file::number::{Meta, Number, Slot, Written};
use crate::model::file::schema::Rule;
use crate::model::text::diagnostic::Place;
use crate::model::text::names::{Kind, suggestion};

/// The number behind the `@` of a point of a beam.
const FRACTION: Rule = Rule::new("at", "fraction of the beam's length", "").from(0.0).to(1.0);

/// A point to hold on to, and where the file says so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Where it is written.
    pub place: Place,
    /// What it is; of a point of the file what that is tied to.
    pub spot: Spot,
    /// The index of a point of the file in the list of points: its offset and axes come on top of the spot.
    pub point: Option<usize>,
}

/// A point to hold on to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Spot {
    /// The ground.
    Ground,
    /// A point of a beam.
    Beam {
        /// Place of the beam in the list of beams.
        beam: usize,
        /// Where on it.
        along: Along,
    },
    /// The center of mass of a body, by its index in the list of bodies.
    Body(usize),
    /// A frame, by its index in the list of frames.
    Frame(usize),
}

/// A point along a beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Along {
    /// Its first node.
    Start,
    /// Its last node.
    End,
    /// A fraction of its undeformed arc length, 0 to 1.
    Fraction(Number),
    /// Node k, from 0.
    Node(usize),
}

/// What a key may name.
#[derive(Debug)]
pub struct Allowed {
    /// Kinds of things.
    pub kinds: &'static [Kind],
    /// Whether the ground makes sense.
    pub ground: bool,
    /// What may be written, for messages.
    pub forms: &'static str,
}

/// What a point of the file can be tied to.
pub const CARRIERS: Allowed = Allowed {
    kinds: &[Kind::Body, Kind::Frame, Kind::Beam],
    ground: true,
    forms: "ground, BEAM.start, BEAM.end, BEAM@0.5, BEAM.node[3], BODY or FRAME",
};
/// The sides of joints and springs.
pub const SIDES: Allowed = Allowed {
    kinds: &[Kind::Body, Kind::Frame, Kind::Point, Kind::Beam],
    ground: true,
    forms: "ground, BEAM.start, BEAM.end, BEAM@0.5, BEAM.node[3], BODY, FRAME or POINT",
};
/// What a load can move.
pub const LOADED: Allowed = Allowed {
    kinds: &[Kind::Body, Kind::Point, Kind::Beam],
    ground: false,
    forms: "BEAM.start, BEAM.end, BEAM@0.5, BEAM.node[3], BODY or POINT",
};
/// What can be looked at, by an anchor or otherwise.
pub const WATCHED: Allowed = Allowed {
    kinds: &[
        Kind::Body,
        Kind::Frame,
        Kind::Point,
        Kind::Joint,
        Kind::Drive,
        Kind::Actuator,
        Kind::Gear,
        Kind::Spring,
        Kind::Friction,
        Kind::Stop,
        Kind::Lock,
        Kind::Contact,
        Kind::Foundation,
        Kind::Rope,
        Kind::Beam,
    ],
    ground: false,
    forms: "BEAM.start, BEAM.end, BEAM@0.5, BEAM.node[3], BODY, FRAME, POINT, JOINT, DRIVE, ACTUATOR, GEAR, SPRING, FRICTION, STOP, \
            LOCK, CONTACT, FOUNDATION or ROPE",
};

/// What an observer can move with.
pub const OBSERVING: Allowed = Allowed {
    kinds: &[Kind::Body, Kind::Frame, Kind::Point, Kind::Beam],
    ground: false,
    forms: "BEAM.start, BEAM.end, BEAM@0.5, BEAM.node[3], BODY, FRAME or POINT",
};

impl Allowed {
    /// `a body, frame or point of a beam was expected`.
    fn expected(&self) -> String {
        let word = |kind: &Kind| match kind {
            Kind::Beam => "point of a beam",
            Kind::Point => "[point]",
            _ => kind.word(),
        };
        format!("a {} was expected", either(&self.kinds.iter().map(word).collect::<Vec<_>>()))
    }
}

impl Anchor {
    /// Reads `key`; none if it is missing or wrong, which is reported.
    pub(in crate::model) fn read(reader: &mut Reader<'_, '_>, key: &'static str, allowed: &Allowed) -> Option<Self> {
        let written = reader.has(key);
        let Some((text, place)) = reader.text(key) else {
            if !written {
                reader.missing(key, allowed.forms);
            }
            return None;
        };
        if text == "ground" && !allowed.ground {
            let message = format!("`{key}` of {} is the ground", reader.title);
            reader.context.report.error(place, &message, &allowed.expected(), "");
            return None;
        }
        parse(reader.context, &text, place, allowed).map(|(spot, point)| Self { place, spot, point })
    }

    /// Whether it is the ground itself: its origin, where nothing else is said.
    pub fn is_ground(&self) -> bool {
        self.spot == Spot::Ground && self.point.is_none()
    }

    /// Whether it is on a beam or a body.
    pub fn can_move(&self) -> bool {
        matches!(self.spot, Spot::Beam { .. } | Spot::Body(_))
    }

    /// Reports a joint of which neither side can move.
    pub(in crate::model) fn expect_motion(reader: &mut Reader<'_, '_>, a: Option<Self>, b: Option<Self>) {
        let (Some(a), Some(b)) = (a, b) else { return };
        if !a.can_move() && !b.can_move() {
            let message = format!("{} connects two points that cannot move", reader.title);
            reader.context.report.error(b.place, &message, "one side must be a beam or a body", "");
        }
    }

    /// Reports a spring or an actuator between two points of which neither moves: unlike a joint, it also has a force
    /// between frames.
    pub(in crate::model) fn expect_way(reader: &mut Reader<'_, '_>, a: Option<Self>, b: Option<Self>) {
        let (Some(a), Some(b)) = (a, b) else { return };
        let frames = &reader.context.moving_frames;
        let moves = |side: Self| match side.spot {
            Spot::Frame(frame) => frames.get(frame).copied().unwrap_or(true),
            _ => side.can_move(),
        };
        if !moves(a) && !moves(b) {
            let message = format!("{} connects two points that cannot move", reader.title);
            reader.context.report.error(b.place, &message, "one side must be a beam, a body or a frame that moves", "");
        }
    }
}

/// What a text names, and the number of the point where it is one.
fn parse(context: &mut Context<'_>, text: &str, place: Place, allowed: &Allowed) -> Option<(Spot, Option<usize>)> {
    if text == "ground" {
        return Some((Spot::Ground, None));
    }
    let length = text.find(['.', '@']).unwrap_or(text.len());
    let (name, rest) = text.split_at(length);
    if context.names.is_unclear(name) {
        return None;
    }
    let at = context.report.source.inside(place, text, 0..length);
    // Only a beam has points: a joint of the same name may stand before it.
    let beam = || context.names.find_of(name, |kind| kind == Kind::Beam).filter(|_| !rest.is_empty());
    let Some(named) = beam().or_else(|| context.names.find_among(name, allowed.kinds)) else {
        let known = allowed.kinds.iter().flat_map(|kind| context.names.of(*kind));
        let near = suggestion(name, known.chain(allowed.ground.then_some("ground")));
        let label = if near.is_empty() { allowed.expected() } else { near };
        let help = format!("possible: {}", allowed.forms);
        context.report.error(at, &format!("nothing in the file is named `{name}`"), &label, &help);
        return None;
    };
    let (kind, beam) = (named.kind, named.index);
    if !allowed.kinds.contains(&kind) {
        let message = format!("`{name}` is a {}", kind.word());
        context.report.error(at, &message, &allowed.expected(), &format!("possible: {}", allowed.forms));
        return None;
    }
    if kind != Kind::Beam {
        if !rest.is_empty() {
            let at = context.report.source.inside(place, text, length..text.len());
            let message = format!("a {} has no points", kind.word());
            context.report.error(at, &message, &format!("`{name}` alone was expected"), "");
            return None;
        }
        return match kind {
            Kind::Body => Some((Spot::Body(named.index), None)),
            Kind::Frame => Some((Spot::Frame(named.index), None)),
            // Without a carrier the point itself is wrong, which is reported.
            Kind::Point => context.carriers.get(named.index)?.map(|on| (on.spot, Some(named.index))),
            _ => None,
        };
    }
    let along = if let Some(fraction) = rest.strip_prefix('@') {
        let at = context.report.source.inside(place, text, length + 1..text.len());
        let program = context.program(fraction, at, Variable::None);
        let written = program.map_or(Written::Broken, |program| Written::Formula(Formula::single(program)));
        let meta = Meta::of(&FRACTION, format!("{name}@"));
        Along::Fraction(context.numbers.push(Slot { meta, place: at, listed: None, written }))
    } else {
        match rest {
            ".start" => Along::Start,
            ".end" => Along::End,
            _ => match node(rest) {
                Some(_) if context.free_meshes.get(beam) == Some(&true) => {
                    let at = context.report.source.inside(place, text, length..text.len());
                    let message = format!("beam {name} has no numbered nodes: [beam.{name}] gives no `elements`");
                    let help = format!("name the place itself, as in {name}@0.3, or give `elements` in [beam.{name}]");
                    context.report.error(at, &message, "the program chooses the nodes", &help);
                    return None;
                }
                Some(node) => Along::Node(node),
                None => {
                    let message = match rest {
                        "" => format!("`{name}` is a whole beam, a point was expected"),
                        _ => format!("a beam has no point `{rest}`"),
                    };
                    let label = suggestion(rest, [".start", ".end", ".node[0]"]);
                    let help = format!("{name}.start, {name}.end, {name}@0.5 or {name}.node[3]");
                    let at = if rest.is_empty() { 0 } else { length };
                    let at = context.report.source.inside(place, text, at..text.len());
                    context.report.error(at, &message, &label, &help);
                    return None;
                }
            },
        }
    };
    Some((Spot::Beam { beam, along }, None))
}

/// `.node[3]` to 3.
fn node(rest: &str) -> Option<usize> {
    let digits = rest.strip_prefix(".node[")?.strip_suffix(']')?;
    digits.chars().all(|c| c.is_ascii_digit()).then(|| digits.parse().ok()).flatten()
}
