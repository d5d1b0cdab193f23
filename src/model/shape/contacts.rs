//! How thick a beam is for what it touches.

use super::sections;
use crate::model::file::document::Document;
use crate::model::file::entries::contact::ContactSpec;

/// Distance of the surface of a beam from its axis, m.
pub fn contact_radius(document: &Document, written: &ContactSpec, beam: usize) -> f64 {
    written.radius.map_or_else(
        || {
            let section = sections::at_start(document, &document.sections[document.beams[beam].section]);
            section.outline.size().map_or(0.0, |size| 0.5 * size[0].max(size[1]))
        },
        |radius| document.value(radius),
    )
}
