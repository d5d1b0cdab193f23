//! The mistakes of temperatures along beams.

use crate::mechanics::beam::centerline::Centerline;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::number::Number;
use crate::model::shape::heat::{Places, places};
use crate::model::shape::{sections, shown};
use crate::model::text::diagnostic::Diagnostic;

/// The first mistake of the temperature of `beam`.
pub fn mistake(document: &Document, beam: &BeamSpec, line: &Centerline) -> Option<Diagnostic> {
    let written = || [beam.temperature].into_iter().chain(beam.gradients()).flatten();
    let first = written().next()?;
    if sections::expansion(document, beam).is_none() {
        let message = format!("beam {} has a temperature, and its material no thermal expansion", beam.name);
        let label = "by this the beam would expand";
        let help = "give the material `expansion`, in 1/K: 1.2e-5 for steel";
        return Some(document.diagnostic(document.place(first), &message, label, help));
    }
    if !written().all(|number| document.is_sound(number)) {
        return None;
    }
    let functions = written().map(|number| (number, document.function(number)));
    functions.filter(|(_, function)| function.has_rate()).find_map(|(number, function)| {
        let points = |places: Places| if Some(number) == beam.temperature { places.axial } else { places.bending };
        places(line).flat_map(points).find_map(|s| wrong_at(document, beam, (number, &function), s))
    })
}

/// What is wrong with a temperature at the arc length `s`, m, at the start.
fn wrong_at(
    document: &Document,
    beam: &BeamSpec,
    (number, function): (Number, &Function),
    s: f64,
) -> Option<Diagnostic> {
    let (here, time) = (function.at_rate(s), document.drawn_at(0.0));
    let value = here.value(time);
    let objection = document.objection_to(number, value)?;
    let there = format!("at s = {} m of beam {}", shown(s), beam.name);
    let place = document.place(number);
    Some(match here.undefined(time) {
        Some(undefined) => {
            let message = format!("`{}` has no value {there}", document.name(number));
            let help = format!("add rows to the table, or set outside = \"hold\" in [function.{}]", undefined.name);
            document.diagnostic(place, &message, &undefined.to_string(), &help)
        }
        None => {
            let message = format!("`{}` {objection}", document.name(number));
            let help = "`s` is the arc length from the start of the beam, in m";
            document.diagnostic(place, &message, &format!("{there} this is {}", shown(value)), help)
        }
    })
}
