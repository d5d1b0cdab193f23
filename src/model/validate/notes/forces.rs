//! Forces that do not do what their author meant: laws of springs that push away from rest, stops that push from the
//! start.

use super::Note;
use crate::model::file::document::Document;
use crate::model::file::entries::body::BodySpec;
use crate::model::file::entries::simulation::{Analysis, Initial};
use crate::model::file::entries::spring::SpringLaw;
use crate::model::file::number::Number;

/// Elongations at which the sign of a law is looked at, m or rad.
const ELONGATIONS: [f64; 5] = [1e-4, 1e-3, 1e-2, 0.1, 0.5];

/// Names springs whose law pushes away from rest at every elongation: the sign is the other one.
pub fn turned_laws(document: &Document) -> Vec<Note> {
    let note = |number: Number| {
        let function = document.function(number);
        let pushes = |x: &f64| {
            let [stretched, squeezed] = [*x, -x].map(|x| function.with_rate(x, 0.0)[0]);
            stretched < 0.0 && squeezed > 0.0
        };
        ELONGATIONS.iter().all(pushes).then(|| {
            let text = "pushes away from rest at every elongation, and nothing stays there. A spring that pulls back has a positive tension where x is positive: \
                        \"100*x\", not \"-100*x\"";
            Note::of(document, number, text)
        })
    };
    let laws = document.springs.iter().filter_map(|spring| match spring.law {
        SpringLaw::Function(force) => Some(force),
        SpringLaw::Linear { .. } => None,
    });
    laws.filter_map(note).collect()
}

/// Names stops that push as drawn, where every coordinate is 0.
pub fn violated_stops(document: &Document) -> Vec<Note> {
    let simulation = &document.simulation;
    if simulation.analysis == Analysis::Dynamic && simulation.initial == Initial::Equilibrium {
        return Vec::new();
    }
    let limits = document.stops.iter().flat_map(|stop| {
        let lower = stop.lower.filter(|number| document.value(*number) > 0.0).map(|number| (number, "below"));
        let upper = stop.upper.filter(|number| document.value(*number) < 0.0).map(|number| (number, "above"));
        lower.into_iter().chain(upper)
    });
    let note = |(number, side): (Number, &str)| {
        let text = format!(
            "= {}: the coordinate is 0 as drawn, {side} this limit, so that the stop pushes from the start. Coordinates count from the drawing: shift the limits, or draw \
             the joint within them",
            document.value(number)
        );
        Note::of(document, number, &text)
    };
    limits.map(note).collect()
}

/// Names bodies of a copied section that all lie at one place.
pub fn stacked_copies(document: &Document) -> Vec<Note> {
    let mut notes: Vec<Note> = Vec::new();
    for (number, body) in document.bodies.iter().enumerate() {
        let origin = document.origin_place(body.place);
        let is_copy = |other: &&BodySpec| document.origin_place(other.place) == origin && other.name != body.name;
        let place = document.vector(body.position);
        let mut same = document.bodies[number + 1..].iter().filter(is_copy);
        let Some(other) = same.find(|other| document.vector(other.position) == place) else { continue };
        let text = format!(
            "the copies {} and {} have their centers of mass at the same place, {place:?}. Give the copies `turn` or `move`, or a position with the index in it",
            body.name, other.name
        );
        notes.push(Note { place: body.place, text });
    }
    notes
}
