//! `[beam.NAME]`: a beam and how it is divided and formulated; its line is in curve.rs.

use super::curve::Line;
use crate::mechanics::beam::quadratic_twist::Twist;
use crate::mechanics::beam::strain::Strain;
use crate::model::diagnostic::Place;
use crate::model::names::Kind;
use crate::model::number::Number;
use crate::model::reader::Reader;
use crate::model::schema;

/// A section `[beam.NAME]`.
#[derive(Clone, Debug)]
pub struct Beam {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// Place in the list of materials.
    pub material: usize,
    /// Place in the list of sections.
    pub section: usize,
    /// The line it follows; none: it is wrong, and reported.
    pub line: Option<Line>,
    /// Direction of the section's y at the start, to be made perpendicular to the tangent.
    pub y_axis: [Number; 3],
    /// Number of elements.
    pub elements: Number,
    /// Which strains the energy knows.
    pub strain: Strain,
    /// How the twist runs inside an element.
    pub twist: Twist,
    /// false: the twist is left out.
    pub torsion: bool,
    /// Additional turn of the section from start to end, rad.
    pub pretwist: Number,
    /// Initial velocity of the start, m/s.
    pub velocity: [Number; 3],
    /// Initial angular velocity, rad/s.
    pub angular_velocity: [Number; 3],
}

/// The words of `strain`.
const STRAINS: [(&str, Strain); 3] =
    [("large", Strain::Large), ("large_truncated", Strain::LargeTruncated), ("small", Strain::Small)];

/// The words of `twist`.
const TWISTS: [(&str, Twist); 2] = [("linear", Twist::Linear), ("quadratic", Twist::Quadratic)];

impl Beam {
    pub(in crate::model) fn read(name: &str, mut reader: Reader<'_, '_>) -> Option<Self> {
        // The first ones stand in for what is reported: the beam must keep its place in the list.
        let material = reader.reference("material", Kind::Material).unwrap_or(0);
        let section = reader.reference("section", Kind::Section).unwrap_or(0);
        let line = Line::read(&mut reader);
        let y_axis = reader.vector_or(&schema::Y_AXIS, [0.0, 1.0, 0.0]);
        let elements = reader.number(&schema::ELEMENTS);
        reader.word("element", &[("ancf14", ())], &["ancf24"], Some(()));
        let strain = reader.word("strain", &STRAINS, &[], Some(Strain::Large)).unwrap_or(Strain::Large);
        let twist = reader.word("twist", &TWISTS, &[], Some(Twist::Linear)).unwrap_or(Twist::Linear);
        let torsion = reader.boolean("torsion", true);
        let pretwist = reader.number_or(&schema::PRETWIST, 0.0);
        let velocity = reader.vector_or(&schema::VELOCITY, [0.0; 3]);
        let angular_velocity = reader.vector_or(&schema::ANGULAR_VELOCITY, [0.0; 3]);
        let place = reader.place;
        reader.finish();
        Some(Self {
            name: name.to_owned(),
            place,
            material,
            section,
            line,
            y_axis,
            elements,
            strain,
            twist,
            torsion,
            pretwist,
            velocity,
            angular_velocity,
        })
    }
}
