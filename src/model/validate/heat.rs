//! Temperatures along beams: where they are asked for, and what is wrong with them there.

use super::{sections, shown};
use crate::math::quadrature::{GAUSS_POINTS, LOBATTO_POINTS};
use crate::mechanics::beam::centerline::Centerline;
use crate::mechanics::beam::profile::inside;
use crate::mechanics::input::heat::POINTS;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::number::Number;
use crate::model::text::diagnostic::Diagnostic;

/// Arc lengths at which an element knows its temperature, m; at its ends just inside it.
#[derive(Clone, Copy, Debug)]
pub struct Places {
    /// Of the temperature on the axis.
    pub axial: [f64; POINTS],
    /// Of its gradient.
    pub bending: [f64; POINTS],
}

/// Where the elements of a beam know their temperatures.
pub fn places(line: &Centerline) -> impl Iterator<Item = Places> + '_ {
    let length: f64 = line.spans.iter().map(|span| span.length).sum();
    line.spans.iter().map(move |span| {
        let ends = [span.node, span.node + 1].map(|node| line.nodes[node].fraction);
        let at = |xi: f64| inside(ends, xi) * length;
        Places { axial: LOBATTO_POINTS.map(at), bending: GAUSS_POINTS.map(at) }
    })
}

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
