//! Beams that water carries without slowing them, and air that meets nothing.

use super::Note;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::number::Number;
use crate::model::shape::sections;

/// Names beams in water without drag.
pub(super) fn lines(document: &Document) -> Vec<Note> {
    document.beams.iter().filter_map(|beam| without_drag(document, beam)).chain(idle_air(document)).collect()
}

fn idle_air(document: &Document) -> Option<Note> {
    let air = document.air.as_ref()?;
    let meets = |beam: &BeamSpec| document.sections.get(beam.section).is_some_and(|own| own.immersion.meets_air());
    let is_idle =
        !document.beams.iter().any(meets) && document.bodies.iter().all(|body| document.value(body.volume) == 0.0);
    is_idle.then(|| Note {
        place: air.place,
        text: String::from(
            "[air] acts on no beam and no body: give sections `drag`, 1.2 and 0 are usual for a cylinder, and bodies \
             a `volume` and `drag_areas`",
        ),
    })
}

fn without_drag(document: &Document, beam: &BeamSpec) -> Option<Note> {
    let water = document.water.as_ref()?;
    // Nothing is slowed that stands in still water.
    let stands = |number: &Number| document.function(*number).is_constant() && document.value(*number) == 0.0;
    if document.simulation.analysis == Analysis::Static && water.current.iter().all(stands) {
        return None;
    }
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
