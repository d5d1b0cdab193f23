//! How thick a beam is for what it touches.

use super::sections;
use crate::model::file::document::Document;
use crate::model::file::entries::contact::ContactSpec;

/// Distance of the surface of a beam from its axis, m.
pub fn contact_radius(document: &Document, written: &ContactSpec, beam: usize) -> f64 {
    // The radius of a contact is that of the beams that touch, not of other ones that they touch.
    let written = written.radius.filter(|_| written.beams.contains(&beam));
    written.map_or_else(|| own_radius(document, beam), |radius| document.value(radius))
}

/// The same where no contact says it: half the largest extent of the section, m.
pub fn own_radius(document: &Document, beam: usize) -> f64 {
    // A file with a section that it does not have is refused.
    let Some(own) = document.sections.get(document.beams[beam].section) else { return 0.0 };
    let outline = sections::at_start(document, own).outline.size().map(|size| size[0].max(size[1]));
    // 0 keeps water off a beam, and says nothing of its size.
    let diameter = own.immersion.outer_diameter.map(|number| document.value(number)).filter(|own| *own > 0.0);
    0.5 * diameter.or(outline).unwrap_or(0.0)
}
