//! `[rope.NAME]`: a rope over sheaves, from one end to the other.

use super::Parts;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Anchor, SIDES};
use crate::model::file::schema::{Key, PLACES, Role, Rule};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("from", Role::Name(PLACES), "the point where it begins"),
    Key::name("from_drum", Role::Name("surface"), "the drum that it unwinds from, instead of `from`"),
    Key::name("over", Role::Names("surface"), "the sheave that it runs over, or a list of sheaves in its order"),
    Key::name("to", Role::Name(PLACES), "the point where it ends"),
    Key::name("to_drum", Role::Name("surface"), "the drum that it winds up on, instead of `to`"),
    Key::word(
        "turns",
        &[],
        "for each drum and sheave in the order of the rope: 1 where it runs right-handed about the axis, else -1",
    ),
    Key::number(&[&STIFFNESS]),
    Key::number(&[&DAMPING]),
    Key::number(&[&RADIUS]),
    Key::number(&[&FRICTION]),
    Key::flag("sticks", "true: it never slips on its sheaves, as a toothed belt does"),
    Key::number(&[&LENGTH]),
    Key::number(&[&PRETENSION]),
];

const STIFFNESS: Rule = Rule::new("stiffness", "tension over strain, EA", "N").above(0.0).tunable();
const DAMPING: Rule = Rule::new("damping", "tension over the rate of the strain", "N.s").from(0.0).tunable();
const RADIUS: Rule =
    Rule::new("radius", "radius of the rope, whose axis runs by this much outside of the surfaces", "m").from(0.0);
const FRICTION: Rule =
    Rule::new("friction", "coefficient of dry friction on the sheaves; without it the rope runs freely over them", "")
        .from(0.0)
        .tunable();
const LENGTH: Rule =
    Rule::new("length", "length without tension, with arcs on sheaves; by default as drawn", "m").above(0.0);
const PRETENSION: Rule = Rule::new("pretension", "tension as drawn, instead of `length`", "N").from(0.0);

/// An end of a rope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum End {
    /// A point.
    Point(Anchor),
    /// A drum, by its number among the surfaces.
    Drum(usize),
}

/// A section `[rope.NAME]`.
#[derive(Clone, Debug)]
pub struct RopeSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Its two ends.
    pub ends: [End; 2],
    /// The sheaves in its order, by their numbers among the surfaces.
    pub over: Vec<usize>,
    /// The turn about each drum and sheave in its order: 1 where it is right-handed about the axis, else -1.
    pub turns: Vec<i64>,
    /// EA, N.
    pub stiffness: Number,
    /// N s.
    pub damping: Number,
    /// m.
    pub radius: Number,
    /// How it holds on its sheaves.
    pub hold: Hold,
    /// Its length without tension.
    pub slack: Slack,
}

/// How a rope holds on its sheaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Hold {
    /// It runs freely.
    Free,
    /// Dry friction with this coefficient.
    Friction(Number),
    /// It never slips.
    Sticks,
}

/// How long a rope is without tension.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slack {
    /// As long as drawn.
    Drawn,
    /// m.
    Length(Number),
    /// Tension as drawn, N.
    Pretension(Number),
}

impl RopeSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let from = end(&mut reader, "from", "from_drum");
        let over = if reader.has("over") { reader.references("over", Kind::Surface) } else { Some(Vec::new()) };
        let to = end(&mut reader, "to", "to_drum");
        let place_of_turns = if reader.has("turns") { reader.place_of("turns") } else { reader.place };
        let has_turns = reader.has("turns");
        let turns = reader.whole_numbers("turns");
        let (stiffness, damping) = (reader.number(&STIFFNESS), reader.number_or(&DAMPING, 0.0));
        let radius = reader.number_or(&RADIUS, 0.0);
        let sticks = reader.boolean("sticks", false);
        let hold = match (sticks, reader.has("friction")) {
            (true, _) => {
                reader.exclude("friction", "sticks");
                Hold::Sticks
            }
            (false, true) => Hold::Friction(reader.number(&FRICTION)),
            (false, false) => Hold::Free,
        };
        let slack = match (reader.optional(&LENGTH), reader.has("pretension")) {
            (Some(length), _) => {
                reader.exclude("pretension", "length");
                Slack::Length(length)
            }
            (None, true) => Slack::Pretension(reader.number(&PRETENSION)),
            (None, false) => Slack::Drawn,
        };
        if let (Some(from), Some(over), Some(to)) = (from, &over, to) {
            let drums = [from, to].iter().filter(|end| matches!(end, End::Drum(_))).count();
            let count = over.len() + drums;
            if turns.len() != count || turns.iter().any(|turn| turn.unsigned_abs() != 1) {
                let listed = if has_turns { "are not as many numbers 1 or -1" } else { "are missing" };
                let message = format!("the turns of {} {listed}: it has {count} drums and sheaves", reader.title);
                let help = "one number for each of them, in the order of the rope: 1 where the rope runs \
                            right-handed about the axis of the surface, -1 where it runs left-handed";
                reader.context.report.error(place_of_turns, &message, "`turns` of that many was expected", help);
                reader.abandon();
                return None;
            }
            if let ([End::Point(a), End::Point(b)], []) = ([from, to], over.as_slice()) {
                Anchor::expect_way(&mut reader, Some(a), Some(b));
            }
        }
        let place = reader.place;
        reader.finish();
        let ends = [from?, to?];
        Some(Self { name: name.to_owned(), place, ends, over: over?, turns, stiffness, damping, radius, hold, slack })
    }

    /// The points where it begins and ends.
    pub fn points(&self) -> impl Iterator<Item = Anchor> + '_ {
        self.ends.iter().filter_map(|end| if let End::Point(anchor) = end { Some(*anchor) } else { None })
    }

    /// Its wheels by their numbers among the surfaces, with their turns; the drums at its ends are among them.
    pub fn wheels(&self) -> impl Iterator<Item = (usize, i64)> + '_ {
        let drum = |end: End| if let End::Drum(surface) = end { Some(surface) } else { None };
        let surfaces = drum(self.ends[0]).into_iter().chain(self.over.iter().copied()).chain(drum(self.ends[1]));
        surfaces.zip(self.turns.iter().copied())
    }
}

/// Reads an end: a point, or a drum.
fn end(reader: &mut Reader<'_, '_>, point: &'static str, drum: &'static str) -> Option<End> {
    if reader.has(drum) {
        reader.exclude(point, drum);
        return reader.reference(drum, Kind::Surface).map(End::Drum);
    }
    if !reader.has(point) {
        let help = format!("{}; or `{drum}`, the drum that winds it up", SIDES.forms);
        reader.missing(point, &help);
        return None;
    }
    Anchor::read(reader, point, &SIDES).map(End::Point)
}
