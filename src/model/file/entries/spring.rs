//! `[spring.NAME]`: a spring and a damper along the line between two points.

use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::{Anchor, SIDES};
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;

/// A section `[spring.NAME]`.
#[derive(Clone, Debug)]
pub struct SpringSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The first end; the ground is the origin of the global axes.
    pub a: Anchor,
    /// The second end.
    pub b: Anchor,
    /// Stiffness, N/m.
    pub stiffness: Number,
    /// Damping, N s/m.
    pub damping: Number,
    /// Unstretched length, m; default: the distance of the ends as drawn.
    pub length: Option<Number>,
}

impl SpringSpec {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        let a = Anchor::read(&mut reader, "a", &SIDES);
        let b = Anchor::read(&mut reader, "b", &SIDES);
        Anchor::expect_motion(&mut reader, a, b);
        let stiffness = reader.number(&schema::SPRING_STIFFNESS);
        let damping = reader.number_or(&schema::SPRING_DAMPING, 0.0);
        let length = reader.optional(&schema::SPRING_LENGTH);
        let place = reader.place;
        reader.finish();
        Some(Self { name: name.to_owned(), place, a: a?, b: b?, stiffness, damping, length })
    }
}
