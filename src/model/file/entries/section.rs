//! `[section.NAME]`: a doubly symmetric cross-section, as a shape, as integrals, or as a shape with some integrals given.

use crate::model::file::number::{Number, Numbers};
use crate::model::file::reader::Reader;
use crate::model::file::schema;
use crate::model::text::diagnostic::Place;

/// A section `[section.NAME]`.
#[derive(Clone, Debug)]
pub struct SectionSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The outline.
    pub shape: Shape,
    /// Area, m²; always there for a general section, as the next three are.
    pub area: Option<Number>,
    /// `∫ z² dA`, m⁴.
    pub second_moment_y: Option<Number>,
    /// `∫ y² dA`, m⁴.
    pub second_moment_z: Option<Number>,
    /// Saint-Venant's torsion constant, m⁴.
    pub torsion_constant: Option<Number>,
    /// `∫ (y² + z²) dA` for spin inertia and Wagner term, m⁴; default: the sum of the second moments.
    pub polar_moment: Option<Number>,
    /// `∫ y⁴ dA`, `∫ y² z² dA`, `∫ z⁴ dA`, m⁶; default: of the shape; for a general section of a rectangle with the same area and second moments.
    pub fourth_moments: Option<[Number; 3]>,
}

/// An outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shape {
    /// Width along the section's y, height along its z, m.
    Rectangle {
        /// Along y, m.
        width: Number,
        /// Along z, m.
        height: Number,
    },
    /// A full circle.
    Circle {
        /// Radius, m.
        radius: Number,
    },
    /// A circular tube.
    Tube {
        /// Inner radius, m.
        inner: Number,
        /// Outer radius, m.
        outer: Number,
    },
    /// No outline: integrals only.
    General,
}

#[derive(Clone, Copy)]
enum Word {
    Rectangle,
    Circle,
    Tube,
    General,
}

/// The words of `shape`.
const SHAPES: [(&str, Word); 4] =
    [("rectangle", Word::Rectangle), ("circle", Word::Circle), ("tube", Word::Tube), ("general", Word::General)];

impl SectionSpec {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        let place = reader.place;
        // Without the shape nobody knows which keys belong here.
        let Some(word) = reader.word("shape", &SHAPES, None) else {
            reader.abandon();
            return None;
        };
        let shape = match word {
            Word::Rectangle => {
                Shape::Rectangle { width: reader.number(&schema::WIDTH), height: reader.number(&schema::HEIGHT) }
            }
            Word::Circle => Shape::Circle { radius: reader.number(&schema::RADIUS) },
            Word::Tube => Shape::Tube { inner: reader.number(&schema::INNER), outer: reader.number(&schema::OUTER) },
            Word::General => Shape::General,
        };
        let mut integral = |rule| match word {
            Word::General => Some(reader.number(rule)),
            _ => reader.optional(rule),
        };
        let area = integral(&schema::AREA);
        let second_moment_y = integral(&schema::SECOND_MOMENT_Y);
        let second_moment_z = integral(&schema::SECOND_MOMENT_Z);
        let torsion_constant = integral(&schema::TORSION_CONSTANT);
        let polar_moment = reader.optional(&schema::POLAR_MOMENT);
        let fourth_moments = reader.optional_vector(&schema::FOURTH_MOMENTS);
        reader.finish();
        let name = name.to_owned();
        Some(Self {
            name,
            place,
            shape,
            area,
            second_moment_y,
            second_moment_z,
            torsion_constant,
            polar_moment,
            fourth_moments,
        })
    }

    /// What no single number can be wrong about: the wall of a tube has a thickness.
    pub(in crate::model) fn objection(&self, numbers: &Numbers) -> Option<(Number, String)> {
        let Shape::Tube { inner, outer } = self.shape else { return None };
        let (inside, outside) = (numbers.values[inner.0], numbers.values[outer.0]);
        (inside >= outside).then(|| (inner, format!("must be less than the outer radius, {outside}")))
    }
}
