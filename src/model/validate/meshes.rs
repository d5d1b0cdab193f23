//! The elements of beams whose file leaves their number to the program: so many that most models are right with them,
//! nodes where joints need them, and where forces act at points if that takes few elements: the shape has a kink in its
//! curvature there, which no element has inside. They are short enough to lie on round surfaces that the beam may
//! touch. A run makes them finer where they are too few.

use super::super::file::document::Document;
use super::super::file::entries::beam::{BeamSpec, FEWEST_ELEMENTS};
use super::super::file::entries::contact::ContactSpec;
use super::super::file::entries::joint::JointSpec;
use super::super::file::reader::anchor::{Along, Anchor, Spot};
use super::super::shape::{fits, lines};
use crate::math::vectors::angle_between;
use crate::mechanics::beam::centerline::Centerline;

/// Angle that an element turns by as drawn, rad, at most: a ring of 16 elements is right to 1 %.
const LARGEST_ANGLE: f64 = 25.0 * std::f64::consts::PI / 180.0;
/// Longest element on something round, over its radius: with longer ones a rope that runs onto it loses percents of its
/// way.
pub(super) const LONGEST: f64 = 0.6;
/// A shape that is bent more in one part than in others has up to so many times the elements of an even one.
const MOST_TIMES_FOR_BENDS: usize = 4;
/// A count is sought up to so many times the one that the shape asks for.
const MOST_TIMES: usize = 8;
/// The same, for nodes where forces act: a finer mesh does without them.
const MOST_TIMES_FOR_FORCES: usize = 4;

/// Chooses the elements of all beams that the file gives none.
pub(super) fn choose(document: &mut Document) {
    for number in 0..document.beams.len() {
        let beam = &document.beams[number];
        if beam.is_meshed_by_program
            && let Some(count) = count(document, number, beam)
        {
            document.choose_elements(number, count);
        }
    }
}

/// The elements of a beam; none: its line is wrong, which is reported elsewhere.
fn count(document: &Document, number: usize, beam: &BeamSpec) -> Option<usize> {
    let fewest = FEWEST_ELEMENTS as usize;
    let drawn = |count: usize| lines::line(document, beam, count).ok().flatten();
    let line = (0..MOST_TIMES).find_map(|times| drawn(fewest << times))?;
    let pretwist = document.value(beam.pretwist).abs();
    let angle = turns(&line).sum::<f64>().max(if pretwist.is_finite() { pretwist } else { 0.0 });
    // The round-off of a full turn makes no further element.
    let even = fewest.max((angle / LARGEST_ANGLE - 1e-9).ceil() as usize);
    let bent = bent(even, drawn);
    let length: f64 = line.spans.iter().map(|span| span.length).sum();
    let least = bent.max(touching(document, number, length).min(MOST_TIMES * bent));
    let held: Vec<f64> = held_fractions(document, number);
    let is_right = |count: &usize| match held.is_empty() {
        true => drawn(*count).is_some(),
        false => held.iter().all(|fraction| fits(document, beam, *count, *fraction)),
    };
    let forces = pushed_fractions(document, number);
    let is_best =
        |count: &usize| is_right(count) && forces.iter().all(|fraction| fits(document, beam, *count, *fraction));
    let best = (least..=MOST_TIMES_FOR_FORCES * least).find(is_best).filter(|_| !forces.is_empty());
    best.or_else(|| (least..=MOST_TIMES * least).find(is_right)).or(Some(least))
}

/// The angles by which the elements of a line turn as drawn, rad.
fn turns(line: &Centerline) -> impl Iterator<Item = f64> {
    line.spans.iter().map(|span| angle_between(&line.nodes[span.node].tangent, &line.nodes[span.node + 1].tangent))
}

/// A number of elements from `even` on none of which turns by more than [`LARGEST_ANGLE`]: a strap that is straight but
/// for half a turn around a drum needs as short ones there as one that is all around it. Sharp bends end the search.
fn bent(even: usize, drawn: impl Fn(usize) -> Option<Centerline>) -> usize {
    let mut count = even;
    loop {
        let Some(line) = drawn(count) else { return count };
        let most = turns(&line).fold(0.0, f64::max) / LARGEST_ANGLE - 1e-9;
        let next = count.max((most * count as f64).ceil() as usize);
        if next == count {
            return count;
        }
        if next > MOST_TIMES_FOR_BENDS * even {
            return even;
        }
        count = next;
    }
}

/// The number of elements of a beam of length `length`, m, that are short enough to lie on what is round.
fn touching(document: &Document, number: usize, length: f64) -> usize {
    let surfaces = document.contacts.iter().flat_map(ContactSpec::pairs).filter(|(beam, _)| *beam == number);
    // One that is wrong is not there, which is reported elsewhere.
    let known = surfaces.filter_map(|(_, surface)| document.surfaces.get(surface));
    let radii = known.filter_map(|surface| surface.shape.bending_radius(|number| document.value(number)));
    let smallest = radii.filter(|radius| *radius > 0.0).reduce(f64::min);
    smallest.map_or(0, |radius| (length / (LONGEST * radius) - 1e-9).ceil() as usize)
}

/// Fractions of a beam at which joints hold on to nodes.
fn held_fractions(document: &Document, number: usize) -> Vec<f64> {
    fractions(document, number, document.joints.iter().flat_map(JointSpec::held))
}

/// Fractions of a beam at which springs, actuators and loads act.
fn pushed_fractions(document: &Document, number: usize) -> Vec<f64> {
    fractions(document, number, document.anchors_of_forces())
}

/// The fractions of a beam that `anchors` name.
fn fractions(document: &Document, number: usize, anchors: impl Iterator<Item = Anchor>) -> Vec<f64> {
    let fractions = anchors.filter_map(|anchor| match anchor.spot {
        Spot::Beam { beam, along: Along::Fraction(fraction) } if beam == number => Some(document.value(fraction)),
        _ => None,
    });
    fractions.filter(|fraction| (0.0..=1.0).contains(fraction)).collect()
}
