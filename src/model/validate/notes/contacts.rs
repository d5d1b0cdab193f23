//! Contacts whose mesh is too coarse for what they touch.

use super::super::meshes::LONGEST;
use super::Note;
use crate::model::file::document::Document;
use crate::model::shape::Lines;

/// Says which beams have elements that are too long for a surface.
pub fn coarse_contacts(document: &Document, lines: &Lines) -> Vec<Note> {
    let mut notes = Vec::new();
    for contact in &document.contacts {
        // A run makes the meshes of the program finer until it is right.
        let given = |pair: &(usize, usize)| !document.beams[pair.0].is_meshed_by_program;
        for (beam, surface) in contact.pairs().filter(given) {
            let Some(radius) = document.surfaces[surface].shape.bending_radius(|number| document.value(number)) else {
                continue;
            };
            let Some(line) = lines.line(beam) else { continue };
            let longest = line.spans.iter().map(|span| span.length).fold(0.0, f64::max);
            if longest > LONGEST * radius {
                let whole: f64 = line.spans.iter().map(|span| span.length).sum();
                let (name, surface) = (&document.beams[beam].name, &document.surfaces[surface].name);
                let text = format!(
                    "elements of beam {name} are up to {longest:.3} m long, too long to lie on surface {surface} with \
                     its radius of {radius} m. Where the beam is bent around it, take elements = {:.0} or more: half \
                     its radius each",
                    (whole / (0.5 * radius)).ceil()
                );
                notes.push(Note { place: contact.place, text });
            }
        }
    }
    notes
}
