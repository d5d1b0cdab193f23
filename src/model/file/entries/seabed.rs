//! `[seabed]`: the bottom of the water, on which beams come to lie. It stands for a plane and a contact of the beams in
//! water with it, both of the name `seabed`.

use super::Parts;
use super::contact::{Bed, ContactSpec};
use super::section::Shape as SectionShape;
use super::surface::{Shape, SurfaceSpec};
use super::water::WaterSpec;
use crate::model::file::reader::Reader;
use crate::model::file::reader::anchor::Spot;
use crate::model::file::schema::{Key, Rule, words_of};

/// The name of the plane and of the contact.
pub const NAME: &str = "seabed";

/// The keys of the section.
pub(super) const KEYS: &[Key] = &[
    Key::number(&[&STIFFNESS]),
    Key::number(&[&DAMPING]),
    Key::list(&[&FRICTION], "1 or 2"),
    Key::number(&[&SHEAR_STIFFNESS]),
    Key::flag("friction_in_statics", "true: the first equilibrium has friction too, which depends on the drawing"),
    Key::word("contact", &words_of(&SIDES), "what touches the bottom: the outside of a beam or its axis"),
    Key::list(&[&SLOPE], "2"),
];

const STIFFNESS: Rule =
    Rule::new("stiffness", "pressure of the bottom per penetration, which acts on the diameter of the beam", "Pa/m")
        .above(0.0)
        .tunable();
const DAMPING: Rule =
    Rule::new("damping", "pressure of the bottom per rate of penetration, on the diameter of the beam", "Pa.s/m")
        .from(0.0)
        .tunable();
const FRICTION: Rule =
    Rule::new("friction", "coefficient of dry friction, or those along the beam and across it", "").from(0.0).tunable();
const SHEAR_STIFFNESS: Rule = Rule::new(
    "shear_stiffness",
    "shear stress per displacement until the beam slides, on its diameter; by default `stiffness`",
    "Pa/m",
)
.above(0.0)
.tunable();
const SLOPE: Rule =
    Rule::new("slope", "rise of the bottom per length along x and along y; the depth is that at the origin", "");

/// The part of a beam that touches the bottom.
const SIDES: [(&str, bool); 2] = [("outside", false), ("axis", true)];

/// Reads the section, and adds what it stands for to `parts`.
pub(in crate::model) fn read(mut reader: Reader<'_, '_>, water: Option<&WaterSpec>, parts: &mut Parts) {
    let place = reader.place;
    let (stiffness, damping) = (reader.number(&STIFFNESS), reader.number_or(&DAMPING, 0.0));
    let [along, across] = match reader.length_of(FRICTION.key) {
        Some(_) => reader.optional_pair(&FRICTION).map_or([None; 2], |pair| pair.map(Some)),
        None => [reader.optional(&FRICTION); 2],
    };
    let friction_stiffness = reader.optional(&SHEAR_STIFFNESS);
    let friction_in_statics = reader.boolean("friction_in_statics", false);
    let at_axis = reader.word("contact", &SIDES, Some(false)).unwrap_or_default();
    let slope = reader.pair_or(&SLOPE, [0.0; 2]);
    let depth = water.and_then(|water| Some((water, water.depth?)));
    let Some((water, depth)) = depth else {
        let (message, help) = match water {
            Some(_) => ("[seabed] is in water without a bottom", "give `depth` in [water], m below its surface"),
            None => ("[seabed] has no water", "add [water] with its `density` and its `depth`"),
        };
        reader.context.report.error(place, message, "the depth of the water is missing", help);
        return reader.abandon();
    };
    reader.finish();
    let name = String::from(NAME);
    let has_diameter = |section: usize| {
        parts.sections.get(section).is_some_and(|section| {
            let is_round = matches!(section.shape, SectionShape::Circle { .. } | SectionShape::Tube { .. });
            is_round || section.immersion.outer_diameter.is_some()
        })
    };
    let beams = parts.beams.iter().enumerate().filter(|(_, beam)| has_diameter(beam.section));
    parts.contacts.push(ContactSpec {
        name: name.clone(),
        place,
        beams: beams.map(|(number, _)| number).collect(),
        surfaces: vec![parts.surfaces.len()],
        touched: Vec::new(),
        itself: false,
        radius: None,
        stiffness: Some(stiffness),
        damping,
        friction: along,
        friction_stiffness,
        bed: Some(Bed { at_axis, across, friction_in_statics }),
    });
    let shape = Shape::Bottom { surface: water.surface, depth, slope };
    parts.surfaces.push(SurfaceSpec { name, place, on: Spot::Ground, offset: None, shape });
}
