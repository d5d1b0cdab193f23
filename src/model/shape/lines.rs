//! The lines of beams as drawn, from what is written; and what is wrong with them, in words.

use super::{over, sections, shown, vector};
use crate::math::catenary::{Catenary, NoCatenary};
use crate::math::curve::Curve;
use crate::math::curve_defect::{CurveDefect, LARGEST_BEND, LARGEST_CORNER, LARGEST_JUMP};
use crate::math::elementary::{acos, hypot};
use crate::math::jet::Jet;
use crate::math::{Vec3, spline};
use crate::mechanics::beam::centerline::{Centerline, Spacing, shares};
use crate::mechanics::beam::division::Division;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::curve::{CurveSpec, Line, Shape};
use crate::model::file::number::Number;
use crate::model::file::reader::anchor::Along;
use crate::model::text::diagnostic::{Diagnostic, Place};
use std::f64::consts::PI;
use std::sync::Arc;

/// Cosine of the sharpest corner of a polyline: one degree from going back.
const SHARPEST_COSINE: f64 = -0.999_847_7;
/// How near two positions must be to be one, of the length of all: their round-off.
const SAME_PLACE: f64 = 1e-12;
/// A difference of positions on a curve that is none in a message, of its whole range.
const NOTHING: f64 = 1e-6;
/// More elements than this are not proposed.
pub const MOST_PROPOSED: usize = 10_000;

/// A line; none where a number in it is wrong, which is reported elsewhere.
type Drawn = Result<Option<Centerline>, Box<Diagnostic>>;

/// The lines of all beams, in file order; none where something is wrong.
#[derive(Clone, Debug, Default)]
pub struct Lines {
    lines: Vec<Option<Centerline>>,
    /// How they are divided: of a straight beam that is known without its line.
    divisions: Vec<Option<Division>>,
}

impl Lines {
    /// As far as they can be drawn.
    pub fn of(document: &Document) -> Self {
        let mut lines = Self::default();
        for beam in &document.beams {
            lines.push(
                document,
                beam,
                whole(document, beam).and_then(|count| line(document, beam, count).ok().flatten()),
            );
        }
        lines
    }

    /// Adds the line of the next beam.
    pub fn push(&mut self, document: &Document, beam: &BeamSpec, line: Option<Centerline>) {
        let is_straight = matches!(beam.line, Some(Line::Straight { .. }));
        let own = line.as_ref().map(|line| line.division.clone());
        let straight = || is_straight.then(|| whole(document, beam).map(Division::Equal)).flatten();
        self.divisions.push(own.or_else(straight));
        self.lines.push(line);
    }

    /// The line of beam `beam`.
    pub fn line(&self, beam: usize) -> Option<&Centerline> {
        self.lines.get(beam).and_then(Option::as_ref)
    }

    /// How beam `beam` is divided into elements.
    pub fn division(&self, beam: usize) -> Option<&Division> {
        self.divisions.get(beam).and_then(Option::as_ref)
    }

    /// The fraction of the arc length of beam `beam` at which a point of it is, 0 to 1.
    pub fn fraction(&self, document: &Document, beam: usize, along: Along) -> Option<f64> {
        let fraction = match along {
            Along::Start => 0.0,
            Along::End => 1.0,
            Along::Fraction(number) => document.value(number),
            Along::Node(node) => self.division(beam)?.fraction(node)?,
        };
        fraction.is_finite().then_some(fraction)
    }
}

/// The number of elements of a beam; none: it is wrong, which is reported elsewhere.
pub fn whole(document: &Document, beam: &BeamSpec) -> Option<usize> {
    let elements = document.value(beam.elements);
    (document.objection(beam.elements).is_none() && elements.is_finite()).then_some(elements as usize)
}

