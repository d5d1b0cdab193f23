//! From where positions are counted inside the system: the global origin, or the middle of a mechanism that is drawn
//! far from it.
//!
//! A cantilever of steel drawn at map coordinates, 1e6 m away, has axial forces of some newtons that are round-off of
//! its positions.

use crate::math::Vec3;
use crate::model::file::document::Document;
use crate::model::shape::Lines;

/// How many times its extent a mechanism must be away from the origin: nearer, round-off is below 1e-13 of its size.
const FAR: f64 = 1e3;

/// The origin of positions, global, m.
pub(super) fn of(document: &Document, lines: &Lines) -> Vec3 {
    let beams = (0..document.beams.len()).filter_map(|beam| lines.line(beam));
    let nodes = beams.flat_map(|line| line.nodes.iter().map(|node| node.place));
    let bodies = document.bodies.iter().map(|body| super::vector(document, body.position));
    let (mut low, mut high) = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
    for place in nodes.chain(bodies) {
        low = low.inf(&place);
        high = high.sup(&place);
    }
    let (middle, extent) = (0.5 * (low + high), (high - low).norm());
    let is_far = middle.norm().is_finite() && extent > 0.0 && middle.norm() > FAR * extent;
    if is_far { middle } else { Vec3::zeros() }
}
