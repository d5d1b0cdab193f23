//! `[point.NAME]`: a named place with axes, rigidly tied to the ground, a body, a frame or a section of a beam.

use super::Parts;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Anchor, CARRIERS, Spot};
use crate::model::file::schema::{Key, PLACES, Role, Rule};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("on", Role::Name(PLACES), "what the point is rigidly tied to"),
    Key::global(&[&OFFSET], Role::Offset),
    Key::global(&[&POINT_AXES], Role::Axes),
];

const OFFSET: Rule = Rule::new("offset", "place of the point relative to what it is on, in the axes of that", "m");
const POINT_AXES: Rule = Rule::new("axes", "axes of the point as drawn, global, one per row", "");

/// A section `[point.NAME]`.
#[derive(Clone, Debug)]
pub struct PointSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// What it is tied to; default: the ground.
    pub on: Anchor,
    /// Its position relative to that, in the axes of that, m: global axes of the ground, body axes from the center of
    /// mass, section axes of a beam.
    pub offset: [Number; 3],
    /// Its axes as drawn, global, one per row; default: those of what it is tied to.
    pub axes: Option<[[Number; 3]; 3]>,
}

impl PointSpec {
    /// Also tells the context what the point is tied to, for all that refers to it. A mistake in `on` leaves a point of
    /// the ground, to which no reference is found.
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let place = reader.place;
        let ground = Anchor { place, spot: Spot::Ground, point: None };
        let on = if reader.has("on") { Anchor::read(&mut reader, "on", &CARRIERS) } else { Some(ground) };
        let offset = reader.vector_or(&OFFSET, [0.0; 3]);
        let axes = reader.table(&POINT_AXES);
        reader.context.carriers.push(on);
        reader.finish();
        Some(Self { name: name.to_owned(), place, on: on.unwrap_or(ground), offset, axes })
    }
}
