//! `[contact.NAME]`: beams that touch surfaces, each other and themselves.

use super::Parts;
use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Key, Role, Rule};
use crate::model::text::diagnostic::Place;
use crate::model::text::names::Kind;

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::name("of", Role::Names("beam"), "the beam that touches, or a list of beams"),
    Key::name(
        "with",
        Role::Names("surface or beam"),
        "the surface or the other beam that it touches, `itself` for its own coils, or a list of them",
    ),
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

/// The word for the beam itself among what it touches.
pub const ITSELF: &str = "itself";

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
    /// The beams that they touch, by their numbers.
    pub touched: Vec<usize>,
    /// They touch their own coils.
    pub itself: bool,
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
        let with = reader.references_among("with", &[Kind::Surface, Kind::Beam], Some(ITSELF));
        let (radius, stiffness) = (reader.optional(&RADIUS), reader.optional(&STIFFNESS));
        let damping = reader.number_or(&DAMPING, 0.0);
        let (friction, friction_stiffness) = (reader.optional(&FRICTION), reader.optional(&FRICTION_STIFFNESS));
        let place = reader.place;
        reader.finish();
        let (beams, with) = (beams?, with?);
        let of_kind = |kind: Kind| {
            with.iter().flatten().filter(move |(own, _)| *own == kind).map(|(_, index)| *index).collect::<Vec<_>>()
        };
        Some(Self {
            name: name.to_owned(),
            place,
            beams,
            surfaces: of_kind(Kind::Surface),
            touched: of_kind(Kind::Beam),
            itself: with.contains(&None),
            radius,
            stiffness,
            damping,
            friction,
            friction_stiffness,
            bed: None,
        })
    }

    /// Whether beams touch each other or themselves.
    pub fn is_between_beams(&self) -> bool {
        self.itself || !self.touched.is_empty()
    }

    /// The pairs of beams that touch each other, each pair once; twice the same beam: its own coils.
    pub fn beam_pairs(&self) -> Vec<(usize, usize)> {
        let mut pairs: Vec<(usize, usize)> = Vec::new();
        for beam in &self.beams {
            if self.itself {
                pairs.push((*beam, *beam));
            }
            for other in self.touched.iter().filter(|other| *other != beam) {
                if !pairs.contains(&(*other, *beam)) {
                    pairs.push((*beam, *other));
                }
            }
        }
        pairs
    }

    /// The contacts of the system that it stands for: each surface of each beam.
    pub fn pairs(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.beams.iter().flat_map(|beam| self.surfaces.iter().map(|surface| (*beam, *surface)))
    }
}