/// The line of a beam in `elements` elements.
///
/// # Errors
/// The mistake of the geometry.
pub fn line(document: &Document, beam: &BeamSpec, elements: usize) -> Drawn {
    match &beam.line {
        None => Ok(None),
        Some(Line::Straight { from, to }) => straight(document, beam, [*from, *to], elements),
        Some(Line::Laid { place, from, to, length }) => laid(document, beam, ([*from, *to], *length, *place), elements),
        Some(Line::Curved(curve)) => match &curve.shape {
            Shape::Points(points) => through(document, beam, curve, points, elements),
            Shape::Over(tight) => match over::curve(document, beam, tight)? {
                Some(found) => smooth(document, beam, curve, &found, elements),
                None => Ok(None),
            },
            Shape::Expressions { coordinates, range } => {
                let Some(found) = expressions(document, *coordinates, *range)? else { return Ok(None) };
                if curve.polyline {
                    return sampled(document, beam, curve, &found, elements);
                }
                smooth(document, beam, curve, &found, elements)
            }
        },
    }
}

/// How a beam in `elements` elements is divided; none where it cannot be drawn.
pub fn division(document: &Document, beam: &BeamSpec, elements: usize) -> Option<Division> {
    line(document, beam, elements).ok()?.map(|line| line.division)
}

/// Whether a beam of `elements` elements could be drawn and had a node at a fraction.
pub fn fits(document: &Document, beam: &BeamSpec, elements: usize, fraction: f64) -> bool {
    let is_equal = match &beam.line {
        Some(Line::Curved(curve)) => !curve.polyline && curve.spacing == Spacing::Arc,
        _ => true,
    };
    if is_equal && Division::Equal(elements).end_at(fraction).is_none() {
        return false;
    }
    matches!(line(document, beam, elements), Ok(Some(line)) if line.division.end_at(fraction).is_some())
}

fn mistake<T>(document: &Document, place: Place, message: &str, label: &str, help: &str) -> Result<T, Box<Diagnostic>> {
    Err(Box::new(document.diagnostic(place, message, label, help)))
}

fn straight(document: &Document, beam: &BeamSpec, ends: [[Number; 3]; 2], elements: usize) -> Drawn {
    let [Some(from), Some(to)] = ends.map(|end| vector(document, end)) else { return Ok(None) };
    let length = (to - from).norm();
    let place = document.place(ends[1][0]);
    if length == 0.0 {
        let message = format!("beam {} has no length", beam.name);
        return mistake(document, place, &message, "`to` must differ from `from`", "");
    }
    if !length.is_finite() {
        let message = format!("beam {} is too long to compute with", beam.name);
        return mistake(document, place, &message, "this is too far away", "");
    }
    Ok(Some(Centerline::straight(from, to, elements)))
}

/// As a line of a length hangs between two points.
fn laid(
    document: &Document,
    beam: &BeamSpec,
    (ends, length, written): ([[Number; 3]; 2], Number, Place),
    elements: usize,
) -> Drawn {
    let [Some(from), Some(to)] = ends.map(|end| vector(document, end)) else { return Ok(None) };
    let arc = document.value(length);
    if document.objection(length).is_some() || !arc.is_finite() {
        return Ok(None);
    }
    let span = to - from;
    let distance = hypot(span.x, span.y);
    let floats = floats(document, beam);
    let sign = if floats { -1.0 } else { 1.0 };
    let ground = document.water.as_ref().filter(|_| !floats).and_then(|water| {
        let depth = document.value(water.depth?);
        // The end that lies lower is on the bottom, if any is.
        let rise = rise_of_bottom(document, if from.z < to.z { from } else { to });
        Some(document.value(water.surface) - depth + rise - from.z)
    });
    let found = match Catenary::new(arc, [distance, sign * span.z], ground) {
        Ok(found) => found,
        Err(reason) => {
            let message = format!("beam {} cannot be laid from `from` to `to`", beam.name);
            let (label, help) = match reason {
                NoCatenary::Short(chord) => (
                    format!("it is {} m long, and its ends are {} m apart", shown(arc), shown(chord)),
                    "make it longer, or leave out `lay`: a beam without it is straight",
                ),
                NoCatenary::Vertical => (
                    String::from("its ends are above each other, and it would hang in a fold"),
                    "move one of the ends sideways, or leave out `lay`",
                ),
                NoCatenary::Below => (
                    String::from("one of its ends is below the bottom of the water"),
                    "raise the end, or set a larger `depth` in [water]",
                ),
                NoCatenary::Heap(most) => (
                    format!(
                        "it is {} m long, and on the bottom of the water it would lie in a heap from {} m on",
                        shown(arc),
                        shown(most)
                    ),
                    "make it shorter, or move its ends apart",
                ),
            };
            return mistake(document, written, &message, &label, help);
        }
    };
    let along = Vec3::new(span.x, span.y, 0.0) / distance;
    let coordinates = Arc::new(move |s| {
        let [x, z] = found.at(s);
        let of = |start: f64, share: f64, own: Jet| Jet {
            value: start + share * own.value,
            first: share * own.first,
            second: share * own.second,
        };
        [of(from.x, along.x, x), of(from.y, along.y, x), of(from.z, sign, z)]
    });
    let curve = Curve::new(coordinates, [0.0, arc], found.limits());
    let shape = Shape::Expressions { coordinates: ends[0], range: [length; 2] };
    let written = CurveSpec { place: written, shape, polyline: false, spacing: Spacing::Arc };
    smooth(document, beam, &written, &curve, elements)
}

