//! `[contact.NAME]`: beams that touch surfaces.

use super::Parts;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("of", Role::Names("beam"), "the beam that touches, or a list of beams"),
    Key::name("with", Role::Names("surface"), "the surface that it touches, or a list of surfaces"),
    Key::number(&[&RADIUS]),
    Key::number(&[&STIFFNESS]),
    Key::number(&[&DAMPING]),
    Key::number(&[&FRICTION]),
    Key::number(&[&FRICTION_STIFFNESS]),
];

const RADIUS: Rule = Rule::new(
    "radius",
    "distance of the surface of the beam from its axis; by default half the largest extent of its section",
    "m",
)
.from(0.0);
const STIFFNESS: Rule =
    Rule::new("stiffness", "force per length of beam and penetration; by default that of the beam itself", "N/m2")
        .above(0.0)
        .tunable();
const DAMPING: Rule =
    Rule::new("damping", "share of the elastic force per rate of penetration", "s/m").from(0.0).tunable();
const FRICTION: Rule = Rule::new("friction", "coefficient of dry friction", "").from(0.0).tunable();
const FRICTION_STIFFNESS: Rule = Rule::new(
    "friction_stiffness",
    "force per length and displacement while both sides stick; by default `stiffness`",
    "N/m2",
)
.above(0.0)
.tunable();

/// A section `[contact.NAME]`.
#[derive(Clone, Debug)]
pub struct ContactSpec {
    /// Its name.
    pub name: String,
    /// Where the name stands.
    pub place: Place,
    /// The beams, by their numbers.
    pub beams: Vec<usize>,
    /// The surfaces, by their numbers.
    pub surfaces: Vec<usize>,
    /// Distance of the surface of the beams from their axes, m; none: by their sections.
    pub radius: Option<Number>,
    /// Force per length and penetration, N/m²; none: by the beams.
    pub stiffness: Option<Number>,
    /// Share of the force that is added for each unit of the rate of the penetration, s/m.
    pub damping: Number,
    /// Coefficient of dry friction; none: it is smooth.
    pub friction: Option<Number>,
    /// Force per length and displacement while both sides stick, N/m²; none: the stiffness.
    pub friction_stiffness: Option<Number>,
    /// The seabed, whose stiffness and damping act on the diameter of beams; none: a surface.
    pub bed: Option<Bed>,
}

/// How a contact with the bottom differs from one with a rigid surface: its numbers act on the diameter of the beam.
#[derive(Clone, Copy, Debug)]
pub struct Bed {
    /// The axis of the beam touches, else its outside.
    pub at_axis: bool,
    /// Coefficient of friction across the beam; that of the contact is along it.
    pub across: Option<Number>,
    /// The first equilibrium has friction.
    pub friction_in_statics: bool,
}

impl ContactSpec {
    pub(super) fn read(name: &str, mut reader: Reader<'_, '_>, _: &Parts) -> Option<Self> {
        let beams = reader.references("of", Kind::Beam);
        let surfaces = reader.references("with", Kind::Surface);
        let (radius, stiffness) = (reader.optional(&RADIUS), reader.optional(&STIFFNESS));
        let damping = reader.number_or(&DAMPING, 0.0);
        let (friction, friction_stiffness) = (reader.optional(&FRICTION), reader.optional(&FRICTION_STIFFNESS));
        let place = reader.place;
        reader.finish();
        let (beams, surfaces) = (beams?, surfaces?);
        Some(Self {
            name: name.to_owned(),
            place,
            beams,
            surfaces,
            radius,
            stiffness,
            damping,
            friction,
            friction_stiffness,
            bed: None,
        })
    }

    /// The contacts of the system that it stands for: each surface of each beam.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.beams.iter().flat_map(|beam| self.surfaces.iter().map(|surface| (*beam, *surface)))
    }
}
