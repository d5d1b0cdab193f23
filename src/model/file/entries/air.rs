//! `[air]`: the air around beams and bodies, above the water if there is any, and its wind.

use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Rule};
use crate::model::text::diagnostic::Place;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[Key::number(&[&DENSITY]), Key::list(&[&WIND], "3"), Key::number(&[&RAMP])];

/// Density of dry air at 15 °C at sea level (International Standard Atmosphere), kg/m³.
const USUAL_DENSITY: f64 = 1.225;

const DENSITY: Rule = Rule::new("density", "density of the air; 1.225 where it is not given", "kg/m3").above(0.0);
const WIND: Rule = Rule::new("wind", "velocity of the air, by the height z and the time t", "m/s").in_flow();
const RAMP: Rule = Rule::new("ramp", "time in which the wind grows from nothing", "s").from(0.0);

/// The section `[air]`.
#[derive(Clone, Debug)]
pub struct AirSpec {
    /// Where the section stands.
    pub place: Place,
    /// kg/m³.
    pub density: Number,
    /// m/s, by z and t.
    pub wind: [Number; 3],
    /// s.
    pub ramp: Number,
}

impl AirSpec {
    pub(in crate::model) fn read(mut reader: Reader<'_, '_>) -> Self {
        let air = Self {
            place: reader.place,
            density: reader.number_or(&DENSITY, USUAL_DENSITY),
            wind: reader.vector_or(&WIND, [0.0; 3]),
            ramp: reader.number_or(&RAMP, 0.0),
        };
        reader.finish();
        air
    }
}