/// How far the bottom of the water below `point` is above that at the origin, m.
fn rise_of_bottom(document: &Document, point: Vec3) -> f64 {
    let [along_x, along_y] = document.slope_of_bottom();
    along_x * point.x + along_y * point.y
}

/// Whether a beam weighs less than the water that it displaces.
fn floats(document: &Document, beam: &BeamSpec) -> bool {
    let (Some(water), Some(section)) = (&document.water, document.sections.get(beam.section)) else { return false };
    let Some(material) = sections::material(document, beam) else { return false };
    let [line_density, _] = sections::at_start(document, section).densities(&material);
    let diameter = sections::outer_diameter(section, |number| document.value(number)).unwrap_or(0.0);
    line_density < document.value(water.density) * PI / 4.0 * diameter * diameter
}

/// The curve that three expressions of the parameter give; none where a number is wrong.
fn expressions(
    document: &Document,
    coordinates: [Number; 3],
    range: [Number; 2],
) -> Result<Option<Curve>, Box<Diagnostic>> {
    let functions = coordinates.map(|number| document.function(number));
    let sound = coordinates.iter().chain(&range).all(|number| document.is_sound(*number));
    let [begin, end] = range.map(|number| document.value(number));
    let ascend = functions.iter().all(|function| function.objection().is_none());
    if !(sound && ascend && begin.is_finite() && end.is_finite()) {
        return Ok(None);
    }
    if begin >= end {
        let name = document.name(range[0]);
        let message = format!("`{}` does not ascend", name.strip_suffix("[1]").unwrap_or(name));
        let place = document.place(range[0]).to(document.place(range[1]));
        let label = format!("this runs from {begin} to {end}");
        return mistake(document, place, &message, &label, "a curve runs from the smaller to the greater s");
    }
    let limits = functions.iter().flat_map(|function| function.breaks([begin, end])).collect();
    let coordinates = Arc::new(move |s| functions.each_ref().map(|function| function.jet(s)));
    Ok(Some(Curve::new(coordinates, [begin, end], limits)))
}

/// Through points: straight pieces or a spline.
fn through(document: &Document, beam: &BeamSpec, curve: &CurveSpec, points: &[[Number; 3]], elements: usize) -> Drawn {
    let places: Option<Vec<Vec3>> = points.iter().map(|point| vector(document, *point)).collect();
    let Some(places) = places else { return Ok(None) };
    let place_of = |k: usize| document.place(points[k][0]).to(document.place(points[k][2]));
    let lengths: Vec<f64> = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    if let Some(k) = lengths.iter().position(|length| !length.is_finite()) {
        let message = format!("beam {} is too long to compute with", beam.name);
        return mistake(document, place_of(k + 1), &message, "this is too far away", "");
    }
    if let Some(k) = same_place(&lengths, lengths.iter().sum()) {
        let message = format!("points {} and {} of beam {} are at the same place", k + 1, k + 2, beam.name);
        return mistake(document, place_of(k + 1), &message, "another place was expected", "");
    }
    if !curve.polyline {
        return smooth(document, beam, curve, &spline::through(&places), elements);
    }
    if let Some((k, angle)) = way_back(&places) {
        let message = format!("beam {} turns back on itself at point {}", beam.name, k + 1);
        let label = format!("by {angle:.2} degrees");
        return mistake(document, place_of(k), &message, &label, "a corner turns by 179 degrees at most");
    }
    if elements < lengths.len() {
        let message = format!("beam {} has {} straight pieces and {elements} elements", beam.name, lengths.len());
        let label = format!("at least one element a piece: {} or more", lengths.len());
        return mistake(document, document.place(beam.elements), &message, &label, "");
    }
    Ok(Some(Centerline::polyline(&places, &shares(&lengths, elements))))
}

