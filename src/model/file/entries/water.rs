//! `[water]`: the water around the beams, its surface and its flow.

use crate::mechanics::fluid::waves::Stretching;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Rule, words_of};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::number(&[&DENSITY]),
    Key::number(&[&SURFACE]),
    Key::number(&[&DEPTH]),
    Key::list(&[&CURRENT], "3"),
    Key::number(&[&RAMP]),
    Key::word("stretching", &words_of(&STRETCHINGS), "the flow of waves above still water"),
];

const DENSITY: Rule = Rule::new("density", "density of the water", "kg/m3").above(0.0);
const SURFACE: Rule = Rule::new("surface", "height of the still water, z", "m");
const DEPTH: Rule = Rule::new("depth", "depth of the water; without end where it is not given", "m").above(0.0);
const CURRENT: Rule = Rule::new("current", "velocity of the water, by the height z and the time t", "m/s").in_flow();
const RAMP: Rule = Rule::new("ramp", "time in which current and waves grow from nothing", "s").from(0.0);

/// The words of `stretching`.
const STRETCHINGS: [(&str, Stretching); 3] =
    [("none", Stretching::None), ("vertical", Stretching::Vertical), ("wheeler", Stretching::Wheeler)];

/// The section `[water]`.
#[derive(Clone, Debug)]
pub struct WaterSpec {
    /// Where the section stands.
    pub place: Place,
    /// kg/m³.
    pub density: Number,
    /// Height of the still water, m.
    pub surface: Number,
    /// m; none: without end.
    pub depth: Option<Number>,
    /// m/s, by z and t.
    pub current: [Number; 3],
    /// s.
    pub ramp: Number,
    /// The flow of waves above still water.
    pub stretching: Stretching,
}

impl WaterSpec {
    pub(in crate::model) fn read(mut reader: Reader<'_, '_>) -> Self {
        let place = reader.place;
        let water = Self {
            place,
            density: reader.number(&DENSITY),
            surface: reader.number_or(&SURFACE, 0.0),
            depth: reader.optional(&DEPTH),
            current: reader.vector_or(&CURRENT, [0.0; 3]),
            ramp: reader.number_or(&RAMP, 0.0),
            stretching: reader.word("stretching", &STRETCHINGS, Some(Stretching::Wheeler)).unwrap_or_default(),
        };
        reader.finish();
        water
    }
}
