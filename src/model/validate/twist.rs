//! Elements that are twisted too far, by the pretwist of the beam or by the turn of its section.

use crate::math::curve_defect::LARGEST_BEND;
use crate::mechanics::beam::centerline::{Centerline, Span};
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::number::Number;
use crate::model::shape::lines::{self, MOST_PROPOSED};
use crate::model::shape::shown;
use crate::model::text::diagnostic::Diagnostic;

/// The most pretwist of an element, rad: a right angle with the round-off of the fractions of nodes.
const LARGEST_TWIST: f64 = LARGEST_BEND * (1.0 + 1e-9);

/// The mistake of a beam that has an element with too much pretwist.
pub fn by_pretwist(document: &Document, beam: &BeamSpec, line: &Centerline) -> Option<Diagnostic> {
    let pretwist = document.value(beam.pretwist);
    let angle = most_twisted(pretwist, line);
    if !pretwist.is_finite() || angle <= LARGEST_TWIST {
        return None;
    }
    let elements = line.spans.len();
    let message = format!("an element of beam {} is pretwisted by {:.1} degrees", beam.name, angle.to_degrees());
    let label = format!("{} rad over {elements} elements", shown(pretwist));
    let most = format!("the limit is {} degrees an element", LARGEST_BEND.to_degrees().round());
    let help = match enough_for_twist(document, beam, pretwist, elements, angle) {
        Some(count) => format!("{most}: take elements = {count}; pretwist is in rad, from start to end"),
        None => format!("{most}; pretwist is in rad, from start to end"),
    };
    Some(document.diagnostic(document.place(beam.pretwist), &message, &label, &help))
}

/// The largest share of a pretwist, which grows with the arc length, that an element has, rad.
fn most_twisted(pretwist: f64, line: &Centerline) -> f64 {
    let share = |span: &Span| line.nodes[span.node + 1].fraction - line.nodes[span.node].fraction;
    line.spans.iter().map(|span| (pretwist * share(span)).abs()).fold(0.0, f64::max)
}

/// A number of elements, more than `elements`, none of which has too much pretwist; with so many one has `angle`, rad.
fn enough_for_twist(
    document: &Document,
    beam: &BeamSpec,
    pretwist: f64,
    elements: usize,
    mut angle: f64,
) -> Option<usize> {
    let mut count = elements;
    while angle > LARGEST_TWIST {
        count = usize::max(count + 1, (count as f64 * angle / LARGEST_TWIST).ceil() as usize);
        if count > MOST_PROPOSED {
            return None;
        }
        angle = most_twisted(pretwist, &lines::line(document, beam, count).ok()??);
    }
    Some(count)
}

/// An element between whose ends the section turns too far.
pub fn by_section(
    document: &Document,
    beam: &BeamSpec,
    line: &Centerline,
    twist: Number,
    length: f64,
) -> Option<Diagnostic> {
    let function = document.function(twist);
    let turn = |node: usize| {
        let fraction = line.nodes[node].fraction;
        function.value(fraction * length) + document.value(beam.pretwist) * fraction
    };
    let angle = line.spans.iter().map(|span| (turn(span.node + 1) - turn(span.node)).abs()).fold(0.0, f64::max);
    (angle > LARGEST_TWIST).then(|| {
        let message =
            format!("an element of beam {} is turned by {:.1} degrees from end to end", beam.name, angle.to_degrees());
        let most = format!("the limit is {} degrees an element", LARGEST_BEND.to_degrees().round());
        let help = format!("{most}: take more elements; the `turn` of a section is in rad");
        document.diagnostic(document.place(twist), &message, "by its section", &help)
    })
}
