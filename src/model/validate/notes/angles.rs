//! Angles in degrees where radians are meant.

use super::Note;
use crate::math::integral::integral;
use crate::model::expression::function::Function;
use crate::model::file::document::Document;
use crate::model::file::entries::drive::Motion;
use crate::model::file::entries::frame::Orientation;
use crate::model::file::entries::joint::Coordinate;
use crate::model::file::entries::simulation::Analysis;
use crate::model::file::number::Number;

/// Angles of a half or a full turn and their usual parts, in degrees. As radians, each is several turns and no special
/// position.
const DEGREES: [f64; 9] = [30.0, 45.0, 60.0, 90.0, 120.0, 135.0, 180.0, 270.0, 360.0];
/// Rates in degrees per second, of a motion that is uniform. 30, 60 and 120 rad/s are usual speeds of shafts.
const DEGREES_PER_SECOND: [f64; 5] = [45.0, 90.0, 180.0, 270.0, 360.0];
/// Relative distance from such an angle, and from standing still: round-off of an expression.
const ROUND_OFF: f64 = 1e-9;
/// The same for an angle that is the integral of a rate.
const OF_INTEGRAL: f64 = 1e-6;

/// Names angles that are usual ones in degrees.
pub fn odd_angles(document: &Document) -> Vec<Note> {
    // The parameter of a path ends anywhere.
    let turning = turning_parts(document).into_iter().filter(|_| !document.follows_arc_length());
    turning.filter_map(|(number, turn)| reached(document, number, turn)).chain(limits(document)).collect()
}

/// How a number turns something.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    /// It is the angle.
    Angle,
    /// It is the rate of the angle.
    Rate,
}

/// The motions of drives and frames.
fn turning_parts(document: &Document) -> Vec<(Number, Turn)> {
    let drives = document.drives.iter().filter(|drive| drive.is_angle() && !drive.input);
    let drives = drives.map(|drive| match drive.motion {
        Motion::Value(number) => (number, Turn::Angle),
        Motion::Rate(number) => (number, Turn::Rate),
    });
    let frames = document.frames.iter().filter(|frame| !frame.input).filter_map(|frame| match frame.orientation {
        Orientation::Rotation(numbers) => Some(numbers),
        Orientation::Quaternion(_) => None,
    });
    drives.chain(frames.flatten().map(|number| (number, Turn::Angle))).collect()
}

/// Tells a motion that comes to rest, or in statics ends, at an angle that is one in degrees, or that reaches it at a
/// rate that is one in degrees per second. A shaft that turns on otherwise may stop anywhere.
fn reached(document: &Document, number: Number, turn: Turn) -> Option<Note> {
    let stop = document.value(document.simulation.stop);
    let is_static = document.simulation.analysis == Analysis::Static;
    let function = document.function(number);
    let (angle, rate, tolerance) = match turn {
        Turn::Angle => (function.value(stop), function.jet(stop).first, ROUND_OFF),
        Turn::Rate => (turned(&function, stop), function.value(stop), OF_INTEGRAL),
    };
    let is_still = is_static || rate.abs() * stop <= tolerance * angle.abs();
    let is_uniform =
        near(rate, &DEGREES_PER_SECOND, ROUND_OFF).is_some() && (angle - rate * stop).abs() <= tolerance * angle.abs();
    let round = near(angle, &DEGREES, tolerance).filter(|_| is_still || is_uniform)?;
    let turns = angle.abs() / std::f64::consts::TAU;
    let what = match (turn, is_still) {
        (Turn::Angle, _) => format!("reaches {round} rad, {turns:.1} turns"),
        (Turn::Rate, true) => format!("turns by {round} rad, {turns:.1} turns"),
        (Turn::Rate, false) => format!("is {} rad/s, {turns:.1} turns until the end", rate.abs()),
    };
    let write = if turn == Turn::Rate && !is_still { rate.abs() } else { round };
    Some(Note::of(document, number, &format!("{what}. Angles are in radians: {write} degrees are \"{write}*pi/180\"")))
}

/// The integral of a rate from 0 to `stop`, piece by piece.
fn turned(rate: &Function, stop: f64) -> f64 {
    let breaks = rate.breaks([0.0, stop]);
    let ends = breaks.into_iter().filter(|time| 0.0 < *time && *time < stop).chain([stop]);
    let mut from = 0.0;
    ends.map(|to| {
        // At its end a piece is over.
        let piece = integral(&|time: f64| rate.value(time.min(to.next_down())), from, to);
        from = to;
        piece
    })
    .sum()
}

/// Stops of joints, angles of springs at rest, and pretwists: numbers that are angles.
fn limits(document: &Document) -> Vec<Note> {
    let is_angle = |coordinate: Coordinate| coordinate == Coordinate::Angle;
    let stops = document.stops.iter().filter(|stop| is_angle(stop.action.coordinate()));
    let rests = document.springs.iter().filter(|spring| is_angle(spring.action.coordinate()));
    let pretwists = document.beams.iter().map(|beam| beam.pretwist);
    let numbers = stops.flat_map(|stop| stop.lower.into_iter().chain(stop.upper));
    let numbers = numbers.chain(rests.filter_map(|spring| spring.rest)).chain(pretwists);
    let note = |number: Number| {
        let angle = document.value(number);
        let round = near(angle, &DEGREES, ROUND_OFF)?;
        let text = format!(
            "= {angle} rad, {:.1} turns. Angles are in radians: {round} degrees are \"{round}*pi/180\"",
            round / std::f64::consts::TAU
        );
        Some(Note::of(document, number, &text))
    };
    numbers.filter_map(note).collect()
}

/// The one of `list` that the size of `value` is.
fn near(value: f64, list: &[f64], tolerance: f64) -> Option<f64> {
    list.iter().copied().find(|round| (value.abs() - round).abs() <= tolerance * round)
}
