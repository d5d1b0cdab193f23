//! Lines without stiffness of their own, and beams that water carries without slowing them.

use super::Note;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::section::{Rigidities, Shape};
use crate::model::shape::{Lines, sections, shown};

/// Names the rigidity that stands in for one of 0, and beams in water without drag.
pub(super) fn lines(document: &Document, lines: &Lines) -> Vec<Note> {
    let beams = || document.beams.iter().enumerate();
    let soft = beams().filter_map(|(number, beam)| without_stiffness(document, lines, number, beam));
    let free = beams().filter_map(|(_, beam)| without_drag(document, beam));
    soft.chain(free).collect()
}

fn without_stiffness(document: &Document, lines: &Lines, number: usize, beam: &BeamSpec) -> Option<Note> {
    let section = document.sections.get(beam.section)?;
    let Shape::Rigidities(Rigidities { bending: [y, z], torsion, .. }) = section.shape else { return None };
    let least = sections::least_rigidity(document, beam, lines.line(number)?);
    let none = [y, z, torsion].into_iter().find(|own| document.value(*own) == 0.0).filter(|_| least > 0.0)?;
    let text = format!(
        "is 0: beam {} is computed with {} N m2, 1e-7 of its weight times the square of \
         its longest element",
        beam.name,
        shown(least)
    );
    Some(Note::of(document, none, &text))
}

fn without_drag(document: &Document, beam: &BeamSpec) -> Option<Note> {
    document.water.as_ref()?;
    let section = document.sections.get(beam.section)?;
    let diameter = sections::outer_diameter(section, |number| document.value(number))?;
    let is_dragged = section.immersion.drag.is_some() || section.immersion.added_mass.is_some();
    (diameter > 0.0 && !is_dragged).then(|| Note {
        place: beam.place,
        text: format!(
            "beam {} is in water, and its section {} has no `drag` and no `added_mass`: the water \
             carries it and does not slow it. Give both; 1.2 and 1 are usual across a cylinder, and 0 leaves them out",
            beam.name, section.name
        ),
    })
}
