//! The keys of a section that say how water and air act on it.

use crate::model::file::number::Number;
use crate::model::file::reader::Reader;
use crate::model::file::schema::{Rule, words_of};

pub(super) const OUTER_DIAMETER: Rule =
    Rule::new("outer_diameter", "diameter outside, of the displaced volume and of drag; 0: no fluid acts", "m")
        .from(0.0)
        .along_beam();
pub(super) const DRAG: Rule =
    Rule::new("drag", "drag coefficient across the beam and along it", "").from(0.0).along_beam();
pub(super) const ADDED_MASS: Rule =
    Rule::new("added_mass", "added mass coefficient across the beam and along it", "").from(0.0).along_beam();
pub(super) const CONTENTS_DENSITY: Rule =
    Rule::new("contents_density", "density of what fills the tube", "kg/m3").from(0.0).along_beam();

/// The area per length of the drag along a beam.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DragArea {
    /// The diameter.
    Diameter,
    /// The circumference.
    Circumference,
}

/// The words of `drag_area`.
const DRAG_AREAS: [(&str, DragArea); 2] =
    [("diameter", DragArea::Diameter), ("circumference", DragArea::Circumference)];
/// The same for the table of keys.
pub(super) const DRAG_AREA_WORDS: [&str; 2] = words_of(&DRAG_AREAS);

/// How water and air act on a section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Immersion {
    /// Diameter outside, m; none: that of the shape.
    pub outer_diameter: Option<Number>,
    /// Drag coefficients across the beam and along it; none: no drag.
    pub drag: Option<[Number; 2]>,
    /// Area of the drag along the beam.
    pub drag_area: Option<DragArea>,
    /// Added mass coefficients across the beam and along it; none: no water moves with it.
    pub added_mass: Option<[Number; 2]>,
    /// Density of what fills the tube, kg/m³.
    pub contents_density: Option<Number>,
}

impl Immersion {
    /// Reads the keys; `is_tube`: the section has an inside.
    pub(super) fn read(reader: &mut Reader<'_, '_>, is_tube: bool) -> Self {
        if !is_tube {
            let message = "`contents_density` belongs to shape = \"tube\", which has an inside";
            reader.refuse(CONTENTS_DENSITY.key, message, "count the contents in the line_density or the density");
        }
        let drag_area = reader.has("drag_area").then(|| reader.word("drag_area", &DRAG_AREAS, None)).flatten();
        Self {
            outer_diameter: reader.optional(&OUTER_DIAMETER),
            drag: reader.optional_pair(&DRAG),
            drag_area,
            added_mass: reader.optional_pair(&ADDED_MASS),
            contents_density: reader.optional(&CONTENTS_DENSITY),
        }
    }

    /// Whether air acts on it: its buoyancy alone is nothing to speak of.
    pub fn meets_air(&self) -> bool {
        self.drag.is_some() || self.added_mass.is_some()
    }

    /// All numbers that are written.
    pub fn numbers(&self) -> impl Iterator<Item = Number> {
        let pairs = self.drag.into_iter().chain(self.added_mass).flatten();
        self.outer_diameter.into_iter().chain(pairs).chain(self.contents_density)
    }
}
