//! `[load.NAME]`: a force and a moment at a point of a beam, or along a beam.

use super::anchor::Anchor;
use crate::model::diagnostic::Place;
use crate::model::names::Kind;
use crate::model::number::Number;
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
        reader.unavailable("input", "available: input = false; loads as expressions of t");
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, target: target?, force, moment, follower })
    }
}
