//! `[load.NAME]`: a force and a moment at a point of a beam, or along a beam.

use super::anchor::Anchor;
use crate::model::diagnostic::Place;
use crate::model::names::Kind;
use crate::model::number::{Number, Written};
use crate::model::reader::Reader;
use crate::model::schema;

/// A section `[load.NAME]`.
#[derive(Clone, Debug)]
pub struct Load {
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
    /// true: it turns with the section.
    pub follower: bool,
    /// true: the host gives force and moment; the numbers are start values.
    pub input: bool,
}

/// What a load acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// A point.
    At(Anchor),
    /// A whole beam, by its place in the list: force and moment are per length.
    On(usize),
}

impl Load {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        let along = reader.has("on");
        let target = if along {
            reader.exclude("at", "on");
            Some(Target::On(reader.reference("on", Kind::Beam)))
        } else {
            Anchor::read_beam_point(&mut reader, "at").map(Target::At)
        };
        let (force, moment) = match along {
            false => (&schema::FORCE, &schema::MOMENT),
            true => (&schema::FORCE_PER_LENGTH, &schema::MOMENT_PER_LENGTH),
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
                let frame = if follower { "the section's" } else { "global" };
                let held = if input { ", held during a communication step" } else { "" };
                reader.context.numbers.slots[number.0].meta.description =
                    format!("{what}{per_length} of load {name} {verb} {frame} {axis}{held}");
            }
        }
        if input {
            for number in force.into_iter().chain(moment) {
                make_input(&mut reader, number);
            }
        }
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, target: target?, force, moment, follower, input })
    }
}

/// Makes a component an input of the FMU.
fn make_input(reader: &mut Reader<'_, '_>, number: Number) {
    let context = &mut reader.context;
    let slot = &mut context.numbers.slots[number.0];
    if let Written::Formula(_) = slot.written {
        let message = format!("`{}` is an input and an expression", slot.meta.name);
        context.report.error(slot.place, &message, "a number was expected: the start value of the input", "");
    }
    slot.meta.input = true;
    slot.listed.get_or_insert(usize::MAX);
}
