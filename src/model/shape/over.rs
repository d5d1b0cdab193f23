//! The line of a beam that is drawn tight over surfaces.

use super::contacts::{contact_radius, own_radius};
use super::{carriers, shown, vector};
use crate::math::curve::Curve;
use crate::math::elementary::asin;
use crate::math::jet::Jet;
use crate::math::tight_line::{NoWay, TightLine, Wheel};
use crate::math::{Mat3, Vec3};
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::contact::ContactSpec;
use crate::model::file::entries::curve::TightSpec;
use crate::model::file::entries::surface::{Shape, SurfaceSpec};
use crate::model::file::reader::anchor::Spot;
use crate::model::text::diagnostic::Diagnostic;
use std::f64::consts::TAU;
use std::sync::Arc;

/// Sine of the angle between two axes that are one direction but for round-off.
const SAME_DIRECTION: f64 = 1e-9;

/// A surface as drawn.
struct Round<'a> {
    spec: &'a SurfaceSpec,
    middle: Vec3,
    axes: Mat3,
    /// Radius of the axis of the beam on it, m.
    radius: f64,
}

/// The curve of a beam over surfaces; none where a number is wrong, which is reported elsewhere.
///
/// # Errors
/// Why there is no such line.
pub fn curve(document: &Document, beam: &BeamSpec, written: &TightSpec) -> Result<Option<Curve>, Box<Diagnostic>> {
    let mut rounds = Vec::new();
    for surface in &written.over {
        match round(document, beam, written, *surface)? {
            Some(round) => rounds.push(round),
            None => return Ok(None),
        }
    }
    let Some(first) = rounds.first() else { return Ok(None) };
    let axes = first.axes;
    of_one_direction(document, written, &rounds)?;
    // Components along and across the axes, from the middle of the first surface.
    let own = |point: Vec3| axes.tr_mul(&(point - first.middle));
    let turns = written.turns.clone().unwrap_or_else(|| outside(&rounds, &axes));
    let wheels = rounds.iter().zip(&turns).map(|(round, turn)| {
        let sense = turn.signum() as f64 * round.axes.column(0).dot(&axes.column(0)).signum();
        let middle = own(round.middle);
        Wheel { center: [middle.y, middle.z], radius: sense * round.radius, laps: turn.unsigned_abs() as u32 - 1 }
    });
    let ends = match written.ends.map(|ends| ends.map(|end| vector(document, end))) {
        None => None,
        Some([Some(from), Some(to)]) => Some([own(from), own(to)]),
        Some(_) => return Ok(None),
    };
    let mut wheels: Vec<Wheel> = wheels.collect();
    if let Some([from, to]) = ends {
        let point = |end: Vec3| Wheel { center: [end.y, end.z], radius: 0.0, laps: 0 };
        wheels.insert(0, point(from));
        wheels.push(point(to));
    }
    let line = match TightLine::over(&wheels, ends.is_none()) {
        Ok(line) => line,
        Err(NoWay(span)) => return Err(no_way(document, beam, written, span)),
    };
    if !line.length.is_finite() || line.length == 0.0 {
        let [what, label] = match line.length == 0.0 {
            true => ["has no length", "these are too small"],
            false => ["is too long to compute with", "these are too far away"],
        };
        let message = format!("the curve of beam {} {what}", beam.name);
        return Err(mistake(document, written, &message, label, ""));
    }
    if written.turns.is_none()
        && let Some(inside) = inside(&line, &rounds)
    {
        let message = format!("the curve of beam {} does not go around all surfaces from outside", beam.name);
        let label = format!("surface {} is not at the outside of them, in this order", rounds[inside].spec.name);
        let help = "list the surfaces as a belt around them meets them, or give the `turns`: 1 or -1 for each";
        return Err(mistake(document, written, &message, &label, help));
    }
    let (height, rise) = ends.map_or((0.0, 0.0), |[from, to]| (from.x, (to.x - from.x) / line.length));
    let first_wheel = usize::from(ends.is_some());
    for (wheel, arc) in line.arcs() {
        let round = &rounds[wheel - first_wheel];
        let heights = arc.map(|s| height + rise * s - own(round.middle).x);
        if let Some(beside) = beside(document, round, heights) {
            let message = format!("the curve of beam {} runs beside surface {}", beam.name, round.spec.name);
            let label = format!("{} m from its middle along its axis", shown(beside));
            let help = match ends {
                Some(_) => "move `from` and `to` along the axis: between them the curve rises evenly",
                None => "move the surfaces along their axes: a closed curve is in the plane of the first surface",
            };
            return Err(mistake(document, written, &message, &label, help));
        }
    }
    let (origin, range, limits) = (first.middle, [0.0, line.length], line.limits());
    let coordinates = Arc::new(move |s| {
        let [position, first, second] = line.at(s);
        let value = origin + axes * Vec3::new(height + rise * s, position[0], position[1]);
        let first = axes * Vec3::new(rise, first[0], first[1]);
        let second = axes * Vec3::new(0.0, second[0], second[1]);
        [0, 1, 2].map(|i| Jet { value: value[i], first: first[i], second: second[i] })
    });
    Ok(Some(Curve::new(coordinates, range, limits)))
}

/// A mistake of the surfaces that are written.
#[cold]
fn mistake(document: &Document, written: &TightSpec, message: &str, label: &str, help: &str) -> Box<Diagnostic> {
    Box::new(document.diagnostic(written.location, message, label, help))
}