/// Straight pieces between samples of a curve, an element each.
fn sampled(document: &Document, beam: &BeamSpec, written: &CurveSpec, curve: &Curve, elements: usize) -> Drawn {
    if let Some(defect) = crate::math::curve_defect::of_length(curve) {
        return defective(document, beam, written, curve, &defect, elements);
    }
    let ends = written.spacing.ends(curve, elements);
    let places: Vec<Vec3> = ends.iter().map(|s| curve.at(*s)[0]).collect();
    let at_s = |k: usize| format!("s = {}", shown_in(curve.range, ends[k]));
    let lengths: Vec<f64> = places.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
    if let Some(k) = same_place(&lengths, curve.length()) {
        let message = format!("nodes {k} and {} of beam {} are at the same place", k + 1, beam.name);
        let label = format!("at {} and {}", at_s(k), at_s(k + 1));
        let help = "between nodes a polyline is straight: with more elements they come apart";
        return mistake(document, written.place, &message, &label, help);
    }
    if let Some((k, angle)) = way_back(&places) {
        let message = format!("beam {} turns back on itself at node {k}", beam.name);
        let label = format!("by {angle:.2} degrees at {}", at_s(k));
        let help = "between nodes a polyline is straight: a corner turns by 179 degrees at most";
        return mistake(document, written.place, &message, &label, help);
    }
    Ok(Some(Centerline::polyline(&places, &vec![1; elements])))
}

/// The first piece that has no length beside the `whole`, m.
fn same_place(lengths: &[f64], whole: f64) -> Option<usize> {
    lengths.iter().position(|length| *length <= SAME_PLACE * whole)
}

/// The first corner at which a polyline turns back on itself, and its angle, degrees.
fn way_back(places: &[Vec3]) -> Option<(usize, f64)> {
    let corner = |k: &usize| {
        let (before, after) = (places[*k] - places[k - 1], places[k + 1] - places[*k]);
        before.normalize().dot(&after.normalize())
    };
    let k = (1..places.len() - 1).find(|k| corner(k) < SHARPEST_COSINE)?;
    Some((k, acos(corner(&k).clamp(-1.0, 1.0)).to_degrees()))
}

fn smooth(document: &Document, beam: &BeamSpec, written: &CurveSpec, curve: &Curve, elements: usize) -> Drawn {
    match Centerline::curved(curve, written.spacing, elements) {
        Ok(line) => Ok(Some(line)),
        Err(defect) => defective(document, beam, written, curve, &defect, elements),
    }
}

