//! `[load.NAME]`: a force and a moment at a point of a beam or at a body, or along a beam.

use super::Parts;
use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Anchor, LOADED, Spot};
use crate::model::file::reader::input::{HELD, make_input};
use crate::model::file::schema::{Key, PLACES, Role, Rule};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("at", Role::Name(PLACES), "the point of a beam or the body that it acts on"),
    Key::name("on", Role::Name(PLACES), "the beam that it is spread over or moves along, instead of `at`"),
    Key::number(&[&STATION]),
    Key::global(&[&FORCE, &FORCE_PER_LENGTH], Role::Direction),
    Key::global(&[&MOMENT, &MOMENT_PER_LENGTH], Role::Direction),
    Key::flag("follower", "true: it turns with what it acts on"),
    Key::flag("input", "true: the host gives force and moment"),
];

const FORCE: Rule = Rule::new("force", "force", "N").tunable().in_time();
const MOMENT: Rule = Rule::new("moment", "moment", "N.m").tunable().in_time();
const STATION: Rule = Rule::new(
    "station",
    "where on the beam `on` it acts: a fraction of the length, 0 at the start, 1 at the end; beyond them it acts on \
     nothing",
    "",
)
.in_time();
const FORCE_PER_LENGTH: Rule = Rule::new("force", "force per length", "N/m").tunable().in_time();
const MOMENT_PER_LENGTH: Rule = Rule::new("moment", "moment per length", "N").tunable().in_time();

/// A section `[load.NAME]`.
#[derive(Clone, Debug)]
pub struct LoadSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it acts on.
    pub target: Target,
    /// Force, N, or N/m along a beam; may change in time.
    pub force: [Number; 3],
    /// Moment, N m, or N along a beam; may change in time.
    pub moment: [Number; 3],
    /// true: it turns with the section, or with the body.
    pub follower: bool,
    /// true: the host gives force and moment; the numbers are start values.
    pub input: bool,
}

/// What a load acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point of a beam, or a body.
    At(Anchor),
    /// A whole beam, by its index in the list: force and moment are per length.
    On(usize),
    /// A beam, by its place in the list, along which it moves.
    Moving {
        /// The beam.
        beam: usize,
        /// Where on it: a fraction of its length; may change in time.
        station: Number,
    },
}

/// Whether a load can move what it acts on; if not, that is reported.
fn moves(reader: &mut Reader<'_, '_>, anchor: &Anchor) -> bool {
    if !anchor.can_move() {
        let message = format!("{} acts on a point that a load cannot move", reader.title);
        let label = "it is not on a beam or a body";
        reader.context.report.error(anchor.place, &message, label, "loads act on beams, bodies, and points on them");
    }
    anchor.can_move()
}

impl LoadSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let moves_along = reader.has("station");
        let along = reader.has("on") && !moves_along;
        let target = if moves_along {
            let station = reader.number(&STATION);
            reader.exclude("at", "station");
            reader.reference("on", Kind::Beam).map(|beam| Target::Moving { beam, station })
        } else if along {
            reader.exclude("at", "on");
            reader.reference("on", Kind::Beam).map(Target::On)
        } else {
            Anchor::read(&mut reader, "at", &LOADED).filter(|anchor| moves(&mut reader, anchor)).map(Target::At)
        };
        let (force, moment) = match along {
            false => (&FORCE, &MOMENT),
            true => (&FORCE_PER_LENGTH, &MOMENT_PER_LENGTH),
        };
        if !reader.has("force") && !reader.has("moment") {
            reader.missing("force", "or `moment`, or both: each a list of 3");
        }
        let force = reader.vector_or(force, [0.0; 3]);
        let moment = reader.vector_or(moment, [0.0; 3]);
        let follower = reader.boolean("follower", false);
        let input = reader.boolean("input", false);
        for (what, verb, numbers) in [("Force", "along", force), ("Moment", "about", moment)] {
            for (number, axis) in numbers.into_iter().zip(["x", "y", "z"]) {
                let per_length = if along { " per length" } else { "" };
                let frame = match (follower, target) {
                    (false, _) => "global",
                    (true, Some(Target::At(Anchor { point: Some(_), .. }))) => "the point's",
                    (true, Some(Target::At(Anchor { spot: Spot::Body(_), .. }))) => "the body's",
                    (true, _) => "the section's",
                };
                let held = if input { format!(", {HELD}") } else { String::new() };
                reader.context.numbers.slots[number.0].meta.description =
                    format!("{what}{per_length} of load {name} {verb} {frame} {axis}{held}");
            }
        }
        if input {
            for number in force.into_iter().chain(moment) {
                make_input(reader.context, number);
            }
        }
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, target: target?, force, moment, follower, input })
    }

    /// A reason why its numbers do not go together, with the number to blame.
    pub(super) fn objection(&self, numbers: &Numbers) -> Option<(Number, String)> {
        let Target::Moving { station, .. } = self.target else { return None };
        let is_off = !(0.0..=1.0).contains(&numbers.value(station)) && numbers.function(station).is_constant();
        is_off.then(|| {
            (station, String::from("must be from 0 to 1: beyond the ends of the beam the load acts on nothing"))
        })
    }
}