/// Refuses surfaces whose axes have different directions.
fn of_one_direction(document: &Document, written: &TightSpec, rounds: &[Round<'_>]) -> Result<(), Box<Diagnostic>> {
    let first = &rounds[0];
    let sine = |round: &Round<'_>| round.axes.column(0).cross(&first.axes.column(0)).norm();
    let Some(other) = rounds.iter().find(|round| sine(round) > SAME_DIRECTION) else { return Ok(()) };
    let message = format!("the axes of surfaces {} and {} have different directions", first.spec.name, other.spec.name);
    let label = format!("they are {:.3} degrees apart", asin(sine(other).min(1.0)).to_degrees());
    let help = "beam curves run over surfaces whose axes have one direction; give `points` instead";
    Err(mistake(document, written, &message, &label, help))
}

/// A surface; none where a number is wrong.
fn round<'a>(
    document: &'a Document,
    beam: &BeamSpec,
    written: &TightSpec,
    surface: usize,
) -> Result<Option<Round<'a>>, Box<Diagnostic>> {
    let Some(spec) = document.surfaces.get(surface) else { return Ok(None) };
    let Some(own) = spec.shape.winding_radius() else {
        let message = format!("beam {} cannot be wound around surface {}", beam.name, spec.name);
        let help = "`over` takes cylinders, from outside, and sheaves";
        return Err(mistake(document, written, &message, "beam curves do not run around this shape", help));
    };
    let distance = match written.radius {
        Some(radius) => document.value(radius),
        None => distance(document, beam, surface),
    };
    let axes = spec.axes(&document.numbers);
    let offset = spec.offset(&document.numbers);
    let on_carrier = || Some(carriers::position(document, spec.on)? + carriers::axes(document, spec.on)? * offset);
    let Some(middle) = (if spec.on == Spot::Ground { Some(offset) } else { on_carrier() }) else { return Ok(None) };
    let radius = document.value(own) + distance;
    // A position that is no number is reported where it is written.
    let is_known = !middle.iter().any(|part| part.is_nan());
    let is_sound = is_known && radius > 0.0 && radius.is_finite() && axes.iter().all(|part| part.is_finite());
    Ok(is_sound.then_some(Round { spec, middle, axes, radius }))
}

/// Distance of the beam's axis from a surface that it touches, m.
fn distance(document: &Document, beam: &BeamSpec, surface: usize) -> f64 {
    let Some(beam) = document.beams.iter().position(|own| own.name == beam.name) else { return 0.0 };
    let is_of_both = |contact: &&ContactSpec| contact.pairs().any(|pair| pair == (beam, surface));
    let contact = document.contacts.iter().find(is_of_both);
    contact.map_or_else(|| own_radius(document, beam), |contact| contact_radius(document, contact, beam))
}

/// The turns of a belt that is around all surfaces from outside, in their order.
fn outside(rounds: &[Round<'_>], axes: &Mat3) -> Vec<i64> {
    let middles: Vec<Vec3> = rounds.iter().map(|round| axes.tr_mul(&round.middle)).collect();
    let next = |k: usize| &middles[(k + 1) % middles.len()];
    let area: f64 = (0..middles.len()).map(|k| middles[k].y * next(k).z - middles[k].z * next(k).y).sum();
    let sense = |round: &Round<'_>| round.axes.column(0).dot(&axes.column(0)).signum() as i64;
    let whole = if area < 0.0 { -1 } else { 1 };
    rounds.iter().map(|round| whole * sense(round)).collect()
}

/// The surface with the longest arc where a closed line makes a loop: its arcs are more than one whole turn.
fn inside(line: &TightLine, rounds: &[Round<'_>]) -> Option<usize> {
    let angles = || line.arcs().map(|(wheel, [begin, end])| (wheel, (end - begin) / rounds[wheel].radius));
    let is_loop = angles().map(|(_, angle)| angle).sum::<f64>() > 1.5 * TAU;
    let longest = angles().max_by(|a, b| a.1.total_cmp(&b.1)).map(|(wheel, _)| wheel);
    longest.filter(|_| is_loop)
}

/// How far the arc on a surface is from its middle where that is too far, m.
fn beside(document: &Document, round: &Round<'_>, heights: [f64; 2]) -> Option<f64> {
    let half = match round.spec.shape {
        Shape::Cylinder { length: Some(length), .. } => 0.5 * document.value(length),
        Shape::Sheave { groove, .. } => document.value(groove),
        _ => f64::INFINITY,
    };
    let far = heights[0].abs().max(heights[1].abs());
    (far > half).then_some(far)
}

/// Two neighbors without a common tangent.
fn no_way(document: &Document, beam: &BeamSpec, written: &TightSpec, span: usize) -> Box<Diagnostic> {
    let count = written.over.len();
    let name = |surface: usize| format!("surface {}", document.surfaces[written.over[surface]].name);
    let [from, to] = match written.ends {
        None => [name(span), name((span + 1) % count)],
        Some(_) => [span, span + 1].map(|seat| match seat {
            0 => String::from("`from`"),
            seat if seat > count => String::from("`to`"),
            seat => name(seat - 1),
        }),
    };
    let message = format!("the curve of beam {} has no way from {from} to {to}", beam.name);
    let label = "they overlap, or one of them is inside the other";
    mistake(document, written, &message, label, "move them apart, or take smaller radii")
}
