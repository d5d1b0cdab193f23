//! Beams that water carries without slowing them.

use super::Note;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::shape::sections;

/// Names beams in water without drag.
pub(super) fn lines(document: &Document) -> Vec<Note> {
    document.beams.iter().filter_map(|beam| without_drag(document, beam)).collect()
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