/// What is wrong with a curve, in words.
fn defective(
    document: &Document,
    beam: &BeamSpec,
    written: &CurveSpec,
    curve: &Curve,
    defect: &CurveDefect,
    elements: usize,
) -> Drawn {
    let name = &beam.name;
    let is_spline = matches!(written.shape, Shape::Points(_));
    let at = |s: f64| match &written.shape {
        Shape::Points(points) => point_near(document, points, s),
        Shape::Expressions { .. } | Shape::Over(_) => format!("s = {}", shown_in(curve.range, s)),
    };
    let (message, label, help) = match *defect {
        CurveDefect::NoLength => (
            format!("the curve of beam {name} has no length"),
            String::from("all of it is at one place"),
            String::new(),
        ),
        CurveDefect::NotFinite { s } => (
            format!("the curve of beam {name} is not finite at {}", at(s)),
            String::new(),
            String::from(match is_spline {
                true => "the points are too far apart to compute with",
                false => "x, y, z and their derivatives must be finite from the first s to the last",
            }),
        ),
        CurveDefect::Unmeasured { s } => (
            format!("the length of the curve of beam {name} could not be found"),
            format!("it is not finite, or the curve is too wild, near {}", at(s)),
            String::from("a curve may not reach a pole, nor oscillate faster than its elements can follow"),
        ),
        CurveDefect::Cusp { s } => (
            format!("the curve of beam {name} has no tangent at {}", at(s)),
            String::from("its derivative is zero there"),
            String::from(match is_spline {
                true => {
                    "a spline through points that lead back the way they came turns on the spot: move them, or add others"
                }
                false => "a cusp, or a parameter that stops: the derivatives of x, y and z must not all be 0",
            }),
        ),
        CurveDefect::Jump { s, size, length } => (
            format!("the curve of beam {name} jumps at {}", at(s)),
            format!("by {} m", shown(size)),
            format!(
                "pieces must meet to {} % of an element's length, here {} m",
                100.0 * LARGEST_JUMP,
                shown(LARGEST_JUMP * length)
            ),
        ),
        CurveDefect::Corner { s, angle } => (
            format!("the curve of beam {name} has a corner at {}", at(s)),
            format!("of {} degrees", shown(angle.to_degrees())),
            format!(
                "a smooth beam may have corners of {} degrees; with polyline = true straight pieces are welded at corners",
                LARGEST_CORNER.to_degrees().round()
            ),
        ),
        CurveDefect::Bend { range, angle } => {
            let message = format!("an element of beam {name} turns by {:.1} degrees", angle.to_degrees());
            let [from, to] = range.map(|s| shown_in(curve.range, s));
            let label = format!("from s = {from} to s = {to}");
            let most = format!("an element can turn by at most {} degrees", LARGEST_BEND.to_degrees().round());
            let help = match enough(curve, written.spacing, elements, angle) {
                Some(count) => format!("{most}: take elements = {count}"),
                None => most,
            };
            return mistake(document, document.place(beam.elements), &message, &label, &help);
        }
    };
    mistake(document, written.place, &message, &label, &help)
}

/// A parameter as a message shows it: what is nothing beside the range is 0.
fn shown_in([begin, end]: [f64; 2], s: f64) -> String {
    shown(if s.abs() < NOTHING * (end - begin) { 0.0 } else { s })
}

/// The point, or the points between which a spline has the parameter `s`, its chord length, m.
fn point_near(document: &Document, points: &[[Number; 3]], s: f64) -> String {
    let places: Vec<Vec3> = points.iter().map(|point| Vec3::from(document.vector(*point))).collect();
    let mut chords = vec![0.0];
    chords.extend(places.windows(2).scan(0.0, |sum, pair| {
        *sum += (pair[1] - pair[0]).norm();
        Some(*sum)
    }));
    let near = NOTHING * chords[chords.len() - 1];
    match chords.iter().position(|chord| (chord - s).abs() <= near) {
        Some(k) => format!("point {}", k + 1),
        None => {
            let k = chords.partition_point(|chord| *chord < s).clamp(1, chords.len() - 1);
            format!("a place between points {k} and {}", k + 1)
        }
    }
}

/// Attempts at a number of elements that is hardly more than is needed.
const CAREFUL: u32 = 4;

/// A number of elements, more than `elements`, none of which turns too far; with so many one turns by `angle`, rad.
fn enough(curve: &Curve, spacing: Spacing, elements: usize, mut angle: f64) -> Option<usize> {
    let mut count = elements;
    for attempt in 0.. {
        // A sharp bend keeps its angle while elements become shorter: counts that grow by one would take thousands of
        // attempts.
        let least = if attempt < CAREFUL { count + 1 } else { 2 * count };
        count = usize::max(least, (count as f64 * angle / LARGEST_BEND).ceil() as usize);
        if count > MOST_PROPOSED {
            return None;
        }
        match Centerline::curved(curve, spacing, count) {
            Ok(_) => return Some(count),
            Err(CurveDefect::Bend { angle: still, .. }) => angle = still,
            Err(_) => return None,
        }
    }
    None
}
